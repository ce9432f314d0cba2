// How finely each patch is to be tessellated in this view: one vertex a patch, captured by transform
// feedback.  OpenGL 3.3.  Steps in u and v, and 1 where diagonals are to fall; steps (0, 0) for a patch
// out of view, or with SOLID one that faces away.

#include "lib/levels.glsl"
#ifdef SOLID
#include "lib/facing.glsl"
#endif

in int patch_index;

uniform mat4 clip_from_model;
uniform vec2 half_size;    // of the viewport, in pixels
uniform float tolerance;   // pixels
uniform sampler2D position_net;
#ifdef GENERIC_DEGREE
uniform ivec2 position_degree;
#else
const ivec2 position_degree = ivec2(POSITION_DEGREE_U, POSITION_DEGREE_V);
#endif
#ifdef TEXTURED
uniform sampler2D texture_net;
#ifdef GENERIC_DEGREE
uniform ivec2 texture_degree;
#else
const ivec2 texture_degree = ivec2(TEXTURE_DEGREE_U, TEXTURE_DEGREE_V);
#endif
uniform int texture_stride;   // 0: one map shared by all patches
#endif

out vec3 steps;

void main() {
    Bends seen = bends(position_net, patch_index, position_degree, clip_from_model, half_size);
#ifdef TEXTURED
    Bends sought =
        bends(texture_net, patch_index * texture_stride, texture_degree, mat4(1.0), vec2(1.0));
    float unit = pixels_a_unit(seen, sought);
#else
    Bends sought = flat_bends();
    float unit = 0.0;
#endif
    bool hidden = seen.out_of_view;
#ifdef SOLID
    hidden = hidden || faces_away(position_net, patch_index, position_degree, clip_from_model);
#endif
    steps = hidden ? vec3(0.0) : fewest_steps(seen, tolerance, sought, unit);
}
