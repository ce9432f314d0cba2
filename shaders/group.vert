// Which segments of a polyline are drawn as one: neighbours that fill a rectangle well, so that a
// pixel between them is tried once and not by each.  Once for each view and width; captured, and
// then read as a texture by lib/groups.glsl.
//
//    |       |       |       |       |     32 segments of a line, or all it has,
//    |   |   |       |   |   |       |     or half of them, a quarter ...: the most that fit

#include "lib/polyline.glsl"

uniform float half_width;   // pixels

in ivec3 line;
in int segment;             // gl_VertexID starts again at 4096 on softpipe

out vec4 circle, extent;    // of lib/groups.glsl

const int LARGEST = 32;             // segments
const float WORTH = 128.0;          // segments tried for a pixel that cost as much as one drawn
const float DEPTH_OFF = 2.5e-4;     // of a segment from its rectangle

void main() {
    gl_Position = vec4(0.0);
    circle = extent = vec4(0.0);
    int place = segment - line.x;
    float margin = half_width + MARGIN;
    bool is_found = place < 0;
    for (int size = LARGEST; !is_found; size /= 2) {
        int before = place % size;
        int first = segment - before, last = min(first + size - 1, line.y);
        int count = last - first + 1;
        vec4 start = point_at(first - 1), end = point_at(last);
        vec2 chord = end.xy - start.xy;
        float span = length(chord);
        vec2 along = span > 0.0 ? chord / span : vec2(1.0, 0.0);
        vec2 left = vec2(-along.y, along.x);

        vec2 low = vec2(0.0), high = vec2(span, 0.0);   // along the chord and across
        float arc = 0.0, depth_off = 0.0;
        vec4 from = start;
        for (int other = first; other <= last; ++other) {
            vec4 to = point_at(other);
            vec2 apart = to.xy - start.xy;
            vec2 local = vec2(dot(apart, along), dot(apart, left));
            low = min(low, local);
            high = max(high, local);
            arc += length(to.xy - from.xy);
            float depth = mix(start.z, end.z, clamp(local.x / max(span, 1e-3), 0.0, 1.0));
            depth_off = max(depth_off, abs(to.z - depth));
            from = to;
        }
        is_found = size == 1 || (arc * float(count) <= WORTH * margin
            && high.y - low.y <= margin && depth_off <= DEPTH_OFF);

        extent = vec4(low.x, high.x, low.y, high.y);
        circle.xy = start.xy + 0.5 * (along * (low.x + high.x) + left * (low.y + high.y));
        circle.zw = vec2(0.5 * length(high - low), before == 0 ? count : -count);
    }
}
