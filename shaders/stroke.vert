// Thick lines: one instance a segment, a strip of two triangles as wide as the line and a little
// more, in pixels.  Neighbouring segments share the miter at their common point:
//
//        before      start              end       after
//           o---------o------------------o---------o
//                     |##################|
//                     miter          miter
//
// Where no segment joins, or the line turns by more than a right angle, it ends in a square cap.
// Core profile draws no lines wider than a pixel.

uniform mat4 clip_from_model;
uniform vec2 viewport;      // pixels
uniform float half_width;   // pixels
uniform float depth_bias;   // towards the eye, in normalised depth

in vec2 corner;             // (0 start .. 1 end, -1 right .. +1 left)
in vec4 before, start, end, after;
in float joins_before, drawn, joins_after;   // 1 or 0

out float across;           // pixels from the line's middle

const float FEATHER = 1.0;

vec2 pixel(vec4 clip) {
    return clip.xy / clip.w * 0.5 * viewport;
}

void main() {
    vec4 clip_start = clip_from_model * start, clip_end = clip_from_model * end;
    vec2 a = pixel(clip_start), b = pixel(clip_end);
    float span = length(b - a);
    if (drawn == 0.0 || !(span > 1e-4)) {
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);   // clipped
        across = 0.0;
        return;
    }
    vec2 along = (b - a) / span;
    vec2 left = vec2(-along.y, along.x);
    bool at_end = corner.x > 0.5;
    vec2 beyond = at_end ? pixel(clip_from_model * after) - b : a - pixel(clip_from_model * before);
    float reach = length(beyond);
    bool joined = (at_end ? joins_after : joins_before) > 0.0 && reach > 1e-4;
    vec2 at = at_end ? b : a;
    vec2 side = left;
    if (joined && dot(along, beyond) > 0.0) {
        vec2 tangent = normalize(along + beyond / reach);
        side = vec2(-tangent.y, tangent.x) / dot(tangent, along);
    } else {
        at += along * (at_end ? half_width : -half_width);
    }
    across = corner.y * (half_width + FEATHER);
    vec4 clip = at_end ? clip_end : clip_start;
    gl_Position = vec4((at + side * across) / (0.5 * viewport), clip.z / clip.w - depth_bias, 1.0);
}
