"""Catmull and Clark's subdivision where n quads meet: eigenvalues and the characteristic map.

Around the vertex lie n sectors; point (i, j) of sector k is reached by i steps along ray k and j
along ray k + 1:

         ray k+1                  One step of subdivision halves the parameter (u, v) and
            |                     takes a neighbourhood into a smaller one of the same shape,
         2  o----o----o           to first order by the factor lambda: its eigenvectors are the
            | 2  | 3  |           control points of the characteristic map chi. Cells 1, 2, 3
         1  o----o----o           make one ring of bicubic patches, and the ring of level m is
            |    | 1  |           lambda^m times the first.
         0  o----o----o  ray k
            0    1    2

Source: E. Catmull, J. Clark, Computer-Aided Design 10 (1978), 350-355; U. Reif, Computer Aided
Geometric Design 12 (1995), 153-174.
"""

from __future__ import annotations

from functools import cache
from math import cos, pi, sin, sqrt

import numpy as np

from .mesh import Mesh, mesh
from .net import Array, control_net

REACH = 3  # steps along a ray that a ring of patches needs
CELLS = ((1, 0), (1, 1), (0, 1))
EVEN = {-1: 1 / 8, 0: 6 / 8, 1: 1 / 8}  # masks of uniform cubic splines: a point that stays,
ODD = {0: 1 / 2, 1: 1 / 2}  # and one in the middle
BEZIER = np.array([[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]) / 6.0


def subdominant(n: int) -> float:
    """lambda = (c + 5 + sqrt((c + 9)(c + 1)))/16, c = cos(2 pi/n); 1/2 for n = 4."""
    c = cos(2.0 * pi / n)
    return (c + 5.0 + sqrt((c + 9.0) * (c + 1.0))) / 16.0


def point(n: int, k: int, i: int, j: int) -> int:
    """The number of a point; -1 as a coordinate is the neighbouring sector's."""
    if i == 0 and j == 0:
        return 0
    if j < 0:
        return point(n, k - 1, -j, i)
    if i <= 0:
        return point(n, k + 1, j, -i)
    return 1 + k % n * REACH * (REACH + 1) + (i - 1) * (REACH + 1) + j


def count(n: int) -> int:
    """How many points there are."""
    return 1 + n * REACH * (REACH + 1)


@cache
def matrix(n: int) -> Array:
    """One step of subdivision: new points from old ones, (count, count)."""
    rows = np.zeros((count(n), count(n)))
    for k in range(n):
        for i in range(1, REACH + 1):
            for j in range(REACH + 1):
                for a, along in _mask(i).items():
                    for b, across in _mask(j).items():
                        rows[point(n, k, i, j), point(n, k, a, b)] += along * across
        # (F + 2 R + (n - 3) v)/n with the means F of the faces' points, R of the edges' middles
        rows[0, 0] += (1 / 4 + 1 + n - 3) / n / n
        rows[0, point(n, k, 1, 0)] += (2 / 4 + 1) / n / n
        rows[0, point(n, k, 1, 1)] += 1 / 4 / n / n
    rows.flags.writeable = False
    return rows


def _mask(index: int) -> dict[int, float]:
    """Of the new point `index` on a line: old points with their weights."""
    return {index // 2 + step: w for step, w in (ODD if index % 2 else EVEN).items()}


@cache
def characteristic_points(n: int) -> Array:
    """Control points (count, 2) of chi: both eigenvectors of lambda, turned so that the first
    points on rays 0 and 1 are (1, 0) and (cos 2 pi/n, sin 2 pi/n)."""
    _, _, right = np.linalg.svd(matrix(n) - subdominant(n) * np.eye(count(n)))
    basis = right[-2:].T
    corners = [point(n, 0, 1, 0), point(n, 1, 1, 0)]
    aims = np.array([[1.0, 0.0], [cos(2.0 * pi / n), sin(2.0 * pi / n)]])
    points = basis @ np.linalg.solve(basis[corners], aims)
    points.flags.writeable = False
    return points


def ring(n: int, points: Array) -> Array:
    """The first ring over control points (count, 2 or 3), as Bezier nets (3 n, 4, 4, 4)."""
    spline = np.array([_controls(n, points, k, *cell) for k in range(n) for cell in CELLS])
    return control_net(np.einsum("ai,bj,pijc->pabc", BEZIER, BEZIER, spline))


def _controls(n: int, points: Array, k: int, i: int, j: int) -> Array:
    """The 4 x 4 control points around cell (i, j)."""
    steps = (-1, 0, 1, 2)
    return np.array([[points[point(n, k, i + a, j + b)] for b in steps] for a in steps])


def parameters(n: int) -> Array:
    """(u, v) in their sector as bilinear nets (3 n, 2, 2, 4) of the first ring."""
    corners = [[[(i + a, j + b) for b in (0, 1)] for a in (0, 1)] for i, j in CELLS]
    return control_net(np.tile(np.array(corners, float), (n, 1, 1, 1)))


def rings(first: Array, factor: float, levels: int) -> Array:
    """The first ring and its images under the factor, `levels` in all: (levels P, m, n, 4)."""
    scaled = [first * [factor**m, factor**m, factor**m, 1.0] for m in range(levels)]
    return np.concatenate(scaled)


def star(n: int) -> Mesh:
    """The control points of chi as a flat mesh: n sectors of 3 x 3 quads."""
    cells = [(k, i, j) for k in range(n) for i in range(REACH) for j in range(REACH)]
    faces = [
        [point(n, k, i + a, j + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for k, i, j in cells
    ]
    flat = np.zeros((count(n), 3))
    flat[:, :2] = characteristic_points(n)
    return mesh(flat, faces)
