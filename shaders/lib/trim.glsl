// Which part of a surface stays, decided for each fragment in the parameter domain.
// Twin: geometry/trimming/lookup.py, same names; geometry/trimming/packing.py packs what is read.
//
// The region's unit square is a grid of cells, and a crowded cell is a grid again. A cell has a
// winding number and the pieces of trim curves near it, each the graph of a polynomial over u
// (flat) or over v (steep):
//
//      +--------+      v = f(u)  or  u = f(v):  y0 + tau (y1 - y0) + tau (1 - tau) bump(tau)
//      |  o-----|-*
//      |     ___|/     the point o has the cell's winding number and, for each piece that the
//      +----/---+      ray to the right meets, 1 more where it runs up, 1 less where down
//
// (W. Schollmeyer and B. Froehlich, Direct trimming of NURBS surfaces on the GPU, 2009, with
// graphs in place of their bisection.)

#include "net.glsl"

uniform isampler2D trim_nodes;   // first piece, steep + 65536 flat ones, winding number, first cell
uniform sampler2D trim_pieces;   // three texels a piece: (u0, v0, u1, v1), b0 .. b3, b4 .. b7
uniform sampler2D trim_shares;   // of the cells of the first grid, mip-mapped
uniform int trim_side;           // cells along a side of the first grid

ivec4 trim_node(int index) {
    return texelFetch(trim_nodes, ivec2(index % NET_WIDTH, index / NET_WIDTH), 0);
}

// The node of the smallest cell around a point whose margin is as wide as `reach`, and its size.
ivec4 find_leaf(vec2 uv, float reach, out float size) {
    vec2 place = clamp(uv, 0.0, 1.0) * float(trim_side);
    ivec2 cell = min(ivec2(place), trim_side - 1);
    ivec4 node = trim_node(cell.y * trim_side + cell.x);
    size = 1.0 / float(trim_side);
    while (node.w > 0 && reach * float(TRIM_DIVISION) <= TRIM_MARGIN * size) {
        place = (place - vec2(cell)) * float(TRIM_DIVISION);
        cell = min(ivec2(place), TRIM_DIVISION - 1);
        node = trim_node(node.w + cell.y * TRIM_DIVISION + cell.x);
        size /= float(TRIM_DIVISION);
    }
    return node;
}

int piece_count(ivec4 node) {
    return (node.y & 0xFFFF) + (node.y >> 16);
}

vec4 trim_texel(int piece, int part) {
    return control_point(trim_pieces, 3 * piece + part);
}

// The bump of a piece's graph: b0 .. b7.
struct Bump { vec4 low, high; };

Bump trim_bump(int piece) {
    return Bump(trim_texel(piece, 1), trim_texel(piece, 2));
}

// f(x) of a graph that runs from (x0, y0) to (x1, y1).
float graph_value(vec4 ends, Bump bump, float x) {
    float tau = (x - ends.x) / (ends.z - ends.x);
    float high = bump.high.x + tau * (bump.high.y + tau * (bump.high.z + tau * bump.high.w));
    float swell = bump.low.x + tau * (bump.low.y + tau * (bump.low.z + tau * (bump.low.w + tau * high)));
    return ends.y + tau * (ends.w - ends.y) + tau * (1.0 - tau) * swell;
}

// By how much the winding number changes where the ray to the right from a point meets a piece.
int ray_way(vec4 piece, vec2 uv) {
    return (piece.y <= uv.y) == (piece.w <= uv.y) ? 0 : piece.w > piece.y ? 1 : -1;
}

// Whether the piece is on the right of a point at its height; `value`: of the graph there.
bool on_the_right(vec4 piece, bool steep, float value, vec2 uv) {
    bool rising = (piece.w > piece.y) == (piece.z > piece.x);
    return steep ? value > uv.x : rising ? value <= uv.y : value > uv.y;
}

// Whether a point is in the bounding box of a piece, `reach` wider.
bool is_near(vec4 piece, vec2 uv, vec2 reach) {
    vec2 low = min(piece.xy, piece.zw) - reach, high = max(piece.xy, piece.zw) + reach;
    return uv.x >= low.x && uv.y >= low.y && uv.x <= high.x && uv.y <= high.y;
}

// What pieces tell by their bounding boxes, 30 at a time: the change of the winding number by
// those that a point is not near, and the set of the others, one bit each. (Software rasterisers
// execute an `if` for every fragment, and a loop at least once: so this is one loop, and what
// takes long is another, over few.)
int scan_pieces(int first, int count, vec2 uv, vec2 reach, out int near) {
    int turns = 0, bit = 1;
    near = 0;
    do {
        vec4 piece = trim_texel(first, 0);
        bool here = is_near(piece, uv, reach);
        near |= here && count > 0 ? bit : 0;
        turns += !here && count > 0 && uv.x < piece.x ? ray_way(piece, uv) : 0;
        bit *= 2;
        ++first;
        --count;
    } while (count > 0 && bit < 1 << 30);
    return turns;
}

int lowest_bit(int set) {
    return int(log2(float(set & -set)) + 0.5);
}

// 1 where the surface stays, 0 where not.
int winding_number(vec2 uv) {
    float size;
    ivec4 node = find_leaf(uv, 0.0, size);
    int winding = node.z, steeps = node.y & 0xFFFF, count = piece_count(node), near;
    int done = 0;
    do {
        winding += scan_pieces(node.x + done, count - done, uv, vec2(0.0), near);
        do {
            int i = done + lowest_bit(max(near, 1));
            vec4 piece = trim_texel(node.x + i, 0);
            Bump bump = trim_bump(node.x + i);
            bool steep = i < steeps;
            vec4 ends = steep ? piece.yxwz : piece;
            float value = graph_value(ends, bump, steep ? uv.y : uv.x);
            winding += near != 0 && on_the_right(piece, steep, value, uv) ? ray_way(piece, uv) : 0;
            near &= near - 1;
        } while (near != 0);
        done += 30;
    } while (done < count);
    return winding;
}

// Integral of clamp(x) - sign(x)/2 over [-1/2, 1/2], from 0.
float beside(float x) {
    float within = min(abs(x), 0.5);
    return 0.5 * within * (within - 1.0);
}

// By how much a segment, in pixels, changes the coverage of the pixel [-1/2, 1/2]^2 about 0: the
// winding number rises by 1 where the way from 0 first up or down and then across crosses the
// segment from its right to its left, and this is the integral of that over the pixel.
//
//      +----|----+
//      |    |  / |      along the way across: integral of clamp(x) - sign(x)/2 dy,
//      |    0 /  |      up or down: where the segment crosses x = 0
//      |    |/   |
//      +----/----+
float swept_area(vec2 start, vec2 end) {
    vec2 way = end - start;
    float slope = way.y != 0.0 ? way.x / way.y : 0.0;
    float y0 = clamp(start.y, -0.5, 0.5), y1 = clamp(end.y, -0.5, 0.5);
    float x0 = start.x + (y0 - start.y) * slope, x1 = end.x + (y1 - end.y) * slope;
    float middle = 0.5 * (x0 + x1);
    float mean = (x0 < 0.0) == (x1 < 0.0) && abs(x1 - x0) < 1e-2
        ? clamp(middle, -0.5, 0.5) - (middle < 0.0 ? -0.5 : 0.5)
        : (beside(x1) - beside(x0)) / (x1 - x0);
    float total = y0 == y1 ? 0.0 : (y1 - y0) * mean;
    if ((start.x < 0.0) != (end.x < 0.0)) {
        float crossing = clamp(start.y - way.y * start.x / way.x, -0.5, 0.5);
        total += sign(way.x) * ((crossing > 0.0 ? 0.5 : -0.5) - crossing);
    }
    return total;
}

// The share that stays of the pixel around uv, (u,v) having these derivatives by its x and y.
// Exact where curves are straight within a pixel, corners and slivers too. A pixel that is
// larger than the cells takes their shares, which are mip-mapped.
float pixel_coverage(vec2 uv, vec2 across, vec2 up) {
    vec2 reach = 0.5 * (abs(across) + abs(up));
    float widest = max(reach.x, reach.y), size;
    ivec4 node = find_leaf(uv, widest, size);
    float determinant = across.x * up.y - across.y * up.x, share = 0.0;
    bool coarse = widest > TRIM_MARGIN * size || determinant == 0.0;
    for (bool look = coarse; look; look = false)
        share = textureGrad(trim_shares, uv, across, up).r;
    mat2 to_pixels = mat2(up.y, -across.y, -up.x, across.x) / determinant;
    int winding = node.z, steeps = node.y & 0xFFFF, count = coarse ? 0 : piece_count(node), near;
    float swept = 0.0;
    int done = 0;
    do {
        winding += scan_pieces(node.x + done, count - done, uv, reach, near);
        do {
            int i = done + lowest_bit(max(near, 1));
            vec4 piece = trim_texel(node.x + i, 0);
            Bump bump = trim_bump(node.x + i);
            bool steep = i < steeps;
            vec4 ends = steep ? piece.yxwz : piece;
            vec2 middle = steep ? uv.yx : uv, half_way = steep ? reach.yx : reach;
            float first = max(min(ends.x, ends.z), middle.x - half_way.x);
            float last = min(max(ends.x, ends.z), middle.x + half_way.x);
            float here = clamp(middle.x, first, last);
            float away = graph_value(ends, bump, here) - middle.y;
            bool right = on_the_right(piece, steep, away + middle.y, uv);
            // Not on the curve itself: then all agree on the side.
            float least = 1e-5 * half_way.y;
            if (here == middle.x)
                away = away > 0.0 ? max(away, least) : min(away, -least);
            vec2 a = vec2(first - middle.x, graph_value(ends, bump, first) - middle.y);
            vec2 b = vec2(here - middle.x, away);
            vec2 c = vec2(last - middle.x, graph_value(ends, bump, last) - middle.y);
            a = to_pixels * (steep ? a.yx : a);
            b = to_pixels * (steep ? b.yx : b);
            c = to_pixels * (steep ? c.yx : c);
            float area = swept_area(a, b) + swept_area(b, c);
            winding += near != 0 && right ? ray_way(piece, uv) : 0;
            swept += near == 0 ? 0.0 : ends.z > ends.x ? area : -area;
            near &= near - 1;
        } while (near != 0);
        done += 30;
    } while (done < count);
    return coarse ? share : clamp(float(winding) + sign(determinant) * swept, 0.0, 1.0);
}
