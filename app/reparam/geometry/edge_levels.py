"""Levels of edges that patches share, and of grids that end in them without a crack."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .net import MAX_ORDER, Array


def edge_numbers(nets: Array) -> NDArray[np.int64]:
    """A number for each edge of the patches (P, m, n, 4), the same for the same curve: (P, 4).

    The edges u = 0, v = 0, u = 1, v = 1; a curve is the same read backwards too.
    """
    return numbered(edge_marks(nets))


def edge_marks(nets: Array) -> NDArray[np.uint64]:
    """A mark for each edge, the same for the same curve: (P, 4). It tells of one patch what
    `edge_numbers` tells of many. Two other curves have one mark once in 2^64; then they are but
    drawn as finely as each other.
    """
    bits = (nets + 0.0).view(np.uint64)  # -0 is 0
    points = sum(_scattered(bits[..., k] + SALTS[k]) * SALTS[k] for k in range(nets.shape[-1]))
    edges = [points[:, 0], points[:, :, 0], points[:, -1], points[:, :, -1]]
    return np.stack([np.minimum(_in_order(e), _in_order(e[:, ::-1])) for e in edges], -1)


def numbered(marks: NDArray[np.uint64]) -> NDArray[np.int64]:
    """0, 1, ... for marks (P, 4), the same for the same."""
    return np.asarray(np.unique(marks, return_inverse=True)[1].reshape(marks.shape), np.int64)


# Odd numbers, of which a sum tells the order: multiples of 2^64 over the golden ratio.
SALTS = np.arange(1, MAX_ORDER + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15) | np.uint64(1)


def _scattered(bits: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Close numbers, and such with many zeros, far apart (the finish of MurmurHash3)."""
    for shift, factor in ((33, 0xFF51AFD7ED558CCD), (33, 0xC4CEB9FE1A85EC53)):
        bits = (bits ^ (bits >> np.uint64(shift))) * np.uint64(factor)
    return bits ^ (bits >> np.uint64(33))


def _in_order(points: NDArray[np.uint64]) -> NDArray[np.uint64]:
    return np.asarray(_scattered(points) @ SALTS[: points.shape[1]])


def edge_levels(levels: NDArray[np.int64], numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """The level of each edge (P, 4): the most that a patch along it asks for in levels (P, 2).

    An edge as fine as the finest patch beside it keeps the bound in the triangles along it, and
    neighbours agree, so nothing cracks. (By the edge curve alone a straight edge of a bent patch
    would get one step, and the long triangles there would leave the surface.)
    """
    asked = levels[:, [1, 0, 1, 0]].ravel()
    finest = np.zeros(int(numbers.max(initial=0)) + 1, np.int64)
    np.maximum.at(finest, numbers.ravel(), asked)
    return np.maximum(finest[numbers], 1)


def fitted(
    levels: NDArray[np.int64], edges: NDArray[np.int64], numbers: NDArray[np.int64]
) -> NDArray[np.int64]:
    """The same and finer levels of edges (P, 4), so that in triangles of stitching.py, of grids of
    levels (P, 2), no side goes back by more than half a step of the grid.

    From n steps to e of the edge a side goes back by up to (n - gcd(n, e)) / (n e).
    """
    wanted, numbers = levels[:, [1, 0, 1, 0]], numbers.ravel()
    strips = (levels == 1).any(-1)
    while True:
        own = wanted.copy()
        own[strips] = _steps_of_strips(levels[strips], edges[strips])
        apart = np.flatnonzero(own != edges)
        n, e = own.ravel()[apart], edges.ravel()[apart]
        short = 2 * wanted.ravel()[apart] * (n - np.gcd(n, e)) > n * e
        if not short.any():
            return edges
        apart, n, e = apart[short], n[short], e[short]
        finest = np.zeros(int(numbers.max()) + 1, np.int64)
        finest[numbers] = edges.ravel()
        np.maximum.at(finest, numbers[apart], np.where(n > MANY, -(-e // n) * n, e + 1))
        edges = finest[numbers].reshape(edges.shape)


def _steps_of_strips(levels: NDArray[np.int64], edges: NDArray[np.int64]) -> NDArray[np.int64]:
    """The steps (k, 4) along edges (k, 4) that `stitched_patch` gives patches with one step in u or
    in v."""
    fewer, in_u = np.minimum(edges, edges[:, [2, 3, 0, 1]]), levels[:, :1] > 1
    along = np.where(in_u, [False, True, False, True], [True, False, True, False])
    return np.where(along, fewer, levels[:, [1, 0, 1, 0]])


MANY = 64  # steps, above which a few more on an edge are sought no longer


def grid_levels(levels: NDArray[np.int64], edges: NDArray[np.int64]) -> NDArray[np.int64]:
    """The same and finer: levels (P, 2) of grids that can snap to edges (P, 4) of their own.

    Vertices on an edge go to the edge's steps, of which there are no more than theirs.
    """
    in_u, in_v = edges[:, 1::2].max(-1), edges[:, ::2].max(-1)
    return np.asarray(np.maximum(levels, np.stack([in_u, in_v], -1)))


STEPS = np.unique([k << s for k in (2, 3) for s in range(14)] + [1])
"""1, 2, 3, 4, 6, 8, 12 ...: few enough levels that patches of one level are many."""


def snapped(index: NDArray[np.int64], steps: int, edge_steps: int) -> NDArray[np.int64]:
    """Where vertices on an edge go, of `steps` to those of the edge: towards the middle.

    Then each triangle there spans a step of the edge at most: its diagonal, which ends on the edge
    farther from the middle than inside, does not grow. Twin: lib/snap.glsl
    """
    half = steps // 2
    before = -(-np.minimum(index, half) * edge_steps // steps)
    return np.where(index > half, np.maximum(index * edge_steps // steps, before), before)


def in_tiles(
    levels: NDArray[np.int64], edges: NDArray[np.int64], numbers: NDArray[np.int64], most: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The same and finer, and how many tiles (P, 2), a power of two, each patch is cut into so
    that none has more than `most` steps: all of a patch have as many, and as many of its edges.
    """
    tiles = np.exp2(np.ceil(np.log2(np.maximum(levels / most, 1.0)))).astype(np.int64)
    finest = np.ones(int(numbers.max(initial=0)) + 1, np.int64)
    np.maximum.at(finest, numbers.ravel(), tiles[:, [1, 0, 1, 0]].ravel())
    parts = finest[numbers]
    edges = -(-edges // parts) * parts
    levels = -(-grid_levels(levels, edges) // tiles) * tiles
    return levels, edges, tiles
