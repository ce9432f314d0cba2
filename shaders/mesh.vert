// A surface that evaluate.vert has evaluated: its maps are attributes now.  OpenGL 3.3.

#include "lib/surface.glsl"

in vec4 point;
#ifdef TEXTURED
in vec4 map;
uniform int level;
#endif
#ifdef LIT
in vec3 normal;
#endif

void main() {
    emit_point(point);
#ifdef TEXTURED
    int step_index = gl_VertexID % ((level + 1) * (level + 1));
    emit_map(map, vec2(step_index / (level + 1), step_index % (level + 1)) / float(level));
#endif
#ifdef LIT
    emit_normal(normal);
#endif
}
