// Letters and shapes of Dear ImGui are white on transparent; their colour comes with the vertices.

uniform sampler2D atlas;

in vec2 at;
in vec4 color;
out vec4 fragment;

void main() {
    fragment = color * texture(atlas, at);
}
