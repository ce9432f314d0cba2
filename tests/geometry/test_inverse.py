"""Point inversion against closed forms, dense samples, and the maps it inverts."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.inverse import Picker, _distance, distances, invert
from reparam.geometry.net import Array, control_net
from reparam.geometry.planar_maps import ALIGNED_IDENTITY, R

DEGREES = [(1, 1), (2, 2), (1, 4), (5, 3), (8, 8)]


def image(net: Array, uv: Array) -> Array:
    """(x, y, z) of each (u, v)."""
    return np.stack([project(evaluate(net, u, v)) for u, v in uv.reshape(-1, 2)])


def r(u: Array, v: Array) -> Array:
    """Formula (13) in powers."""
    a, b = 2.0 * u - 1.0, 2.0 * v - 1.0
    return np.stack([b * (3.0 - a * a) / 2.0, -a * (3.0 - b * b) / 2.0], -1)


def rational(degrees: tuple[int, int], disorder: float, seed: int) -> Array:
    """A rational net about the points (i, j)."""
    random = np.random.default_rng(seed)
    m, n = degrees[0] + 1, degrees[1] + 1
    grid = np.stack(np.meshgrid(np.arange(m), np.arange(n), indexing="ij"), -1)
    points = grid + random.uniform(-disorder, disorder, (m, n, 2))
    return control_net(points, random.uniform(0.5, 2.0, (m, n)))


def test_r_inside() -> None:
    uv = np.random.default_rng(1).random((1500, 2))
    assert np.abs(invert(R, r(*uv.T)) - uv).max() < 1e-10


def test_r_at_its_singular_corners_and_near_them() -> None:
    corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]], float)
    found = invert(R, r(*corners.T))
    assert np.abs(found - corners).max() < 1e-7
    assert distances(R, r(*corners.T), found).max() < 1e-14
    for away, along in ((1e-2, 2.0), (1e-4, 2.0), (1e-6, 2.0), (1e-2, 1.0), (1e-3, 1.0)):
        inside = np.abs(corners - np.array([away, along * away]))
        found = invert(R, r(*inside.T))
        assert distances(R, r(*inside.T), found).max() < 1e-14
        assert np.abs(found - inside).max() < 1e-15 / away + 1e-10


def test_outside_of_r_the_nearest_point_of_four_parabolas() -> None:
    points = np.random.default_rng(2).uniform(-4.0, 4.0, (300, 2))
    x, y = np.abs(points.T)
    beside = np.where(y <= 1.0, (3.0 - y * y) / 2.0 - x, -np.inf)
    above = np.where(x <= 1.0, (3.0 - x * x) / 2.0 - y, -np.inf)
    outside = np.maximum(beside, above) < 0.0
    assert 50 < outside.sum() < 290
    found = invert(R, points)
    assert distances(R, points, found)[~outside].max() < 1e-12
    assert (np.minimum(found, 1.0 - found)[outside].min(-1) == 0.0).all()
    t = np.linspace(-1.0, 1.0, 4001)
    arc = np.stack([(3.0 - t * t) / 2.0, t], -1)
    rim = np.concatenate([arc, -arc, arc[:, ::-1], -arc[:, ::-1]])
    least = np.array([np.linalg.norm(rim - p, axis=1).min() for p in points[outside]])
    excess = distances(R, points, found)[outside] - least
    assert excess.max() < 1e-12
    assert excess.min() > -1e-6


def test_the_square_itself_clamps() -> None:
    points = np.random.default_rng(3).uniform(-3.0, 3.0, (7, 30, 2))
    expected = np.stack([(1.0 - points[..., 1]) / 2.0, (points[..., 0] + 1.0) / 2.0], -1)
    found = invert(ALIGNED_IDENTITY, points)
    assert found.shape == (7, 30, 2)
    assert np.abs(found - np.clip(expected, 0.0, 1.0)).max() < 1e-12


@pytest.mark.parametrize("degrees", DEGREES)
def test_rational_maps_of_many_degrees(degrees: tuple[int, int]) -> None:
    uv = np.random.default_rng(4).random((60, 2))
    for seed in range(2):
        net = rational(degrees, 0.25, seed)
        assert np.abs(invert(net, image(net, uv)[:, :2]) - uv).max() < 1e-10


def test_gradient_and_hessian_are_the_derivatives() -> None:
    net = rational((3, 2), 0.4, 7)
    uv, points, step = np.array([[0.3, 0.6], [0.8, 0.1]]), np.array([[4.0, -1.0], [0.5, 3.0]]), 1e-5
    here = _distance(net, points, uv)
    for axis in range(2):
        way = step * np.eye(2)[axis]
        ahead, behind = _distance(net, points, uv + way), _distance(net, points, uv - way)
        slope = (ahead.value - behind.value) / (2.0 * step)
        assert here.gradient[:, axis] == pytest.approx(slope, rel=1e-7)
        turn = (ahead.gradient - behind.gradient) / (2.0 * step)
        assert here.hessian[:, axis] == pytest.approx(turn, rel=1e-7)


@pytest.mark.parametrize("degrees", [(0, 2), (1, 1), (2, 2), (3, 3)])
def test_the_nearest_point_of_a_surface_in_space(degrees: tuple[int, int]) -> None:
    random = np.random.default_rng(5)
    shape = (degrees[0] + 1, degrees[1] + 1)
    net = control_net(random.uniform(-1, 1, (*shape, 3)), random.uniform(0.5, 2.0, shape))
    points = random.uniform(-2.0, 2.0, (60, 3))
    t = np.linspace(0.0, 1.0, 121)
    samples = project(evaluate(net, *np.meshgrid(t, t, indexing="ij"))).reshape(-1, 3)
    least = np.array([np.linalg.norm(samples - p, axis=1).min() for p in points])
    found = distances(net, points, invert(net, points))
    assert (found - least).max() < 1e-12
    assert (least - found).max() < 2e-2


def test_a_collapsed_edge_and_a_point_are_inverted_too() -> None:
    triangle = control_net([[(0, 0), (0, 0)], [(1, 0), (0, 1)]])
    points = np.array([[0.2, 0.3], [0.0, 0.0], [-1.0, -1.0], [2.0, 2.0]])
    found = invert(triangle, points)
    assert np.isfinite(found).all()
    nearest = np.array([[0.2, 0.3], [0.0, 0.0], [0.0, 0.0], [0.5, 0.5]])
    assert image(triangle, found)[:, :2] == pytest.approx(nearest, abs=1e-8)
    assert np.isfinite(invert(control_net([[(1, 2)]]), points)).all()


def test_pick_takes_the_topmost_and_then_the_nearest() -> None:
    low = control_net([[(0, 0, 0), (0, 2, 0)], [(2, 0, 0), (2, 2, 0)]])
    roof = low + np.array([1.0, 1.0, 0.0, 0.0]) + np.array([0, 0, 5.0, 0.0])
    picker = Picker(np.stack([low, roof]))
    assert picker.pick((0.5, 0.25)) == (0, pytest.approx(0.25), pytest.approx(0.125))
    assert picker.pick((1.5, 1.5)) == (1, pytest.approx(0.25), pytest.approx(0.25))
    assert picker.pick((9.0, 2.0)) == (1, pytest.approx(1.0), pytest.approx(0.5))


def test_pick_takes_the_topmost_of_a_large_heap() -> None:
    square = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    heap = np.stack([square + np.array([0.0, 0.0, height, 0.0]) for height in range(50)])
    assert Picker(heap).pick((0.5, 0.5))[0] == 49
    assert Picker(heap[::-1]).pick((0.5, 0.5))[0] == 0


def test_pick_sees_the_near_side_of_a_folded_patch() -> None:
    fold = control_net([[(0, 0, 0), (0, 1, 0)], [(2, 0, 1), (2, 1, 1)], [(0, 0, 2), (0, 1, 2)]])
    patch, u, v = Picker(fold[None]).pick((0.5, 0.5))
    assert (patch, v) == (0, pytest.approx(0.5))
    assert 4.0 * u * (1.0 - u) == pytest.approx(0.5)
    assert u > 0.5


def test_pick_among_many() -> None:
    random = np.random.default_rng(6)
    nets = np.stack([rational((2, 2), 0.2, seed) for seed in range(200)])
    nets[..., :2] += nets[..., 3:] * random.uniform(-20.0, 20.0, (200, 1, 1, 2))
    nets[..., 2] = nets[..., 3] * np.arange(200.0)[:, None, None]
    picker = Picker(nets)
    for target in range(0, 200, 23):
        point = project(evaluate(nets[target], 0.3, 0.6))[:2]
        patch, u, v = picker.pick(point)
        assert patch >= target
        assert project(evaluate(nets[patch], u, v))[:2] == pytest.approx(point, abs=1e-9)
