// The tessellation evaluator, second stage: how finely.  OpenGL 4.0.
//
// A level above the hardware's (64) is drawn as tiles; `tile` says where this one begins and how
// many steps it has in u and v:
//
//   v ^  +----+----+--+
//     |  | 64 | 64 |12|     level 140
//     +-> u ----+---+--+

layout(vertices = 1) out;

in int patch_of_vertex[];
out int patch_of_surface[];

uniform ivec4 tile;   // first step in u, in v; steps in u, in v

void main() {
    patch_of_surface[gl_InvocationID] = patch_of_vertex[gl_InvocationID];
    vec2 steps = vec2(tile.zw);
    gl_TessLevelInner[0] = steps.x;
    gl_TessLevelInner[1] = steps.y;
    gl_TessLevelOuter[0] = steps.y;   // u = 0
    gl_TessLevelOuter[1] = steps.x;   // v = 0
    gl_TessLevelOuter[2] = steps.y;   // u = 1
    gl_TessLevelOuter[3] = steps.x;   // v = 1
}
