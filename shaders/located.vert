// Vertices evaluated and read back once, to be measured: each says where on which patch it lies.
// OpenGL 3.3.  A patch is a number of vertices in a row.

#include "lib/surface.glsl"

in vec4 point;
#ifdef LOCATED
in vec2 place;   // (u, v)
uniform int vertices;
#endif

void main() {
    emit_point(point);
#ifdef LOCATED
    emit_place(gl_VertexID / vertices, place);
#endif
}
