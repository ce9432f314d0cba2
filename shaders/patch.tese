// The tessellation evaluator, third stage: the surface and its maps at one point of the grid.
// OpenGL 4.0.  The same evaluate() as evaluate.vert.
//
// With PROBE each grid point is drawn onto its own texel instead, for reading back; with LISTED
// it is evaluated at parameters of the caller's, any list of them laid onto the grid.

layout(quads, equal_spacing, ccw
#ifdef PROBE
    , point_mode
#endif
    ) in;

#include "lib/evaluate.glsl"
#include "lib/normal.glsl"
#include "lib/grid.glsl"
#ifndef PROBE
#include "lib/surface.glsl"
#endif

in int patch_of_surface[];

uniform int level;
uniform ivec4 tile;

uniform sampler2D position_net;
#ifdef GENERIC_DEGREE
uniform ivec2 position_degree;
#else
const ivec2 position_degree = ivec2(POSITION_DEGREE_U, POSITION_DEGREE_V);
#endif
#ifdef TEXTURED
uniform sampler2D texture_net;
uniform int texture_stride;   // 0: one map shared by all patches
#ifdef GENERIC_DEGREE
uniform ivec2 texture_degree;
#else
const ivec2 texture_degree = ivec2(TEXTURE_DEGREE_U, TEXTURE_DEGREE_V);
#endif
#endif
#ifdef PROBE
#ifdef LISTED
uniform sampler2D parameter_list;   // packed like a net
uniform int last_parameter;
#endif
uniform ivec2 probe_size;
flat out vec4 probed_parameters;
flat out vec4 probed_point;
flat out vec3 probed_normal;
#endif

void main() {
    int patch_index = patch_of_surface[0];
    ivec2 step_index = tile.xy + ivec2(gl_TessCoord.xy * vec2(tile.zw) + 0.5);
#ifdef LISTED
    int number = step_index.x * (level + 1) + step_index.y;
    vec4 uv = control_point(parameter_list, min(number, last_parameter));
#else
    vec4 uv = grid_parameters(step_index, level);
#endif
#if defined(PROBE) || defined(LIT)
    vec4 point;
    vec3 normal = surface_normal(position_net, patch_index, position_degree, uv, point);
#else
    vec4 point = evaluate(position_net, patch_index, position_degree, uv);
#endif
#ifdef PROBE
    int texel = (patch_index * (level + 1) + step_index.x) * (level + 1) + step_index.y;
    vec2 center = vec2(texel % probe_size.x, texel / probe_size.x) + 0.5;
    gl_Position = vec4(2.0 * center / vec2(probe_size) - 1.0, 0.0, 1.0);
    probed_parameters = uv;
    probed_point = point;
    probed_normal = normal;
#else
    emit_point(point);
#ifdef TEXTURED
    emit_map(evaluate(texture_net, patch_index * texture_stride, texture_degree, uv), uv.xz);
#endif
#ifdef LIT
    emit_normal(normal);
#endif
#endif
}
