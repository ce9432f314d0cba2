"""The GPU's levels against geometry/levels.py."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from truth import random_nets

from reparam.geometry.bends import bends
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.facing import faces_away
from reparam.geometry.levels import (
    box_corners,
    fewest_one_way,
    fewest_steps,
    out_of_view,
    pixels_a_unit,
)
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array
from reparam.geometry.surface_spline import surface_spline
from reparam.gpu.fineness import Fineness
from reparam.gpu.plans import Tolerance
from reparam.scenes.layers import Patches, Picture, Ramp, Texture
from reparam.snapshot import Studio

SIZE = (640, 400)
HALF = (320.0, 200.0)
TOLERANCE = 0.5


@pytest.fixture
def fineness(studio: Studio) -> Fineness:
    return Fineness(studio.ctx, studio.painter.programs, studio.painter.evaluation)


def view(net: Array, zoom: float = 1.0, field_of_view: float = 0.0) -> Camera:
    return frame(sample_surface(net), *SIZE, View(zoom=zoom), True, field_of_view)


def clip(net: Array, camera: Camera) -> Array:
    return np.asarray(net @ camera.clip_from_model().T)


@pytest.mark.parametrize("degrees", [(1, 1), (2, 2), (3, 1), (4, 6), (0, 2), (9, 5)])
@pytest.mark.parametrize("rational", [False, True])
@pytest.mark.parametrize("field_of_view", [0.0, 50.0])
def test_steps(
    fineness: Fineness, degrees: tuple[int, int], rational: bool, field_of_view: float
) -> None:
    nets = random_nets(np.random.default_rng(degrees), degrees, rational, 30)
    camera = view(nets, field_of_view=field_of_view)
    found = fineness.read(Patches(nets), camera, SIZE, TOLERANCE)[0]
    expected = fewest_steps(bends(clip(nets, camera), HALF), TOLERANCE)
    near = np.abs(found - expected) <= np.maximum(1, expected // 100)  # ties of float32
    assert near.all()
    assert (found == expected).all(-1).mean() > 0.8


@pytest.mark.parametrize("degrees", [(2, 2), (3, 3), (9, 5)])
def test_steps_of_cells_cut_one_way(fineness: Fineness, degrees: tuple[int, int]) -> None:
    nets = random_nets(np.random.default_rng(degrees), degrees, degrees == (2, 2), 60)
    camera = view(nets)
    found, falling = fineness.read(Patches(nets), camera, SIZE, TOLERANCE, one_way=True)
    seen = bends(clip(nets, camera), HALF)
    expected, falls = fewest_one_way(seen, TOLERANCE)
    assert (np.abs(found - expected) <= np.maximum(1, expected // 100)).all()
    assert (found == expected).all(-1).mean() > 0.8
    assert (falling == falls).mean() > 0.9
    assert 0.2 < falling.mean() < 0.8
    assert expected.prod(-1).sum() < 0.9 * fewest_steps(seen, TOLERANCE).prod(-1).sum()


@pytest.mark.parametrize("shared", [False, True])
def test_a_map_adds_its_own(fineness: Fineness, shared: bool) -> None:
    random = np.random.default_rng(3)
    nets = random_nets(random, (1, 2), True, 20)
    maps = random_nets(random, (3, 2), True, 1 if shared else 20)
    camera = view(nets)
    layer = Patches(nets, Texture(maps[0] if shared else maps, Picture()))
    found = fineness.read(layer, camera, SIZE, TOLERANCE)[0]
    seen = clip(nets, camera)
    maps = np.broadcast_to(maps, (20, *maps.shape[1:]))
    sought, unit = bends(maps, (1.0, 1.0)), pixels_a_unit(seen, maps, HALF)
    expected = fewest_steps(bends(seen, HALF), TOLERANCE, sought, unit)
    assert (np.abs(found - expected) <= np.maximum(1, expected // 100)).all()
    assert (expected.prod(-1) > fewest_steps(bends(seen, HALF), TOLERANCE).prod(-1)).all()


def test_a_map_of_the_fragments_adds_nothing(fineness: Fineness) -> None:
    random = np.random.default_rng(3)
    nets, maps = (random_nets(random, degrees, True, 20) for degrees in ((1, 2), (3, 2)))
    camera = view(nets)
    found = [
        fineness.read(Patches(nets, Texture(maps, Ramp(0.0, 1.0), exact)), camera, SIZE, TOLERANCE)[
            0
        ]
        for exact in (True, False)
    ]
    assert (found[0] == fineness.read(Patches(nets), camera, SIZE, TOLERANCE)[0]).all()
    assert (found[0] < found[1]).any()


def test_out_of_view(fineness: Fineness) -> None:
    nets = random_nets(np.random.default_rng(4), (2, 2), True, 400)
    nets[..., :3] += nets[..., 3:] * np.random.default_rng(5).uniform(-9, 9, (400, 1, 1, 3))
    camera = view(nets, zoom=4.0)
    found = fineness.read(Patches(nets), camera, SIZE, TOLERANCE)[0]
    gone = out_of_view(clip(nets, camera))
    assert ((found == 0).all(-1) == gone).all()
    assert 0.3 < gone.mean() < 0.99


@pytest.mark.parametrize("field_of_view", [0.0, 70.0])
def test_of_a_solid_body_what_faces_away_is_left_out(
    fineness: Fineness, field_of_view: float
) -> None:
    mesh = MESHES["cube"]()
    nets = surface_spline(mesh.topology, 0.5).nets(mesh.vertices)
    camera = view(nets, field_of_view=field_of_view)
    whole = fineness.read(Patches(nets), camera, SIZE, TOLERANCE)[0]
    found = fineness.read(Patches(nets, solid=True), camera, SIZE, TOLERANCE)[0]
    left_out, expected = (found == 0).all(-1), faces_away(clip(nets, camera))
    assert np.count_nonzero(left_out != expected) <= 3  # float32
    assert (found[~left_out] == whole[~left_out]).all()
    assert 0.3 < left_out.mean() < 0.6


def test_a_layer_beside_the_picture_is_not_looked_at(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    nets = random_nets(np.random.default_rng(6), (2, 2), True, 9)
    adaptive, tolerance = studio.painter.surfaces.adaptive, Tolerance(TOLERANCE, SIZE)
    camera = view(nets)
    right = camera.rotation[0] * camera.half_width
    looked = adaptive.plan(Patches(nets), camera, "vertex", tolerance)
    assert len(looked.patches) > 0
    monkeypatch.setattr(Fineness, "read", None)
    for share in (-4.0, 4.0):
        beside = replace(camera, center=camera.center + share * right)
        assert len(adaptive.plan(Patches(nets), beside, "vertex", tolerance).patches) == 0


def test_boxes_out_of_view() -> None:
    nets = random_nets(np.random.default_rng(7), (2, 3), True, 20)
    corners = box_corners(nets)
    points = (nets[..., :3] / nets[..., 3:]).reshape(-1, 3)
    assert (corners.min((0, 1)) == [*points.min(0), 1.0]).all()
    assert (corners.max((0, 1)) == [*points.max(0), 1.0]).all()
    nets[3, 1, 2, 3] = 0.0
    assert not out_of_view(box_corners(nets) + 99.0)
