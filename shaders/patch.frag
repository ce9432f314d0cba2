// Colour of a patch: its picture through the texture map, or one colour; lit from the eye if asked.
//
// With multisampling a pixel on the rim is drawn though its centre lies outside, where the map is
// extrapolated and the picture's next square begins: specks. `centroid` would mend that, but
// jitter the picture along every inner edge too. Instead the map is followed, linear as it is in
// a triangle, from the pixel's centre to the nearest parameters that lie in the patch, and with
// smooth filtering as far inside as the filter reaches:
//
//        |   o  centre, at (u,v)
//     ---+---|-------------- v = 1
//        |   x  inside.y         picture(o) + d(picture)/d(u,v) * (x - o)

uniform vec4 color;
#ifdef TEXTURED
uniform sampler2D image;
uniform float reach;   // of the filter, in pixels: 0 for nearest
in vec2 image_coordinates;
in vec2 parameters;
#endif
#ifdef LIT
in vec3 view_normal;
#endif

out vec4 fragment;

#ifdef TEXTURED
vec4 look_up() {
    vec2 image_x = dFdx(image_coordinates), image_y = dFdy(image_coordinates);
    mat2 uv_from_pixels = mat2(dFdx(parameters), dFdy(parameters));
    vec2 margin = clamp(reach * (abs(uv_from_pixels[0]) + abs(uv_from_pixels[1])), 1e-5, 0.5);
    vec2 step_inside = clamp(parameters, margin, 1.0 - margin) - parameters;
    vec2 at = image_coordinates;
    if (step_inside != vec2(0.0) && determinant(uv_from_pixels) != 0.0)
        at += mat2(image_x, image_y) * (inverse(uv_from_pixels) * step_inside);
#ifdef MIRRORED
    at = 1.0 - abs(mod(at, 2.0) - 1.0);
#endif
    // The derivatives of the map itself: smooth across rim and mirror.
    return textureGrad(image, at, image_x, image_y);
}
#endif

void main() {
    fragment = color;
#ifdef TEXTURED
    fragment *= look_up();
#endif
#ifdef LIT
    // Two-sided, from over the eye's left shoulder.
    vec3 normal = normalize(view_normal);
    float facing = abs(dot(normal, normalize(vec3(-0.35, 0.45, 1.0))));
    fragment.rgb *= 0.45 + 0.55 * facing;
#endif
}
