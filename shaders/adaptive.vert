// The vertex evaluator where each patch has its own levels: patches of one level are drawn together,
// one instance a patch.  OpenGL 3.3.

#include "lib/maps.glsl"
#include "lib/grid.glsl"
#include "lib/snap.glsl"

in ivec2 step_index;
in int patch_index;
in ivec4 outer;   // steps of the edges u = 0, v = 0, u = 1, v = 1, at most those of the patch

uniform ivec2 level;

void main() {
    ivec2 k = step_index, n = level;
    snap(k, n, ivec4(ivec2(0), level), outer);
    emit_surface(patch_index, grid_parameters(k, n));
#ifdef LEVEL
    emit_steps(level, outer);
#endif
}
