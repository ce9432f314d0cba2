"""What a fragment asks of a packed region, in float64. Twin: shaders/lib/trim.glsl, same names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cells import DIVISION, MARGIN
from .cutting import BUMP_STEP, STEPS
from .graphs import horner
from .packing import FLAT_PIECE, KINDS, STEEP_PIECE, WINDING, PackedTrim
from .pieces import Array, Indices
from .shares import WHOLE, corner_shares
from .winding import expand

OUTSIDE, INSIDE, CUT = 0, 1, 2
WITHIN = INSIDE, CUT  # of which something stays


@dataclass(frozen=True)
class Cells:
    """Where points are: the node (k,), the cell's size (k,) and its middle (k, 2)."""

    node: Indices
    size: Array
    middle: Array


def find_leaf(packed: PackedTrim, points: Array, reach: Array | None = None) -> Cells:
    """The smallest cells that points (k, 2) of the unit square lie in.

    With `reach` (k, 2), how far pixels extend to each side: the smallest ones whose margin is as
    wide, or those of the coarsest grid.
    """
    inside = np.clip(points, 0.0, 1.0)
    most = np.zeros(len(points)) if reach is None else reach.max(1)
    sides = np.array(packed.sides)
    grid = np.minimum((most[:, None] > MARGIN / sides).sum(1), len(sides) - 1)
    side, before = sides[grid], (np.cumsum(sides**2) - sides**2)[grid]
    place = inside * side[:, None]
    cell = np.minimum(place.astype(np.intp), side[:, None] - 1)
    node, size = before + cell[:, 1] * side + cell[:, 0], 1.0 / side
    corner, active = cell * size[:, None], np.arange(len(points))
    while len(active):
        first = packed.divisions[node[active]]
        deeper = (first > 0) & (most[active] <= MARGIN * size[active] / DIVISION)
        active, first = active[deeper], first[deeper]
        size[active] /= DIVISION
        own = size[active, None]
        cell = ((inside[active] - corner[active]) / own).astype(np.intp).clip(0, DIVISION - 1)
        corner[active] += cell * own
        node[active] = first + cell[:, 1] * DIVISION + cell[:, 0]
    return Cells(node, size, corner + size[:, None] / 2.0)


def counts_and_windings(packed: PackedTrim, node: Indices) -> tuple[Indices, Indices]:
    """How many pieces nodes (k,) have, and their winding numbers: (k,) each."""
    told = packed.nodes[node, 1].astype(np.intp)
    return told % WINDING, told // WINDING


def _pieces_of(packed: PackedTrim, cells: Cells) -> tuple[Indices, Indices, Array]:
    """For each of the cells, its pieces: which of the cells, their kinds, (m,) each, and their
    numbers (m, 8): (x0, x1, y0, y1 - y0) and b0 .. b3, in the unit square."""
    counts, _ = counts_and_windings(packed, cells.node)
    number, place = expand(packed.nodes[cells.node, 0].astype(np.intp), counts)
    packs = packed.pieces[place]
    low, high = packs.astype(np.int16).astype(np.float64), packs >> 16
    kind = (high[:, 3] & (KINDS - 1)).astype(np.intp)
    high[:, 3] -= kind
    step = cells.size[number, None] / STEPS
    steep = (kind == STEEP_PIECE)[:, None]
    middle = np.where(steep, cells.middle[number, ::-1], cells.middle[number])
    piece = np.empty((len(place), 8))
    piece[:, :2] = middle[:, :1] + step * np.stack([low[:, 0], high[:, 0]], -1)
    piece[:, 2] = middle[:, 1] + step[:, 0] * low[:, 1]
    piece[:, 3] = step[:, 0] * (high[:, 1] - low[:, 1])
    piece[:, 4::2], piece[:, 5::2] = BUMP_STEP * step * low[:, 2:], BUMP_STEP * step * high[:, 2:]
    return number, kind, piece


def boxes_kept(packed: PackedTrim, low: Array, high: Array) -> NDArray[np.int8]:
    """What stays of boxes [low, high] (n, 2) of the unit square: OUTSIDE, INSIDE, or CUT where a
    curve may come near: (n,). By cells of the finest grid, summed up beforehand."""
    side = packed.sides[0]
    count, winding = counts_and_windings(packed, np.arange(side**2))
    total = np.pad((count > 0).reshape(side, side).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    first, last = (
        np.clip(np.floor(box * side + slack), 0, side - 1).astype(np.intp)
        for box, slack in ((low, -1e-6), (high, 1e-6))
    )
    (i, j), (k, m) = first.T, last.T
    count = total[m + 1, k + 1] - total[j, k + 1] - total[m + 1, i] + total[j, i]
    alike = np.where(winding[j * side + i] != 0, INSIDE, OUTSIDE)
    return np.where(count > 0, CUT, alike).astype(np.int8)


def height(piece: Array, x: Array) -> Array:
    """f(x) of pieces (m, 8) at (m,)."""
    tau = (x - piece[:, 0]) / (piece[:, 1] - piece[:, 0])
    return np.asarray(piece[:, 2] + tau * (piece[:, 3] + (1.0 - tau) * horner(piece.T[4:], tau)))


def turns(kind: Indices, piece: Array, x: Array, y: Array, value: Array) -> Indices:
    """What pieces (m, 8) add to the winding number of points (x, y), each (m,), `value` being
    their height there.

    The ray to the right crosses a steep piece if it starts at a height between its ends and on
    the left of it. That it crosses a flat one is the difference of two statements: that it runs
    lower than the piece's right end, and that the point lies lower than the piece itself.
    """
    start, end, y0, rise = piece[:, :4].T
    forward = end > start
    under = (value > y).astype(np.intp)
    lower = (np.where(forward, y0 + rise, y0) > y) & (kind == FLAT_PIECE)
    crossed = ((start > x) != (end > x)) * under
    once = np.where(kind == STEEP_PIECE, crossed, lower.astype(np.intp) - under)
    return np.asarray(np.where(forward, once, -once))


def winding_number(packed: PackedTrim, points: Array) -> Indices:
    """1 where the surface stays and 0 where not, at points (k, 2) of the unit square: (k,)."""
    leaf = find_leaf(packed, points)
    number, kind, piece = _pieces_of(packed, leaf)
    x, y = _along(kind, points[number])
    here = np.clip(x, piece[:, :2].min(1), piece[:, :2].max(1))
    met = np.bincount(number, turns(kind, piece, x, y, height(piece, here)), len(points))
    return np.asarray(counts_and_windings(packed, leaf.node)[1] + met.round().astype(np.intp))


def _along(kind: Indices, pairs: Array) -> tuple[Array, Array]:
    """Pairs (m, 2) for (u, v), by the axis that the piece is over, and by the other."""
    steep = kind == STEEP_PIECE
    return np.where(steep, pairs[:, 1], pairs[:, 0]), np.where(steep, pairs[:, 0], pairs[:, 1])


def pixel_coverage(packed: PackedTrim, points: Array, across: Array, up: Array) -> Array:
    """The share that stays of pixels with their middles at points (k, 2): (k,).

    `across` and `up` (k, 2) are the derivatives of (u, v) by the pixel's x and y. Exact for
    curves that are straight within a pixel, corners and slivers too; a pixel that is larger than
    the cells' margins takes what cells of about its size say.
    """
    reach = (np.abs(across) + np.abs(up)) / 2.0
    wide = np.sqrt(np.maximum((across**2).sum(1), (up**2).sum(1)))
    leaf = find_leaf(packed, points, reach)
    number, kind, piece = _pieces_of(packed, leaf)
    determinant = across[:, 0] * up[:, 1] - across[:, 1] * up[:, 0]
    (x, y), (half, rise) = _along(kind, points[number]), _along(kind, reach[number])
    low, high = piece[:, :2].min(1), piece[:, :2].max(1)
    forward = np.where(piece[:, 1] > piece[:, 0], half, -half)
    offsets = []
    for step in (-forward, 0.0, forward):
        at = np.clip(x + step, low, high)
        value = height(piece, at)
        off = np.stack([at - x, value - y], -1)
        if step is not forward and np.ndim(step) == 0:
            met = turns(kind, piece, x, y, value)
            least = np.where(value > y, 1e-5, -1e-5) * rise
            near = (off[:, 0] == 0.0) & (np.abs(off[:, 1]) < 1e-5 * rise)
            off[:, 1] = np.where(near, least, off[:, 1])
        off = np.where((kind == STEEP_PIECE)[:, None], off[:, ::-1], off)
        offsets.append(to_pixels(off, across[number], up[number], determinant[number]))
    swept = swept_area(offsets[0], offsets[1]) + swept_area(offsets[1], offsets[2])
    total = np.bincount(number, met + np.sign(determinant)[number] * swept, len(points))
    coverage = counts_and_windings(packed, leaf.node)[1] + total
    coarse = (reach > MARGIN * leaf.size[:, None]).any(1) | (determinant == 0.0)
    return np.where(coarse, cell_share(packed, points, wide), coverage.clip(0.0, 1.0))


def cell_share(packed: PackedTrim, points: Array, wide: Array) -> Array:
    """The share that stays of cells from half to once as wide as pixels (k,) at points (k, 2),
    interpolated between their middles: (k,)."""
    finest = len(packed.shares[0])
    level = np.floor(np.log2(np.maximum(wide * finest, 1.0))).astype(np.intp)
    found = np.zeros(len(points))
    for chosen, shares in enumerate(packed.shares):
        here = np.minimum(level, len(packed.shares) - 1) == chosen
        place = points[here].clip(0.0, 1.0) * len(shares) + 0.5
        corner = np.minimum(place.astype(np.intp), len(shares))
        u, v = (place - corner).T
        a, b, c, d = corner_shares(shares)[corner[:, 1], corner[:, 0]].T / WHOLE
        found[here] = (1 - v) * (a + u * (b - a)) + v * (c + u * (d - c))
    return found


def to_pixels(offset: Array, across: Array, up: Array, determinant: Array) -> Array:
    """Offsets (k, 2) in (u, v) as offsets in pixels."""
    x = up[:, 1] * offset[:, 0] - up[:, 0] * offset[:, 1]
    y = across[:, 0] * offset[:, 1] - across[:, 1] * offset[:, 0]
    return np.asarray(np.stack([x, y], -1) / determinant[:, None])


def swept_area(start: Array, end: Array) -> Array:
    """By how much segments (k, 2) change the coverage of the pixel [-1/2, 1/2]^2 about 0: (k,).

    The winding number rises by 1 where the way from 0 first up or down and then across crosses
    a segment from its right to its left; this is the integral of that over the pixel.
    """
    (ax, ay), (bx, by) = start.T, end.T
    dx, dy = bx - ax, by - ay
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(dy != 0.0, dx / dy, 0.0)
        y0, y1 = ay.clip(-0.5, 0.5), by.clip(-0.5, 0.5)
        x0, x1 = ax + (y0 - ay) * slope, bx + (y1 - by) * slope
        crossing = (ay - dy * ax / dx).clip(-0.5, 0.5)
        mean = (beside(x1) - beside(x0)) / (x1 - x0)
    middle = (x0 + x1) / 2.0
    level = middle.clip(-0.5, 0.5) - np.where(middle < 0.0, -0.5, 0.5)
    one_side = ((x0 < 0.0) == (x1 < 0.0)) & (np.abs(x1 - x0) < 1e-2)
    across = (y1 - y0) * np.where(one_side, level, mean)
    along = np.sign(dx) * (np.where(crossing > 0.0, 0.5, -0.5) - crossing)
    crosses = (ax < 0.0) != (bx < 0.0)
    return np.where(y0 == y1, 0.0, across) + np.where(crosses, along, 0.0)


def beside(x: Array) -> Array:
    """Integral of clamp(x) - sign(x)/2 over [-1/2, 1/2], from 0."""
    within = np.minimum(np.abs(x), 0.5)
    return np.asarray(within * (within - 1.0) / 2.0)
