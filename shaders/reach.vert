// What lies around a group: how many groups, back and ahead, it may share pixels with (one where
// the line runs on smoothly, many around a cusp, of a closed line all at most), so that stroke.frag
// need not look further; and how far its caps reach.  Once for each view and width.

#include "lib/polyline.glsl"
#include "lib/groups.glsl"

uniform float half_width;   // pixels

in ivec3 line;
in int segment;

out vec4 reach;             // groups back and ahead; pixels beyond the chord at its start and end

const int WINDOW = 256;     // groups looked at, each way

struct Group {
    vec4 circle;
    vec2 a, b;      // its chord
    float off;      // its points from the chord, at most
};

Group group_at(int segment) {
    Group group;
    group.circle = circle_of(segment);
    int count = int(group.circle.w);
    vec4 extent = extent_of(segment);
    group.a = point_at(count > 0 ? segment - 1 : segment + count).xy;
    group.b = point_at(count > 0 ? segment + count - 1 : segment).xy;
    group.off = max(-extent.z, extent.w) + max(-extent.x, extent.y - length(group.b - group.a));
    return group;
}

float turn(vec2 a, vec2 b, vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether chords cross or come as near as that.
bool are_near(vec2 a, vec2 b, vec2 c, vec2 d, float far) {
    float square = min(min(distance_square(a - c, b - c), distance_square(a - d, b - d)),
        min(distance_square(c - a, d - a), distance_square(c - b, d - b)));
    return sqrt(square) < far || turn(a, b, c) * turn(a, b, d) <= 0.0
        && turn(c, d, a) * turn(c, d, b) <= 0.0;
}

bool may_share_pixels(Group here, Group there) {
    float far = 2.0 * half_width + 2.0;
    float apart = length(here.circle.xy - there.circle.xy) - here.circle.z - there.circle.z;
    bool found = false;
    for (bool is_near = apart < far; is_near; is_near = false)
        found = are_near(here.a, here.b, there.a, there.b, far + here.off + there.off);
    return found;
}

// How far beyond an end, in half widths, a segment may be the nearest: all of the cap, or where
// the line runs on in direction `beyond` the wedge between the two.
float overhang(vec2 along, vec2 beyond) {
    float reach = length(beyond);
    float cosine = dot(along, beyond) / max(reach, 1e-20);
    return reach > 1e-3 && cosine > 0.0 ? sqrt(max(1.0 - cosine * cosine, 0.0)) : 1.0;
}

void main() {
    gl_Position = vec4(0.0);
    reach = vec4(0.0);
    int first = max(segment, 1);
    Group here = group_at(first);
    int count = segment >= line.x ? int(here.circle.w) : 0, last = first + count - 1;
    int previous = count > 0 ? segment_before(line, first) : -1;
    int next = count > 0 ? segment_after(line, last) : -1;

    vec2 chord = here.b - here.a;
    float span = length(chord);
    chord = span > 0.0 ? chord / span : vec2(1.0, 0.0);
    float tilt = 0.0;
    vec2 from = here.a;
    for (int other = first; other <= last && count > 1; ++other) {
        vec2 to = point_at(other).xy;
        tilt = max(tilt, overhang(chord, to - from));
        from = to;
    }
    vec2 beyond = vec2(1.0);
    if (previous >= 0)
        beyond.x = max(tilt, overhang(chord, here.a - point_at(previous - 1).xy));
    if (next >= 0)
        beyond.y = max(tilt, overhang(chord, point_at(next).xy - here.b));
    reach.zw = beyond * (half_width + DIAGONAL) + (MARGIN - DIAGONAL);

    for (int step = 1; step <= WINDOW && previous >= 0 && previous != last; ++step) {
        Group there = group_at(previous);
        if (may_share_pixels(here, there))
            reach.x = float(step);
        previous = segment_before(line, previous - int(abs(there.circle.w)) + 1);
    }
    for (int step = 1; step <= WINDOW && next >= 0 && next != first; ++step) {
        Group there = group_at(next);
        if (may_share_pixels(here, there))
            reach.y = float(step);
        next = segment_after(line, next + int(abs(there.circle.w)) - 1);
    }
}
