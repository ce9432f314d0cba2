// Segments that are drawn together, as group.vert has found them: two texels a segment, in pixels:
//
//      (middle x, y and radius of a circle around all of its group, n)
//      (extent of its points: along its chord from, to; across it from, to)
//
// Of n segments the first has n, the others -n; 0 is a point where a line begins.

uniform sampler2D groups;

vec4 group_texel(int index) {
    return texelFetch(groups, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}

vec4 circle_of(int segment) {
    return group_texel(2 * segment);
}

vec4 extent_of(int segment) {
    return group_texel(2 * segment + 1);
}
