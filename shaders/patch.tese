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

#include "lib/maps.glsl"
#include "lib/grid.glsl"

in int patch_of_surface[];
in ivec4 tile_of_surface[];

#ifdef ADAPTIVE
#include "lib/snap.glsl"
in ivec2 inner_of_surface[];
in ivec4 outer_of_surface[];
#else
uniform int level;
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
    ivec4 tile = tile_of_surface[0];
#ifdef ADAPTIVE
    ivec2 steps = inner_of_surface[0];
    ivec2 step_index = ivec2(gl_TessCoord.xy * vec2(tile.zw) + 0.5);
    snap(step_index, steps, tile, outer_of_surface[0]);
    emit_surface(patch_index, grid_parameters(step_index, steps));
#ifdef LEVEL
    emit_steps(inner_of_surface[0], outer_of_surface[0]);
#endif
#else
    ivec2 step_index = tile.xy + ivec2(gl_TessCoord.xy * vec2(tile.zw) + 0.5);
#ifdef LISTED
    int number = step_index.x * (level + 1) + step_index.y;
    vec4 uv = control_point(parameter_list, min(number, last_parameter));
#else
    vec4 uv = grid_parameters(step_index, ivec2(level));
#endif
#ifdef PROBE
    int texel = (patch_index * (level + 1) + step_index.x) * (level + 1) + step_index.y;
    vec2 center = vec2(texel % probe_size.x, texel / probe_size.x) + 0.5;
    gl_Position = vec4(2.0 * center / vec2(probe_size) - 1.0, 0.0, 1.0);
    probed_parameters = uv;
    probed_normal = surface_normal(position_net, patch_index, position_degree, uv, probed_point);
#else
    emit_surface(patch_index, uv);
#ifdef LEVEL
    emit_steps(ivec2(level), ivec4(level));
#endif
#endif
#endif
}
