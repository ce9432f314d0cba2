"""Patches as triangles in float64, for files: what the GPU draws, with vertices shared."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .evaluate import evaluate, project
from .net import Array
from .normal import surface_normal
from .trimming import TrimRegion
from .trimming.mesh import triangulate_region

Indices = NDArray[np.intp]

MAX_VERTICES = 1 << 24
WELD = 1e-9  # of the size: vertices that near are one


@dataclass(frozen=True, eq=False)
class Triangles:
    """Points and unit normals (V, 3), (s, t) (V, 2) or None, quads (Q, 4) counter-clockwise.

    `places` (V,) says which vertices lie at one place, though their normals or (s, t) differ.
    """

    points: Array
    normals: Array
    maps: Array | None
    quads: Indices
    places: Indices

    def triangles(self) -> Indices:
        """The quads halved: (2 Q, 3). A quad with a side of no length gives one triangle."""
        both = np.concatenate([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]])
        corners = self.places[both]
        a, b, c = corners.T
        return np.asarray(both[(a != b) & (b != c) & (c != a)])


def tessellate(nets: Array, level: int, maps: Array | None = None) -> Triangles:
    """Patches (P, m, n, 4) on grids of level x level cells; `maps` are texture nets.

    Raises ValueError for more than MAX_VERTICES vertices.
    """
    count = len(nets) * (level + 1) ** 2
    if count > MAX_VERTICES:
        raise ValueError(f"expected at most {MAX_VERTICES} vertices, found {count}")
    t = np.arange(level + 1) / level
    u, v = (grid.ravel() for grid in np.meshgrid(t, t, indexing="ij"))
    points = project(evaluate(nets, u, v)).reshape(-1, 3)
    normals = surface_normal(nets, u, v).reshape(-1, 3)
    texture = None
    if maps is not None:
        there = project(evaluate(maps, u, v))[..., :2]
        texture = np.broadcast_to(there, (len(nets), len(u), 2)).reshape(-1, 2)
    number = np.arange(count).reshape(len(nets), level + 1, level + 1)
    a, b = number[:, :-1, :-1], number[:, 1:, :-1]
    c, d = number[:, 1:, 1:], number[:, :-1, 1:]
    quads = np.stack([a, b, c, d], -1).reshape(-1, 4)
    return Triangles(points, normals, texture, quads, welded(points))


def tessellate_trimmed(
    nets: Array, domains: Array, region: TrimRegion, level: int, maps: Array | None = None
) -> Triangles:
    """What a trim region leaves of one surface's patches; `domains` (P, 4) are u0, u1, v0, v1.

    Triangles come as quads with their last corner twice; each lies in one cell of one patch.
    """
    steps = np.arange(level + 1) / level
    lines = [
        np.unique(np.round(low[:, None] + (high - low)[:, None] * steps, 12))
        for low, high in (domains[:, :2].T, domains[:, 2:].T)
    ]
    parameters, faces = triangulate_region(region, *lines)
    middle = parameters[faces].mean(1)
    inside = (middle[:, None, 0] >= domains[:, 0]) & (middle[:, None, 0] <= domains[:, 1])
    inside &= (middle[:, None, 1] >= domains[:, 2]) & (middle[:, None, 1] <= domains[:, 3])
    patch = inside.argmax(1)
    pairs, number = np.unique(
        np.stack([np.repeat(patch, 3), faces.ravel()], -1), axis=0, return_inverse=True
    )
    own, at = pairs.T
    u0, u1, v0, v1 = domains[own].T
    u, v = (parameters[at, 0] - u0) / (u1 - u0), (parameters[at, 1] - v0) / (v1 - v0)
    points, normals = np.empty((len(own), 3)), np.empty((len(own), 3))
    texture = None if maps is None else np.empty((len(own), 2))
    for index in np.unique(own):
        here = own == index
        points[here] = project(evaluate(nets[index], u[here], v[here]))
        normals[here] = surface_normal(nets[index], u[here], v[here])
        if texture is not None and maps is not None:
            texture[here] = project(evaluate(maps[index], u[here], v[here]))[:, :2]
    quads = number.reshape(-1, 3)[:, [0, 1, 2, 2]]
    return Triangles(points, normals, texture, quads, welded(points))


def welded(points: Array) -> Indices:
    """For each point the number of its place, (V,), counted from 0 in the order of appearance."""
    size = float(np.ptp(points, axis=0).max()) or 1.0
    # Off the middle of a cell, where coordinates like 1/2 and 1/3 do not fall on its border.
    cells = np.floor(points / (size * WELD) + 0.318).astype(np.int64)
    _, first, place = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    order = np.empty(len(first), np.intp)
    order[np.argsort(first)] = np.arange(len(first))
    return order[place.ravel()]
