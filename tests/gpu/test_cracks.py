"""Patches that share an edge meet in the same bits, so no picture shows a crack."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import moderngl
import numpy as np
import pytest
from closed_bodies import bulged_cube, edges, pairings
from numpy.typing import NDArray

from reparam import assets
from reparam.geometry.camera import View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array, control_net
from reparam.geometry.surface_spline import surface_spline
from reparam.gpu.painter import Painter
from reparam.gpu.readback import read_points
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

EVALUATORS = ["vertex", "tessellation"]
LEVELS = [7, 8, 13]
CLOSED = (
    "cube", "tetrahedron", "octahedron", "icosahedron", "dodecahedron", "prism6", "prism7",
    "prism8", "prism9", "three_handles", "torus", "hexagon_torus", "t_mesh",
)  # fmt: skip
SIZE = 192
COUNTING = """
uniform vec4 color;
out vec4 fragment;
void main() { fragment = gl_FrontFacing ? color : -color; }
"""


def grids(studio: Studio, evaluator: str, nets: Array, level: int) -> NDArray[np.float32]:
    points = read_points(studio.painter, evaluator, nets, level).points
    return points.reshape(len(nets), level + 1, level + 1, 4)


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("order", [3, 4, 8])
def test_every_pairing_of_edges(studio: Studio, evaluator: str, level: int, order: int) -> None:
    nets, kinds = pairings(np.random.default_rng(order), order)
    found = grids(studio, evaluator, nets, level)
    for (one, other, backwards), first, second in zip(kinds, found[::2], found[1::2], strict=True):
        a, b = edges(first)[one], edges(second)[other]
        assert (a == (b[::-1] if backwards else b)).all(), (one, other, backwards)


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("mixed", [False, True])
def test_a_closed_body_has_each_edge_point_twice(
    studio: Studio, evaluator: str, level: int, mixed: bool
) -> None:
    nets = bulged_cube(1, rational=True, mixed=mixed).nets
    found = np.stack(edges(grids(studio, evaluator, nets, level)))
    _, times = np.unique(found[:, :, 1:-1].reshape(-1, 4), axis=0, return_counts=True)
    assert times.tolist() == [2] * (12 * (level - 1))
    assert len(np.unique(found[:, :, [0, -1]].reshape(-1, 4), axis=0)) == 8


@pytest.fixture
def counter(
    studio: Studio, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[tuple[Painter, moderngl.Framebuffer, moderngl.Texture]]:
    """A painter whose fragments add +1 (front) or -1 (back) to a float picture."""
    shutil.copytree(assets.root() / "shaders", tmp_path / "shaders")
    (tmp_path / "shaders" / "patch.frag").write_text(COUNTING)
    monkeypatch.setattr(assets, "root", lambda: tmp_path)
    ctx = studio.ctx
    texture = ctx.texture((SIZE, SIZE), 4, dtype="f2")
    framebuffer = ctx.framebuffer([texture])
    framebuffer.use()
    ctx.enable(moderngl.BLEND)
    ctx.blend_func = moderngl.ONE, moderngl.ONE
    yield Painter(ctx), framebuffer, texture
    ctx.blend_func = moderngl.DEFAULT_BLENDING
    ctx.disable(moderngl.BLEND)
    ctx.extra.use()
    framebuffer.release()
    texture.release()


def counts(texture: moderngl.Texture) -> NDArray[np.float16]:
    return np.frombuffer(texture.read(), np.float16).reshape(SIZE, SIZE, 4)[..., 0]


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("mixed", [False, True])
def test_front_and_back_faces_cancel_at_every_pixel(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str, mixed: bool
) -> None:
    painter, framebuffer, texture = counter
    nets = bulged_cube(2, rational=not mixed, mixed=mixed).nets
    body, opened, points = Patches(nets), Patches(nets[1:]), sample_surface(nets)
    random = np.random.default_rng(3)
    for turn in range(12):
        azimuth, elevation, zoom = random.uniform([0.0, -90.0, 1.0], [360.0, 90.0, 4.0])
        camera = frame(points, SIZE, SIZE, View(zoom, (0.0, 0.0), azimuth, elevation), True)
        framebuffer.clear()
        painter.surfaces.draw(body, camera, evaluator, (*LEVELS, 100)[turn % 4])
        assert np.count_nonzero(counts(texture)) == 0, turn
    painter.surfaces.draw(opened, camera, evaluator, 7)
    assert np.count_nonzero(counts(texture)) > 100


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize(
    ("name", "views"),
    [("cube", 3), ("prism7", 3), *(pytest.param(n, 200, marks=pytest.mark.slow) for n in CLOSED)],
)
def test_surface_splines_are_closed(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture],
    evaluator: str,
    name: str,
    views: int,
) -> None:
    painter, framebuffer, texture = counter
    leaks = 1 if "softpipe" in painter.capabilities.renderer else 0  # its edges are floats
    found = MESHES[name]()
    ratios = np.random.default_rng(4).uniform(0.1, 0.9, len(found.topology.ends))
    nets = surface_spline(found.topology, ratios).nets(found.vertices)
    body, points = Patches(nets), sample_surface(nets)
    random = np.random.default_rng(5)
    for turn in range(views):
        azimuth, elevation, zoom = random.uniform([0.0, -90.0, 1.0], [360.0, 90.0, 4.0])
        camera = frame(points, SIZE, SIZE, View(zoom, (0.0, 0.0), azimuth, elevation), True)
        framebuffer.clear()
        painter.surfaces.draw(body, camera, evaluator, LEVELS[turn % 3])
        assert np.count_nonzero(counts(texture)) <= leaks, turn
    whole = frame(points, SIZE, SIZE, View(), True)
    framebuffer.clear()
    painter.surfaces.draw(Patches(nets[: len(nets) // 2]), whole, evaluator, 7)
    assert np.count_nonzero(counts(texture)) > 100


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("level", [7, 64, 100, 130])
def test_a_flat_patch_covers_each_pixel_once(
    counter: tuple[Painter, moderngl.Framebuffer, moderngl.Texture], evaluator: str, level: int
) -> None:
    painter, framebuffer, texture = counter
    square = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
    camera = frame(sample_surface(square), SIZE, SIZE, View(zoom=2.0), False)
    framebuffer.clear()
    painter.surfaces.draw(Patches(square), camera, evaluator, level)
    assert (counts(texture) == 1.0).all()
    turned = frame(sample_surface(square), SIZE, SIZE, View(), False)
    framebuffer.clear()
    painter.surfaces.draw(Patches(square.swapaxes(0, 1)), turned, evaluator, level)
    assert set(np.unique(counts(texture))) == {0.0, -1.0}
