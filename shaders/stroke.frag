// Antialiased across: full within the half width, gone one pixel further.

uniform vec4 color;
uniform float half_width;
in float across;
out vec4 fragment;

void main() {
    float coverage = clamp(half_width + 0.5 - abs(across), 0.0, min(1.0, 2.0 * half_width));
    fragment = vec4(color.rgb, color.a * coverage);
}
