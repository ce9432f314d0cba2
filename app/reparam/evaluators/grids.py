"""glMapGrid and glEvalMesh: the parameters of a mesh, and how its vertices are joined.

     j
v2   +--+--+--+      vertex (i, j) is number i * (steps in v + 1) + j;
     |  |  |  |      the grid goes on beyond 0..n, where the map is extrapolated
v1   +--+--+--+  i
     u1       u2
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from .arguments import Quad
from .constants import (
    GL_FILL,
    GL_LINE,
    GL_LINE_LOOP,
    GL_LINE_STRIP,
    GL_LINES,
    GL_POINT,
    GL_POINTS,
    GL_POLYGON,
    GL_QUAD_STRIP,
    GL_QUADS,
    GL_TRIANGLE_FAN,
    GL_TRIANGLE_STRIP,
    GL_TRIANGLES,
)
from .maps import Array

Indices = NDArray[np.int32]

CORNERS = {GL_POINTS: 1, GL_LINES: 2, GL_TRIANGLES: 3}
DRAWN_AS = {GL_POINT: GL_POINTS, GL_LINE: GL_LINES, GL_FILL: GL_TRIANGLES}


@dataclass(frozen=True)
class Axis:
    """One direction of glMapGrid: `segments` from `start` to `end`."""

    segments: int = 1
    start: float = 0.0
    end: float = 1.0


@dataclass(frozen=True)
class Walk:
    """One direction of glEvalMesh: points `first` to `last` of an axis, both included."""

    axis: Axis
    first: int
    last: int

    @property
    def count(self) -> int:
        """How many points; 0 where the range is empty."""
        return max(0, self.last - self.first + 1)

    def values(self) -> Array:
        """The parameters. Point 0 is `start` and point `segments` is `end`, exactly."""
        i, n = np.arange(self.first, self.last + 1), self.axis.segments
        return np.asarray(((n - i) * self.axis.start + i * self.axis.end) / n)


@dataclass(frozen=True)
class Grid:
    """The points of a mesh. A curve's has the one point 0 in v."""

    u: Walk
    v: Walk

    @cached_property
    def shape(self) -> tuple[int, int]:
        """Points in u and in v."""
        return self.u.count, self.v.count

    @property
    def turned(self) -> bool:
        """Whether it runs against one of u and v, so that its cells wind the other way."""
        u, v = self.u.axis, self.v.axis
        return (u.end < u.start) != (v.end < v.start)


@lru_cache(maxsize=256)
def grid_of(u: Axis, i1: int, i2: int, v: Axis, j1: int, j2: int) -> Grid:
    """The same object for the same grid: it is told apart quickly."""
    return Grid(Walk(u, i1, i2), Walk(v, j1, j2))


@lru_cache(maxsize=64)
def grid_points(grid: Grid) -> Array:
    """(u, v) of all points, u slowest: shape (k, 2). The same array for the same grid."""
    u, v = np.meshgrid(grid.u.values(), grid.v.values(), indexing="ij")
    return _constant(np.stack([u.ravel(), v.ravel()], -1))


@lru_cache(maxsize=256)
def grid_pairs(grid: Grid, domain: Quad, row: int | None = None) -> Array:
    """What the evaluator takes, for maps of one domain: as `pairs`, the same array each time.

    `row`: points in v, the last one again where that is more than the grid has.
    """
    points = grid_points(grid)
    if row is not None:
        last = grid.shape[1] - 1
        points = points.reshape(*grid.shape, 2)[:, np.minimum(np.arange(row), last)].reshape(-1, 2)
    return _constant(pairs(points, domain))


def pairs(parameters: Array, domain: Quad) -> Array:
    """(t, 1-t) in u and in v: shape (k, 4), from (u, v) of shape (k, 2) in a rising domain."""
    (u, v), (u1, u2, v1, v2) = parameters.T, domain
    wide, high = u2 - u1, v2 - v1
    return np.stack([(u - u1) / wide, (u2 - u) / wide, (v - v1) / high, (v2 - v) / high], -1)


@lru_cache(maxsize=64)
def mesh_indices(
    shape: tuple[int, int], mode: int, turned: bool = False, row: int | None = None
) -> Indices:
    """The points (p, 1), lines (p, 2) or triangles (p, 3) of a mesh, in OpenGL's order.

    The triangles wind counter-clockwise in (u,v), as the normal d/du x d/dv has it. (Vertices
    in the order of the specification wind clockwise, against GL_AUTO_NORMAL.) `row` is how many
    points in v are stored, if more than the shape has.
    """
    stored = shape[1] if row is None else row
    number = np.arange(shape[0] * stored, dtype=np.int32).reshape(shape[0], stored)
    number = number[:, : shape[1]].T  # [j, i]
    if mode == GL_POINT:
        return number.reshape(-1, 1)
    if mode == GL_LINE:
        along_u = np.stack([number[:, :-1], number[:, 1:]], -1).reshape(-1, 2)
        across = number.T
        along_v = np.stack([across[:, :-1], across[:, 1:]], -1).reshape(-1, 2)
        return np.concatenate([along_u, along_v])
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = [a, d, b, b, d, c] if turned else [a, b, d, b, c, d]
    return np.stack(cells, -1).reshape(-1, 3)


@lru_cache(maxsize=64)
def primitive_indices(mode: int, count: int) -> tuple[int, Indices]:
    """What glBegin(mode) makes of `count` vertices: GL_POINTS, GL_LINES or GL_TRIANGLES, and
    indices (p, 1), (p, 2) or (p, 3). Left-over vertices are ignored, as OpenGL does."""
    k = np.arange(count, dtype=np.int32)
    if mode == GL_POINTS:
        return GL_POINTS, k.reshape(-1, 1)
    if mode == GL_LINES:
        return GL_LINES, k[: count // 2 * 2].reshape(-1, 2)
    if mode in (GL_LINE_STRIP, GL_LINE_LOOP):
        lines = np.stack([k[:-1], k[1:]], -1)
        if mode == GL_LINE_LOOP and count > 1:
            lines = np.concatenate([lines, [[k[-1], 0]]]).astype(np.int32)
        return GL_LINES, lines
    if mode == GL_TRIANGLES:
        return GL_TRIANGLES, k[: count // 3 * 3].reshape(-1, 3)
    if mode == GL_TRIANGLE_STRIP:
        odd = k[:-2] % 2
        return GL_TRIANGLES, np.stack([k[:-2] + odd, k[1:-1] - odd, k[2:]], -1)
    if mode in (GL_TRIANGLE_FAN, GL_POLYGON):
        return GL_TRIANGLES, np.stack([0 * k[2:], k[1:-1], k[2:]], -1)
    if mode == GL_QUADS:
        a = k[: count // 4 * 4 : 4]
        return GL_TRIANGLES, _halves(a, a + 1, a + 2, a + 3)
    assert mode == GL_QUAD_STRIP
    a = k[: max(0, count // 2 * 2 - 2) : 2]
    return GL_TRIANGLES, _halves(a, a + 1, a + 3, a + 2)


def chained(segments: Indices) -> tuple[Indices, Array]:
    """Segments (p, 2) as polylines: the vertices in their order, and for each 1, or 0 where a
    line begins. A segment that starts where the one before it ends goes on."""
    begins = np.ones(len(segments), bool)
    begins[1:] = segments[1:, 0] != segments[:-1, 1]
    used = np.stack([begins, np.ones(len(segments), bool)], -1)
    links = np.broadcast_to([0.0, 1.0], used.shape)
    return segments[used], links[used]


def _halves(a: Indices, b: Indices, c: Indices, d: Indices) -> Indices:
    return np.stack([a, b, c, a, c, d], -1).reshape(-1, 3)


def _constant(array: Array) -> Array:
    array.setflags(write=False)
    return array
