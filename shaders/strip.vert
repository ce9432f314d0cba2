// The vertex evaluator on a grid: one vertex here is a strip, STRIP points of an iso-curve u = const
// of one patch, captured by transform feedback.  OpenGL 3.3.  evaluate.vert does the same for any
// list of parameters, fetching all control points for each.
//
//   v ^  |  |  |      |: an iso-curve, cut into strips if it has many points
//     |  |  |  |
//     +-> u
//
// EACH(F) is F(0); F(1); ... for the STRIP points: with constant indices arrays stay in registers.

#include "lib/strip.glsl"
#ifdef NORMALS
#include "lib/normal.glsl"
#endif

in vec4 start;   // u, 1-u; number of the first point in v; patch

uniform sampler2D net;
uniform sampler2D columns;   // v, 1-v of each grid point, packed like a net
uniform int first_patch;
const ivec2 degree = ivec2(DEGREE_U, DEGREE_V);

out vec4 point[STRIP];
#ifdef NORMALS
out vec3 normal[STRIP];
#endif

vec4 curve[MAX_ORDER], across[MAX_ORDER];

vec2 column_parameter(int k) {
    return control_point(columns, int(start.z) + k).xy;
}

void place(int k) {
    vec2 v = column_parameter(k);
    float column[MAX_ORDER];
    bernstein(degree.y, v, column);
    point[k] = curve_point(degree.y, column, curve);
#ifdef NORMALS
    float slope[MAX_ORDER];
    bernstein_derivative(degree.y, v, slope);
    normal[k] = cross_of_tangents(point[k], curve_point(degree.y, column, across),
                                  curve_point(degree.y, slope, curve));
#endif
}

void main() {
    int patch_index = first_patch + int(start.w);
    iso_curve(net, patch_index, degree, start.xy, curve, across);
    EACH(place)
#ifdef NORMALS
    // Rare, so one loop at the end that software leaves at once.
    bool rare = false;
#define SEE(K) rare = rare || is_singular(normal[K])
    EACH(SEE)
    for (int k = rare ? 0 : STRIP; k < STRIP; ++k) {
        vec4 uv = vec4(start.xy, column_parameter(k));
        normal[k] = limit_normal(net, patch_index, degree, uv, normal[k]);
    }
#define UNIT(K) normal[K] = normalize(normal[K])
    EACH(UNIT)
#endif
}
