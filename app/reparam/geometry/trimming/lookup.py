"""What a fragment asks of a packed region, in float64. Twin: shaders/lib/trim.glsl, same names."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .cells import DIVISION, MARGIN, ray_crossings
from .graphs import FLAT, STEEP, TERMS, Graphs
from .packing import FLAT_UNIT, PackedTrim
from .pieces import Array, Indices
from .winding import expand

OUTSIDE, INSIDE, CUT = 0, 1, 2


def find_leaf(
    packed: PackedTrim, points: Array, reach: Array | None = None
) -> tuple[Indices, Array]:
    """The node (k,) of the smallest cell that points (k, 2) of the unit square lie in, its size.

    With `reach` (k, 2), how far pixels extend to each side: the smallest cell whose margin is
    as wide, or one of the first grid.
    """
    place = np.clip(points, 0.0, 1.0)
    node = np.zeros(len(points), dtype=np.intp)
    first, division = np.zeros(len(points), dtype=np.intp), packed.side
    size = np.ones(len(points))
    active = np.arange(len(points))
    while len(active):
        scaled = place[active] * division
        cell = np.minimum(scaled.astype(np.intp), division - 1)
        place[active] = scaled - cell
        size[active] /= division
        node[active] = first[active] + cell[:, 1] * division + cell[:, 0]
        first[active] = packed.nodes[node[active], 3]
        division = DIVISION
        deeper = first[active] > 0
        if reach is not None:
            deeper &= reach[active].max(1) <= MARGIN * size[active] / DIVISION
        active = active[deeper]
    return node, size


def _pieces_of(packed: PackedTrim, leaf: Indices) -> tuple[Indices, Graphs]:
    """For each of the leaves, its pieces: which of the leaves (m,), and the graphs (m)."""
    begin, counts = packed.nodes[leaf, :2].T.astype(np.intp)
    flats, steeps = np.divmod(counts, FLAT_UNIT)
    number, place = expand(begin, steeps + flats)
    values = packed.pieces[place].astype(np.float64)
    axis = np.where(place < (begin + steeps)[number], STEEP, FLAT)
    return number, Graphs(axis, values[:, 0].reshape(-1, 2, 2), values[:, 1:].reshape(-1, TERMS))


def boxes_kept(packed: PackedTrim, low: Array, high: Array) -> NDArray[np.int8]:
    """What stays of boxes [low, high] (n, 2) of the unit square: OUTSIDE, INSIDE, or CUT where a
    curve may come near: (n,). By cells of the first grid, summed up beforehand."""
    grid = packed.nodes[: packed.side**2].reshape(packed.side, packed.side, 4)
    met = (grid[..., 1] > 0) | (grid[..., 3] > 0)
    total = np.pad(met.astype(np.int64).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    first, last = (
        np.clip(np.floor(box * packed.side + slack), 0, packed.side - 1).astype(np.intp)
        for box, slack in ((low, -1e-6), (high, 1e-6))
    )
    (i, j), (k, m) = first.T, last.T
    count = total[m + 1, k + 1] - total[j, k + 1] - total[m + 1, i] + total[j, i]
    alike = np.where(grid[j, i, 2] != 0, INSIDE, OUTSIDE)
    return np.where(count > 0, CUT, alike).astype(np.int8)


def winding_number(packed: PackedTrim, points: Array) -> Indices:
    """1 where the surface stays and 0 where not, at points (k, 2) of the unit square: (k,)."""
    leaf, _ = find_leaf(packed, points)
    number, graphs = _pieces_of(packed, leaf)
    crossings = np.bincount(number, ray_crossings(graphs, points[number]), len(points))
    return np.asarray(packed.nodes[leaf, 2] + crossings.round().astype(np.intp))


def pixel_coverage(packed: PackedTrim, points: Array, across: Array, up: Array) -> Array:
    """The share that stays of pixels with their middles at points (k, 2): (k,).

    `across` and `up` (k, 2) are the derivatives of (u, v) by the pixel's x and y. Exact for
    curves that are straight within a pixel, corners and slivers too; where a pixel is larger
    than a cell's margin the cell's own coverage is taken.
    """
    reach = (np.abs(across) + np.abs(up)) / 2.0
    leaf, size = find_leaf(packed, points, reach)
    number, graphs = _pieces_of(packed, leaf)
    u, v = points[number].T
    determinant = across[:, 0] * up[:, 1] - across[:, 1] * up[:, 0]
    axis, everything = graphs.axis, np.arange(len(graphs))
    x, _ = graphs.along(everything)
    middle = np.where(axis == STEEP, v, u)
    half = reach[number, axis]
    low = np.maximum(x.min(1), middle - half)
    high = np.minimum(x.max(1), middle + half)
    seen = np.flatnonzero(low < high)
    nearest = np.clip(middle, low, high)
    offsets = []
    for at in (low, nearest, high):
        value = graphs.values(everything, at)
        off = np.stack([at - middle, value - np.where(axis == STEEP, u, v)], -1)
        if at is nearest:
            least = 1e-5 * reach[number, 1 - axis]
            away = np.where(
                off[:, 1] > 0.0, np.maximum(off[:, 1], least), np.minimum(off[:, 1], -least)
            )
            off[:, 1] = np.where(off[:, 0] == 0.0, away, off[:, 1])
        off = np.where((axis == STEEP)[:, None], off[:, ::-1], off)
        offsets.append(to_pixels(off, across[number], up[number], determinant[number]))
    forward = np.where(x[:, 1] > x[:, 0], 1.0, -1.0)
    swept = swept_area(offsets[0], offsets[1]) + swept_area(offsets[1], offsets[2])
    total = np.bincount(number[seen], (forward * swept)[seen], len(points))
    coverage = winding_number(packed, points) + np.sign(determinant) * total
    coarse = (reach > MARGIN * size[:, None]).any(1) | (determinant == 0.0)
    cell = np.minimum((points.clip(0.0, 1.0) * packed.side).astype(np.intp), packed.side - 1)
    return np.where(coarse, packed.shares[cell[:, 1], cell[:, 0]], coverage.clip(0.0, 1.0))


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
