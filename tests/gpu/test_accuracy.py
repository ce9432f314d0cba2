"""Both evaluators against float64: points, normals, parameters, singular and extreme nets."""

from __future__ import annotations

import numpy as np
import pytest
from truth import errors, random_nets

from reparam.geometry.body import homogeneous
from reparam.geometry.evaluate import evaluate, grid_parameters, project
from reparam.geometry.net import Array
from reparam.geometry.normal import surface_normal
from reparam.geometry.planar_maps import R
from reparam.gpu.readback import read_points
from reparam.gpu.tiles import tiles
from reparam.snapshot import Studio

EVALUATORS = ["vertex", "tessellation"]
DEGREES = [(1, 8), (2, 2), (3, 5), (4, 1), (5, 7), (6, 4), (7, 6), (8, 3)]
HIGH = [(20, 20), (31, 2), (9, 31), (31, 31)]  # one program, whatever the degree
ARC = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])  # a quarter: x, y, w


def sphere_octant() -> Array:
    """The unit sphere about 0, its pole at u = 1."""
    x, y = ARC[:, None, 0] * ARC[:, 0], ARC[:, None, 0] * ARC[:, 1]
    z, w = ARC[:, None, 1] * ARC[:, 2], ARC[:, None, 2] * ARC[:, 2]
    return np.stack([x, y, z, w], -1)


@pytest.mark.parametrize("degrees", DEGREES + HIGH)
@pytest.mark.parametrize("rational", [False, True])
def test_points_and_normals(studio: Studio, degrees: tuple[int, int], rational: bool) -> None:
    nets = random_nets(np.random.default_rng(degrees), degrees, rational)
    for level in (7, 13):
        has = EVALUATORS[: 1 + studio.painter.capabilities.tessellation]
        both = [read_points(studio.painter, name, nets, level) for name in has]
        for found in both:
            worst = errors(nets, found)
            assert worst.point < 4e-7
            assert worst.normal < 1e-5
        sizes = np.abs(project(nets)).max()
        off = project(both[0].points) - project(both[-1].points)
        assert np.abs(off).max() < 2e-7 * sizes


@pytest.mark.parametrize("degrees", DEGREES + HIGH)
def test_normals_move_no_point(studio: Studio, degrees: tuple[int, int]) -> None:
    """OpenGL's own: GL_AUTO_NORMAL takes another algorithm and moves points in the last bits."""
    nets = random_nets(np.random.default_rng(degrees), degrees, True)
    read, parameters = studio.painter.evaluation.read, grid_parameters(7)
    lit = read(nets, parameters, normals=True)
    assert (read(nets, parameters) == lit[..., :4]).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("degrees", [(0, 0), (0, 3), (2, 0)])
def test_degree_zero(studio: Studio, evaluator: str, degrees: tuple[int, int]) -> None:
    nets = random_nets(np.random.default_rng(1), degrees, True)
    found = read_points(studio.painter, evaluator, nets, 7)
    assert errors(nets, found).point < 4e-7
    assert (found.normals == [0.0, 0.0, 1.0]).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("level", [1, 7, 49, 64])
def test_parameters_are_exact_and_mirrored(studio: Studio, evaluator: str, level: int) -> None:
    found = read_points(studio.painter, evaluator, R, level).parameters
    parameters = found.reshape(level + 1, level + 1, 4)
    assert (parameters[0, 0] == [0.0, 1.0, 0.0, 1.0]).all()
    assert (parameters[-1, -1] == [1.0, 0.0, 1.0, 0.0]).all()
    assert (parameters == parameters[::-1, ::-1, [1, 0, 3, 2]]).all()
    assert (parameters == parameters.swapaxes(0, 1)[..., [2, 3, 0, 1]]).all()
    expected = grid_parameters(level).reshape(parameters.shape)
    np.testing.assert_allclose(parameters, expected, rtol=2e-7)


@pytest.mark.tessellation
@pytest.mark.parametrize("level", [100, 130])
def test_levels_above_the_hardware_s(studio: Studio, level: int) -> None:
    nets = random_nets(np.random.default_rng(2), (2, 3), True, patches=2)
    found = read_points(studio.painter, "tessellation", nets, level)
    expected = np.broadcast_to(grid_parameters(level), found.parameters.shape)
    np.testing.assert_allclose(found.parameters, expected, rtol=2e-7)
    assert errors(nets, found).point < 4e-7


@pytest.mark.parametrize("level", [1, 63, 64, 65, 100, 128, 130, 1024])
def test_tiles_cover_each_cell_once(level: int) -> None:
    times = np.zeros((level, level), int)
    for u, v, steps_u, steps_v in tiles(level):
        assert 1 <= steps_u <= 64
        assert 1 <= steps_v <= 64
        times[u : u + steps_u, v : v + steps_v] += 1
    assert (times == 1).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_a_thousand_patches(studio: Studio, evaluator: str) -> None:
    nets = random_nets(np.random.default_rng(3), (2, 2), True, patches=1000)
    found = read_points(studio.painter, evaluator, nets, 3)
    u, v = found.parameters[0, :, 0].astype(float), found.parameters[0, :, 2].astype(float)
    expected = project(evaluate(nets.astype(np.float32).astype(np.float64), u, v))
    assert np.abs(project(found.points) - expected).max() < 4e-7


def test_patches_are_consecutive_or_shared(studio: Studio) -> None:
    nets = random_nets(np.random.default_rng(4), (3, 2), True, patches=7)
    parameters = np.array([[0.3, 0.7, 0.8, 0.2], [1.5, -0.5, -0.25, 1.25]])
    evaluation = studio.painter.evaluation
    everything = evaluation.read(nets, parameters)
    expected = evaluate(nets, parameters[:, 0], parameters[:, 2])
    np.testing.assert_allclose(everything, expected, atol=2e-5)
    some = np.frombuffer(evaluation.run(nets, parameters, range(2, 5)).read(), np.float32)
    assert (some.reshape(3, 2, 4) == everything[2:5]).all()
    shared = np.frombuffer(evaluation.run(nets[1], parameters, range(2, 5)).read(), np.float32)
    assert (shared.reshape(3, 2, 4) == everything[1]).all()
    assert (evaluation.read(nets, parameters, normals=True)[..., :4] == everything).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_normals_at_the_corners_of_r(studio: Studio, evaluator: str) -> None:
    lifted = R.copy()
    lifted[..., :3] = R[..., :3] @ np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    normals = read_points(studio.painter, evaluator, lifted, 7).normals
    expected = surface_normal(lifted, 0.5, 0.5)
    np.testing.assert_allclose(normals[0], np.broadcast_to(expected, (64, 3)), atol=3e-4)


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_normals_at_the_pole_of_a_sphere(studio: Studio, evaluator: str) -> None:
    found = read_points(studio.painter, evaluator, sphere_octant(), 7)
    points = project(found.points[0].astype(np.float64))
    np.testing.assert_allclose(np.linalg.norm(points, axis=-1), 1.0, atol=4e-7)
    np.testing.assert_allclose(found.normals[0, :-8], -points[:-8], atol=1e-5)
    np.testing.assert_allclose(found.normals[0, -8:], -points[-8:], atol=2e-3)


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("rational", [False, True])
def test_normals_at_poles_of_asymmetric_nets(
    studio: Studio, evaluator: str, rational: bool
) -> None:
    nets = random_nets(np.random.default_rng(6), (3, 3), rational, patches=40)
    nets[:, 0] = nets[:, :1, 0] / nets[:, :1, 0, 3:] * nets[:, 0, :, 3:]
    found = read_points(studio.painter, evaluator, nets, 7).normals[:, :8]
    expected = surface_normal(nets, np.full(8, 1e-6), np.arange(8) / 7)
    assert np.median(np.linalg.norm(found - expected, axis=-1).max(-1)) < 0.05


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("degrees", [(2, 2), (1, 8), (20, 20)])
def test_collapsed_nets_give_no_nan(
    studio: Studio, evaluator: str, degrees: tuple[int, int]
) -> None:
    shape = (degrees[0] + 1, degrees[1] + 1)
    random = np.random.default_rng(7)
    line = random.normal(size=(*shape, 1)) * random.normal(size=3)
    rail = np.broadcast_to(random.normal(size=(shape[0], 1, 3)), (*shape, 3))
    flat = np.full((*shape, 3), 0.3)
    nets = homogeneous(np.stack([flat, 0.0 * flat, line, rail, rail * 1e18, line * 1e-18]))
    found = read_points(studio.painter, evaluator, nets, 7)
    assert np.isfinite(found.points).all()
    np.testing.assert_allclose(np.linalg.norm(found.normals, axis=-1), 1.0, atol=1e-6)
    assert (found.normals[1] == [0.0, 0.0, 1.0]).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize(
    ("scale", "weight"), [(1e-18, 1.0), (1e17, 1.0), (1e17, 1e-17), (1e-4, 1e-17), (1.0, 1e17)]
)
def test_extreme_coordinates(studio: Studio, evaluator: str, scale: float, weight: float) -> None:
    nets = random_nets(np.random.default_rng(8), (3, 5), True)
    nets *= np.array([scale, scale, scale, 1.0]) * weight
    worst = errors(nets, read_points(studio.painter, evaluator, nets, 7))
    assert worst.point < 4e-7
    assert worst.normal < 1e-5
