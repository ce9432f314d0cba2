// The vertex evaluator where each patch has its own levels: all patches in one draw, whose vertices
// say where on which patch they lie (geometry/stitching.py).  OpenGL 3.3.

#include "lib/maps.glsl"
#include "lib/grid.glsl"

in int patch_index;
in uvec4 place;   // (k, n, l, m): u = k/n, v = l/m
#ifdef LEVEL
in ivec2 inner;   // steps of the patch, in u and v
in ivec4 outer;   // of its edges u = 0, v = 0, u = 1, v = 1
#endif

void main() {
    ivec4 at = ivec4(place);
    emit_surface(patch_index, grid_parameters(at.xz, at.yw));
#ifdef LEVEL
    emit_steps(inner, outer);
#endif
}
