"""Levels of edges that patches share, and of grids that end in them without a crack."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .net import Array


def edge_numbers(nets: Array) -> NDArray[np.int32]:
    """A number for each edge of the patches (P, m, n, 4), the same for the same curve: (P, 4).

    The edges u = 0, v = 0, u = 1, v = 1; a curve is the same read backwards too.
    """
    nets = nets + 0.0  # -0 is 0
    numbers = np.empty((len(nets), 4), np.int32)
    count = 0
    edges = [nets[:, 0], nets[:, :, 0], nets[:, -1], nets[:, :, -1]]
    groups = [(0, 1, 2, 3)] if nets.shape[1] == nets.shape[2] else [(0, 2), (1, 3)]
    for group in groups:
        curves = np.stack([edges[k] for k in group], 1).reshape(len(nets) * len(group), -1)
        backwards = curves.reshape(len(curves), -1, nets.shape[-1])[:, ::-1].reshape(curves.shape)
        first = np.take_along_axis(curves - backwards, (curves != backwards).argmax(1)[:, None], 1)
        canonical = np.ascontiguousarray(np.where(first <= 0.0, curves, backwards))
        rows = canonical.view(np.dtype((np.void, canonical.dtype.itemsize * canonical.shape[1])))
        _, found = np.unique(rows.ravel(), return_inverse=True)
        numbers[:, group] = count + found.reshape(len(nets), len(group))
        count += int(found.max()) + 1
    return numbers


def edge_levels(levels: NDArray[np.int64], numbers: NDArray[np.int32]) -> NDArray[np.int64]:
    """The level of each edge (P, 4): the most that a patch along it asks for in levels (P, 2).

    An edge as fine as the finest patch beside it keeps the bound in the triangles along it, and
    neighbours agree, so nothing cracks. (By the edge curve alone a straight edge of a bent patch
    would get one step, and the long triangles there would leave the surface.)
    """
    asked = levels[:, [1, 0, 1, 0]].ravel()
    finest = np.zeros(int(numbers.max(initial=0)) + 1, np.int64)
    np.maximum.at(finest, numbers.ravel(), asked)
    return np.maximum(finest[numbers], 1)


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
    levels: NDArray[np.int64], edges: NDArray[np.int64], numbers: NDArray[np.int32], most: int
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
