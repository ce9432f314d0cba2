"""Triangles of patches that have steps of their own inside, and on each edge those asked for there.

A grid of cells, cut along rising diagonals, or mirrored along falling ones. Where an edge has more
steps than the grid, the grid's vertices on it move to steps of the edge, and each triangle there
opens into a fan:

    +-----+-----+-----+
    |   / |   / |   / |     3 steps inside; the lower edge has 4, and the grid's
    | /   | /   | /   |     vertices on it are at its steps 0, 2, 3 and 4
    +-----+-----+-----+
    |   //|    /|    /|
    | / / |   / |   / |
    +---+--+---+---+--+

Vertices move right on the lower edge and down on the right one, as on the others after half a turn:
so no side of a triangle goes further than a step of the grid each way, and none goes backwards by
more than `fitted` in edge_levels.py allows. A triangle with two sides on edges, in the lower right
and the upper left corner, opens from the last step of one edge to all steps of the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Places = NDArray[np.uint16]
Triangles = NDArray[np.int32]

KINDS = 4096  # of patches with few cells that are remembered
FEW = 256


@dataclass(frozen=True)
class Stitched:
    """Vertices and triangles of many patches: the row of each vertex's patch (V,), its place
    (V, 4), each (k, n, l, m) standing for u = k/n, v = l/m, and triangles (T, 3)."""

    rows: Ints
    places: Places
    triangles: Triangles


def stitched(steps: Ints, edges: Ints, falling: NDArray[np.bool_]) -> Stitched:
    """All triangles of patches with steps (P, 2) in u and v, and as many or more on their edges
    u = 0, v = 0, u = 1, v = 1 (P, 4); diagonals rise, or fall (P,). Patches of a kind follow one
    another."""
    order, kinds, first = _kinds(np.column_stack([steps, edges, falling]))
    pieces = [_few(*kind) if kind[0] * kind[1] <= FEW else stitched_patch(*kind) for kind in kinds]
    times = np.diff(np.append(first, len(order)))
    sizes, vertices = _repeated(np.array([len(places) for places, _ in pieces]), times)
    counts, corners = _repeated(np.array([len(triangles) for _, triangles in pieces]), times)
    places = np.concatenate([places for places, _ in pieces]).take(vertices, 0)
    triangles = np.concatenate([triangles for _, triangles in pieces]).take(corners, 0)
    before = (np.cumsum(sizes) - sizes).astype(np.int32)
    triangles += before.repeat(counts)[:, None]
    return Stitched(order.repeat(sizes), places, triangles)


def _kinds(rows: Ints) -> tuple[Ints, list[list[int]], Ints]:
    """How to sort rows (P, 7), those that differ, and where each of them begins."""
    scale = (int(rows.max()) + 1) ** np.arange(4)
    one, other = rows[:, :3] @ scale[:3], rows[:, 3:] @ scale
    order = np.lexsort([other, one])
    one, other = one[order], other[order]
    first = np.flatnonzero(np.append(True, (np.diff(one) != 0) | (np.diff(other) != 0)))
    return order, rows[order[first]].tolist(), first


def _repeated(sizes: Ints, times: Ints) -> tuple[Ints, Ints]:
    """Runs of a list, run k so many times: the sizes of all, and the numbers in the list."""
    starts, all_sizes = (np.cumsum(sizes) - sizes).repeat(times), sizes.repeat(times)
    before = np.cumsum(all_sizes) - all_sizes
    return all_sizes, np.arange(all_sizes.sum()) + (starts - before).repeat(all_sizes)


def stitched_patch(
    nu: int, nv: int, left: int, bottom: int, right: int, top: int, falling: int = 0
) -> tuple[Places, Triangles]:
    """The vertices' places (V, 4) and triangles (T, 3), counter-clockwise in (u, v), of one patch.

    The vertices inside come first, then the rim, once around. Where there are none, steps along
    the patch are free: then vertices move on one edge alone, not on both against each other.
    """
    if falling:
        places, triangles = stitched_patch(nu, nv, right, bottom, left, top)
        places[:, 0] = places[:, 1] - places[:, 0]
        return places, triangles[:, ::-1]
    if nu == 1:
        nv = min(left, right)
    elif nv == 1:
        nu = min(bottom, top)
    inner, rim = (nu - 1) * (nv - 1), bottom + right + top + left
    # The numbers of step k on each edge; a step on the left one may be the first of the rim.
    on_bottom = inner + np.arange(bottom + 1)
    on_right = on_bottom[-1] + np.arange(right + 1)
    on_top = on_right[-1] + top - np.arange(top + 1)
    on_left = inner + (rim - np.arange(left + 1)) % rim

    i, j = np.arange(nu + 1), np.arange(nv + 1)
    grid = np.empty((nu + 1, nv + 1), np.int64)
    grid[1:-1, 1:-1] = np.arange(inner).reshape(nu - 1, nv - 1)
    grid[:, 0], grid[:, -1] = on_bottom[-(-i * bottom // nu)], on_top[i * top // nu]
    grid[0], grid[-1] = on_left[-(-j * left // nv)], on_right[j * right // nv]
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]

    at_bottom = grid[np.arange(bottom - 1) * nu // bottom + 1, 1]
    at_top = grid[-(-np.arange(2, top + 1) * nu // top) - 1, -2]
    at_right = grid[-2, -(-np.arange(1, right + 1) * nv // right) - 1]
    at_right[at_right == grid[-2, 0]] = on_bottom[-2]
    at_left = grid[1, np.arange(left) * nv // left + 1]
    at_left[at_left == grid[1, -1]] = on_top[1]
    corners = [
        (a[:-1, 1:], b[:-1, 1:], c[:-1, 1:]),
        (a[1:, :-1], c[1:, :-1], d[1:, :-1]),
        (at_bottom, on_bottom[:-2], on_bottom[1:-1]),
        (at_top, on_top[2:], on_top[1:-1]),
        (at_right, on_right[:-1], on_right[1:]),
        (at_left, on_left[1:], on_left[:-1]),
    ]
    inside = np.repeat(i[1:-1], nv - 1), nu, np.tile(j[1:-1], nu - 1), nv
    vertices = [
        _rows(inside, inner),
        _rows((np.arange(bottom), bottom, 0, 1), bottom),
        _rows((1, 1, np.arange(right), right), right),
        _rows((np.arange(top, 0, -1), top, 1, 1), top),
        _rows((0, 1, np.arange(left, 0, -1), left), left),
    ]
    sides = [_rows(each, each[0].size, np.int32) for each in corners]
    return np.concatenate(vertices), np.concatenate(sides)


_few = lru_cache(maxsize=KINDS)(stitched_patch)


def _rows(columns: tuple[Ints | int, ...], count: int, kind: type = np.uint16) -> NDArray[Any]:
    rows: NDArray[Any] = np.empty((count, len(columns)), kind)
    for k, column in enumerate(columns):
        rows[:, k] = np.ravel(column)
    return rows
