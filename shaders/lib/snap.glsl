// Where a patch has other levels than an edge of it, vertices on the edge go to the edge's steps:
//
//     +--+--+--+--+--+--+     level 6 here; diagonals run towards the middle,
//     | /| /| /|\ |\ |\ |     as tessellators draw them
//     +--+--+--+--+--+--+     edge v = 0 in 4 steps: vertices 1 and 2 go up to 1 and 2,
//     +----+----+----+----+   4 and 5 down to 2 and 3; neighbours meet
//
// Towards the middle, so that no triangle spans more than a step of the edge.
// Twin: snapped in geometry/edge_levels.py

int snapped(int index, int steps, int edge_steps) {
    int before = (min(index, steps / 2) * edge_steps + steps - 1) / steps;
    return index > steps / 2 ? max(index * edge_steps / steps, before) : before;
}

// A vertex of a tile, (first step in u, in v; steps in u, in v), of a patch of `steps`: where it is
// among the patch's steps, or those of an edge of it (u = 0, v = 0, u = 1, v = 1) where they are
// fewer: then tiles are equal, on the edge too.
void snap(inout ivec2 index, inout ivec2 steps, ivec4 tile, ivec4 edges) {
    ivec2 at = index, own = steps;
    index += tile.xy;
    bvec2 first = equal(index, ivec2(0)), last = equal(index, own);
    if (first.x || last.x)
        steps.y = first.x ? edges.x : edges.z;
    if (first.y || last.y)
        steps.x = first.y ? edges.y : edges.w;
    if (steps.y != own.y) {
        int share = steps.y * tile.w / own.y;
        index.y = tile.y / tile.w * share + snapped(at.y, tile.w, share);
    }
    if (steps.x != own.x) {
        int share = steps.x * tile.z / own.x;
        index.x = tile.x / tile.z * share + snapped(at.x, tile.z, share);
    }
}
