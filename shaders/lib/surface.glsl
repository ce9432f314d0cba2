// What a vertex of a surface hands to patch.frag, from its evaluated maps.  Shared by mesh.vert
// (evaluated beforehand) and patch.tese (evaluated on the spot).

uniform mat4 clip_from_model;

#ifdef TEXTURED
uniform vec4 image_from_map;   // scale s, scale t, offset s, offset t
out vec3 image_map;
out vec2 parameters;
#endif

#ifdef LIT
uniform mat3 view_from_model;
out vec3 view_normal;
#endif

void emit_point(vec4 point) {
    gl_Position = clip_from_model * point;
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
}
#endif

#ifdef LIT
void emit_normal(vec3 normal) {
    view_normal = view_from_model * normal;
}
#endif
