// Which part of a surface stays, decided for each fragment in the parameter domain.
// Twin: geometry/trimming/lookup.py, same names; geometry/trimming/packing.py packs what is read.
//
// The region's unit square is a grid of cells, or several from fine to coarse, and a crowded cell is
// a grid again. A cell has a winding number and the pieces of trim curves near it, each the graph of
// a polynomial over u (flat) or over v (steep), counted in steps from the cell's middle:
//
//      +--------+      v = f(u)  or  u = f(v):  y0 + tau (y1 - y0) + tau (1 - tau) bump(tau)
//      |  o-----|-*
//      |     ___|/     the point o has the cell's winding number and, for each piece that the
//      +----/---+      ray to the right meets, 1 more where it runs up, 1 less where down
//
// (W. Schollmeyer and B. Froehlich, Direct trimming of NURBS surfaces on the GPU, 2009, with
// graphs in place of their bisection.)
//
// Software rasterisers execute an `if` for every fragment, and a loop at least once: so there is
// one short loop, and it does everything for a piece, whether near or not. And textureLod at the
// middle of a texel takes them two thirds of the time of texelFetch, which looks for the borders.
//
//   BY_SAMPLE      each of a pixel's samples is decided; where OpenGL cannot, its middle for all
//   TRIM_GRIDS     how many grids there are, each with half as many cells a side as the one before
//   TRIM_DIVIDED   there are cells that are grids again

uniform isampler2D trim_nodes;    // of the grids' cells, one grid above the other: first piece; how
                                  // many, + 2^16 winding number; where those stand that divide the
                                  // cell, or < 0
uniform vec2 trim_node_step;      // the size of a texel of those
uniform isampler2D trim_pieces;   // x0 | x1, y0 | y1, b0 | b1, b2 | b3, in 16 bits each; then of
                                  // grids that get coarser the shares of four cells, in 8 bits each,
                                  // corner by corner, four corners a texel
uniform vec2 trim_piece_step;
uniform int trim_shares;          // where they begin
uniform int trim_coarsest;        // how often the finest of these grids is halved
uniform float trim_side;          // cells along a side of the finest grid of pieces
#ifdef TRIM_DIVIDED
uniform isampler2D trim_below;    // nodes of the cells that divide others
#endif

const int STEEP = 0, CLOSING = 1, FLAT = 2;

// Along a table of rows, NET_WIDTH in each: the place in it, in texels.
vec2 trim_place(int index) {
    return vec2(index & (NET_WIDTH - 1), int(uint(index) / uint(NET_WIDTH))) + 0.5;
}

// A cell: its middle, how many steps of its pieces' numbers there are to the domain's side, and
// whether its margin is too narrow for what was asked.
struct Cell {
    vec2 middle;
    float steps;
    bool narrow;
};

// The node of the smallest cell around a point whose margin is as wide as `reach`.
ivec2 find_leaf(vec2 uv, float reach, out Cell found) {
    float side = trim_side;
    vec2 inside = clamp(uv, 0.0, 1.0), corner = vec2(0.0);
#if TRIM_GRIDS > 1
    // The least power of two that is above this is how much coarser a grid has to be.
    int wide = (floatBitsToInt(reach * trim_side * (1.0 / TRIM_MARGIN)) >> 23) - 126;
    side = float(int(trim_side) >> clamp(wide, 0, TRIM_GRIDS - 1));
    corner.y = 2.0 * (trim_side - side);
#endif
    float size = 1.0 / side;
    vec2 cell = min(floor(inside * side), side - 1.0);
    ivec4 node = textureLod(trim_nodes, (cell + corner + 0.5) * trim_node_step, 0.0);
    vec2 middle = (cell + 0.5) * size;
#ifdef TRIM_DIVIDED
    while (node.z >= 0 && reach * float(TRIM_DIVISION) <= TRIM_MARGIN * size) {
        vec2 low = middle - 0.5 * size;
        size /= float(TRIM_DIVISION);
        cell = clamp(floor((inside - low) / size), 0.0, float(TRIM_DIVISION - 1));
        int number = node.z + int(cell.y) * TRIM_DIVISION + int(cell.x);
        node = texelFetch(trim_below, ivec2(trim_place(number)), 0);
        middle = low + (cell + 0.5) * size;
    }
#endif
    found = Cell(middle, float(TRIM_STEPS) / size, reach > TRIM_MARGIN * size);
    return node.xy;
}

struct Piece { vec4 ends, bump; int kind; };   // (x0, x1, y0, y1 - y0), b0 .. b3

ivec4 trim_texel(int index) {
    return textureLod(trim_pieces, trim_place(index) * trim_piece_step, 0.0);
}

Piece to_piece(ivec4 texel) {
    ivec4 low = (texel << 16) >> 16, high = texel >> 16;
    int kind = high.w & 3;
    return Piece(vec4(low.x, high.x, low.y, high.y - low.y),
                 vec4(low.z, high.z, low.w, high.w - kind) * TRIM_BUMP_STEP, kind);
}

// f, at tau.
float height(Piece piece, float tau) {
    vec4 b = piece.bump;
    float swell = b.x + tau * (b.y + tau * (b.z + tau * b.w));
    return piece.ends.z + tau * (piece.ends.w + (1.0 - tau) * swell);
}

// What a piece adds to the winding number of a point (x, y), by which it starts at r0 and ends at
// r1, both along the axis that it is over, and `under` which the point lies or not.
//
// The ray to the right crosses a steep piece if it starts at a height between its ends and on the
// left of it. That it crosses a flat one is the difference of two statements: that it runs lower
// than the piece's right end, and that the point lies lower than the piece itself.
int turns(Piece piece, float r0, float r1, float y, bool under) {
    bool forward = r1 > r0;
    bool lower = piece.kind == FLAT && piece.ends.z + (forward ? piece.ends.w : 0.0) > y;
    bool crossed = (r0 > 0.0) != (r1 > 0.0) && under;
    int once = piece.kind == STEEP ? int(crossed) : int(lower) - int(under);
    return forward ? once : -once;
}

// 1 where the surface stays, 0 where not.
int winding_number(vec2 uv) {
    Cell cell;
    ivec2 node = find_leaf(uv, 0.0, cell);
    vec2 place = (uv - cell.middle) * cell.steps;
    int winding = node.y >> 16, i = node.x, end = i + (node.y & 0xFFFF);
    do {
        Piece piece = to_piece(trim_texel(i));
        vec2 at = piece.kind == STEEP ? place.yx : place;
        float r0 = piece.ends.x - at.x, r1 = piece.ends.y - at.x;
        float value = height(piece, clamp(-r0 / (r1 - r0), 0.0, 1.0));
        int more = turns(piece, r0, r1, at.y, value > at.y);
        winding += i < end ? more : 0;
        ++i;
    } while (i < end);
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
    float crossing = clamp(start.y - way.y * start.x / way.x, -0.5, 0.5);
    float beyond = sign(way.x) * ((crossing > 0.0 ? 0.5 : -0.5) - crossing);
    return (start.x < 0.0) != (end.x < 0.0) ? total + beyond : total;
}

// Which corner has the shares of the four cells, from half to once as wide as a pixel, between
// whose middles a point lies; `between`: how far from the first to the last. `area` is the pixel's.
int share_corner(vec2 uv, float area, out vec2 between) {
    int finest = 2 * int(trim_side) >> (TRIM_GRIDS - 1);
    // The floor of the binary logarithm, of the square halved, stands in the number itself.
    int level = max((floatBitsToInt(area * float(finest * finest)) >> 23) - 127, 0) >> 1;
    int side = max(finest >> min(level, 30), 1);
    vec2 place = clamp(uv, 0.0, 1.0) * float(side) + 0.5;
    ivec2 corner = min(ivec2(place), side);
    between = place - vec2(corner);
    // Before this grid come those of (s + 1)^2 corners, s from the finest to twice its own side.
    // The squares divided by 3, exactly, by a product modulo 2^32: division is slow.
    int before = 4 * ((finest * finest - side * side) * -1431655765) + 4 * (finest - side);
    return before + min(level, trim_coarsest) + corner.y * (side + 1) + corner.x;
}

// What a texel of shares says between the middles of a corner's cells.
float share_told(ivec4 texel, int corner, vec2 between) {
    ivec2 pair = (corner & 2) == 0 ? texel.xy : texel.zw;
    int four = (corner & 1) == 0 ? pair.x : pair.y;
    vec4 told = vec4(ivec4(four, four >> 8, four >> 16, four >> 24) & 0xFF) * (1.0 / 255.0);
    vec2 row = mix(told.xz, told.yw, between.x);
    return mix(row.x, row.y, between.y);
}

// The share that stays of the pixel around uv, (u,v) having these derivatives by its x and y.
// Exact where curves are straight within a pixel, corners and slivers too. A pixel that is larger
// than the cells' margins takes what cells of about its size say.
float pixel_coverage(vec2 uv, vec2 across, vec2 up) {
    vec2 reach = 0.5 * (abs(across) + abs(up)), between;
    Cell cell;
    ivec2 node = find_leaf(uv, max(reach.x, reach.y), cell);
    float determinant = across.x * up.y - across.y * up.x;
    bool coarse = cell.narrow || determinant == 0.0;
    int corner = share_corner(uv, max(dot(across, across), dot(up, up)), between);
    mat2 to_pixels = mat2(up.y, -across.y, -up.x, across.x) / (determinant * cell.steps);
    vec2 place = (uv - cell.middle) * cell.steps;
    reach *= cell.steps;
    int winding = node.y >> 16, i = coarse ? trim_shares + (corner >> 2) : node.x;
    int end = coarse ? 0 : i + (node.y & 0xFFFF);
    float swept = 0.0;
    ivec4 texel;
    do {
        texel = trim_texel(i);
        Piece piece = to_piece(texel);
        bool steep = piece.kind == STEEP;
        vec2 at = steep ? place.yx : place, half_way = steep ? reach.yx : reach;
        float r0 = piece.ends.x - at.x, r1 = piece.ends.y - at.x;
        float forward = r1 > r0 ? half_way.x : -half_way.x;
        vec3 x = clamp(vec3(-forward, 0.0, forward), min(r0, r1), max(r0, r1));
        vec3 tau = (x - r0) / (r1 - r0);
        float first = height(piece, tau.x), here = height(piece, tau.y), last = height(piece, tau.z);
        int more = turns(piece, r0, r1, at.y, here > at.y);
        // Not on the curve itself: then all agree on the side.
        float away = here - at.y, least = 1e-5 * half_way.y;
        if (x.y == 0.0)
            away = away > 0.0 ? max(away, least) : min(away, -least);
        vec2 a = vec2(x.x, first - at.y), b = vec2(x.y, away), c = vec2(x.z, last - at.y);
        a = to_pixels * (steep ? a.yx : a);
        b = to_pixels * (steep ? b.yx : b);
        c = to_pixels * (steep ? c.yx : c);
        float area = swept_area(a, b) + swept_area(b, c);
        winding += i < end ? more : 0;
        swept += i < end ? area : 0.0;
        ++i;
    } while (i < end);
    float share = share_told(texel, corner, between);
    return coarse ? share : clamp(float(winding) + sign(determinant) * swept, 0.0, 1.0);
}

#ifdef BY_SAMPLE
uniform int samples;

// What winding_number says of four points near uv, one bit each: 1 where the surface stays.
int winding_set(vec2 uv, vec2 reach, vec4 u, vec4 v) {
    float widest = max(reach.x, reach.y);
    Cell cell;
    ivec2 node = find_leaf(uv, widest, cell);
    vec2 between;
    int corner = share_corner(uv, 4.0 * widest * widest, between);
    u = (u - cell.middle.x) * cell.steps;
    v = (v - cell.middle.y) * cell.steps;
    int i = cell.narrow ? trim_shares + (corner >> 2) : node.x;
    int end = cell.narrow ? 0 : i + (node.y & 0xFFFF);
    ivec4 winding = ivec4(node.y >> 16);
    ivec4 texel;
    do {
        texel = trim_texel(i);
        Piece piece = to_piece(texel);
        bool steep = piece.kind == STEEP, forward = piece.ends.y > piece.ends.x;
        vec4 x = steep ? v : u, y = steep ? u : v, b = piece.bump;
        vec4 tau = clamp((x - piece.ends.x) / (piece.ends.y - piece.ends.x), 0.0, 1.0);
        vec4 swell = b.x + tau * (b.y + tau * (b.z + tau * b.w));
        vec4 value = piece.ends.z + tau * (piece.ends.w + (1.0 - tau) * swell);
        float right = piece.ends.z + (forward ? piece.ends.w : 0.0);
        ivec4 under = ivec4(greaterThan(value, y));
        ivec4 lower = ivec4(lessThan(y, vec4(piece.kind == FLAT ? right : -1e9)));
        ivec4 crossed = ivec4(lessThan(x, piece.ends.xxxx)) ^ ivec4(lessThan(x, piece.ends.yyyy));
        ivec4 once = steep ? crossed & under : lower - under;
        winding += i < end ? (forward ? once : -once) : ivec4(0);
        ++i;
    } while (i < end);
    int several = (1 << int(4.0 * share_told(texel, corner, between) + 0.5)) - 1;
    ivec4 bits = min(abs(winding), 1) * ivec4(1, 2, 4, 8);
    return cell.narrow ? several : bits.x + bits.y + bits.z + bits.w;
}

// Leave to the fragment the samples at which the surface stays.
void keep_samples(vec2 uv) {
#if __VERSION__ >= 400 || (defined(GL_ARB_gpu_shader5) && defined(GL_ARB_sample_shading))
    vec2 reach = 0.5 * (abs(dFdx(uv)) + abs(dFdy(uv)));
    int kept = 0, i = 0;
    do {
        ivec4 number = min(ivec4(i, i + 1, i + 2, i + 3), samples - 1);
        vec2 a = interpolateAtSample(trim_parameters, number.x);
        vec2 b = interpolateAtSample(trim_parameters, number.y);
        vec2 c = interpolateAtSample(trim_parameters, number.z);
        vec2 d = interpolateAtSample(trim_parameters, number.w);
        kept |= winding_set(uv, reach, vec4(a.x, b.x, c.x, d.x), vec4(a.y, b.y, c.y, d.y)) << i;
        i += 4;
    } while (i < samples);
    if (kept == 0)
        discard;
    gl_SampleMask[0] = kept;
#else
    if (winding_number(uv) == 0)
        discard;
#endif
}
#endif
