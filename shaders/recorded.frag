// OpenGL's lighting (2.1 specification, 2.14.1: one light, no attenuation, a viewer at infinity),
// for each fragment and on both sides, and GL_MODULATE with a texture.  As in recorded.vert, and
//
//   ONE_SIDED       what is seen from behind is lit as from the front
//   SHINY           there is a highlight
//   COLOR_MATERIAL  the colour is the ambient and the diffuse material

#ifdef COLORED
in vec4 vertex_color;
#else
uniform vec4 vertex_color;
#endif
#ifdef LIT
in vec3 eye_normal;
uniform vec4 light_position;      // in eye coordinates; a direction has the length 1
uniform vec3 ambient, diffuse;    // light times material, but for a COLOR_MATERIAL
#ifdef POSITIONAL
in vec4 eye_position;
#endif
#ifdef SHINY
uniform vec3 specular;            // light times material
uniform float shininess;
#endif
#endif
#ifdef TEXTURED
#ifdef PROJECTIVE
in vec3 vertex_texcoord;
#else
in vec2 vertex_texcoord;
#endif
uniform sampler2D image;
#endif
#ifdef TRIMMED
in vec2 trim_parameters;
#include "lib/trim.glsl"
#endif

out vec4 fragment;

#ifdef LIT
vec4 lit_color() {
#ifdef ONE_SIDED
    vec3 normal = normalize(eye_normal);
#else
    vec3 normal = normalize(gl_FrontFacing ? eye_normal : -eye_normal);
#endif
#ifdef POSITIONAL
    vec3 to_light = normalize(light_position.xyz * eye_position.w -
                              eye_position.xyz * light_position.w);
#else
    vec3 to_light = light_position.xyz;
#endif
    float facing = max(dot(normal, to_light), 0.0);
    vec4 sum = vec4(ambient + facing * diffuse, 1.0);
#ifdef COLOR_MATERIAL
    sum *= vertex_color;
#endif
#ifdef SHINY
    vec3 halfway = normalize(to_light + vec3(0.0, 0.0, 1.0));
    float shine = facing > 0.0 ? pow(max(dot(normal, halfway), 0.0), shininess) : 0.0;
    sum.rgb += shine * specular;
#endif
    return sum;
}
#endif

void main() {
#ifdef LIT
    fragment = lit_color();
#else
    fragment = vertex_color;
#endif
#ifdef TEXTURED
#ifdef PROJECTIVE
    fragment *= textureProj(image, vertex_texcoord);
#else
    fragment *= texture(image, vertex_texcoord);
#endif
#endif
#ifdef TRIMMED
#ifdef BY_SAMPLE
    keep_samples(trim_parameters);
#else
    if (winding_number(trim_parameters) == 0)
        discard;
#endif
#endif
}
