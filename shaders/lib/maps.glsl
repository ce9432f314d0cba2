// The maps of a patch, position and texture, and how a vertex gets everything that patch.frag needs
// from them.  Shared by patch.tese and adaptive.vert, which evaluate on the spot.

#include "evaluate.glsl"
#include "normal.glsl"
#ifndef PROBE
#include "surface.glsl"
#endif

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

#ifndef PROBE
void emit_surface(int patch_index, vec4 uv) {
#ifdef LIT
    vec4 point;
    emit_normal(surface_normal(position_net, patch_index, position_degree, uv, point));
#else
    vec4 point = evaluate(position_net, patch_index, position_degree, uv);
#endif
    emit_point(point);
#ifdef LOCATED
    emit_place(patch_index, uv.xz);
#endif
#ifdef TEXTURED
    emit_map(evaluate(texture_net, patch_index * texture_stride, texture_degree, uv), uv.xz);
#endif
#ifdef TRIMMED
    emit_trim(patch_index, uv);
#endif
}
#endif
