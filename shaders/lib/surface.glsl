// What a vertex of a surface hands to patch.frag, from its evaluated maps.  Shared by mesh.vert
// (evaluated beforehand) and patch.tese (evaluated on the spot).

uniform mat4 clip_from_model;

// The parts of a trimmed surface are drawn by two programs and must meet.
invariant gl_Position;

#ifdef TEXTURED
uniform vec4 image_from_map;   // scale s, scale t, offset s, offset t
out vec3 image_map;
out vec2 parameters;
#endif

#ifdef TRIMMED
#include "net.glsl"
uniform sampler2D patch_domains;   // of each patch (u0, u1, v0, v1) in the trim region's square
uniform int domain_stride;         // 0: one domain shared by all patches
out vec2 trim_parameters;
#endif

#ifdef LIT
uniform mat3 view_from_model;
out vec3 view_normal;
#endif

#ifdef ERROR
// llvmpipe divides what it interpolates at a centroid by the w of the pixel's centre. A common factor
// of x, y and w, or of u and 1-u, drops out when the point is projected.
centroid out vec3 drawn_place;   // x, y, w of the clip coordinates
centroid out vec4 drawn_uv;      // (u, 1-u, v, 1-v)
#endif

void emit_point(vec4 point) {
    gl_Position = clip_from_model * point;
#ifdef ERROR
    drawn_place = gl_Position.xyw;
#endif
}

#ifdef TEXTURED
void emit_map(vec4 map, vec2 uv) {
    image_map = vec3(map.xy * image_from_map.xy + map.w * image_from_map.zw, map.w);
    parameters = uv;
}
#endif

#ifdef LOCATED
flat out int located_patch;
out vec2 located_uv;
void emit_place(int patch_index, vec2 uv) {
    located_patch = patch_index;
    located_uv = uv;
#ifdef ERROR
    drawn_uv = vec4(uv.x, 1.0 - uv.x, uv.y, 1.0 - uv.y);
#endif
}
#endif

#ifdef TRIMMED
// uv = (u, 1-u, v, 1-v): neighbours have the parameters of their common edge bit for bit.
void emit_trim(int patch_index, vec4 uv) {
    vec4 domain = control_point(patch_domains, patch_index * domain_stride);
    trim_parameters = vec2(domain.x * uv.y + domain.y * uv.x, domain.z * uv.w + domain.w * uv.z);
}
#endif

#ifdef LIT
void emit_normal(vec3 normal) {
    view_normal = view_from_model * normal;
}
#endif

#ifdef LEVEL
flat out ivec2 inner_steps;
flat out ivec4 edge_steps;   // of the edges u = 0, v = 0, u = 1, v = 1
void emit_steps(ivec2 inner, ivec4 edges) {
    inner_steps = inner;
    edge_steps = edges;
}
#endif
