// How much of a pixel a polyline covers that is as wide as a disc of radius half_width run along
// it: 16 x 16 points of the pixel are tried against the capsules of all segments near by.  Their
// union counts, so joins, sharp turns and cusps are as exact as a straight edge; and only the
// nearest segment draws the pixel, so translucent edges never add up.
//
//        _______________
//       (_______________)      a capsule meets a row of points in one interval:
//        . . . [#######]       disc, disc and the band between them together
//
// The segments are walked from this one, back and ahead as far as reach.vert found any near.

#include "lib/polyline.glsl"

uniform vec4 color;
uniform float half_width;   // pixels

flat in int segment;
flat in ivec2 window;

out vec4 fragment;

const int ROWS = 16;
const float DIAGONAL = 0.7072;   // half of a pixel's

float distance_to(vec2 a, vec2 b) {
    vec2 way = b - a;
    float t = clamp(-dot(a, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
    PRECISE float distance = length(a + t * way);
    return distance;
}

float reciprocal(float x) {
    return 1.0 / (abs(x) < 1e-6 ? (x < 0.0 ? -1e-6 : 1e-6) : x);
}

// The points of one row, at height y from `a`, within a disc around `a`: from .x to .y.
vec2 disc_interval(vec2 a, float y) {
    float square = half_width * half_width - y * y;
    float half_chord = sqrt(max(square, 0.0));
    return square >= 0.0 ? vec2(a.x - half_chord, a.x + half_chord) : vec2(1e6, -1e6);
}

// Adds the points that lie in the capsule from a to b; bit k of rows[j] is point k of row j.
void add_capsule(vec2 a, vec2 b, inout uint rows[ROWS]) {
    vec2 way = b - a;
    float span = length(way);
    vec2 along = span > 1e-6 ? way / span : vec2(1.0, 0.0);
    vec2 inverse = vec2(reciprocal(along.x), reciprocal(along.y));
    for (int row = 0; row < ROWS; ++row) {
        float height = (float(row) + 0.5) / float(ROWS) - 0.5;
        vec2 y = vec2(height) - vec2(a.y, b.y);
        vec2 disc_a = disc_interval(a, y.x), disc_b = disc_interval(b, y.y);
        // 0 <= along.x x + along.y y <= span  and  |along.x y - along.y x| <= half_width
        vec2 length_ends = (vec2(0.0, span) - along.y * y.x) * inverse.x;
        vec2 width_ends = (along.x * y.x + vec2(-half_width, half_width)) * inverse.y;
        float low = max(min(length_ends.x, length_ends.y), min(width_ends.x, width_ends.y));
        float high = min(max(length_ends.x, length_ends.y), max(width_ends.x, width_ends.y));
        vec2 band = low <= high ? a.x + vec2(low, high) : vec2(1e6, -1e6);
        float from = min(min(disc_a.x, disc_b.x), band.x);
        float to = max(max(disc_a.y, disc_b.y), band.y);
        int first = int(ceil(clamp((from + 0.5) * 16.0 - 0.5, 0.0, 16.0)));
        int last = int(floor(clamp((to + 0.5) * 16.0 - 0.5, -1.0, 15.0)));
        if (first <= last)
            rows[row] |= (2u << uint(last)) - (1u << uint(first));
    }
}

uint count_bits(uint bits) {   // of 16
    bits -= (bits >> 1) & 0x5555u;
    bits = (bits & 0x3333u) + ((bits >> 2) & 0x3333u);
    bits = (bits + (bits >> 4)) & 0x0f0fu;
    return (bits + (bits >> 8)) & 0x1fu;
}

void main() {
    vec2 pixel = gl_FragCoord.xy;
    vec4 start = line_point(segment - 1), end = line_point(segment);
    float own = distance_to(start.xy - pixel, end.xy - pixel);
    bool is_owner = own <= half_width + DIAGONAL;
    ivec2 touching = ivec2(0);   // steps back and ahead to the last segment that meets the pixel

    // Most pixels around a short segment belong to its neighbour, and are left at once.
    int other = segment;
    vec4 point = start;
    for (int step = 1; step <= window.x && is_owner; ++step) {
        other = segment_before(other - 1, point);
        vec4 from = line_point(other - 1), to = line_point(other);
        float distance = distance_to(from.xy - pixel, to.xy - pixel);
        is_owner = own < distance || (own == distance && segment <= other);
        if (distance < half_width + DIAGONAL)
            touching.x = step;
        point = from;
    }
    other = segment;
    point = end;
    for (int step = 1; step <= window.y && is_owner; ++step) {
        other = segment_after(other, point);
        vec4 from = line_point(other - 1), to = line_point(other);
        float distance = distance_to(from.xy - pixel, to.xy - pixel);
        is_owner = own < distance || (own == distance && segment <= other);
        if (distance < half_width + DIAGONAL)
            touching.y = step;
        point = to;
    }
    if (!is_owner)
        discard;

    float coverage = 1.0;
    // A loop that runs once or never: software rasterisers leave it, an `if` they execute.
    for (bool is_edge = own > half_width - DIAGONAL; is_edge; is_edge = false) {
        uint rows[ROWS];
        for (int row = 0; row < ROWS; ++row)
            rows[row] = 0u;
        add_capsule(start.xy - pixel, end.xy - pixel, rows);
        other = segment;
        point = start;
        for (int step = 1; step <= touching.x; ++step) {
            other = segment_before(other - 1, point);
            vec4 from = line_point(other - 1);
            add_capsule(from.xy - pixel, line_point(other).xy - pixel, rows);
            point = from;
        }
        other = segment;
        point = end;
        for (int step = 1; step <= touching.y; ++step) {
            other = segment_after(other, point);
            vec4 to = line_point(other);
            add_capsule(line_point(other - 1).xy - pixel, to.xy - pixel, rows);
            point = to;
        }
        uint count = 0u;
        for (int row = 0; row < ROWS; ++row)
            count += count_bits(rows[row]);
        coverage = float(count) / 256.0;
    }
    fragment = vec4(color.rgb, color.a * coverage);
}
