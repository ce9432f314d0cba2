// How many segments, back and ahead, a segment may share pixels with: one where the line runs on
// smoothly, many around a cusp, of a closed line all at most.  Once for each view, so that
// stroke.frag need not look further.

#include "lib/polyline.glsl"

uniform float half_width;   // pixels

in float link;              // of the segment's end point

out vec2 reach;

const int WINDOW = 256;     // segments looked at, each way

bool is_near(vec2 middle, float length_here, vec2 a, vec2 b) {
    float apart = length((a + b) * 0.5 - middle) - (length(b - a) + length_here) * 0.5;
    return apart < 2.0 * half_width + 2.0;
}

void main() {
    int own = gl_VertexID;
    reach = vec2(0.0);
    gl_Position = vec4(0.0);
    vec4 end = line_point(own), start = line_point(max(own - 1, 0));
    vec2 middle = (start.xy + end.xy) * 0.5;
    float length_here = link > 0.5 ? length(end.xy - start.xy) : 0.0;

    vec4 here = start;
    int segment = link > 0.5 ? segment_before(own - 1, here) : -1;
    for (int step = 1; step <= WINDOW && segment >= 0 && segment != own; ++step) {
        vec4 from = line_point(segment - 1);
        if (is_near(middle, length_here, from.xy, line_point(segment).xy))
            reach.x = float(step);
        segment = segment_before(segment - 1, from);
    }
    here = end;
    segment = link > 0.5 ? segment_after(own, here) : -1;
    for (int step = 1; step <= WINDOW && segment >= 0 && segment != own; ++step) {
        vec4 to = line_point(segment);
        if (is_near(middle, length_here, line_point(segment - 1).xy, to.xy))
            reach.y = float(step);
        segment = segment_after(segment, to);
    }
}
