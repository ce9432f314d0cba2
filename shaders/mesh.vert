// A surface that evaluate.vert has evaluated: its maps are attributes now.  OpenGL 3.3.

#include "lib/grid.glsl"
#include "lib/surface.glsl"

in vec4 point;
#ifdef TEXTURED
in vec4 map;
#endif
#if defined(TEXTURED) || defined(LOCATED) || defined(TRIMMED)
uniform int level;
#endif
#if defined(LOCATED) || defined(TRIMMED)
uniform int first_patch;
#endif
#ifdef LIT
in vec3 normal;
#endif

void main() {
    emit_point(point);
#if defined(TEXTURED) || defined(LOCATED) || defined(TRIMMED)
    int count = (level + 1) * (level + 1), place = gl_VertexID % count;
    vec4 uv = grid_parameters(ivec2(place / (level + 1), place % (level + 1)), ivec2(level));
#endif
#ifdef TEXTURED
    emit_map(map, uv.xz);
#endif
#ifdef LOCATED
    emit_place(first_patch + gl_VertexID / count, uv.xz);
#endif
#ifdef TRIMMED
    emit_trim(first_patch + gl_VertexID / count, uv);
#endif
#ifdef LIT
    emit_normal(normal);
#endif
#ifdef LEVEL
    emit_steps(ivec2(level), ivec4(level));
#endif
}
