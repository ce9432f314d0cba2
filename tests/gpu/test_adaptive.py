"""Patches drawn to a tolerance: accurate at each fragment, no cracks, no more than is due."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import moderngl
import numpy as np
import pytest
from closed_bodies import bulged_cube
from test_accuracy import sphere_octant
from test_cracks import counter, counts
from truth import random_nets

from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.edge_levels import edge_marks
from reparam.geometry.evaluate import project, sample_surface
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.planar_maps import R
from reparam.geometry.surface_spline import surface_spline
from reparam.geometry.torus import two_halves
from reparam.gpu import adaptive
from reparam.gpu.accuracy import Drawn, deviations
from reparam.gpu.adaptive import tiled
from reparam.gpu.painter import Painter
from reparam.gpu.plans import Plan, Tolerance, uniform_plan
from reparam.gpu.targets import Target
from reparam.gpu.tiles import draws
from reparam.scenes.display import Display
from reparam.scenes.layers import Figure, Patches, Space
from reparam.snapshot import Studio

__all__ = ["counter"]  # the fixture

EVALUATORS = ["vertex", "tessellation"]
SPLINES = ("cube", "dodecahedron", "prism9", "three_handles", "t_mesh")
SIZE = (320, 240)
BODIES = {
    "r": R[None],
    "rational sphere-like cube": bulged_cube(2, rational=True, mixed=False).nets,
    "cubic": random_nets(np.random.default_rng(1), (3, 3), False, 3),
    "rational": random_nets(np.random.default_rng(2), (2, 3), True, 3),
}


def views(nets: Array, count: int, zoom: float = 1.0, size: tuple[int, int] = SIZE) -> list[Camera]:
    """From all sides, every second one in perspective."""
    random = np.random.default_rng(7)
    angles = random.uniform([0.0, -90.0], [360.0, 90.0], (count, 2)).tolist()
    points, others = sample_surface(nets), project(nets).reshape(-1, 3)
    fields = np.where(np.arange(count) % 2, random.uniform(20.0, 110.0, count), 0.0).tolist()
    return [
        frame(points, *size, View(zoom, (0.0, 0.0), *seen), True, field, others)
        for seen, field in zip(angles, fields, strict=True)
    ]


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("zoom", [1.0, 3.0])
def test_every_fragment_is_within_the_tolerance(
    studio: Studio, evaluator: str, name: str, zoom: float
) -> None:
    """But for a few where a triangle seen from its edge is thinner than the rasteriser's grid."""
    nets = BODIES[name]
    layer, adaptive = Patches(nets), studio.painter.surfaces.adaptive
    found = []
    for camera in views(nets, 2, zoom):  # one of each kind
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


@pytest.mark.slow
@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", ["sphere", "torus", "three handles", "blend ratio .1"])
def test_bodies_from_all_sides(studio: Studio, evaluator: str, name: str) -> None:
    """Half a pixel in 50 views, orthographic and in perspective, whole and close up."""
    nets = large(name)
    layer, adaptive = Patches(nets), studio.painter.surfaces.adaptive
    for turn, camera in enumerate(views(nets, 50)):
        if turn % 5 == 4:
            camera = replace(
                camera, half_width=camera.half_width / 6.0, half_height=camera.half_height / 6.0
            )
        plan = adaptive.plan(layer, camera, evaluator, Tolerance(0.5, SIZE))
        off = deviations(Drawn(studio.painter, layer, camera, evaluator, plan, SIZE))
        assert np.count_nonzero(off > 0.5) <= 1e-4 * len(off), turn


def large(name: str) -> Array:
    """Nets of the bodies that the tolerance is promised for."""
    if name == "sphere":
        octant = sphere_octant()
        turns = product((1.0, -1.0), repeat=3)
        return np.stack([octant * [*signs, 1.0] for signs in turns])
    if name == "torus":
        return two_halves().patches().reshape(-1, 3, 3, 4)
    mesh = MESHES["three_handles"]()
    ratio = 0.1 if name == "blend ratio .1" else 0.5
    return surface_spline(mesh.topology, ratio).nets(mesh.vertices)


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
    for turn, seen in enumerate(views(nets, 10, size=texture.size)):
        enlarged = random.uniform(1.0, 9.0)
        camera = replace(
            seen, half_width=seen.half_width / enlarged, half_height=seen.half_height / enlarged
        )
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
def test_no_crack_between_layers(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str
) -> None:
    """A body whose patches are shared out to layers: planned together they are one."""
    painter, framebuffer, texture = counter
    nets = bulged_cube(3, rational=True, mixed=True).nets
    layers = (Patches(nets[::2].copy()), Patches(nets[1::2].copy()))
    cracks = []
    for beside in (layers, ()):
        cracks.append(0)
        for camera in views(nets, 4, size=texture.size):
            framebuffer.clear()
            for layer in layers:
                tolerance = Tolerance(0.5, texture.size, beside)
                painter.surfaces.draw(layer, camera, evaluator, tolerance)
            cracks[-1] += int(np.count_nonzero(counts(texture)))
    assert cracks[0] == 0
    assert cracks[1] > 0  # planned apart they show


def test_a_solid_body_has_no_hole_where_patches_are_left_out(studio: Studio) -> None:
    """All that faces the eye is there: the same pixels are covered, but for less than a pixel
    along the outline."""
    mesh = MESHES["cube"]()
    nets = surface_spline(mesh.topology, 0.5).nets(mesh.vertices)
    bounds = sample_surface(nets)
    display = Display(tolerance=0.5, samples=1, perspective=60.0)
    target = Target(studio.ctx, SIZE, 1, studio.painter.capabilities)
    covered = []
    for solid in (True, False):
        layers = (Patches(nets[::2], solid=solid), Patches(nets[1::2], solid=solid))
        shown = Figure((Space("body", bounds, layers, spatial=True),))
        studio.painter.draw(shown, target, display, plain=True)
        picture = target.pixels()[::-1]
        covered.append((picture != picture[0, 0]).any(-1))
    target.release()
    studio.ctx.extra.use()
    assert covered[1].sum() > 10000
    assert np.count_nonzero(covered[0] != covered[1]) <= 4


@pytest.mark.slow
@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", ["sphere", "torus", *SPLINES])
def test_no_crack_in_two_hundred_views(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str, name: str
) -> None:
    painter, framebuffer, texture = counter
    nets = large(name) if name not in SPLINES else bumpy(name)
    nets = turned_outwards(nets) if name == "sphere" else nets
    body, random = Patches(nets), np.random.default_rng(6)
    tolerance = Tolerance(0.5, texture.size)
    for turn, seen in enumerate(views(nets, 200, size=texture.size)):
        enlarged = 1.0 / random.uniform(1.0, 5.0)
        camera = replace(
            seen, half_width=seen.half_width * enlarged, half_height=seen.half_height * enlarged
        )
        framebuffer.clear()
        painter.surfaces.draw(body, camera, evaluator, tolerance)
        assert np.count_nonzero(counts(texture)) == 0, turn


def bumpy(name: str) -> Array:
    """A surface spline with blend ratios at random."""
    found = MESHES[name]()
    ratios = np.random.default_rng(4).uniform(0.1, 0.9, len(found.topology.ends))
    return surface_spline(found.topology, ratios).nets(found.vertices)


def turned_outwards(octants: Array) -> Array:
    """A reflected octant is turned over: u and v change places."""
    signs = np.sign(octants[:, 1, 1, :3]).prod(-1)
    return np.where(signs[:, None, None, None] > 0, octants, octants.swapaxes(1, 2))


def test_an_edit_looks_at_the_edges_it_changed(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    painter, tolerance = studio.painter, Tolerance(0.5, SIZE)
    nets = random_nets(np.random.default_rng(5), (3, 3), False, 50)
    nets[1::2, 0] = nets[::2, -1]
    camera = views(nets, 1)[0]
    painter.surfaces.adaptive.plan(Patches(nets), camera, "vertex", tolerance)
    looked = []

    def marks(patches: Array) -> np.ndarray:
        looked.append(len(patches))
        return edge_marks(patches)

    monkeypatch.setattr(adaptive, "edge_marks", marks)
    edited = nets.copy()
    edited[[8, 21], 1:3] += 0.05
    edited[21, 0] += 0.05
    for _ in range(2):
        painter.surfaces.sweep()
        plan = painter.surfaces.adaptive.plan(Patches(edited), camera, "vertex", tolerance)
    assert sum(looked) < 20
    monkeypatch.undo()
    anew = Studio().painter.surfaces.adaptive.plan(Patches(edited), camera, "vertex", tolerance)
    assert (plan.edges == anew.edges).all()


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
    assert plan.edges[0, :3].tolist() == [1, 1, 1]
    assert plan.edges[0, 3] > 20
    assert plan.inner[0, 0] == 1 if evaluator == "vertex" else plan.inner[0, 0] >= plan.edges[0, 3]
    framebuffer.clear()
    painter.surfaces.draw(Patches(nets), camera, evaluator, tolerance)
    assert (counts(texture) == 1.0).all()


@pytest.mark.tessellation
def test_many_vertices_in_one_draw(studio: Studio) -> None:
    """llvmpipe counts them by 16 bits."""
    nets = random_nets(np.random.default_rng(9), (2, 2), False, 25)
    layer, camera = Patches(nets), views(nets, 1)[0]
    plan = uniform_plan(layer, 60)
    off = deviations(Drawn(studio.painter, layer, camera, "tessellation", plan, SIZE))
    assert off.max() < 1.0


def test_only_patches_above_the_hardware_s_level_are_tiled() -> None:
    levels, tiles = np.array([[4, 64], [152, 66]]), np.array([[1, 1], [4, 2]])
    rows = tiled(Plan(np.array([3, 8]), levels, np.ones((2, 4), int), tiles, np.zeros(2, bool)))
    assert rows[:, 0].tolist() == [3] + 8 * [8]
    assert rows[0, 7:].tolist() == [0, 0, 4, 64]
    covered = np.zeros((152, 66), int)
    for u, v, steps_u, steps_v in rows[1:, 7:].tolist():
        assert (steps_u, steps_v) == (38, 33)
        covered[u : u + steps_u, v : v + steps_v] += 1
    assert (covered == 1).all()


def test_draws_are_as_large_as_software_bears() -> None:
    vertices = np.array([4, 60000, 6000, 9, 70000, 4] + 80 * [4], np.int32)
    pieces = list(draws(vertices, True))
    assert pieces[:4] == [(0, 2), (2, 2), (4, 1), (5, 64)]
    assert sum(count for _, count in pieces) == len(vertices)
    assert list(draws(vertices, False)) == [(0, len(vertices))]


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
