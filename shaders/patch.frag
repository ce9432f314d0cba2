// Colour of a patch: its picture through the texture map, or one colour; lit from the eye if asked.
//
// With multisampling a pixel on the rim is drawn though its centre lies outside, where the map is
// extrapolated and the picture's next square begins: specks. `centroid` would mend that, but
// jitter the picture along every inner edge too. Instead the map is followed, linear as it is in
// a triangle, from the pixel's centre to the nearest place whose (u,v) lie in the patch, and with
// smooth filtering as far inside as the filter reaches:
//
//        |   o  centre
//     ---+---|-------------- v = 1
//        |   x  inside             picture(o) + d(picture)/d(pixel) * (x - o)
//
// A field is told in the colours of a ramp, by g(s,t) or by s alone, with lines where it has equally
// spaced values; if it is to be EXACT its map is evaluated here instead of being interpolated.
//
// A trimmed surface is cut off at pixel centres, or BY_SAMPLE, or with ANTIALIASED fades into what
// is behind it by the share of the pixel that stays.

// Here, for a file is expanded once, under whatever condition.
#include "lib/net.glsl"

uniform vec4 color;
#ifdef PICTURE
uniform sampler2D image;
#endif
#ifdef TEXTURED
in vec3 image_map;       // homogeneous: a rational map stays linear in (x,y)
in vec2 parameters;
#endif
#ifdef RAMP
#include "lib/formula.glsl"
uniform float low, high, contours;
#else
uniform float reach;   // of the filter, in pixels: 0 for nearest
#endif
#ifdef LIT
in vec3 view_normal;
#endif
#ifdef LOCATED
#include "lib/evaluate.glsl"
#include "lib/curvature.glsl"
#include "lib/distortion.glsl"
#include "lib/shading.glsl"
flat in int located_patch;
in vec2 located_uv;
#endif
#if defined(SHAPED) || defined(DISTORTED) || defined(LEVEL) || defined(ERROR)
#define COLORED        // by a value, and lit mildly
uniform sampler2D position_net;
uniform float scale;   // of a value: where the colour is full
#ifdef GENERIC_DEGREE
uniform ivec2 position_degree;
#else
const ivec2 position_degree = ivec2(POSITION_DEGREE_U, POSITION_DEGREE_V);
#endif
#endif
#ifdef SHAPED
uniform mat3 view_from_model;
uniform vec4 sight;    // the eye is in direction (xy + zw * pixel, 1), in its coordinates
#endif
#ifdef LEVEL
flat in ivec2 inner_steps;
flat in ivec4 edge_steps;
#endif
#ifdef ERROR
centroid in vec3 drawn_place;
centroid in vec4 drawn_uv;
uniform mat4 clip_from_model;
uniform vec2 half_size;   // of the viewport, in pixels
#endif
#ifdef DISTORTED
uniform float middle;  // the value that is white
#endif
#ifdef MAPPED
uniform sampler2D map_net;
uniform int map_stride;   // 0: one map shared by all patches
#ifdef GENERIC_DEGREE
uniform ivec2 map_degree;
#else
const ivec2 map_degree = ivec2(MAP_DEGREE_U, MAP_DEGREE_V);
#endif
#endif
#ifdef TRIMMED
in vec2 trim_parameters;
#include "lib/trim.glsl"
#endif

out vec4 fragment;

#ifdef RAMP
vec4 look_up() {
#ifdef EXACT
    vec2 near = clamp(located_uv, -0.1, 1.1);   // a pixel on the rim may lie outside
    vec4 map = evaluate(map_net, located_patch * map_stride, map_degree,
                        vec4(near.x, 1.0 - near.x, near.y, 1.0 - near.y));
    vec2 at = map.xy / map.w;
#else
    vec2 at = image_map.xy / image_map.z;
#endif
    float share = (FIELD(at.x, at.y) - low) / (high - low);
    vec4 tint = textureLod(image, vec2(mix(0.002, 0.998, clamp(share, 0.0, 1.0)), 0.5), 0.0);
    float line = share * contours;
    float slope = fwidth(line), away = abs(line - round(line)) / max(slope, 1e-9);   // pixels
    if (slope > 1e-5 && line > 0.5 && line < contours - 0.5)   // a constant, an extreme: a blot
        tint.rgb *= mix(0.45, 1.0, clamp(away, 0.0, 1.0));
    return tint;
}
#elif defined(PICTURE)
// The shortest way, in pixels, that brings a parameter with this gradient into the patch.
vec2 way_inside(float parameter, vec2 gradient) {
    float margin = clamp(reach * (abs(gradient.x) + abs(gradient.y)), 1e-5, 0.5);
    float missing = clamp(parameter, margin, 1.0 - margin) - parameter;
    return gradient * (missing / max(dot(gradient, gradient), 1e-30));
}

vec4 look_up() {
    vec2 center = image_map.xy / image_map.z;
    vec2 image_x = dFdx(center), image_y = dFdy(center);
    vec2 gradient_u = vec2(dFdx(parameters.x), dFdy(parameters.x));
    vec2 gradient_v = vec2(dFdx(parameters.y), dFdy(parameters.y));
    vec2 way = vec2(0.0);
    for (int i = 0; i < 2; ++i) {   // in turn: u and v need not be orthogonal
        way += way_inside(parameters.x + dot(gradient_u, way), gradient_u);
        way += way_inside(parameters.y + dot(gradient_v, way), gradient_v);
    }
    vec2 at = center + mat2(image_x, image_y) * way;
#ifdef MIRRORED
    at = 1.0 - abs(mod(at, 2.0) - 1.0);
#endif
    // The derivatives of the map itself: smooth across rim and mirror.
    return textureGrad(image, at, image_x, image_y);
}
#endif

#ifdef LEVEL
// Steps along the nearest edge, in a rim of up to `scale` pixels; of the patch inside.
float shown_steps() {
    vec4 from_edge = vec4(located_uv, 1.0 - located_uv);
    vec2 across_u = vec2(dFdx(located_uv.x), dFdy(located_uv.x));
    vec2 across_v = vec2(dFdx(located_uv.y), dFdy(located_uv.y));
    vec2 rim = min(scale * vec2(length(across_u), length(across_v)), 0.08);
    for (int k = 0; k < 4; ++k)
        if (from_edge[k] < rim[k % 2])
            return float(edge_steps[k]);
    return sqrt(float(inner_steps.x) * float(inner_steps.y));
}
#endif

#ifdef ERROR
// Between where the triangle has (u,v) and where the surface has it. Both are taken at one place of
// the pixel, inside the triangle, and so with multisampling too.
float pixels_off() {
    vec4 exact =
        clip_from_model * evaluate(position_net, located_patch, position_degree, drawn_uv);
    return length((drawn_place.xy / drawn_place.z - exact.xy / exact.w) * half_size);
}
#endif

void main() {
    fragment = color;
#ifdef LEVEL
    fragment.rgb = level_color(shown_steps());
#endif
#ifdef ERROR
    fragment.rgb = error_color(pixels_off() / scale);
#endif
#ifdef PICTURE
    fragment *= look_up();
#endif
#ifdef LOCATED
    vec2 inside = clamp(located_uv, 0.0, 1.0);   // a pixel on the rim may lie outside
    vec4 uv = vec4(inside.x, 1.0 - inside.x, inside.y, 1.0 - inside.y);
#endif
#ifdef DISTORTED
    vec3 distortion = distortions(position_net, position_degree, map_net, map_stride, map_degree,
                                  located_patch, uv);
#if defined(AREA)
    fragment.rgb *= diverging((distortion.x - middle) / scale);
#elif defined(STRETCH)
    fragment.rgb *= diverging((distortion.y - middle) / scale);
#else
    fragment.rgb *= diverging((distortion.z - middle) / scale);
#endif
#endif
#ifdef LIT
    // Two-sided, from over the eye's left shoulder.
    vec3 normal = normalize(view_normal);
#ifdef COLORED
    float ambient = 0.75;
#else
    float ambient = 0.45;
#endif
#ifdef SHAPED
    vec3 exact;
    vec2 curvature = curvatures(position_net, located_patch, position_degree, uv, exact);
    if (dot(exact, exact) > 0.0)
        normal = normalize(view_from_model * exact);
#ifdef ZEBRA
    vec3 eye = normalize(vec3(sight.xy + sight.zw * gl_FragCoord.xy, 1.0));
    fragment.rgb *= mix(0.12, 1.0, zebra(normal, eye));
#else
#ifdef GAUSS
    fragment.rgb *= diverging(curvature.x / scale);
#else
    fragment.rgb *= diverging(curvature.y / scale);
#endif
#endif
#endif
    float facing = abs(dot(normal, normalize(vec3(-0.35, 0.45, 1.0))));
    fragment.rgb *= ambient + (1.0 - ambient) * facing;
#endif
#ifdef TRIMMED
#ifdef BY_SAMPLE
    keep_samples(trim_parameters);
#else
#ifdef ANTIALIASED
    float share = pixel_coverage(trim_parameters, dFdx(trim_parameters), dFdy(trim_parameters));
#else
    float share = winding_number(trim_parameters) != 0 ? 1.0 : 0.0;
#endif
    if (share == 0.0)
        discard;
    fragment.a *= share;
#endif
#endif
}
