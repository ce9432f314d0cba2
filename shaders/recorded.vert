// What the evaluators recorded, in the place of fixed function.  OpenGL 3.3.
// Its maps are attributes now, or, with INSTANCED, the vertex map is evaluated on the spot:
// an instance is a patch, whose control points are attributes too (lib/net.glsl).
//
//   AUTO_NORMAL  so is the normal
//
// Small triangles cost what is interpolated over them, so nothing is that need not be:
//
//   COLORED     the colours differ from vertex to vertex; else one for all
//   TRIMMED     each fragment is to be decided
//   PROJECTIVE  the texture coordinates have a fourth one to be divided by
//   POSITIONAL  the light stands somewhere; else it comes from one direction

#ifdef INSTANCED
#include "lib/evaluate.glsl"
#include "lib/normal.glsl"
in vec4 parameters;
uniform sampler2D net;   // not read: the control points are attributes
const ivec2 degree = ivec2(DEGREE_U, DEGREE_V);
#else
in vec4 position;
#endif
uniform mat4 projection, modelview;

#ifdef COLORED
in vec4 color;
out vec4 vertex_color;
#endif
#ifdef LIT
#ifndef AUTO_NORMAL
in vec3 normal;
#endif
uniform mat3 normal_matrix;
out vec3 eye_normal;
#ifdef POSITIONAL
out vec4 eye_position;
#endif
#endif
#ifdef TEXTURED
in vec4 texcoord;
#ifdef PROJECTIVE
out vec3 vertex_texcoord;
#else
out vec2 vertex_texcoord;
#endif
#endif

#ifdef TRIMMED
#ifdef INSTANCED
in vec4 trim_place;   // where the patch begins and ends in the region's unit square
#else
in vec2 trim_place;
#endif
out vec2 trim_parameters;
#endif

void main() {
#ifdef INSTANCED
    vec4 position;
#if defined(LIT) && defined(AUTO_NORMAL)
    vec3 normal = surface_normal(net, 0, degree, parameters, position);
#else
    position = evaluate(net, 0, degree, parameters);
#endif
#if COMPONENTS == 3
    position.w = 1.0;
#endif
#endif
    vec4 eye = modelview * position;
    gl_Position = projection * eye;
#ifdef TRIMMED
#ifdef INSTANCED
    trim_parameters = trim_place.xy * parameters.yw + trim_place.zw * parameters.xz;
#else
    trim_parameters = trim_place;
#endif
#endif
#ifdef COLORED
    vertex_color = color;
#endif
#ifdef LIT
    eye_normal = normal_matrix * normal;
#ifdef POSITIONAL
    eye_position = eye;
#endif
#endif
#ifdef TEXTURED
#ifdef PROJECTIVE
    vertex_texcoord = texcoord.xyw;
#else
    vertex_texcoord = texcoord.xy;
#endif
#endif
}
