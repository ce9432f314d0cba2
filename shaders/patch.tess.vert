// The tessellation evaluator, first stage: one vertex is one tile of a patch, and hands its number
// down.
// (gl_PrimitiveID restarts with every draw, and is wrong in later stages of some drivers.)

in int patch_index;
in ivec4 tile;   // first step in u, in v; steps in u, in v
out int patch_of_vertex;
out ivec4 tile_of_vertex;
#ifdef ADAPTIVE
in ivec2 inner;
in ivec4 outer;
out ivec2 inner_of_vertex;
out ivec4 outer_of_vertex;
#endif

void main() {
    patch_of_vertex = patch_index;
    tile_of_vertex = tile;
#ifdef ADAPTIVE
    inner_of_vertex = inner;
    outer_of_vertex = outer;
#endif
    gl_Position = vec4(0.0);
}
