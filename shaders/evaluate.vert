// The vertex evaluator: a net at a list of parameters, one instance a patch; what glMapGrid2 and
// glEvalMesh2 did.  OpenGL 3.3.  The results are captured by transform feedback, so a surface is
// evaluated once for each change of its net and drawn any number of times.
//
//   v ^  +--+--+--+     parameters: (u, 1-u, v, 1-v), a grid or any other list
//     |  +--+--+--+     gl_InstanceID: the patch
//     +-> u

#include "lib/evaluate.glsl"
#include "lib/normal.glsl"

in vec4 parameters;

uniform sampler2D net;
uniform int first_patch;
#ifdef GENERIC_DEGREE
uniform ivec2 degree;
#else
const ivec2 degree = ivec2(DEGREE_U, DEGREE_V);
#endif

out vec4 point;
#ifdef NORMALS
out vec3 normal;
#endif

void main() {
#ifdef INSTANCED
    const int patch_index = 0;
#else
    int patch_index = first_patch + gl_InstanceID;
#endif
#ifdef NORMALS
    normal = surface_normal(net, patch_index, degree, parameters, point);
#else
    point = evaluate(net, patch_index, degree, parameters);
#endif
}
