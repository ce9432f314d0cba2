// Where on which patch a fragment lies, for measuring how far off it is; with TEXTURED also what its
// texture map is there.

flat in int located_patch;
in vec2 located_uv;
layout(location = 0) out vec4 fragment;
#ifdef TEXTURED
in vec3 image_map;
layout(location = 1) out vec4 map;
#endif

void main() {
    fragment = vec4(located_patch, located_uv, 1.0);
#ifdef TEXTURED
    map = vec4(image_map.xy / image_map.z, 0.0, 1.0);
#endif
}
