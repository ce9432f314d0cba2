"""Trim regions as triangles: areas, no cracks, each triangle in one cell."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.trimming import trim_region
from reparam.geometry.trimming.mesh import triangulate_region
from trim_cases import SQUARE, circle, region_of, reverse


@pytest.mark.parametrize("name", ["red book", "cusps", "blobs", "sixty-four", "no loops"])
def test_areas_edges_and_cells(name: str) -> None:
    region = region_of(name)
    lines = np.linspace(0.0, 1.0, 17), np.linspace(0.0, 1.0, 10)
    points, triangles = triangulate_region(region, *lines)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2.0
    assert (areas > -1e-12).all()
    assert areas.sum() == pytest.approx(region.area(), abs=2e-3)
    scaled = np.stack([a, b, c]) * [16.0, 9.0]
    assert (np.ceil(scaled.max(0) - 1e-9) - np.floor(scaled.min(0) + 1e-9) <= 1.0).all()
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    both = {(i, j) for i, j in edges.tolist()}
    lone = np.array([(i, j) for i, j in both if (j, i) not in both])
    middle = points[lone].mean(1)
    inner = ((middle > 1e-9) & (middle < 1.0 - 1e-9)).all(1)
    assert (np.abs(region.signed_distance(*middle[inner].T)) < 3e-3).all()


def test_steps_and_domains() -> None:
    stretch = np.array([[4.0, 0, 0], [0, 0.5, 0], [10.0, -2.0, 1.0]])
    hole = [piece @ stretch for piece in reverse(circle())]
    region = trim_region([hole], (10.0, 14.0, -2.0, -1.5))
    lines = np.linspace(10.0, 14.0, 21), np.linspace(-2.0, -1.5, 21)
    points, triangles = triangulate_region(region, *lines)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2.0
    assert areas.sum() == pytest.approx(region.area(), rel=1e-3)
    assert trim_region([SQUARE]).keeps_outside is False
