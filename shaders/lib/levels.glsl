// How finely a patch must be tessellated so that no drawn point is off by more than `tolerance`
// pixels from the surface at the same parameter.  Twin: geometry/levels.py, where it is derived.
//
// A triangle that spans hu x hv of the parameter square is off by at most
//
//     (hu^2 Muu + 2 hu hv Muv + hv^2 Mvv) / 8
//
// with M the second differences of the net, times du (du-1), du dv, dv (dv-1), in pixels.

#include "net.glsl"

const float SEEN = 1.05;    // |x/w|, |y/w| of what is in the viewport, and a little beyond
const float TWIST = 0.1;
const float FINEST = 4096.0;

struct Spread {          // of a net, transformed
    vec4 uu, uv, vv;     // bounds of its second derivatives, by component
    float least;         // smallest w
    float reach;         // largest |x/w|, |y/w|
    vec2 leg;            // longest |d(x,y)/d(u or v)|, by the legs of the net
    bool out_of_view;    // beyond one side of the view volume with all control points
};

vec4 transformed(sampler2D net, int index, mat4 transform) {
    return transform * control_point(net, index);
}

Spread spread(sampler2D net, int patch_index, ivec2 degree, mat4 transform, vec2 scale) {
    int width = degree.y + 1;
    int first = patch_index * (degree.x + 1) * width;
    Spread s = Spread(vec4(0.0), vec4(0.0), vec4(0.0), 1e30, 0.0, vec2(0.0), false);
    bvec3 above = bvec3(true), below = bvec3(true);
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            bool more_u = i < degree.x, more_v = j < degree.y;
            vec4 p = transformed(net, at, transform);
            vec4 in_u = more_u ? transformed(net, at + width, transform) : p;
            vec4 in_v = more_v ? transformed(net, at + 1, transform) : p;
            if (i + 1 < degree.x)
                s.uu = max(s.uu, abs(p - 2.0 * in_u + transformed(net, at + 2 * width, transform)));
            if (j + 1 < degree.y)
                s.vv = max(s.vv, abs(p - 2.0 * in_v + transformed(net, at + 2, transform)));
            if (more_u && more_v)
                s.uv = max(s.uv, abs(p - in_u - in_v + transformed(net, at + width + 1, transform)));
            vec2 seen = p.xy / p.w;
            s.leg = max(s.leg, vec2(length(scale * (in_u.xy / in_u.w - seen)),
                                    length(scale * (in_v.xy / in_v.w - seen))));
            s.reach = max(s.reach, max(abs(seen.x), abs(seen.y)));
            s.least = min(s.least, p.w);
            above = bvec3(above.x && p.x > p.w, above.y && p.y > p.w, above.z && p.z > p.w);
            below = bvec3(below.x && p.x < -p.w, below.y && p.y < -p.w, below.z && p.z < -p.w);
        }
    vec2 d = vec2(degree);
    s.uu *= d.x * (d.x - 1.0);
    s.uv *= d.x * d.y;
    s.vv *= d.y * (d.y - 1.0);
    s.leg *= d;
    s.out_of_view = s.least > 0.0 && (any(above) || any(below));
    return s;
}

// (a, b, c): steps nu x nv are fine enough if  a/nu^2 + 2 b/(nu nv) + c/nv^2 <= 1.
vec3 level_coefficients(Spread s, vec2 scale, float tolerance, float reach) {
    mat3x4 bounds = mat3x4(s.uu, s.uv, s.vv);
    vec3 need;
    for (int k = 0; k < 3; ++k) {
        vec2 pixels = scale * (bounds[k].xy + reach * bounds[k].w);
        need[k] = length(pixels) + tolerance * bounds[k].w;
    }
    return s.least > 0.0 ? min(need / (8.0 * tolerance * s.least), 1e12) : vec3(1e12);
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
