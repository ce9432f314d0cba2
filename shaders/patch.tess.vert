// The tessellation evaluator, first stage: one vertex is one patch, and hands its number down.
// (gl_PrimitiveID restarts with every draw, and is wrong in later stages of some drivers.)

in int patch_index;
out int patch_of_vertex;

void main() {
    patch_of_vertex = patch_index;
    gl_Position = vec4(0.0);
}
