// Polylines in a texture, a texel a point: (x, y) in pixels of the framebuffer, depth, and how the
// line goes on, `link`:
//
//      0 |          a line begins here
//      1 |          joined to the point before
//    1+n |          so too; the last point of a closed line, whose first is n points before
//     -n |          the first point of a closed line, whose last is n points after
//
// Written by flatten.vert, wrapped at NET_WIDTH as control nets are.  A segment goes by the index
// of its end point.

uniform sampler2D line;
uniform int line_points;

vec4 line_point(int index) {
    return texelFetch(line, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}

// The segment before one that starts at point `start`, whose texel is given; -1 if none.
int segment_before(int start, vec4 point) {
    return point.w > 0.5 ? start : point.w < -0.5 ? start + int(-point.w) : -1;
}

// The segment after one that ends at point `end`, whose texel is given; -1 if none.
int segment_after(int end, vec4 point) {
    if (point.w > 1.5)
        return end - int(point.w) + 2;
    int next = end + 1;
    return next < line_points && line_point(next).w > 0.5 ? next : -1;
}
