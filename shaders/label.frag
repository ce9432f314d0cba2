// The text's coverage in its colour.

uniform sampler2D coverage;
uniform vec4 color;
in vec2 at;
out vec4 fragment;

void main() {
    fragment = vec4(color.rgb, color.a * texture(coverage, at).r);
}
