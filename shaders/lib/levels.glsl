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
// over the control points A, B, C of the second derivatives uu, uv, vv, all raised to the net's
// degree, transformed.

#include "net.glsl"

const float FINEST = 4096.0;
const float TINY = 1e-30;
const float STEEPEST = 64.0;
const int SLOPES = 9;      // tried from the middle outwards
const int GROWTHS = 160;   // that lead from 1 to FINEST
const int TRIES = 6;       // one step fewer each time

struct Bends {           // the largest lengths, in pixels
    float uu, uv, vv;    // |A|, |B|, |C|
    vec3 slopes;         // three t = y/x, and there
    vec3 from_u;         // |A +- t B|
    vec3 from_v;         // |B +- t C|
    vec3 edge;           // |A +- 2 t B + t^2 C|
    vec2 between;        // |A +- (s + t) B + s t C|, s and t being neighbours
    vec3 weight;         // second derivatives of w
    float least;         // the smallest w
    float extent;        // across all control points
    vec2 leg;            // longest |d(x,y)/d(u or v)|, by the legs of the net
    bool out_of_view;    // beyond one side of the view volume with all control points
};

Bends flat_bends() {
    return Bends(0.0, 0.0, 0.0, vec3(0.5, 1.0, 2.0), vec3(0.0), vec3(0.0), vec3(0.0), vec2(0.0),
                 vec3(0.0), 1.0, 0.0, vec2(0.0), false);
}

// Control point `at`, number i along a direction in which the net has that degree and stride.
vec4 second_derivative(sampler2D net, int at, int i, int degree, int stride) {
    vec4 sum = vec4(0.0);
    int rest = degree - i;
    for (int k = max(i - 2, 0); k <= min(i, degree - 2); ++k) {
        int weight = k == i - 2 ? i * (i - 1) : k == i - 1 ? 2 * i * rest : rest * (rest - 1);
        if (weight == 0)
            continue;
        int first = at + (k - i) * stride;
        vec4 middle = control_point(net, first + stride);
        sum += float(weight) * ((control_point(net, first) - middle)
                                - (middle - control_point(net, first + 2 * stride)));
    }
    return sum;
}

vec4 mixed_derivative(sampler2D net, int at, ivec2 i, ivec2 degree) {
    vec4 sum = vec4(0.0);
    int width = degree.y + 1;
    ivec2 rest = degree - i;
    for (int k = max(i.x - 1, 0); k <= min(i.x, degree.x - 1); ++k)
        for (int l = max(i.y - 1, 0); l <= min(i.y, degree.y - 1); ++l) {
            int weight = (k < i.x ? i.x : rest.x) * (l < i.y ? i.y : rest.y);
            int first = at + (k - i.x) * width + l - i.y;
            sum += float(weight)
                * ((control_point(net, first) - control_point(net, first + 1))
                   - (control_point(net, first + width) - control_point(net, first + width + 1)));
        }
    return sum;
}

// A bound from below of w where all weights are positive: the least when degrees are raised by one.
float least_weight(sampler2D net, int first, ivec2 degree, mat4 transform) {
    float least = 1e30;
    int width = degree.y + 1;
    for (int i = 0; i <= degree.x + 1; ++i)
        for (int j = 0; j <= degree.y + 1; ++j) {
            vec2 share = vec2(i, j) / vec2(degree + 1);
            vec4 mean = vec4(0.0);
            for (int k = 0; k < 4; ++k) {
                ivec2 at = clamp(ivec2(i, j) - ivec2(k / 2, k % 2), ivec2(0), degree);
                vec2 part = mix(share, 1.0 - share, equal(ivec2(k / 2, k % 2), ivec2(0)));
                mean += part.x * part.y * control_point(net, first + at.x * width + at.y);
            }
            least = min(least, (transform * mean).w);
        }
    return least;
}

// x and y from the middle of the net, whose half extent is reach.
float size(vec4 derivative, vec2 reach) {
    return length(abs(derivative.xy) + reach * abs(derivative.w));
}

float either(vec4 a, vec4 b, vec2 reach) {
    return max(size(a + b, reach), size(a - b, reach));
}

Bends bends(sampler2D net, int patch_index, ivec2 degree, mat4 transform, vec2 scale) {
    int width = degree.y + 1, count = (degree.x + 1) * width, first = patch_index * count;
    Bends s = flat_bends();
    vec2 low = vec2(1e30), high = vec2(-1e30);
    s.least = 1e30;
    float most = 0.0;
    bvec3 above = bvec3(true), below = bvec3(true);
    for (int k = 0; k < count; ++k) {
        vec4 p = transform * control_point(net, first + k);
        vec2 place = p.xy / (p.w > 0.0 ? p.w : 1.0);
        low = min(low, place);
        high = max(high, place);
        s.least = min(s.least, p.w);
        most = max(most, p.w);
        above = bvec3(above.x && p.x > p.w, above.y && p.y > p.w, above.z && p.z > p.w);
        below = bvec3(below.x && p.x < -p.w, below.y && p.y < -p.w, below.z && p.z < -p.w);
    }
    s.out_of_view = s.least > 0.0 && (any(above) || any(below));
    s.extent = length((high - low) * scale);
    vec2 reach = (high - low) * scale * 0.5;
    if (most > s.least && s.least > 0.0)
        s.least = least_weight(net, first, degree, transform);
    mat4 centred = mat4(scale.x, 0.0, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
                        -(low + high) * 0.5 * scale, 0.0, 1.0) * transform;
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 a = centred * second_derivative(net, at, i, degree.x, width);
            vec4 c = centred * second_derivative(net, at, j, degree.y, 1);
            s.uu = max(s.uu, size(a, reach));
            s.vv = max(s.vv, size(c, reach));
            vec4 p = centred * control_point(net, at);
            if (i < degree.x) {
                vec4 next = centred * control_point(net, at + width);
                s.leg.x = max(s.leg.x, length(next.xy / next.w - p.xy / p.w));
            }
            if (j < degree.y) {
                vec4 next = centred * control_point(net, at + 1);
                s.leg.y = max(s.leg.y, length(next.xy / next.w - p.xy / p.w));
            }
        }
    s.leg *= vec2(degree);
    float slope = clamp(sqrt((s.uu + TINY) / (s.vv + TINY)), 1.0 / STEEPEST, STEEPEST);
    s.slopes *= slope;
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 a = centred * second_derivative(net, at, i, degree.x, width);
            vec4 b = centred * mixed_derivative(net, at, ivec2(i, j), degree);
            vec4 c = centred * second_derivative(net, at, j, degree.y, 1);
            s.uv = max(s.uv, size(b, reach));
            s.weight = max(s.weight, abs(vec3(a.w, b.w, c.w)));
            for (int k = 0; k < 3; ++k) {
                float t = s.slopes[k];
                s.from_u[k] = max(s.from_u[k], either(a, t * b, reach));
                s.from_v[k] = max(s.from_v[k], either(b, t * c, reach));
                s.edge[k] = max(s.edge[k], either(a + t * t * c, 2.0 * t * b, reach));
                if (k < 2) {
                    float next = s.slopes[k + 1];
                    s.between[k] =
                        max(s.between[k], either(a + t * next * c, (t + next) * b, reach));
                }
            }
        }
    return s;
}

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
    float t = steps.x / steps.y;
    float base = max(s.uu, t * t * s.vv);
    float off = isosceles(base, edge_bend(s, t)) * 0.5 / (steps.x * steps.x);
    float weight = dot(s.weight, vec3(1.0 / (steps.x * steps.x), 2.0 / (steps.x * steps.y),
                                      1.0 / (steps.y * steps.y)));
    return s.least > 0.0 ? (scale * off + tolerance * weight * 0.125) / (tolerance * s.least) : 1e30;
}

// About how many pixels a unit of a texture map is long: the larger of along u and v.
float pixels_a_unit(Bends seen, Bends sought) {
    return max(sought.leg.x > 0.0 ? seen.leg.x / sought.leg.x : 0.0,
               sought.leg.y > 0.0 ? seen.leg.y / sought.leg.y : 0.0);
}

// The steps in u and v with about the fewest triangles that keep the tolerance; `sought` is the
// map's, (s, t) in pixels if `unit` times as large.
vec2 fewest_steps(Bends seen, float tolerance, Bends sought, float unit) {
    if (seen.extent <= tolerance && seen.least > 0.0)
        return vec2(1.0);
    vec2 steps = vec2(1.0);
    float best = 1e38;
    for (int k = 0; k < SLOPES; ++k) {
        float t = seen.slopes.y * exp2(float((k + 1) / 2) * (k % 2 == 0 ? 0.5 : -0.5));
        vec2 slope = vec2(1.0, 1.0 / t);
        float used =
            share_used(seen, 1.0, slope, tolerance) + share_used(sought, unit, slope, tolerance);
        vec2 trial = max(min(sqrt(used), 1e9) * slope, 1.0);
        if (trial.x * trial.y < 0.999 * best) {
            steps = trial;
            best = trial.x * trial.y;
        }
    }
    steps = min(ceil(steps), FINEST);
    for (int k = 0; k < GROWTHS; ++k) {
        float used =
            share_used(seen, 1.0, steps, tolerance) + share_used(sought, unit, steps, tolerance);
        if (used <= 1.0)
            break;
        steps = min(steps + ceil(steps / 16.0), FINEST);
    }
    vec2 changes[4] = vec2[4](vec2(-1.0, 0.0), vec2(0.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0));
    for (int k = 0; k < TRIES; ++k) {
        vec2 now = steps;
        for (int l = 0; l < 4; ++l) {
            vec2 trial = max(now + changes[l], 1.0);
            float used =
                share_used(seen, 1.0, trial, tolerance) + share_used(sought, unit, trial, tolerance);
            if (trial.x * trial.y < steps.x * steps.y && used <= 1.0)
                steps = trial;
        }
    }
    return steps;
}
