// An arrow head: the triangle with its tip at (size, 0), antialiased by its distance.

uniform vec4 color;
uniform float size;
in vec2 place;
out vec4 fragment;

void main() {
    const vec2 FLANK = vec2(0.342, 0.940);   // normal of a flank, 20 degrees off the axis
    float outside = max(-size - place.x, dot(vec2(place.x - size, abs(place.y)), FLANK));
    fragment = vec4(color.rgb, color.a * clamp(0.5 - outside, 0.0, 1.0));
}
