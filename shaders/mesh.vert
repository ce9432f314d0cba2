// A surface that evaluate.vert has evaluated: its maps are attributes now.  OpenGL 3.3.

#include "lib/surface.glsl"

in vec4 point;
#ifdef TEXTURED
in vec4 map;
#endif
#if defined(TEXTURED) || defined(LOCATED)
uniform int level;
#endif
#ifdef LOCATED
uniform int first_patch;
#endif
#ifdef LIT
in vec3 normal;
#endif

void main() {
    emit_point(point);
#if defined(TEXTURED) || defined(LOCATED)
    int count = (level + 1) * (level + 1), step_index = gl_VertexID % count;
    vec2 uv = vec2(step_index / (level + 1), step_index % (level + 1)) / float(level);
#endif
#ifdef TEXTURED
    emit_map(map, uv);
#endif
#ifdef LOCATED
    emit_place(first_patch + gl_VertexID / count, uv);
#endif
#ifdef LIT
    emit_normal(normal);
#endif
}
