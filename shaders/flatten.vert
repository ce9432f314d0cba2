// Points of polylines onto the picture's pixels, once for each view; captured, and then read as a
// texture by lib/polyline.glsl.

uniform mat4 clip_from_model;
uniform vec4 region;    // left, bottom, width, height of the viewport, in pixels

in vec4 point;

out vec4 place;

void main() {
    vec4 clip = clip_from_model * point;
    vec3 normalised = clip.xyz / clip.w;
    place = vec4(region.xy + (normalised.xy * 0.5 + 0.5) * region.zw, normalised.z, 1.0);
}
