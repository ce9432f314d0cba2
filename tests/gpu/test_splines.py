"""Surface splines on the GPU: normals agree across edges, bodies are closed at every pixel."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.meshes import MESHES
from reparam.geometry.patch_joins import joins
from reparam.geometry.surface_spline import surface_spline
from reparam.gpu.readback import read_points
from reparam.snapshot import Studio

LEVEL = 8
QUICK = ("cube", "icosahedron", "prism8", "three_handles", "t_mesh", "open_cube")


@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
@pytest.mark.parametrize(
    "name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in MESHES]
)
def test_normals_across_edges(studio: Studio, evaluator: str, name: str) -> None:
    found = MESHES[name]()
    ratios = np.random.default_rng(6).uniform(0.1, 0.9, len(found.topology.ends))
    nets = surface_spline(found.topology, ratios).nets(found.vertices)
    report = joins(nets, samples=3, highest=1)
    grid = read_points(studio.painter, evaluator, nets, LEVEL).normals
    normals = grid.reshape(len(nets), LEVEL + 1, LEVEL + 1, 3).astype(np.float64)
    rows, columns = normals, normals.swapaxes(1, 2)
    sides = np.stack([rows[:, 0], rows[:, -1], columns[:, 0], columns[:, -1]], 1)
    one, other = (sides[report.patches[:, k], report.sides[:, k]] for k in (0, 1))
    other = np.where(report.reversed[:, None, None], other[:, ::-1], other)
    sine = np.linalg.norm(np.cross(one, other), axis=-1)
    angle = np.degrees(np.arctan2(sine, (one * other).sum(-1)))
    assert 2 * len(one) + len(report.free) == 4 * len(nets)
    assert angle.max() <= 0.05
