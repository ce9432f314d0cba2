"""The exact outline of patches as they are seen, and how far points of the screen lie from it.

Where a surface turns away from the eye its image folds over: the projection's Jacobian vanishes.
With homogeneous pixel coordinates P = (x w, y w, w) that is

    f(u,v) = det(P, P_u, P_v) = 0,

for an orthographic view the normal times the direction of sight. The outline of the image lies on
these curves and on the surface's border; both also run where other parts hide them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .bernstein import bernstein, bernstein_derivative
from .edge_levels import edge_numbers
from .net import Array

COARSEST, FINEST = 8, 256  # steps of a patch in which the curves are sought
REFINE = 2  # secant steps, after the first
LEAST = 1e-6  # pixels, of a piece
CELL = 4.0  # pixels: of the buckets in which a nearest segment is sought first
PAIRS = 1 << 22  # of points and segments at a time

Ints = NDArray[np.int64]


def outline(nets: Array, pixels: Array, steps: Ints) -> Array:
    """Straight pieces (k, 2, 2), in pixels, of all curves on which the outline of patches may lie.

    `nets` (P, m, n, 4) tell which edges are the same; `pixels` (P, m, n, 3) are the same patches as
    (x w, y w, w); each patch is searched in a grid of `steps` (P,) or more, and left out where that
    is 0. So is what is not before the eye (w > 0).
    """
    rounded = 1 << np.ceil(np.log2(np.clip(steps, COARSEST, FINEST))).astype(np.int64)
    numbers = edge_numbers(nets)
    once = (np.bincount(numbers.ravel()) == 1)[numbers]
    found = [np.zeros((0, 2, 3))]
    for level in np.unique(rounded[steps > 0]):
        group = np.flatnonzero((rounded == level) & (steps > 0))
        for part in np.array_split(group, -(-len(group) * level**2 // (1 << 20))):
            found.append(folds(pixels[part], int(level)))
        found.append(border(pixels[group], once[group], int(level)))
    pieces = np.concatenate(found)
    pieces = pieces[(pieces[..., 2] > 0.0).all(-1)]
    pieces = pieces[..., :2] / pieces[..., 2:]
    long = np.abs(pieces[:, 1] - pieces[:, 0]).max(-1) > LEAST
    return np.asarray(pieces[long])  # f vanishes all along an edge that is a pole


def border(pixels: Array, free: NDArray[np.bool_], level: int) -> Array:
    """The edges of patches (P, m, n, 3) that are `free` (P, 4), in `level` pieces each."""
    edges = (pixels[:, 0], pixels[:, :, 0], pixels[:, -1], pixels[:, :, -1])
    t = np.linspace(0.0, 1.0, level + 1)
    found = [np.zeros((0, 2, 3))]
    for edge, chosen in zip(edges, free.T, strict=True):
        points = np.einsum("ki,pic->pkc", bernstein(edge.shape[1] - 1, t), edge[chosen])
        found.append(np.stack([points[:, :-1], points[:, 1:]], 2).reshape(-1, 2, 3))
    return np.concatenate(found)


def folds(pixels: Array, level: int) -> Array:
    """The curves f = 0 of patches (P, m, n, 3): chords (k, 2, 3) between their exact crossings
    with the lines of a grid."""
    t = np.linspace(0.0, 1.0, level + 1)
    u, v = np.meshgrid(t, t, indexing="ij")
    value = _jacobian(pixels, u.ravel(), v.ravel()).reshape(len(pixels), level + 1, level + 1)
    above = value > 0.0
    across_u, across_v = above[:, 1:] != above[:, :-1], above[:, :, 1:] != above[:, :, :-1]
    numbers_u = np.where(across_u, np.cumsum(across_u).reshape(across_u.shape), 0) - 1
    numbers_v = np.where(across_v, np.cumsum(across_v).reshape(across_v.shape), 0) - 1
    numbers_v += np.where(across_v, np.count_nonzero(across_u), 0)
    ends = [
        _crossings(pixels, value, across_u, level, 0),
        _crossings(pixels, value, across_v, level, 1),
    ]
    points = np.concatenate(ends)
    around = np.stack(
        [numbers_u[:, :, :-1], numbers_v[:, 1:], numbers_u[:, :, 1:], numbers_v[:, :-1]], -1
    ).reshape(-1, 4)  # the four sides of each cell
    around = np.sort(around[(around >= 0).any(-1)], axis=-1)[:, ::-1]
    pairs = around.reshape(-1, 2)
    return np.asarray(points[pairs[(pairs >= 0).all(-1)]])


def _crossings(
    pixels: Array, value: Array, across: NDArray[np.bool_], level: int, axis: int
) -> Array:
    """Points (k, 3) where f = 0 on the grid's pieces along u (axis 0) or v (1) that it crosses."""
    patch, i, j = np.nonzero(across)
    start = np.stack([i, j], -1) / level
    way = np.eye(2)[axis] / level
    own = pixels[patch]

    def f(share: Array) -> Array:
        at = start + share[:, None] * way
        return _jacobian_each(own, at[:, 0], at[:, 1])

    low, high = value[patch, i, j], value[patch, i + (axis == 0), j + (axis == 1)]
    share = _root(f, low, high)
    at = start + share[:, None] * way
    return _points(own, at[:, 0], at[:, 1])


def _root(f: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Where f vanishes between 0 and 1, by regula falsi (Illinois); its values there are given."""
    a, b = np.zeros(len(low)), np.ones(len(low))
    share = low / (low - high)
    for _ in range(REFINE):
        value = f(share)
        left = (value > 0.0) == (low > 0.0)
        a, b = np.where(left, share, a), np.where(left, b, share)
        low, high = np.where(left, value, low / 2.0), np.where(left, high / 2.0, value)
        share = a + (b - a) * low / np.where(low == high, 1.0, low - high)
    return share


def _bases(pixels: Array, u: Array, v: Array) -> tuple[Array, Array, Array, Array]:
    m, n = pixels.shape[-3] - 1, pixels.shape[-2] - 1
    rows = bernstein(m, u), bernstein_derivative(m, u)
    return *rows, bernstein(n, v), bernstein_derivative(n, v)


def _jacobian(pixels: Array, u: Array, v: Array) -> Array:
    """f of each patch at all of k parameters: (P, k)."""
    row, row_slope, column, column_slope = _bases(pixels, u, v)
    pairs = ((row, column), (row_slope, column), (row, column_slope))
    vectors = [np.einsum("ki,kj,pijc->pkc", *pair, pixels, optimize=True) for pair in pairs]
    return np.asarray(np.linalg.det(np.stack(vectors, -1)))


def _jacobian_each(pixels: Array, u: Array, v: Array) -> Array:
    """f of patch k at its own parameters: (k,)."""
    row, row_slope, column, column_slope = _bases(pixels, u, v)
    pairs = ((row, column), (row_slope, column), (row, column_slope))
    vectors = [np.einsum("ki,kj,kijc->kc", *pair, pixels, optimize=True) for pair in pairs]
    return np.asarray(np.linalg.det(np.stack(vectors, -1)))


def _points(pixels: Array, u: Array, v: Array) -> Array:
    row, _, column, _ = _bases(pixels, u, v)
    return np.asarray(np.einsum("ki,kj,kijc->kc", row, column, pixels, optimize=True))


def distances(points: Array, pieces: Array) -> Array:
    """From each point (k, 2) to the nearest of straight pieces (s, 2, 2): (k,); infinite if there
    is none. Buckets that find nothing near enough are made larger."""
    found = np.full(len(points), np.inf)
    cell, open_ = CELL, np.arange(len(points))
    size = max(float(np.ptp(pieces, axis=(0, 1)).max()), CELL) if len(pieces) else 0.0
    while len(open_) and len(pieces):
        off = _distances_within(points[open_], pieces, cell)
        near = (off <= cell * 0.75) | (cell > 4.0 * size)
        found[open_[near]] = off[near]
        open_, cell = open_[~near], cell * 4.0
    return found


def _distances_within(points: Array, pieces: Array, cell: float) -> Array:
    """The same of pieces whose middle, once they are no longer than half a cell, lies in the
    bucket of the point or beside it."""
    ways = pieces[:, 1] - pieces[:, 0]
    times = np.maximum(np.ceil(np.linalg.norm(ways, axis=-1) / (cell / 2.0)), 1.0).astype(np.int64)
    which = np.repeat(np.arange(len(pieces)), times)
    number = np.arange(len(which)) - np.repeat(np.cumsum(times) - times, times)
    way = ways[which] / times[which][:, None]
    start = pieces[which, 0] + number[:, None] * way
    low = np.minimum(points.min(0), start.min(0)) - 2.0 * cell
    bucket = np.floor((start + way / 2.0 - low) / cell).astype(np.int64)
    home = np.floor((points - low) / cell).astype(np.int64)
    stride = int(max(bucket[:, 1].max(), home[:, 1].max())) + 2
    keys = bucket[:, 0] * stride + bucket[:, 1]
    order = np.argsort(keys, kind="stable")
    keys, start, way = keys[order], start[order], way[order]
    found = np.full(len(points), np.inf)
    for x in (-1, 0, 1):  # three buckets side by side are one range of keys
        middle = (home[:, 0] + x) * stride + home[:, 1]
        first, last = np.searchsorted(keys, middle - 1), np.searchsorted(keys, middle + 1, "right")
        for part in np.array_split(np.arange(len(points)), 1 + int((last - first).sum()) // PAIRS):
            count = (last - first)[part]
            point = np.repeat(part, count)
            piece = np.arange(len(point)) - np.repeat(np.cumsum(count) - count, count)
            piece += np.repeat(first[part], count)
            np.minimum.at(found, point, _away(points[point], start[piece], way[piece]))
    return found


def _away(points: Array, start: Array, way: Array) -> Array:
    """From points to the segments start + [0,1] way, one each."""
    long = np.maximum((way * way).sum(-1), 1e-300)
    share = np.clip(((points - start) * way).sum(-1) / long, 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * way, axis=-1))
