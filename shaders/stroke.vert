// Thick lines with round joins and caps: one instance a segment, the first of a group's draws the
// rectangle that group.vert has laid around all pixels which the group may touch:
//
//       +---------------------------+
//       |  .--------------------.   |
//       | (  start ------- end   )  |      stroke.frag says which pixels it owns, and how much
//       |  '--------------------'   |      of them the line covers
//       +---------------------------+
//
// Core profile draws no lines wider than a pixel.

#include "lib/polyline.glsl"
#include "lib/groups.glsl"

uniform vec4 region;        // left, bottom, width, height of the viewport, in pixels
uniform float half_width;   // pixels
uniform float depth_bias;   // towards the eye, in normalised depth

in vec2 corner;             // (0 start .. 1 end, 0 right .. 1 left)
in ivec3 line;
in int segment;
in vec4 reach;              // of reach.vert

flat out ivec3 line_of_group;
flat out ivec2 group;       // first segment, count
flat out ivec2 window;      // groups back and ahead

void main() {
    int count = int(circle_of(segment).w);
    line_of_group = line;
    group = ivec2(segment, count);
    window = ivec2(reach.xy + 0.5);
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);   // clipped
    if (count > 0) {
        vec4 start = point_at(segment - 1), end = point_at(segment + count - 1);
        float beside = half_width + MARGIN;
        vec4 extent = extent_of(segment) + vec4(-reach.z, reach.w, -beside, beside);
        vec2 chord = end.xy - start.xy;
        float span = length(chord);
        vec2 along = span > 0.0 ? chord / span : vec2(1.0, 0.0);
        vec2 local = mix(extent.xz, extent.yw, corner);
        vec2 pixel = start.xy + along * local.x + vec2(-along.y, along.x) * local.y;
        // The cap goes on in depth as the chord does: lines of two widths stay one over the other.
        float depth = mix(start.z, end.z, clamp(local.x / max(span, 1e-3), -1.0, 2.0));
        gl_Position = vec4((pixel - region.xy) / region.zw * 2.0 - 1.0, depth - depth_bias, 1.0);
    }
}
