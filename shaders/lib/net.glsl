// Control points (w x, w y, w z, w) of nets, patch after patch, rows of u, v fastest.
// Twin: gpu/nets.py packs them.
//
// In a texture: one RGBA32F texel each, wrapped at NET_WIDTH.  Any degree, any number of patches,
// readable in every stage of OpenGL 3.3 and later.
//
// INSTANCED, in evaluate.vert and recorded.vert: as attributes that stay for an instance, which is
// a patch.  Its COMPONENTS floats a point (a map of three has w = 1) are then no fetches at all.

#ifdef INSTANCED
in vec4 control[CONTROLS];   // packed densely

vec4 control_point(sampler2D net, int index) {
    vec4 point = vec4(0.0, 0.0, 0.0, 1.0);
    for (int k = 0; k < COMPONENTS; ++k) {
        int place = index * COMPONENTS + k;
        point[k] = control[place / 4][place % 4];
    }
    return point;
}
#else
vec4 control_point(sampler2D net, int index) {
    return texelFetch(net, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}
#endif
