// The tessellation evaluator, first stage: one vertex is one patch, and hands its number down.
// (gl_PrimitiveID restarts with every draw, and is wrong in later stages of some drivers.)

in int patch_index;
out int patch_of_vertex;
#ifdef ADAPTIVE
in ivec2 inner;
in ivec4 outer;
in ivec4 tile;
out ivec2 inner_of_vertex;
out ivec4 outer_of_vertex;
out ivec4 tile_of_vertex;
#endif

void main() {
    patch_of_vertex = patch_index;
#ifdef ADAPTIVE
    inner_of_vertex = inner;
    outer_of_vertex = outer;
    tile_of_vertex = tile;
#endif
    gl_Position = vec4(0.0);
}
