"""A trim region as one triangle mesh."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..net import Array
from .region import TrimRegion
from .triangulation import Polygon, cut_by_grid, triangulate_polygons, trim_polygons


def triangulate_region(
    region: TrimRegion, u_lines: Array, v_lines: Array
) -> tuple[Array, NDArray[np.intp]]:
    """Parameters (k, 2) and triangles (t, 3), counter-clockwise, of what stays of a surface.

    Each triangle lies in one cell of the grid of the increasing lines, which run from border to
    border of the domain, and each inner edge belongs to two. Loops nearer than FLATNESS of a cell
    may run together.
    """
    u0, u1, v0, v1 = region.domain
    fine = np.diff(u_lines).min() / 4.0, np.diff(v_lines).min() / 4.0  # a quarter of FLATNESS
    polygons = trim_polygons(region, (float(fine[0]), float(fine[1])))
    if region.keeps_outside:
        polygons.insert(0, np.array([(u0, v0), (u1, v0), (u1, v1), (u0, v1)]))
    corners: list[Polygon] = []
    for triangle in triangulate_polygons(polygons):
        for _, _, (first, *others) in cut_by_grid(triangle, u_lines, v_lines):
            corners.extend([first, a, b] for a, b in pairwise(others))
    points, number = np.unique(np.array(corners).reshape(-1, 2), axis=0, return_inverse=True)
    faces = number.reshape(-1, 3)
    return points, faces[(faces != np.roll(faces, 1, 1)).all(1)]
