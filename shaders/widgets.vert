// Triangles of Dear ImGui: places in the window's own units, y down, from its upper left corner.

uniform vec2 window;   // its size in those units

in vec2 place;
in vec2 texel;
in vec4 tint;

out vec2 at;
out vec4 color;

void main() {
    at = texel;
    color = tint;
    gl_Position = vec4(2.0 * place.x / window.x - 1.0, 1.0 - 2.0 * place.y / window.y, 0.0, 1.0);
}
