"""Trimmed regions as triangles of which each lies in one cell of a grid.

The loops become polygons, earcut cuts these into triangles, and the grid's lines cut the
triangles. Triangles that shared an edge share its cuts bit for bit, for a cut depends on the edge
and the line alone: there are no T-junctions.

        +----+----+          u-lines first, then v-lines; the rest are convex
        | __/|\\__ |          polygons, drawn as fans
        |/___|___\\|
        +----+----+
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..bernstein import bernstein
from ..derivative_bounds import bounds
from ..net import Array
from .region import TrimRegion

FLATNESS = 0.02  # of a cell: how far a chord may be from its trim curve
MOST_CHORDS = 1 << 14

Point = tuple[float, float]
Polygon = list[Point]


def trim_polygons(region: TrimRegion, cell: tuple[float, float]) -> list[Array]:
    """The loops as closed polygons (k, 2) in (u, v), the first point not repeated.

    No chord is longer than a cell (du, dv), or farther than FLATNESS of a cell from its curve.
    """
    polygons = []
    for loop in region.loops:
        points = [chords(piece, cell) for piece in loop]
        polygons.append(np.concatenate([piece[:-1] for piece in points]))
    return polygons


def chords(piece: Array, cell: tuple[float, float]) -> Array:
    """Points (k, 2) along a polyline (k, 2), its own, or along a Bezier curve (n, 3)."""
    if piece.shape[1] == 2:
        return piece
    net = piece[:, None] / np.array([*cell, 1.0])
    found = bounds(net)
    count = np.ceil(max(float(found.u), np.sqrt(float(found.uu) / 8.0 / FLATNESS), 1.0))
    t = np.linspace(0.0, 1.0, int(min(count, MOST_CHORDS)) + 1)
    points = bernstein(len(piece) - 1, t) @ piece
    return np.asarray(points[:, :2] / points[:, 2:])


def signed_area(polygon: Array) -> float:
    """Positive if counter-clockwise."""
    x, y = polygon.T - polygon[:1].T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2.0)


def triangulate_polygons(polygons: Sequence[Array]) -> Iterator[Polygon]:
    """Triangles, counter-clockwise, of what lies inside counter-clockwise polygons and outside
    the clockwise ones within them."""
    from mapbox_earcut import triangulate_float64  # needed by few, so imported late

    areas = [signed_area(polygon) for polygon in polygons]
    outer = [i for i, area in enumerate(areas) if area > 0.0]
    holes: dict[int, list[int]] = {i: [] for i in outer}
    for i, area in enumerate(areas):
        if area <= 0.0:
            around = [j for j in outer if areas[j] > -area and _inside(polygons[j], polygons[i])]
            if around:
                holes[min(around, key=lambda j: areas[j])].append(i)
    for i, members in holes.items():
        rings = [polygons[i], *(polygons[j] for j in members)]
        points = np.concatenate(rings)
        ends = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
        for a, b, c in triangulate_float64(points, ends).reshape(-1, 3).tolist():
            triangle = points[[a, b, c]]
            corners = triangle if signed_area(triangle) > 0.0 else triangle[::-1]
            yield [(u, v) for u, v in corners.tolist()]


def _inside(polygon: Array, other: Array) -> bool:
    """Whether `other` lies in the polygon, which it does not cross: most of its points do."""
    (x0, y0), (x1, y1) = polygon.T, np.roll(polygon, -1, 0).T
    x, y = other[:, :1], other[:, 1:]
    straddles = (y0 <= y) != (y1 <= y)
    height = np.where(y1 == y0, 1.0, y1 - y0)
    crossed = straddles & (x < x0 + (y - y0) / height * (x1 - x0))
    return bool(np.median(crossed.sum(1) % 2) > 0.5)


def cut_by_grid(
    triangle: Polygon, u_lines: Array, v_lines: Array
) -> Iterator[tuple[int, int, Polygon]]:
    """(i, j, convex polygon): the parts of a triangle in the cells between rising lines.

    What lies beyond the first and last line is left out.
    """
    for i, column in _slabs(triangle, 0, u_lines):
        for j, part in _slabs(column, 1, v_lines):
            yield i, j, part


def _slabs(polygon: Polygon, axis: int, lines: Array) -> Iterator[tuple[int, Polygon]]:
    low = min(point[axis] for point in polygon)
    high = max(point[axis] for point in polygon)
    first = int(np.searchsorted(lines, low, side="right")) - 1
    last = int(np.searchsorted(lines, high, side="left")) - 1
    rest = polygon
    if first < 0:
        _, rest = _split(rest, axis, float(lines[0]))
        first = 0
    for k in range(first, min(last, len(lines) - 2) + 1):
        part, rest = _split(rest, axis, float(lines[k + 1]))
        if len(part) > 2:
            yield k, part
        if len(rest) < 3:
            return


def _split(polygon: Polygon, axis: int, line: float) -> tuple[Polygon, Polygon]:
    """The parts of a convex polygon below and above a line."""
    below: Polygon = []
    above: Polygon = []
    for one, two in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
        if one[axis] <= line:
            below.append(one)
        if one[axis] >= line:
            above.append(one)
        if (one[axis] < line < two[axis]) or (two[axis] < line < one[axis]):
            cut = _cut(min(one, two), max(one, two), axis, line)
            below.append(cut)
            above.append(cut)
    return below, above


def _cut(start: Point, end: Point, axis: int, line: float) -> Point:
    share = (line - start[axis]) / (end[axis] - start[axis])
    other = start[1 - axis] + share * (end[1 - axis] - start[1 - axis])
    return (line, other) if axis == 0 else (other, line)
