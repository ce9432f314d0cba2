"""Curvatures against closed forms: sphere, torus, saddle, cylinder; scales are round."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.curvature import curvatures, round_scale, sampled_curvatures
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.net import control_net
from reparam.geometry.torus import torus

GRID = np.meshgrid(np.linspace(0.05, 0.95, 5), np.linspace(0.0, 1.0, 5), indexing="ij")


def test_torus() -> None:
    nets = torus(3.0, 1.0).patches().reshape(-1, 3, 3, 4)
    points = project(evaluate(nets, *GRID))
    cosine = np.hypot(points[..., 0], points[..., 1]) - 3.0  # of the angle around the tube
    gauss, mean = np.moveaxis(curvatures(nets, *GRID), -1, 0)
    np.testing.assert_allclose(gauss, cosine / (3.0 + cosine), atol=1e-12)
    np.testing.assert_allclose(mean, 0.5 * (1.0 + cosine / (3.0 + cosine)), atol=1e-12)
    turned = curvatures(nets.swapaxes(1, 2), *GRID[::-1])
    np.testing.assert_allclose(turned[..., 0], gauss, atol=1e-12)
    np.testing.assert_allclose(turned[..., 1], -mean, atol=1e-12)


def test_saddle_and_plane() -> None:
    saddle = control_net([[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 2)]])  # z = 2 x y
    found = curvatures(saddle, 0.0, 0.0)
    assert found == pytest.approx([-4.0, 0.0])
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    assert (sampled_curvatures(flat[None]) == 0.0).all()
    point = control_net([[(1, 2, 3)] * 2] * 2)
    assert curvatures(point, 0.5, 0.5).tolist() == [0.0, 0.0]


@pytest.mark.parametrize(
    ("most", "expected"),
    [(0.0, 1.0), (0.9, 1.0), (1.0, 1.0), (1.1, 2.0), (3.0, 5.0), (70.0, 100.0)],
)
def test_scales(most: float, expected: float) -> None:
    assert round_scale(np.linspace(-most, most, 3)) == pytest.approx(expected)
    assert round_scale(np.full(4, -most * 1e-4)) == pytest.approx(expected * (1e-4 if most else 1))
