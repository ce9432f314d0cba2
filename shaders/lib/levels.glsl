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
const float LEAST_BASE = 0.35;  // of a side

// The largest l1 l2 base + (l1 + l2) l3 side, where l1 + l2 + l3 = 1.
float isosceles(float base, float side) {
    return base < 2.0 * side ? side * side / (4.0 * side - base) : base * 0.25;
}

float parabola(float a, float b, float c, float t) {
    return mix(mix(a, b, t), mix(b, c, t), t);
}

// What bends along edges (1, y), y from 0 to t, and (x, t), x from 0 to 1, that rise or fall: the
// middle points of both Bezier forms, and the last of both.
vec3 around(Bends s, int way, float t) {
    vec3 from_u = s.from_u[way], from_v = s.from_v[way], edge = s.edge[way];
    float low = s.slopes.x, high = s.slopes.z;
    if (t < low) {
        float share = t / low;
        return vec3(mix(s.uu, from_u.x, share), t * mix(s.uv, from_v.x, share),
                    parabola(s.uu, from_u.x, edge.x, share));
    }
    if (t > high) {
        float share = high / t;
        return vec3(
            t * mix(s.uv, from_u.z / high, share), t * t * mix(s.vv, from_v.z / high, share),
            t * t * parabola(s.vv, from_v.z / high, edge.z / (high * high), share));
    }
    bool upper = t > s.slopes.y;
    vec2 ends = upper ? s.slopes.yz : s.slopes.xy;
    float share = (t - ends.x) / (ends.y - ends.x);
    if (upper)
        return vec3(mix(from_u.y, from_u.z, share), t * mix(from_v.y, from_v.z, share),
                    parabola(edge.y, s.between[way].y, edge.z, share));
    return vec3(mix(from_u.x, from_u.y, share), t * mix(from_v.x, from_v.y, share),
                parabola(edge.x, s.between[way].x, edge.y, share));
}

float most_of(vec2 v, vec3 w) {
    return max(max(v.x, v.y), max(w.x, max(w.y, w.z)));
}

// The largest |f''[e, e]| of edges e = (x, y), |x| <= 1 and |y| <= t, that rise and that fall.
vec2 edge_bend(Bends s, float t) {
    vec2 pure = vec2(s.uu, t * t * s.vv);
    return vec2(most_of(pure, around(s, 0, t)), most_of(pure, around(s, 1, t)));
}

// The same of edges half as long in one of both directions.
vec2 back_bend(Bends s, float t) {
    vec2 pure = vec2(s.uu, t * t * s.vv), found;
    for (int way = 0; way < 2; ++way) {
        vec3 last = around(s, way, t);
        vec2 lines = mix(pure, last.xy, 0.5);
        vec2 curves = vec2(parabola(pure.x, last.x, last.z, 0.5), parabola(pure.y, last.y, last.z, 0.5));
        found[way] = most_of(pure, vec3(max(lines, curves), 0.0));
    }
    return found;
}

// How much of the tolerance these steps in u and v use up, where pixels are `scale` times as many,
// 1 being all, with triangles cut along diagonals that rise, or that fall. Without ONE_WAY they may
// be cut either way.
vec2 shares_used(Bends s, float scale, vec2 steps, float tolerance) {
    vec2 h = 1.0 / steps;
    vec3 squares = vec3(h.x * h.x, 2.0 * h.x * h.y, h.y * h.y) * 0.125;
    float t = h.y / h.x;
    vec2 side = edge_bend(s, t), base = vec2(max(s.uu, t * t * s.vv));
#ifdef ONE_WAY
    side = max(side, back_bend(s, t).yx);
    base = max(base, LEAST_BASE * side);
#else
    side = vec2(max(side.x, side.y));
#endif
    vec2 bend = vec2(isosceles(base.x, side.x), isosceles(base.y, side.y)) * 0.5 * h.x * h.x
        + dot(s.spread, squares);
    float weight = dot(s.weight, squares), growth = dot(s.growth, h);
    float ratio = min(1.0 / max(1.0 - growth, TINY), s.ratio);
    float moved = min(dot(s.speed, h) / 3.0, s.extent);
    float skew = ratio * growth / 6.0;
    float uneven = min(ratio, 1.0 + skew * skew + ratio * weight * 4.0 / 3.0);
    vec2 off = bend * uneven + ratio * weight * moved;
    return s.ratio < NEVER ? scale * off / tolerance : vec2(NEVER);
}

// About how many pixels a unit of a texture map is long: the larger of along u and v.
float pixels_a_unit(Bends seen, Bends sought) {
    return max(sought.leg.x > 0.0 ? seen.leg.x / sought.leg.x : 0.0,
               sought.leg.y > 0.0 ? seen.leg.y / sought.leg.y : 0.0);
}

// Rising and falling.
vec2 ways_used(Bends seen, Bends sought, float unit, vec2 steps, float tolerance) {
    return shares_used(seen, 1.0, steps, tolerance) + shares_used(sought, unit, steps, tolerance);
}

// The better of both.
float both_used(Bends seen, Bends sought, float unit, vec2 steps, float tolerance) {
    vec2 ways = ways_used(seen, sought, unit, steps, tolerance);
    return min(ways.x, ways.y);
}

// Steps of the same slope, too few if those given are too many, and the other way round.
vec2 enough(Bends seen, Bends sought, float unit, vec2 steps, float tolerance) {
    float times = min(sqrt(both_used(seen, sought, unit, steps, tolerance)), 1e9);
    return max(steps * times, 1.0);
}

// The steps in u and v with about the fewest triangles that keep the tolerance, and 1 if diagonals
// are to fall; `sought` is the map's, (s, t) in pixels if `unit` times as large.
vec3 fewest_steps(Bends seen, float tolerance, Bends sought, float unit) {
    if (seen.extent <= tolerance && seen.ratio < NEVER)
        return vec3(1.0, 1.0, 0.0);
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
    vec2 ways = ways_used(seen, sought, unit, steps, tolerance);
    return vec3(steps, float(ways.y < ways.x));
}
