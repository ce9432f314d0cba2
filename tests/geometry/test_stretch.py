"""Derivative, determinant and singular values against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.net import control_net
from reparam.geometry.planar_maps import ALIGNED_IDENTITY, R
from reparam.geometry.stretch import stretch


@pytest.mark.parametrize(("u", "v"), [(0.5, 0.5), (0.0, 0.5), (0.3, 0.8), (0.0, 0.0)])
def test_r(u: float, v: float) -> None:
    a, b = 2.0 * u - 1.0, 2.0 * v - 1.0
    jacobian = [[-2.0 * a * b, 3.0 - a * a], [b * b - 3.0, 2.0 * a * b]]
    found = stretch(R, u, v)
    assert found.jacobian == pytest.approx(np.array(jacobian), abs=1e-14)
    determinant = 3.0 * (3.0 - a * a - b * b - a * a * b * b)
    assert found.determinant == pytest.approx(determinant, abs=1e-13)
    assert np.prod(found.factors) == pytest.approx(abs(determinant), abs=1e-7)
    assert np.sum(np.square(found.factors)) == pytest.approx(np.sum(np.square(jacobian)))


def test_a_rational_quarter_of_a_ring() -> None:
    """Radius 1 + v; u runs a quarter, at speed 2 / (1 + t^2) times its scale at the ends."""
    w = np.sqrt(0.5)
    points = [[(1, 0), (2, 0)], [(1, 1), (2, 2)], [(0, 1), (0, 2)]]
    ring = control_net(points, [[1, 1], [w, w], [1, 1]])
    found = stretch(ring, 0.0, 0.5)
    assert found.jacobian == pytest.approx(np.array([[0.0, 1.0], [2 * w * 1.5, 0.0]]), abs=1e-14)
    assert found.determinant == pytest.approx(-3.0 * w)
    assert found.factors == pytest.approx((3.0 * w, 1.0))


def test_in_space_the_determinant_is_the_area() -> None:
    roof = control_net([[(0, 0, 0), (0, 2, 0)], [(3, 0, 4), (3, 2, 4)]])
    found = stretch(roof, 0.2, 0.7)
    assert found.jacobian.shape == (3, 2)
    assert found.determinant == pytest.approx(10.0)
    assert found.factors == pytest.approx((5.0, 2.0))


def test_from_one_image_to_the_other() -> None:
    here = stretch(R, 0.3, 0.8)
    same = here.after(here)
    assert same is not None
    assert same.jacobian == pytest.approx(np.eye(2), abs=1e-14)
    from_square = here.after(stretch(ALIGNED_IDENTITY, 0.3, 0.8))
    assert from_square is not None
    assert from_square.factors == pytest.approx(tuple(f / 2.0 for f in here.factors))
    assert here.after(stretch(R, 0.0, 0.0)) is None
    assert here.after(stretch(control_net([[(1, 2)]]), 0.0, 0.0)) is None
