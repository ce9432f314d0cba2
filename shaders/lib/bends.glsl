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

// A row of the net, transformed, and d/du and d2/du2 there, raised to the degree of the net.
vec4 points[MAX_ORDER], slopes_of_row[MAX_ORDER], bends_of_row[MAX_ORDER];

// From two differences on either side of control point k of 0 ... degree.
vec4 raised(vec4 before_last, vec4 before, vec4 after, vec4 after_next, int k, int degree) {
    int rest = degree - k;
    return float(k * (k - 1)) * (before - before_last) + float(2 * k * rest) * (after - before)
        + float(rest * (rest - 1)) * (after_next - after);
}

void read_row(sampler2D net, int first, int i, ivec2 degree, mat4 transform) {
    int width = degree.y + 1, rest = degree.x - i;
    for (int j = 0; j <= degree.y; ++j) {
        int at = first + i * width + j;
        int back = at - min(i, 1) * width, forth = at + min(rest, 1) * width;
        vec4 here = control_point(net, at), last = control_point(net, back),
             next = control_point(net, forth);
        vec4 before = here - last, after = next - here;
        vec4 before_last = last - control_point(net, at - min(i, 2) * width);
        vec4 after_next = control_point(net, at + min(rest, 2) * width) - next;
        points[j] = transform * here;
        slopes_of_row[j] = transform * (float(i) * before + float(rest) * after);
        bends_of_row[j] =
            transform * raised(before_last, before, after, after_next, i, degree.x);
    }
}

// d2/dv2 at control point j of the row.
vec4 second_derivative(int j, int degree) {
    int back = j - min(j, 1), forth = j + min(degree - j, 1);
    vec4 before = points[j] - points[back], after = points[forth] - points[j];
    vec4 before_last = points[back] - points[j - min(j, 2)];
    vec4 after_next = points[j + min(degree - j, 2)] - points[forth];
    return raised(before_last, before, after, after_next, j, degree);
}

// d2/dudv there.
vec4 mixed_derivative(int j, int degree) {
    vec4 before = slopes_of_row[j] - slopes_of_row[j - min(j, 1)];
    vec4 after = slopes_of_row[j + min(degree - j, 1)] - slopes_of_row[j];
    return float(j) * before + float(degree - j) * after;
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
    for (int i = 0; i <= degree.x; ++i) {
        read_row(net, first, i, degree, centred);
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 p = points[j];
            vec4 uu = bends_of_row[j];
            vec4 vv = second_derivative(j, degree.y);
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
                vec4 next = points[j + 1];
                s.leg.y = max(s.leg.y, length(next.xy / next.w - p.xy / p.w));
            }
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
    for (int i = 0; i <= degree.x; ++i) {
        read_row(net, first, i, degree, centred);
        for (int j = 0; j <= degree.y; ++j) {
            vec4 p = points[j];
            vec3 a = relative(bends_of_row[j], p, own);
            vec3 b = relative(mixed_derivative(j, degree.y), p, own);
            vec3 c = relative(second_derivative(j, degree.y), p, own);
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
