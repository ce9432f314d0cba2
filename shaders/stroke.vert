// Thick lines with round joins and caps: one instance a segment, a rectangle of two triangles
// around all pixels that the segment's capsule may touch:
//
//       +---------------------------+
//       |  .--------------------.   |
//       | (  start ------- end   )  |      stroke.frag says which pixels it owns, and how much
//       |  '--------------------'   |      of them the line covers
//       +---------------------------+
//
// Core profile draws no lines wider than a pixel.

#include "lib/polyline.glsl"

uniform vec4 region;        // left, bottom, width, height of the viewport, in pixels
uniform float half_width;   // pixels
uniform float depth_bias;   // towards the eye, in normalised depth

in vec2 corner;             // (0 start .. 1 end, -1 right .. +1 left)
in vec2 reach;              // segments back and ahead

flat out int segment;
flat out ivec2 window;

const float MARGIN = 1.5;   // a pixel's diagonal, and a little

// How far beyond its end, in half widths, a segment may be the nearest: all of the cap, or where
// the line runs on in direction `beyond` the wedge between the two.
float overhang(vec2 along, vec2 beyond) {
    float reach = length(beyond);
    float cosine = dot(along, beyond) / max(reach, 1e-20);
    return reach > 1e-3 && cosine > 0.0 ? sqrt(max(1.0 - cosine * cosine, 0.0)) : 1.0;
}

void main() {
    segment = gl_InstanceID;
    window = ivec2(reach + 0.5);
    vec4 end = line_point(segment), start = line_point(max(segment - 1, 0));
    if (!(end.w > 0.5)) {
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);   // clipped
        return;
    }
    vec2 way = end.xy - start.xy;
    float span = length(way);
    vec2 along = span > 0.0 ? way / span : vec2(1.0, 0.0);
    vec2 left = vec2(-along.y, along.x);
    bool at_end = corner.x > 0.5;
    vec4 place = at_end ? end : start;
    int next = at_end ? segment_after(segment, end) : segment_before(segment - 1, start);
    float beyond = 1.0;
    if (next >= 0)
        beyond = overhang(along, line_point(next).xy - line_point(next - 1).xy);
    float ahead = half_width * beyond + MARGIN;
    vec2 pixel = place.xy + left * corner.y * (half_width + MARGIN)
        + along * (corner.x * 2.0 - 1.0) * ahead;
    // The cap goes on in depth as the segment does: lines of two widths stay one over the other.
    float depth = place.z + (place.z - (at_end ? start.z : end.z)) * min(ahead / max(span, 1e-3), 1.0);
    gl_Position = vec4((pixel - region.xy) / region.zw * 2.0 - 1.0, depth - depth_bias, 1.0);
}
