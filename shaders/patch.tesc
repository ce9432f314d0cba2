// The tessellation evaluator, second stage: how finely.  OpenGL 4.0.
//
// A level above the hardware's (64) is drawn as tiles; `tile` says where this one begins and how
// many steps it has in u and v:
//
//   v ^  +----+----+--+
//     |  | 64 | 64 |12|     level 140
//     +-> u ----+---+--+
//
// With ADAPTIVE each patch brings its own levels, and those of its edges.

layout(vertices = 1) out;

in int patch_of_vertex[];
in ivec4 tile_of_vertex[];
out int patch_of_surface[];
out ivec4 tile_of_surface[];

#ifdef ADAPTIVE
in ivec2 inner_of_vertex[];
in ivec4 outer_of_vertex[];   // of the edges u = 0, v = 0, u = 1, v = 1
out ivec2 inner_of_surface[];
out ivec4 outer_of_surface[];
#endif

void main() {
    patch_of_surface[gl_InvocationID] = patch_of_vertex[gl_InvocationID];
    tile_of_surface[gl_InvocationID] = tile_of_vertex[gl_InvocationID];
#ifdef ADAPTIVE
    inner_of_surface[gl_InvocationID] = inner_of_vertex[gl_InvocationID];
    outer_of_surface[gl_InvocationID] = outer_of_vertex[gl_InvocationID];
#endif
    vec2 steps = vec2(tile_of_vertex[0].zw);
    gl_TessLevelInner[0] = steps.x;
    gl_TessLevelInner[1] = steps.y;
    gl_TessLevelOuter[0] = steps.y;   // u = 0
    gl_TessLevelOuter[1] = steps.x;   // v = 0
    gl_TessLevelOuter[2] = steps.y;   // u = 1
    gl_TessLevelOuter[3] = steps.x;   // v = 1
}
