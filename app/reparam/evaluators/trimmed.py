"""Trimmed surfaces as triangles or lines of which each lies in one cell of its piece's grid.

So the tolerance that holds for the cells holds for them: the longest edge, and the largest
distance of a triangle from the surface, are those of the cell's box.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ..geometry.net import Array
from ..geometry.trimming.triangulation import (
    Point,
    cut_by_grid,
    triangulate_polygons,
    trim_polygons,
)
from .constants import GL_LINE_STRIP, GL_LINES, GL_TRIANGLES
from .glu_constants import GLU_FILL, GLU_NURBS_TESSELLATOR, GLU_OUTLINE_PATCH, NAMES
from .glu_errors import GluInvalidValue
from .sampling import Steps
from .splines import Nurbs

MOST_CELLS = 1 << 20

Place = tuple[int, int]
Line = tuple[Point, Point]
Triangle = tuple[Point, Point, Point]


def trimmed_pieces(nurbs: Nurbs, nu: Steps, nv: Steps) -> tuple[int, dict[Place, list[Array]]]:
    """GL_TRIANGLES, GL_LINES or GL_LINE_STRIP, and for each piece (s, t) their (u, v): (k, 2) each.

    As the display mode says: filled, the edges of the triangles, or the trims and the borders of
    the pieces. Raises GluInvalidValue where memory would not have them all.
    """
    region, properties = nurbs.region, nurbs.properties
    assert region is not None
    if (cells := float(nu.sum()) * float(nv.sum())) > MOST_CELLS:
        raise GluInvalidValue(
            f"{NAMES[properties.sampling_method]}: expected a tolerance or steps that ask for at "
            f"most {MOST_CELLS} cells of a trimmed surface, found {cells:.3g}"
        )
    (u_lines, u_piece), (v_lines, v_piece) = (
        _lines(nurbs.ends(axis), count) for axis, count in ((0, nu), (1, nv))
    )
    cell = (float(np.diff(u_lines).min()), float(np.diff(v_lines).min()))
    triangles: dict[Place, list[Triangle]] = defaultdict(list)
    for triangle in triangulate_polygons(trim_polygons(region, cell)):
        for i, j, polygon in cut_by_grid(triangle, u_lines, v_lines):
            first, *others = polygon
            fan = [(first, a, b) for a, b in pairwise(others)]
            triangles[u_piece[i], v_piece[j]].extend(fan)
    display = properties.display_mode
    if display == GLU_OUTLINE_PATCH:
        borders = _borders(triangles, nurbs)
        return GL_LINE_STRIP, {
            place: [np.array(chain) for chain in _chains(found)] for place, found in borders.items()
        }
    if display == GLU_FILL or properties.mode == GLU_NURBS_TESSELLATOR:
        return GL_TRIANGLES, {at: [np.array(t).reshape(-1, 2)] for at, t in triangles.items()}
    return GL_LINES, {at: [np.array(_edges(t)).reshape(-1, 2)] for at, t in triangles.items()}


def _lines(ends: Array, count: Steps) -> tuple[Array, list[int]]:
    """The lines of the grid, and which piece each of the cells between them belongs to.

    Computed as the grid's points are, so that both hit the same numbers.
    """
    inner = [
        a + (b - a) * (np.arange(n) / n) for a, b, n in zip(ends, ends[1:], count, strict=False)
    ]
    piece = np.repeat(np.arange(len(count)), count)
    return np.append(np.concatenate(inner), ends[-1]), piece.tolist()


def edges_of(triangles: Array) -> Array:
    """The edges of triangles (t, 3, 2), each once: two points each, (k, 2)."""
    corners = [((a, b), (c, d), (e, f)) for (a, b), (c, d), (e, f) in triangles.tolist()]
    return np.array(_edges(corners)).reshape(-1, 2)


def _edges(triangles: list[Triangle]) -> list[Line]:
    """The edges of triangles, each once."""
    around = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    return list({(min(edge), max(edge)): edge for edge in around}.values())


def _borders(triangles: dict[Place, list[Triangle]], nurbs: Nurbs) -> dict[Place, list[Line]]:
    """The edges that bound the region, and those on the borders between two pieces."""
    edges = {
        place: [edge for a, b, c in found for edge in ((a, b), (b, c), (c, a))]
        for place, found in triangles.items()
    }
    every = {edge for found in edges.values() for edge in found}
    inner = [set(nurbs.ends(axis)[1:-1].tolist()) for axis in (0, 1)]

    def seen(edge: Line) -> bool:
        a, b = edge
        if (b, a) not in every:
            return True
        return a < b and any(a[k] == b[k] and a[k] in inner[k] for k in (0, 1))

    return {place: [edge for edge in found if seen(edge)] for place, found in edges.items()}


def _chains(edges: list[Line]) -> Iterator[list[Point]]:
    """Edges end to start, as far as they go."""
    after: dict[Point, list[Point]] = defaultdict(list)
    for a, b in edges:
        after[a].append(b)
    ends = {b for _, b in edges}
    for a in sorted(after, key=lambda point: point in ends):  # first where nothing comes from
        while after[a]:
            chain = [a]
            while after.get(chain[-1]):
                chain.append(after[chain[-1]].pop())
            yield chain
