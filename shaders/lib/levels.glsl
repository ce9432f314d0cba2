// How finely a patch must be tessellated so that no drawn point is off by more than `tolerance`
// pixels from the surface at the same parameter.  Twin: geometry/levels.py, where it is derived.
//
// A triangle that spans hu x hv of the parameter square is off by at most
//
//     (hu^2 Muu + 2 hu hv Muv + hv^2 Mvv) / 8
//
// with M the second differences of the net, times du (du-1), du dv, dv (dv-1), in pixels.

#include "net.glsl"

const float TWIST = 0.1;
const float FINEST = 4096.0;

struct Spread {          // of a net, transformed
    vec3 off;            // largest second derivatives uu, uv, vv: pixels that (x, y)/w is off by,
    vec3 off_w;          //     but for the division; and of w
    float least;         // smallest w
    vec2 leg;            // longest |d(x,y)/d(u or v)|, by the legs of the net
    bool out_of_view;    // beyond one side of the view volume with all control points
};

vec4 transformed(sampler2D net, int index, mat4 transform) {
    return transform * control_point(net, index);
}

// The middle of the net's box, and its half extent.
void box(sampler2D net, int first, int count, mat4 transform, out vec2 middle, out vec2 half_extent) {
    vec2 low = vec2(1e30), high = vec2(-1e30);
    for (int k = 0; k < count; ++k) {
        vec4 p = transformed(net, first + k, transform);
        vec2 place = p.xy / (p.w > 0.0 ? p.w : 1.0);
        low = min(low, place);
        high = max(high, place);
    }
    middle = (low + high) * 0.5;
    half_extent = (high - low) * 0.5;
}

// What a second difference is off by: x and y from the middle of the net, whose half extent is reach.
void widen(inout Spread s, int k, vec4 difference, vec2 scale, vec2 reach) {
    vec4 size = abs(difference);
    s.off[k] = max(s.off[k], length(scale * (size.xy + reach * size.w)));
    s.off_w[k] = max(s.off_w[k], size.w);
}

Spread spread(sampler2D net, int patch_index, ivec2 degree, mat4 transform, vec2 scale) {
    int width = degree.y + 1;
    int first = patch_index * (degree.x + 1) * width;
    Spread s = Spread(vec3(0.0), vec3(0.0), 1e30, vec2(0.0), false);
    vec2 middle, reach;
    box(net, first, (degree.x + 1) * width, transform, middle, reach);
    mat4 centred = mat4(1.0);
    centred[3].xy = -middle;
    centred *= transform;
    bvec3 above = bvec3(true), below = bvec3(true);
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            bool more_u = i < degree.x, more_v = j < degree.y;
            vec4 p = transformed(net, at, centred);
            vec4 in_u = more_u ? transformed(net, at + width, centred) : p;
            vec4 in_v = more_v ? transformed(net, at + 1, centred) : p;
            if (i + 1 < degree.x)
                widen(s, 0, p - 2.0 * in_u + transformed(net, at + 2 * width, centred), scale, reach);
            if (more_u && more_v)
                widen(s, 1, p - in_u - in_v + transformed(net, at + width + 1, centred), scale, reach);
            if (j + 1 < degree.y)
                widen(s, 2, p - 2.0 * in_v + transformed(net, at + 2, centred), scale, reach);
            vec2 seen = p.xy / p.w;
            s.leg = max(s.leg, vec2(length(scale * (in_u.xy / in_u.w - seen)),
                                    length(scale * (in_v.xy / in_v.w - seen))));
            s.least = min(s.least, p.w);
            p.xy += middle * p.w;
            above = bvec3(above.x && p.x > p.w, above.y && p.y > p.w, above.z && p.z > p.w);
            below = bvec3(below.x && p.x < -p.w, below.y && p.y < -p.w, below.z && p.z < -p.w);
        }
    vec2 d = vec2(degree);
    vec3 factors = vec3(d.x * (d.x - 1.0), d.x * d.y, d.y * (d.y - 1.0));
    s.off *= factors;
    s.off_w *= factors;
    s.leg *= d;
    s.out_of_view = s.least > 0.0 && (any(above) || any(below));
    return s;
}

// (a, b, c): steps nu x nv are fine enough if  a/nu^2 + 2 b/(nu nv) + c/nv^2 <= 1.
vec3 level_coefficients(Spread s, float scale, float tolerance) {
    vec3 need = (scale * s.off + tolerance * s.off_w) / (8.0 * tolerance * s.least);
    return s.least > 0.0 ? min(need, 1e12) : vec3(1e12);
}

// About how many pixels a unit of a texture map is long: the larger of along u and v.
float pixels_a_unit(Spread seen, Spread sought) {
    return max(sought.leg.x > 0.0 ? seen.leg.x / sought.leg.x : 0.0,
               sought.leg.y > 0.0 ? seen.leg.y / sought.leg.y : 0.0);
}

// The steps in u and v with about the fewest triangles that meet the need.
vec2 balance(vec3 need) {
    float share = sqrt((need.x + TWIST * need.y + 1e-30) / (need.z + TWIST * need.y + 1e-30));
    float a = need.x + need.y * share, c = need.z + need.y / share;
    float nv = max(1.0, ceil(sqrt(2.0 * c)));
    float nu = max(1.0, ceil(sqrt(a / (1.0 - c / (nv * nv)))));
    float room = 1.0 - a / (nu * nu);
    if (room > 0.0)
        nv = clamp(ceil(sqrt(c / room)), 1.0, nv);
    return min(vec2(nu, nv), FINEST);
}
