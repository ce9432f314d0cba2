// What the evaluators recorded, in the place of fixed function: its maps are attributes now, or
// OpenGL's current values where no map feeds them.  OpenGL 3.3.

in vec4 position;
in vec4 color;
#ifdef LIT
in vec3 normal;
#endif
#ifdef TEXTURED
in vec4 texcoord;
#endif

uniform mat4 projection, modelview;

out vec4 vertex_color;
#ifdef LIT
uniform mat3 normal_matrix;
out vec3 eye_normal;
out vec4 eye_position;
#endif
#ifdef TEXTURED
out vec4 vertex_texcoord;
#endif

void main() {
    vec4 eye = modelview * position;
    gl_Position = projection * eye;
    vertex_color = color;
#ifdef LIT
    eye_position = eye;
    eye_normal = normal_matrix * normal;
#endif
#ifdef TEXTURED
    vertex_texcoord = texcoord;
#endif
}
