// What the evaluators recorded, in the place of fixed function: its maps are attributes now.
// OpenGL 3.3.  Small triangles cost what is interpolated over them, so nothing is that need not be:
//
//   COLORED     the colours differ from vertex to vertex; else one for all
//   PROJECTIVE  the texture coordinates have a fourth one to be divided by
//   POSITIONAL  the light stands somewhere; else it comes from one direction

in vec4 position;
uniform mat4 projection, modelview;

#ifdef COLORED
in vec4 color;
out vec4 vertex_color;
#endif
#ifdef LIT
in vec3 normal;
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

void main() {
    vec4 eye = modelview * position;
    gl_Position = projection * eye;
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
