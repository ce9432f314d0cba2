"""Patches drawn to a tolerance: accurate at each fragment, no cracks, no more than is due."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
from closed_bodies import bulged_cube
from test_cracks import counter, counts
from truth import random_nets

from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.planar_maps import R
from reparam.gpu.accuracy import Drawn, deviations
from reparam.gpu.adaptive import Tolerance
from reparam.gpu.painter import Painter
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

__all__ = ["counter"]  # the fixture

EVALUATORS = ["vertex", "tessellation"]
SIZE = (320, 240)
BODIES = {
    "r": R[None],
    "rational sphere-like cube": bulged_cube(2, rational=True, mixed=False).nets,
    "cubic": random_nets(np.random.default_rng(1), (3, 3), False, 3),
    "rational": random_nets(np.random.default_rng(2), (2, 3), True, 3),
}


def views(nets: Array, count: int, zoom: float = 1.0) -> list[Camera]:
    random = np.random.default_rng(7)
    angles = random.uniform([0.0, -90.0], [360.0, 90.0], (count, 2))
    points = sample_surface(nets)
    return [frame(points, *SIZE, View(zoom, (0.0, 0.0), *a), True) for a in angles.tolist()]


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("zoom", [1.0, 5.0])
def test_every_fragment_is_within_the_tolerance(
    studio: Studio, evaluator: str, name: str, zoom: float
) -> None:
    """But for a few where a triangle seen from its edge is thinner than the rasteriser's grid."""
    nets = BODIES[name]
    layer, adaptive = Patches(nets), studio.painter.surfaces.adaptive
    found = []
    for camera in views(nets, 2, zoom):
        plan = adaptive.plan(layer, camera, evaluator, Tolerance(1.0, SIZE))
        found.append(deviations(Drawn(studio.painter, layer, camera, evaluator, plan, SIZE)))
    off = np.concatenate(found)
    assert len(off) > 5000
    assert np.mean(off > 1.0) < 1e-4
    assert np.quantile(off, 0.999) > 0.01  # so few steps that one can see them


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_too_coarse_a_plan_is_told(studio: Studio, evaluator: str) -> None:
    nets = BODIES["cubic"]
    layer, camera = Patches(nets), views(nets, 1)[0]
    plan = studio.painter.surfaces.adaptive.plan(layer, camera, evaluator, Tolerance(20.0, SIZE))
    off = deviations(Drawn(studio.painter, layer, camera, evaluator, plan, SIZE))
    assert 1.0 < np.quantile(off, 0.99) < 20.0


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("pixels", [0.5, 8.0])
def test_closed_bodies_show_no_crack(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str, pixels: float
) -> None:
    painter, framebuffer, texture = counter
    nets = bulged_cube(3, rational=True, mixed=True).nets
    body, opened, points = Patches(nets), Patches(nets[1:]), sample_surface(nets)
    random, side = np.random.default_rng(3), texture.size[0]
    tolerance, finest = Tolerance(pixels, texture.size), 0
    for turn in range(10):
        azimuth, elevation, zoom = random.uniform([0.0, -90.0, 1.0], [360.0, 90.0, 9.0])
        camera = frame(points, side, side, View(zoom, (0.0, 0.0), azimuth, elevation), True)
        plan = painter.surfaces.adaptive.plan(body, camera, evaluator, tolerance)
        finest = max(finest, int(plan.edges.max()))
        framebuffer.clear()
        painter.surfaces.draw(body, camera, evaluator, tolerance)
        assert np.count_nonzero(counts(texture)) == 0, turn
    assert finest > 64 or pixels > 1.0
    framebuffer.clear()
    camera = frame(points, side, side, View(), True)
    painter.surfaces.draw(opened, camera, evaluator, tolerance)
    assert np.count_nonzero(counts(texture)) > 100


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_a_bent_patch_beside_a_flat_one(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str
) -> None:
    """Neighbours of very different levels in the plane: each pixel is covered once."""
    painter, framebuffer, texture = counter
    flat = [[(-1, 1), (0, 1)], [(-1, 0), (0, 0)], [(-1, -1), (0, -1)]]
    bent = [[(0, 1), (0.9, 1), (1, 1)], [(0, 0), (0.9, 0.7), (1, 0)], [(0, -1), (0.2, -1), (1, -1)]]
    nets = np.stack([raised(flat), control_net(bent)])
    camera = frame(np.array([[-0.9, -0.9, 0.0], [0.9, 0.9, 0.0]]), *texture.size, View(), False)
    tolerance = Tolerance(0.1, texture.size)
    plan = painter.surfaces.adaptive.plan(Patches(nets), camera, evaluator, tolerance)
    assert plan.inner[0].max() < 4 < 20 < plan.inner[1].max()
    framebuffer.clear()
    painter.surfaces.draw(Patches(nets), camera, evaluator, tolerance)
    assert (counts(texture) == 1.0).all()


def raised(points: list[list[tuple[float, float]]]) -> Array:
    return raise_degree(control_net(points), 2, 2)


def test_patches_out_of_view_cost_nothing(studio: Studio) -> None:
    nets = R[None] + np.array([[6.0 * i, 0.0, 0.0, 0.0] for i in range(9)])[:, None, None, :]
    points = sample_surface(nets)
    plans = [
        studio.painter.surfaces.adaptive.plan(
            Patches(nets), frame(points, *SIZE, View(zoom), False), "vertex", Tolerance(0.5, SIZE)
        )
        for zoom in (1.0, 9.0)
    ]
    assert plans[0].patches.tolist() == list(range(9))
    assert plans[1].patches.tolist() == [4]
    assert plans[1].inner.max() > 2 * plans[0].inner.max()


def test_nothing_in_view_is_no_error(studio: Studio) -> None:
    layer = Patches(R[None])
    away = frame(np.array([[5.0, 5.0, 0.0], [6.0, 6.0, 0.0]]), *SIZE, View(), False)
    for evaluator in EVALUATORS:
        studio.painter.surfaces.draw(layer, away, evaluator, Tolerance(0.5, SIZE))
