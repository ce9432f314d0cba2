// OpenGL's lighting (2.1 specification, 2.14.1: one light, no attenuation, a viewer at infinity),
// for each fragment and on both sides, and GL_MODULATE with a texture.

in vec4 vertex_color;
#ifdef LIT
in vec3 eye_normal;
in vec4 eye_position;
uniform vec4 light_position;      // in eye coordinates
uniform vec3 light_ambient;       // the light's and the model's
uniform vec3 light_diffuse;
uniform vec3 specular;            // light times material
uniform vec3 material_ambient, material_diffuse;
uniform float shininess;
uniform bool color_material;
#endif
#ifdef TEXTURED
in vec4 vertex_texcoord;
uniform sampler2D image;
#endif

out vec4 fragment;

#ifdef LIT
vec4 lit_color() {
    vec3 normal = normalize(gl_FrontFacing ? eye_normal : -eye_normal);
    vec3 to_light = normalize(light_position.xyz * eye_position.w -
                              eye_position.xyz * light_position.w);
    vec3 halfway = normalize(to_light + vec3(0.0, 0.0, 1.0));
    float facing = max(dot(normal, to_light), 0.0);
    float shine = facing > 0.0 ? pow(max(dot(normal, halfway), 0.0), shininess) : 0.0;
    vec3 ambient = color_material ? vertex_color.rgb : material_ambient;
    vec3 diffuse = color_material ? vertex_color.rgb : material_diffuse;
    return vec4(ambient * light_ambient + facing * diffuse * light_diffuse + shine * specular,
                color_material ? vertex_color.a : 1.0);
}
#endif

void main() {
#ifdef LIT
    fragment = lit_color();
#else
    fragment = vertex_color;
#endif
#ifdef TEXTURED
    fragment *= textureProj(image, vertex_texcoord.xyw);
#endif
}
