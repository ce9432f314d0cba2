// A control net in a texture: one RGBA32F texel (w x, w y, w z, w) a control point, patch after
// patch, rows of u, v fastest, wrapped at NET_WIDTH.  Twin: gpu/nets.py packs it.
// Any degree, any number of patches, readable in every stage of OpenGL 3.3 and later.

vec4 control_point(sampler2D net, int index) {
    return texelFetch(net, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}
