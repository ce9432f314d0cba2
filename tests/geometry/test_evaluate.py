"""The float64 evaluator against de Casteljau's algorithm in rational numbers and closed forms."""

from __future__ import annotations

from fractions import Fraction

import exact
import numpy as np
import pytest

from reparam.geometry.evaluate import (
    FINEST,
    SAMPLES,
    evaluate,
    evaluate_derivatives,
    jacobian_determinant,
    project,
    sample_surface,
)
from reparam.geometry.net import Array, control_net

random = np.random.default_rng(3)
MIXED = [(0, 0), (0, 3), (1, 1), (1, 4), (4, 1), (2, 3), (3, 2), (5, 6), (8, 1)]
PARAMETERS = [
    (Fraction(a, 7), Fraction(b, 5)) for a, b in [(0, 0), (7, 0), (2, 4), (5, 1), (9, -2)]
]
U, V = (np.array(t, float) for t in zip(*PARAMETERS, strict=True))
T = np.linspace(0.0, 1.0, 17)
GRID = np.meshgrid(T, T, indexing="ij")


@pytest.mark.parametrize(("degree_u", "degree_v"), MIXED)
def test_points_of_asymmetric_nets(degree_u: int, degree_v: int) -> None:
    net = exact.random_net(random, degree_u, degree_v)
    expected = np.array([exact.evaluate(net, u, v) for u, v in PARAMETERS], float)
    scale = np.abs(expected).max(-1, keepdims=True) + 1.0
    assert (np.abs(evaluate(net, U, V) - expected) / scale).max() < 1e-13


@pytest.mark.parametrize(("degree_u", "degree_v"), MIXED)
def test_derivatives_of_asymmetric_nets(degree_u: int, degree_v: int) -> None:
    """Central differences in rational numbers: their error is of the order of step^2 alone."""
    net = exact.random_net(random, degree_u, degree_v)
    step = Fraction(1, 10**9)
    along_u, along_v = evaluate_derivatives(net, U, V)
    for row, (u, v) in enumerate(PARAMETERS):
        for found, (du, dv) in ((along_u, (step, 0)), (along_v, (0, step))):
            ahead = exact.evaluate(net, u + du, v + dv)
            behind = exact.evaluate(net, u - du, v - dv)
            expected = [(a - b) / (2 * step) for a, b in zip(ahead, behind, strict=True)]
            scale = 1.0 + max(abs(float(x)) for x in expected)
            np.testing.assert_allclose(found[row], np.array(expected, float), atol=1e-12 * scale)


def test_first_index_goes_with_u() -> None:
    net = control_net([[(0, 0), (0, 1), (0, 2)], [(5, 0), (5, 1), (5, 2)]])
    assert evaluate(net, 1.0, 0.0).tolist() == [5.0, 0.0, 0.0, 1.0]
    assert evaluate(net, 0.0, 1.0).tolist() == [0.0, 2.0, 0.0, 1.0]
    along_u, along_v = evaluate_derivatives(net, 0.5, 0.5)
    assert along_u[:2].tolist() == [5.0, 0.0]
    assert along_v[:2].tolist() == [0.0, 2.0]


def test_stacked_nets_and_any_shape_of_parameters() -> None:
    nets = exact.random_net(random, 2, 3, 5)
    points = evaluate(nets, *GRID)
    assert points.shape == (5, 17, 17, 4)
    np.testing.assert_allclose(points[3], evaluate(nets[3], *GRID), atol=1e-15)
    assert evaluate_derivatives(nets, 0.5, 0.5)[1].shape == (5, 4)


def circle_arc(half_angle: float) -> Array:
    """(x, y, w) homogeneous points of an arc of the unit circle, symmetric about the x-axis."""
    c, s = np.cos(half_angle), np.sin(half_angle)
    return np.array([[c, -s, 1.0], [1.0, 0.0, c], [c, s, 1.0]])


def revolved(profile: Array, arc: Array) -> Array:
    """A profile (radius, height, w) turned along an arc of directions."""
    x = profile[:, None, 0] * arc[None, :, 0]
    y = profile[:, None, 0] * arc[None, :, 1]
    z = profile[:, None, 1] * arc[None, :, 2]
    return np.stack([x, y, z, profile[:, None, 2] * arc[None, :, 2]], -1)


@pytest.mark.parametrize("half_angle", [0.1, np.pi / 6, np.pi / 4, 1.3])
def test_circle_is_exact(half_angle: float) -> None:
    cylinder = revolved(np.array([[1.0, 0.0, 1.0], [1.0, 2.0, 1.0]]), circle_arc(half_angle))
    points = project(evaluate(cylinder, *GRID))
    np.testing.assert_allclose(np.hypot(points[..., 0], points[..., 1]), 1.0, atol=1e-15)
    angles = np.arctan2(points[0, :, 1], points[0, :, 0])
    np.testing.assert_allclose(angles[[0, 8, -1]], [-half_angle, 0.0, half_angle], atol=1e-15)


def test_sphere_is_exact() -> None:
    sphere = revolved(circle_arc(np.pi / 4), circle_arc(np.pi / 4))
    points = project(evaluate(sphere, *GRID))
    np.testing.assert_allclose(np.linalg.norm(points, axis=-1), 1.0, atol=1e-15)


def test_torus_is_exact() -> None:
    tube = circle_arc(np.pi / 6)
    profile = np.stack([3.0 * tube[:, 2] + tube[:, 0], tube[:, 1], tube[:, 2]], -1)
    x, y, z = np.moveaxis(project(evaluate(revolved(profile, circle_arc(1.0)), *GRID)), -1, 0)
    np.testing.assert_allclose((np.hypot(x, y) - 3.0) ** 2 + z**2, 1.0, atol=3e-15)


def test_determinant_of_a_map_with_a_known_one() -> None:
    net = control_net([[(0, 0), (0, 3)], [(2, 0), (2, 5)]])  # (2u, 3v + 2uv)
    np.testing.assert_allclose(jacobian_determinant(net, *GRID), 2.0 * (3.0 + 2.0 * GRID[0]))


@pytest.mark.parametrize("count", [1, 300, 100_000])
def test_samples_of_many_patches_stay_few(count: int) -> None:
    nets = np.broadcast_to(control_net([[(0, 0), (0, 2)], [(1, 0), (1, 2)]]), (count, 2, 2, 4))
    points = sample_surface(nets if count > 1 else nets[0])
    assert len(points) <= max(SAMPLES, 9 * count)
    assert len(points) >= min(9 * count, (FINEST + 1) ** 2)
    assert points.min(0).tolist() == [0.0, 0.0, 0.0]
    assert points.max(0).tolist() == [1.0, 2.0, 0.0]
