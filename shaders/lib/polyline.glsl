// Polylines in a texture, a texel a point: (x, y) in pixels of the framebuffer, and depth.  Written
// by flatten.vert, wrapped at NET_WIDTH as control nets are.
//
//      line.x - 1   line.x     line.y
//          o----------o--- ... --o      A segment goes by the index of its end point, its line by
//                                       (first segment, last one, 1 if that leads to the first)

uniform sampler2D polyline;

const float DIAGONAL = 0.7072;          // half of a pixel's
const float MARGIN = DIAGONAL + 0.6;    // and as far as its samples are from its centre

vec4 point_at(int index) {
    return texelFetch(polyline, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}

// The neighbours of a segment along its line; -1 if there is none.
int segment_before(ivec3 line, int segment) {
    return segment > line.x ? segment - 1 : line.z == 1 ? line.y : -1;
}

int segment_after(ivec3 line, int segment) {
    return segment < line.y ? segment + 1 : line.z == 1 ? line.x : -1;
}

// From the origin to the segment from a to b.
float distance_square(vec2 a, vec2 b) {
    vec2 way = b - a;
    float t = clamp(-dot(a, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
    vec2 nearest = a + t * way;
    PRECISE float square = dot(nearest, nearest);
    return square;
}
