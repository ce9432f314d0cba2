// The vertex evaluator where each patch has its own levels: patches of one level are drawn together,
// one instance a patch, and vertices on an edge snap to the steps of that edge:
//
//     +--+--+--+--+     level 4 here
//     |  |  |  |  |
//     +--+--+--+--+     edge v = 0 in 2 steps: vertices 1 and 3 go to the nearest,
//     +-----+-----+     the triangles there lose their area, neighbours meet
//
// OpenGL 3.3.

#include "lib/maps.glsl"
#include "lib/grid.glsl"

in ivec2 step_index;
in int patch_index;
in ivec4 outer;   // steps of the edges u = 0, v = 0, u = 1, v = 1, at most those of the patch

uniform ivec2 level;

void snap(inout int index, inout int steps, int edge_steps) {
    index = (2 * index * edge_steps + steps) / (2 * steps);
    steps = edge_steps;
}

void main() {
    ivec2 k = step_index, n = level;
    if (step_index.x == 0 || step_index.x == level.x)
        snap(k.y, n.y, step_index.x == 0 ? outer.x : outer.z);
    if (step_index.y == 0 || step_index.y == level.y)
        snap(k.x, n.x, step_index.y == 0 ? outer.y : outer.w);
    emit_surface(patch_index, grid_parameters(k, n));
#ifdef LEVEL
    emit_steps(level, outer);
#endif
}
