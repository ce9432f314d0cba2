// How finely a patch must be tessellated so that no drawn point is off by more than `tolerance`
// pixels from the surface at the same parameter.  Twin: geometry/levels.py, where it is derived.
//
// A triangle whose edges go no further than hu in u and hv in v is off by no more than half of
// isosceles(base, side), with
//
//       side /\  side     the largest |x^2 A + 2 x y B + y^2 C|, |x| <= hu, |y| <= hv
//           /__\          the same of edges along u or along v
//           base
//
// over the control points A, B, C of bends.glsl, and by what w varies in it.

#include "bends.glsl"

const float FINEST = 4096.0;
const int SLOPES = 9;           // tried from the middle outwards
const float SHORT = 4096.0;     // steps that tell what a slope needs in the limit
const int REFINED = 3;          // times
const int GROWTHS = 160;        // that lead from 1 to FINEST
const int TRIES = 6;            // one step fewer each time

// The largest l1 l2 base + (l1 + l2) l3 side, where l1 + l2 + l3 = 1.
float isosceles(float base, float side) {
    return base < 2.0 * side ? side * side / (4.0 * side - base) : base * 0.25;
}

float parabola(float a, float b, float c, float t) {
    return mix(mix(a, b, t), mix(b, c, t), t);
}

// The largest |f''[e, e]| of edges e = (x, y), |x| <= 1 and |y| <= t.
float edge_bend(Bends s, float t) {
    float low = s.slopes.x, high = s.slopes.z;
    float pure = max(s.uu, t * t * s.vv);
    if (t < low) {
        float share = t / low;
        return max(pure, max(max(mix(s.uu, s.from_u.x, share), t * mix(s.uv, s.from_v.x, share)),
                             parabola(s.uu, s.from_u.x, s.edge.x, share)));
    }
    if (t > high) {
        float share = high / t;
        float from_u = t * mix(s.uv, s.from_u.z / high, share);
        float from_v = t * t * mix(s.vv, s.from_v.z / high, share);
        float edge = t * t * parabola(s.vv, s.from_v.z / high, s.edge.z / (high * high), share);
        return max(pure, max(max(from_u, from_v), edge));
    }
    bool upper = t > s.slopes.y;
    vec2 ends = upper ? s.slopes.yz : s.slopes.xy;
    vec2 from_u = upper ? s.from_u.yz : s.from_u.xy, from_v = upper ? s.from_v.yz : s.from_v.xy;
    vec2 edge = upper ? s.edge.yz : s.edge.xy;
    float share = (t - ends.x) / (ends.y - ends.x);
    return max(pure, max(max(mix(from_u.x, from_u.y, share), t * mix(from_v.x, from_v.y, share)),
                         parabola(edge.x, upper ? s.between.y : s.between.x, edge.y, share)));
}

// How much of the tolerance these steps in u and v use up, where pixels are `scale` times as many;
// 1 is all.
float share_used(Bends s, float scale, vec2 steps, float tolerance) {
    vec2 h = 1.0 / steps;
    vec3 squares = vec3(h.x * h.x, 2.0 * h.x * h.y, h.y * h.y) * 0.125;
    float t = h.y / h.x;
    float base = max(s.uu, t * t * s.vv);
    float bend = isosceles(base, edge_bend(s, t)) * 0.5 * h.x * h.x + dot(s.spread, squares);
    float weight = dot(s.weight, squares), growth = dot(s.growth, h);
    float ratio = min(1.0 / max(1.0 - growth, TINY), s.ratio);
    float moved = min(dot(s.speed, h) / 3.0, s.extent);
    float skew = ratio * growth / 6.0;
    float uneven = min(ratio, 1.0 + skew * skew + ratio * weight * 4.0 / 3.0);
    float off = bend * uneven + ratio * weight * moved;
    return s.ratio < NEVER ? scale * off / tolerance : NEVER;
}

// About how many pixels a unit of a texture map is long: the larger of along u and v.
float pixels_a_unit(Bends seen, Bends sought) {
    return max(sought.leg.x > 0.0 ? seen.leg.x / sought.leg.x : 0.0,
               sought.leg.y > 0.0 ? seen.leg.y / sought.leg.y : 0.0);
}

float both_used(Bends seen, Bends sought, float unit, vec2 steps, float tolerance) {
    return share_used(seen, 1.0, steps, tolerance) + share_used(sought, unit, steps, tolerance);
}

// Steps of the same slope, too few if those given are too many, and the other way round.
vec2 enough(Bends seen, Bends sought, float unit, vec2 steps, float tolerance) {
    float times = min(sqrt(both_used(seen, sought, unit, steps, tolerance)), 1e9);
    return max(steps * times, 1.0);
}

// The steps in u and v with about the fewest triangles that keep the tolerance; `sought` is the
// map's, (s, t) in pixels if `unit` times as large.
vec2 fewest_steps(Bends seen, float tolerance, Bends sought, float unit) {
    if (seen.extent <= tolerance && seen.ratio < NEVER)
        return vec2(1.0);
    vec3 both = vec3(seen.uu, seen.uv, seen.vv) + unit * vec3(sought.uu, sought.uv, sought.vv);
    float slope = likely_slope(both.x + both.y / 16.0, both.z + both.y / 16.0);
    vec2 steps = vec2(1.0);
    float best = 1e38;
    for (int k = 0; k < SLOPES; ++k) {
        float t = slope * exp2(float((k + 1) / 2) * (k % 2 == 0 ? 0.5 : -0.5));
        vec2 trial = SHORT * vec2(1.0, 1.0 / t);
        for (int l = 0; l < 2; ++l)
            trial = enough(seen, sought, unit, trial, tolerance);
        if (trial.x * trial.y < 0.999 * best) {
            steps = trial;
            best = trial.x * trial.y;
        }
    }
    for (int k = 0; k < REFINED; ++k)
        steps = enough(seen, sought, unit, steps, tolerance);
    steps = min(ceil(steps), FINEST);
    for (int k = 0; k < GROWTHS; ++k) {
        if (both_used(seen, sought, unit, steps, tolerance) <= 1.0)
            break;
        steps = min(steps + ceil(steps / 16.0), FINEST);
    }
    vec2 changes[4] = vec2[4](vec2(-1.0, 0.0), vec2(0.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0));
    for (int k = 0; k < TRIES; ++k) {
        vec2 now = steps;
        for (int l = 0; l < 4; ++l) {
            vec2 trial = max(now + changes[l], 1.0);
            if (trial.x * trial.y < steps.x * steps.y
                && both_used(seen, sought, unit, trial, tolerance) <= 1.0)
                steps = trial;
        }
    }
    return steps;
}
