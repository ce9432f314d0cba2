// The tessellation evaluator, second stage: how finely.  OpenGL 4.0.
//
// A level above the hardware's (64) is drawn as tiles; `tile` says where this one begins and how
// many steps it has in u and v:
//
//   v ^  +----+----+--+
//     |  | 64 | 64 |12|     level 140
//     +-> u ----+---+--+

//
// With ADAPTIVE each patch brings its own levels and those of its edges, and all are drawn in
// tile.z x tile.z tiles of equal size.

layout(vertices = 1) out;

in int patch_of_vertex[];
out int patch_of_surface[];

#ifdef ADAPTIVE
in ivec2 inner_of_vertex[];
in ivec4 outer_of_vertex[];   // of the edges u = 0, v = 0, u = 1, v = 1

uniform ivec3 tile;   // which in u, in v; how many along each side

int share(int steps) {
    return (steps + tile.z - 1) / tile.z;
}

// Between tiles of one patch its own level, along its edges theirs. (The tessellator makes two
// steps of one where any edge has more.)
void set_levels(ivec2 inner, ivec4 outer) {
    ivec2 steps = ivec2(share(inner.x), share(inner.y));
    bool first_u = tile.x == 0, last_u = tile.x == tile.z - 1;
    bool first_v = tile.y == 0, last_v = tile.y == tile.z - 1;
    ivec4 edges = ivec4(first_u ? share(outer.x) : steps.y, first_v ? share(outer.y) : steps.x,
                        last_u ? share(outer.z) : steps.y, last_v ? share(outer.w) : steps.x);
    if (any(greaterThan(edges, ivec4(1))) || any(greaterThan(steps, ivec2(1))))
        steps = max(steps, ivec2(2));
    gl_TessLevelInner[0] = float(steps.x);
    gl_TessLevelInner[1] = float(steps.y);
    for (int i = 0; i < 4; ++i)
        gl_TessLevelOuter[i] = float(edges[i]);
}
#else
uniform ivec4 tile;   // first step in u, in v; steps in u, in v
#endif

void main() {
    patch_of_surface[gl_InvocationID] = patch_of_vertex[gl_InvocationID];
#ifdef ADAPTIVE
    set_levels(inner_of_vertex[0], outer_of_vertex[0]);
#else
    vec2 steps = vec2(tile.zw);
    gl_TessLevelInner[0] = steps.x;
    gl_TessLevelInner[1] = steps.y;
    gl_TessLevelOuter[0] = steps.y;   // u = 0
    gl_TessLevelOuter[1] = steps.x;   // v = 0
    gl_TessLevelOuter[2] = steps.y;   // u = 1
    gl_TessLevelOuter[3] = steps.x;   // v = 1
#endif
}
