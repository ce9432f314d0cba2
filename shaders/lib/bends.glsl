// How sharply the patches of a view bend on the screen.  Twin: geometry/bends.py, where it is derived.
//
// For second derivatives A and a of x = (x, y) and w along one edge, control points raised to the
// net's degree, transformed: the largest, side by side,
//
//     |A/w| + reach |a/w|       measured from the middle of the patch, or
//     |A - a q| / w + spread    each with q = x/w, its own place.

#include "net.glsl"

const float TINY = 1e-30;
const float STEEPEST = 64.0;
const float NEVER = 1e30;

struct Bends {           // the largest lengths, in pixels; over w
    float uu, uv, vv;    // |A|, |B|, |C|
    vec3 slopes;         // three t = y/x, and there
    vec3 from_u[2];      // |A +- t B|
    vec3 from_v[2];      // |B +- t C|
    vec3 edge[2];        // |A +- 2 t B + t^2 C|
    vec2 between[2];     // |A +- (s + t) B + s t C|, s and t being neighbours
    vec3 spread;         // what is to be added for uu, uv, vv
    vec3 weight;         // |w_uu|, |w_uv|, |w_vv|
    vec2 growth;         // |w_u|, |w_v|
    vec2 speed;          // |q_u|, |q_v|; 0 if measured from the middle
    float ratio;         // of the largest w to the least; NEVER where one is not positive
    float extent;        // across all control points
    vec2 leg;            // longest |d(x,y)/d(u or v)|, by the legs of the net
    bool out_of_view;    // beyond one side of the view volume with all control points
};

Bends flat_bends() {
    vec3 none[2] = vec3[2](vec3(0.0), vec3(0.0));
    return Bends(0.0, 0.0, 0.0, vec3(0.5, 1.0, 2.0), none, none, none, vec2[2](vec2(0.0), vec2(0.0)),
                 vec3(0.0), vec3(0.0), vec2(0.0), vec2(0.0), 1.0, 0.0, vec2(0.0), false);
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

// The first derivative.
vec4 hodograph(sampler2D net, int at, int i, int degree, int stride) {
    vec4 here = control_point(net, at);
    return float(i) * (here - control_point(net, at - min(i, 1) * stride))
        + float(degree - i) * (control_point(net, at + min(degree - i, 1) * stride) - here);
}

// (A - a q) / w and a / w, of a derivative (A, a) at a control point (w q, w); or A / w with q = 0.
vec3 relative(vec4 derivative, vec4 at, bool own) {
    vec3 over = derivative.xyw / at.w;
    return vec3(own ? over.xy - over.z * at.xy / at.w : over.xy, over.z);
}

float largest(vec3 bent, vec2 reach) {
    return length(abs(bent.xy) + reach * abs(bent.z));
}

// Of edges (1, t) of triangles that bend as much along u as along v.
float likely_slope(float uu, float vv) {
    return clamp(sqrt((uu + TINY) / (vv + TINY)), 1.0 / STEEPEST, STEEPEST);
}

Bends bends(sampler2D net, int patch_index, ivec2 degree, mat4 transform, vec2 scale) {
    int width = degree.y + 1, count = (degree.x + 1) * width, first = patch_index * count;
    Bends s = flat_bends();
    vec2 low = vec2(1e30), high = vec2(-1e30);
    float least = 1e30, most = 0.0;
    bvec3 above = bvec3(true), below = bvec3(true);
    for (int k = 0; k < count; ++k) {
        vec4 p = transform * control_point(net, first + k);
        vec2 place = p.xy / (p.w > 0.0 ? p.w : 1.0);
        low = min(low, place);
        high = max(high, place);
        least = min(least, p.w);
        most = max(most, p.w);
        above = bvec3(above.x && p.x > p.w, above.y && p.y > p.w, above.z && p.z > p.w);
        below = bvec3(below.x && p.x < -p.w, below.y && p.y < -p.w, below.z && p.z < -p.w);
    }
    s.ratio = least > 0.0 ? most / least : NEVER;
    s.out_of_view = least > 0.0 && (any(above) || any(below));
    s.extent = length((high - low) * scale);
    mat4 centred = mat4(scale.x, 0.0, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
                        -(low + high) * 0.5 * scale, 0.0, 1.0) * transform;
    vec2 reach = (high - low) * 0.5 * scale, none = vec2(0.0);
    vec2 owned = vec2(0.0), whole = vec2(0.0), least_of_two = vec2(1e30), most_of_two = vec2(-1e30);
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 p = centred * control_point(net, at);
            vec4 uu = centred * second_derivative(net, at, i, degree.x, width);
            vec4 vv = centred * second_derivative(net, at, j, degree.y, 1);
            vec3 a = relative(uu, p, false), c = relative(vv, p, false);
            whole = max(whole, vec2(largest(a, reach), largest(c, reach)));
            least_of_two = min(least_of_two, vec2(a.z, c.z));
            most_of_two = max(most_of_two, vec2(a.z, c.z));
            owned = max(owned, vec2(largest(relative(uu, p, true), none),
                                    largest(relative(vv, p, true), none)));
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
    vec2 with_spread = owned + 0.25 * s.extent * (most_of_two - least_of_two);
    bool own = (with_spread.x + TINY) * (with_spread.y + TINY)
        <= (whole.x + TINY) * (whole.y + TINY);
    s.uu = own ? owned.x : whole.x;
    s.vv = own ? owned.y : whole.y;
    if (own)
        reach = none;
    s.slopes *= likely_slope(s.uu, s.vv);
    vec3 least_turn = vec3(1e30), most_turn = vec3(-1e30);
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 p = centred * control_point(net, at);
            vec3 a = relative(centred * second_derivative(net, at, i, degree.x, width), p, own);
            vec3 b = relative(centred * mixed_derivative(net, at, ivec2(i, j), degree), p, own);
            vec3 c = relative(centred * second_derivative(net, at, j, degree.y, 1), p, own);
            s.uv = max(s.uv, largest(b, reach));
            least_turn = min(least_turn, vec3(a.z, b.z, c.z));
            most_turn = max(most_turn, vec3(a.z, b.z, c.z));
            for (int way = 0; way < 2; ++way) {
                for (int k = 0; k < 3; ++k) {
                    float t = s.slopes[k];
                    s.from_u[way][k] = max(s.from_u[way][k], largest(a + t * b, reach));
                    s.from_v[way][k] = max(s.from_v[way][k], largest(b + t * c, reach));
                    s.edge[way][k] =
                        max(s.edge[way][k], largest(a + 2.0 * t * b + t * t * c, reach));
                    if (k < 2) {
                        float next = s.slopes[k + 1];
                        s.between[way][k] = max(
                            s.between[way][k],
                            largest(a + (t + next) * b + t * next * c, reach));
                    }
                }
                b = -b;
            }
        }
    s.weight = max(most_turn, -least_turn);
    int rational = most > least ? degree.x : -1;
    for (int i = 0; i <= rational; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 p = centred * control_point(net, at);
            vec3 u = relative(centred * hodograph(net, at, i, degree.x, width), p, true);
            vec3 v = relative(centred * hodograph(net, at, j, degree.y, 1), p, true);
            s.growth = max(s.growth, abs(vec2(u.z, v.z)));
            s.speed = max(s.speed, vec2(length(u.xy), length(v.xy)));
        }
    s.spread = own ? 0.25 * s.extent * (most_turn - least_turn) : vec3(0.0);
    s.speed = own ? s.speed + 0.5 * s.extent * s.growth : vec2(0.0);
    return s;
}
