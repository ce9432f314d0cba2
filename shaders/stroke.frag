// How much of a pixel a polyline covers that is as wide as a disc of radius half_width run along
// it: 16 x 16 points of the pixel are tried against all segments near by.  Their union counts, so
// joins, sharp turns and cusps are as exact as a straight edge; and only the group with the
// nearest segment draws the pixel, so translucent edges never add up.
//
//        _______________
//       (_______________)      a band or disc meets a row of points in one interval
//        . . . [#######]
//
// Bands of segments that go on smoothly meet in a mitre, discs are where the line turns or ends.
// Groups are walked from this one, back and ahead as far as reach.vert found any near.

#include "lib/polyline.glsl"
#include "lib/groups.glsl"

uniform vec4 color;
uniform float half_width;   // pixels

flat in ivec3 line_of_group;
flat in ivec2 group;        // first segment, count
flat in ivec2 window;       // groups back and ahead

out vec4 fragment;

const float MITRE = 1.0 / 256.0;    // pixels that a mitre may reach beyond the disc

// Of the square of 16 x 16 points, from the lower left: bit k of lower[j] is point k of row j, bit
// 16 + k that of row 4 + j; upper has rows 8 to 15.
struct Points {
    uvec4 lower, upper;
};

const vec4 ROWS = vec4(0.0, 1.0, 2.0, 3.0);

// Of a group: the square of its distance, and the first and the last of its segments that touch
// the pixel, -1 if none does.
struct Near {
    float square;
    int first, last;
};

Near near_group(int first, int count, vec2 pixel) {
    Near near = Near(1e30, -1, -1);
    float touching = (half_width + DIAGONAL) * (half_width + DIAGONAL);
    vec2 a = point_at(first - 1).xy - pixel;
    int k = 0;
    do {
        vec2 b = point_at(first + k).xy - pixel;
        float square = distance_square(a, b);
        near.square = min(near.square, square);
        near.last = square <= touching ? k : near.last;
        near.first = near.first < 0 ? near.last : near.first;
        a = b;
        ++k;
    } while (k < count);
    return near;
}

float reciprocal(float x) {
    return 1.0 / (abs(x) < 1e-4 ? (x < 0.0 ? -1e-4 : 1e-4) : x);
}

vec4 smaller(vec4 a, vec4 b) {   // min() has a case for NaN
    return mix(a, b, lessThan(b, a));
}

// The points of four rows: the last `left` (rounded down) of which are also the first `right`.
uvec4 in_both(vec4 left, vec4 right) {
    ivec4 last = clamp(ivec4(left), 0, 16), first = clamp(ivec4(right), 0, 16);
    return (uvec4(0xffff0000u) >> last) & ~(uvec4(0xffffffffu) << first);
}

uvec4 disc_rows(vec4 y, float x, float radius) {
    vec4 square = radius * radius - y * y;
    vec4 half_chord = mix(vec4(-1e6), sqrt(max(square, 0.0)), greaterThanEqual(square, vec4(0.0)));
    return in_both(16.0 - x + half_chord, x + 1.0 + half_chord);
}

uvec4 band_rows(vec4 across, vec4 up, vec4 ends) {
    return in_both(smaller(ends.x - across, ends.z - up), smaller(ends.y + across, ends.w + up));
}

// Adds the points around a, with lengths in pixels from the pixel's centre.
void add_disc(vec2 a, inout Points points) {
    a = a * 16.0 + 7.5;
    float radius = half_width * 16.0;
    vec4 y = ROWS - a.y;
    points.lower |= disc_rows(y, a.x, radius) | disc_rows(y + 4.0, a.x, radius) << 16u;
    points.upper |= disc_rows(y + 8.0, a.x, radius) | disc_rows(y + 12.0, a.x, radius) << 16u;
}

// Adds the points beside the line through a, as far as from reach.x to reach.y along it.
void add_band(vec2 a, vec2 along, vec2 reach, inout Points points) {
    a = a * 16.0 + 7.5;
    vec2 inverse = vec2(reciprocal(along.x), reciprocal(along.y));
    vec2 cut = reach * 16.0 * inverse.x;
    float side = half_width * 16.0 * abs(inverse.y);
    vec4 ends = vec4(16.0 - a.x - min(cut.x, cut.y), a.x + 1.0 + max(cut.x, cut.y),
        16.0 - a.x + side, a.x + 1.0 + side);
    vec2 slopes = vec2(-along.y, along.x) * inverse, four = 4.0 * slopes;
    vec4 across = slopes.x * (ROWS - a.y), up = slopes.y * (ROWS - a.y);
    points.lower |= band_rows(across, up, ends)
        | band_rows(across + four.x, up + four.y, ends) << 16u;
    points.upper |= band_rows(across + 2.0 * four.x, up + 2.0 * four.y, ends)
        | band_rows(across + 3.0 * four.x, up + 3.0 * four.y, ends) << 16u;
}

uint count_bits(uvec4 bits) {
    bits -= (bits >> 1u) & 0x55555555u;
    bits = (bits & 0x33333333u) + ((bits >> 2u) & 0x33333333u);
    bits = (bits + (bits >> 4u)) & 0x0f0f0f0fu;
    uint bytes = bits.x + bits.y + bits.z + bits.w;
    return (bytes * 0x01010101u) >> 24u;
}

// The share that `count` segments from `segment` on cover.
float coverage_of(int segment, int count, vec2 pixel) {
    float touching = (half_width + DIAGONAL) * (half_width + DIAGONAL);
    Points points = Points(uvec4(0u), uvec4(0u));
    vec2 a = point_at(segment - 1).xy - pixel;
    for (bool touches = dot(a, a) < touching; touches; touches = false)
        add_disc(a, points);
    vec2 b = point_at(segment).xy - pixel, way = b - a;
    float span = length(way), mitre = 0.0;
    vec2 along = way / max(span, 1e-6);
    do {
        segment = segment_after(line_of_group, segment);
        --count;
        vec2 c = b, along_next = along;
        float span_next = 0.0;
        for (bool is_last = count == 0; !is_last; is_last = true) {
            c = point_at(segment).xy - pixel;
            way = c - b;
            span_next = length(way);
            along_next = span_next > 1e-6 ? way / span_next : along;
        }
        float turn = abs(along.x * along_next.y - along.y * along_next.x)
            / max(1.0 + dot(along, along_next), 1e-6);
        bool is_corner = half_width * turn * turn > 2.0 * MITRE;
        float mitre_next = is_corner || count == 0 ? 0.0 : half_width * turn;
        float at = clamp(-dot(a, along), 0.0, span);
        vec2 nearest = a + at * along;
        for (bool touches = dot(nearest, nearest) < touching; touches; touches = false)
            add_band(nearest, along, vec2(-mitre, span + mitre_next) - at, points);
        bool has_disc = is_corner || count == 0;
        for (bool touches = has_disc && dot(b, b) < touching; touches; touches = false)
            add_disc(b, points);
        a = b;
        b = c;
        along = along_next;
        span = span_next;
        mitre = mitre_next;
    } while (count > 0);
    return float(count_bits(points.lower) + count_bits(points.upper)) / 256.0;
}

// What a group knows of a pixel, its own nearest point at first.
struct Claim {
    int first;              // of the group's segments
    float square;           // of their distance
    bool is_owner;          // no other is nearer
    int begin;              // the first segment that touches the pixel
    int lowest, highest;    // where it and the last one are, in segments after our first
};

// Another group, `place` segments ahead of ours.
void weigh(int first, int count, int place, vec4 circle, vec2 pixel, inout Claim claim) {
    vec2 apart = circle.xy - pixel;
    float within = circle.z + half_width + DIAGONAL + 1e-3;
    for (bool is_near = dot(apart, apart) < within * within; is_near; is_near = false) {
        Near other = near_group(first, count, pixel);
        claim.is_owner = claim.square < other.square
            || (claim.square == other.square && claim.first <= first);
        if (other.last >= 0 && place < claim.lowest) {
            claim.begin = first + other.first;
            claim.lowest = place + other.first;
        }
        if (other.last >= 0)
            claim.highest = max(claim.highest, place + other.last);
    }
}

void main() {
    vec2 pixel = gl_FragCoord.xy;
    Near own = near_group(group.x, group.y, pixel);
    Claim claim;
    claim = Claim(group.x, own.square, own.last >= 0, group.x + own.first, own.first, own.last);

    // Most pixels that belong to a neighbour are left at once.
    int segment = group.x, place = 0;
    for (int step = 1; step <= window.x && claim.is_owner; ++step) {
        int last = segment_before(line_of_group, segment);
        vec4 circle = circle_of(last);
        int count = int(abs(circle.w));
        segment = last - count + 1;
        place -= count;
        weigh(segment, count, place, circle, pixel, claim);
    }
    segment = group.x + group.y - 1;
    place = group.y;
    for (int step = 1; step <= window.y && claim.is_owner; ++step) {
        int first = segment_after(line_of_group, segment);
        vec4 circle = circle_of(first);
        int count = int(abs(circle.w));
        segment = first + count - 1;
        weigh(first, count, place, circle, pixel, claim);
        place += count;
    }
    if (!claim.is_owner)
        discard;

    float coverage = 1.0;
    // A loop that runs once or never: software rasterisers leave it, an `if` they execute.
    for (bool is_edge = sqrt(own.square) > half_width - DIAGONAL; is_edge; is_edge = false)
        coverage = coverage_of(claim.begin, claim.highest - claim.lowest + 1, pixel);
    if (coverage == 0.0)
        discard;   // nor does it hide what is behind
    fragment = vec4(color.rgb, color.a * coverage);
}
