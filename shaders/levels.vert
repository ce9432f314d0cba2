// How finely each patch is to be tessellated in this view: one vertex a patch, captured by transform
// feedback.  OpenGL 3.3.  (0, 0) for a patch out of view.

#include "lib/levels.glsl"

in int patch_index;

uniform mat4 clip_from_model;
uniform vec2 half_size;    // of the viewport, in pixels
uniform float tolerance;   // pixels
uniform sampler2D position_net;
uniform ivec2 position_degree;
#ifdef TEXTURED
uniform sampler2D texture_net;
uniform ivec2 texture_degree;
uniform int texture_stride;   // 0: one map shared by all patches
#endif

out vec2 steps;

void main() {
    Spread seen = spread(position_net, patch_index, position_degree, clip_from_model, half_size);
    vec3 need = level_coefficients(seen, 1.0, tolerance);
#ifdef TEXTURED
    Spread sought =
        spread(texture_net, patch_index * texture_stride, texture_degree, mat4(1.0), vec2(1.0));
    need += level_coefficients(sought, pixels_a_unit(seen, sought), tolerance);
#endif
    steps = seen.out_of_view ? vec2(0.0) : balance(min(need, 1e12));
}
