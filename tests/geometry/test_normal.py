"""Normals: closed forms, limits where the tangents do not span a plane, and no NaN anywhere."""

from __future__ import annotations

import exact
import numpy as np
import pytest

from reparam.geometry.body import homogeneous, triangle_to_tensor
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.net import Array, control_net
from reparam.geometry.normal import SINGULAR_STEP, cross_of_tangents, safe_normalize, surface_normal
from reparam.geometry.planar_maps import R

random = np.random.default_rng(6)
T = np.linspace(0.0, 1.0, 9)
GRID = np.meshgrid(T, T, indexing="ij")
ARC = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])  # a quarter: x, y, w


def sphere_octant() -> Array:
    """Poles at u = 1; u runs up, v to the east."""
    x = ARC[:, None, 0] * ARC[None, :, 0]
    y = ARC[:, None, 0] * ARC[None, :, 1]
    z = ARC[:, None, 1] * ARC[None, :, 2]
    return np.stack([x, y, z, ARC[:, None, 2] * ARC[None, :, 2]], -1)


def limit_at_pole(net: Array, v: Array) -> tuple[Array, Array]:
    """The normals as u -> 0 of a net whose first row is one point, and the sines there.

    Up to factors p_u is the second row seen from the pole, and p_v is u times its derivative.
    """
    ring = net[1:2] - net[0, 0] / net[0, 0, 3] * net[1:2, :, 3:]
    ring[..., 3] = 1.0
    normal = cross_of_tangents(np.concatenate([np.zeros_like(ring), ring]), np.ones_like(v), v)
    return safe_normalize(normal), np.linalg.norm(normal, axis=-1)


def test_orientation_is_that_of_p_u_x_p_v() -> None:
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    assert (surface_normal(flat, *GRID) == [0.0, 0.0, 1.0]).all()
    assert (surface_normal(flat.swapaxes(0, 1), *GRID) == [0.0, 0.0, -1.0]).all()


def test_paraboloid() -> None:
    net = control_net([[(x, y, x * y) for y in (0.0, 1.0)] for x in (0.0, 1.0)])
    u, v = GRID
    expected = safe_normalize(np.stack([-v, -u, np.ones_like(u)], -1))
    np.testing.assert_allclose(surface_normal(net, u, v), expected, atol=1e-15)


def test_sphere_of_rational_degree_two() -> None:
    net = sphere_octant()
    points = project(evaluate(net, *GRID))
    np.testing.assert_allclose(np.linalg.norm(points, axis=-1), 1.0, atol=1e-15)
    normals = surface_normal(net, *GRID)
    np.testing.assert_allclose(normals[:-1], -points[:-1], atol=1e-13)
    np.testing.assert_allclose(normals[-1], -points[-1], atol=2 * SINGULAR_STEP)


@pytest.mark.parametrize("scale", [1e-18, 1.0, 1e18])
@pytest.mark.parametrize("weight", [1e-18, 1.0, 1e18])
def test_no_scale_matters(scale: float, weight: float) -> None:
    net = sphere_octant()
    scaled = net * [scale, scale, scale, 1.0] * weight
    found, expected = surface_normal(scaled, *GRID), surface_normal(net, *GRID)
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize("degree", [(1, 1), (1, 3), (2, 2), (3, 3), (5, 2), (8, 8)])
@pytest.mark.parametrize("rational", [False, True])
def test_limit_at_a_pole(degree: tuple[int, int], rational: bool) -> None:
    worst = []
    for _ in range(20):
        points = random.uniform(-1.0, 1.0, (degree[0] + 1, degree[1] + 1, 3))
        points[0] = points[0, 0]
        weights = random.uniform(0.5, 2.0, points.shape[:2]) if rational else np.ones(1)
        net = homogeneous(points) * weights[..., None]
        expected, sine = limit_at_pole(net, T)
        found = surface_normal(net, np.zeros_like(T), T)
        worst.append((np.linalg.norm(found - expected, axis=-1) * sine).max())
    assert np.median(worst) < 0.02


def test_limit_at_the_apex_of_a_triangular_patch() -> None:
    corners = np.array([[0.0, 0.0, 0.3], [1.0, 0.1, 0.2], [0.2, 1.0, 0.7]])
    flat = safe_normalize(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
    k = np.array([(3 - j - i, j, i) for i in range(4) for j in range(4 - i)]) / 3.0
    found = surface_normal(triangle_to_tensor(k @ corners, 3), *GRID)
    np.testing.assert_allclose(found, np.broadcast_to(flat, found.shape), atol=1e-12)


def test_limit_at_the_corners_of_r() -> None:
    lifted = R.copy()
    lifted[..., :3] = R[..., :3] @ np.linalg.qr(random.normal(size=(3, 3)))[0]
    middle = surface_normal(lifted, 0.5, 0.5)
    corners = surface_normal(lifted, [0, 0, 1, 1], [0, 1, 0, 1])
    np.testing.assert_allclose(corners, np.broadcast_to(middle, (4, 3)), atol=1e-12)
    assert (surface_normal(R, [0, 0, 1, 1], [0, 1, 0, 1]) == [0.0, 0.0, 1.0]).all()
    assert (np.linalg.norm(cross_of_tangents(R, [0, 1], [0, 0]), axis=-1) < 1e-15).all()


@pytest.mark.parametrize("shape", [(1, 1), (1, 4), (3, 1), (3, 3), (4, 2), (9, 9)])
def test_collapsed_nets_get_a_unit_normal(shape: tuple[int, int]) -> None:
    line = random.normal(size=(*shape, 1)) * random.normal(size=3)
    for points in (np.full((*shape, 3), 0.3), np.zeros((*shape, 3)), line):
        normals = surface_normal(homogeneous(points), *GRID)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=-1), 1.0, atol=1e-15)


def test_where_there_is_no_limit_z_is_taken() -> None:
    along_x = homogeneous(np.arange(9.0).reshape(3, 3, 1) * [1.0, 0.0, 0.0])
    for net in (along_x, homogeneous(np.zeros((3, 3, 3))), homogeneous(np.ones((1, 1, 3)))):
        assert (surface_normal(net, *GRID) == [0.0, 0.0, 1.0]).all()


def test_stacked_nets() -> None:
    nets = exact.random_net(random, 2, 3, 5)
    found = surface_normal(nets, *GRID)
    assert found.shape == (5, 9, 9, 3)
    np.testing.assert_allclose(found[4], surface_normal(nets[4], *GRID), atol=1e-12)


@pytest.mark.parametrize("length", [1e-300, 1e-30, 1.0, 1e30, 1e300])
def test_safe_normalize(length: float) -> None:
    unit = safe_normalize(np.array([[3.0, 0.0, -4.0], [0.0, 0.0, 0.0]]) * length)
    np.testing.assert_allclose(unit, [[0.6, 0.0, -0.8], [0.0, 0.0, 0.0]], rtol=1e-15)
