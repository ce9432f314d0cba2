// A rectangle of pixels: text that was set beforehand, one texel a pixel, or a plain ground.

uniform vec2 viewport;
uniform vec4 box;   // left, bottom, right, top, in pixels from the lower left

in vec2 corner;     // 0 .. 1
out vec2 at;

void main() {
    at = corner;
    gl_Position = vec4(mix(box.xy, box.zw, corner) / viewport * 2.0 - 1.0, 0.0, 1.0);
}
