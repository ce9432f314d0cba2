// Whether a patch shows nothing but its back.
// Twin: geometry/facing.py, where it is derived.

#include "net.glsl"

struct Legs {          // between neighbouring control points, along one direction
    vec2 low, high;    // of (x, y)
    float weight;      // the largest |w|
};

void include(inout Legs legs, vec4 leg) {
    legs.low = min(legs.low, leg.xy);
    legs.high = max(legs.high, leg.xy);
    legs.weight = max(legs.weight, abs(leg.w));
}

vec2 largest(Legs legs) {
    return max(abs(legs.low), abs(legs.high));
}

// The largest a * b of a and b within bounds.
float largest_product(vec2 a, vec2 b) {
    return max(max(a.x * b.x, a.x * b.y), max(a.y * b.x, a.y * b.y));
}

// The same matrix in coordinates in which the patch's middle is 0, its sides along u and v go
// towards x and -y; 0 if it does not face away in its corners.
mat4 straightened(sampler2D net, int first, ivec2 degree, mat4 transform) {
    int width = degree.y + 1, last = first + degree.x * width;
    vec4 a = transform * control_point(net, first), b = transform * control_point(net, last);
    vec4 c = transform * control_point(net, first + degree.y);
    vec4 d = transform * control_point(net, last + degree.y);
    if (min(min(a.w, b.w), min(c.w, d.w)) <= 0.0)
        return mat4(0.0);
    vec2 at = a.xy / a.w, bt = b.xy / b.w, ct = c.xy / c.w, dt = d.xy / d.w;
    vec2 along_u = bt - at + dt - ct, along_v = ct - at + dt - bt;
    float area = along_u.x * along_v.y - along_u.y * along_v.x;
    if (!(area < 0.0))
        return mat4(0.0);
    vec2 middle = (at + bt + ct + dt) * 0.25;
    mat2 straight = inverse(mat2(along_u, -along_v));
    mat4 centred = mat4(1.0);
    centred[0].xy = straight[0];
    centred[1].xy = straight[1];
    centred[3].xy = -(straight * middle);
    return centred * transform;
}

bool faces_away(sampler2D net, int patch_index, ivec2 degree, mat4 transform) {
    int width = degree.y + 1, first = patch_index * (degree.x + 1) * width;
    mat4 to_straight = straightened(net, first, degree, transform);
    if (to_straight[3].w == 0.0)
        return false;
    Legs u = Legs(vec2(1e30), vec2(-1e30), 0.0), v = u;
    vec2 reach = vec2(0.0);
    float least = 1e30;
    for (int i = 0; i <= degree.x; ++i)
        for (int j = 0; j <= degree.y; ++j) {
            int at = first + i * width + j;
            vec4 p = to_straight * control_point(net, at);
            least = min(least, p.w);
            reach = max(reach, abs(p.xy / p.w));
            if (i < degree.x)
                include(u, to_straight * control_point(net, at + width) - p);
            if (j < degree.y)
                include(v, to_straight * control_point(net, at + 1) - p);
        }
    vec2 wide_u = largest(u), wide_v = largest(v);
    float turn = largest_product(vec2(u.low.x, u.high.x), vec2(v.low.y, v.high.y))
        + largest_product(-vec2(u.low.y, u.high.y), vec2(v.low.x, v.high.x));
    vec2 tilt = wide_u.yx * v.weight + wide_v.yx * u.weight;
    return least > 0.0 && turn + dot(reach, tilt) < 0.0;
}
