"""Zebra lines, curvature colours and kinds, fragment by fragment, against float64."""

from __future__ import annotations

from collections.abc import Iterator

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.curvature import curvatures
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import Array, control_net
from reparam.geometry.normal import surface_normal
from reparam.scenes.layers import Kind, Patches, Picture, Texture
from reparam.scenes.shading import HIGH_COLOR, Shading, diverging, zebra_wave
from reparam.snapshot import Studio

SIZE = 96
LIGHT = np.array([-0.35, 0.45, 1.0]) / np.linalg.norm([-0.35, 0.45, 1.0])
ABOVE = View(0.98, (0.0, 0.0), 0.0, 90.0)
EVALUATORS = ["vertex", "tessellation"]


def hills(order: int) -> Array:
    """Two patches over [0, 1] x [0, 2], x and y their parameters, heights at random."""
    random = np.random.default_rng(order)
    t = np.linspace(0.0, 1.0, order)
    x, y = np.meshgrid(t, t, indexing="ij")
    nets = [np.stack([x, y + k, random.uniform(-0.3, 0.3, x.shape)], -1) for k in (0, 1)]
    return control_net(np.stack(nets))


@pytest.fixture
def target(studio: Studio) -> Iterator[moderngl.Framebuffer]:
    renderbuffer = studio.ctx.renderbuffer((SIZE, SIZE))
    framebuffer = studio.ctx.framebuffer([renderbuffer])
    yield framebuffer
    studio.ctx.extra.use()
    framebuffer.release()
    renderbuffer.release()


def drawn(
    studio: Studio,
    target: moderngl.Framebuffer,
    layer: Patches,
    evaluator: str,
    shading: Shading,
    scale: float,
) -> tuple[Camera, NDArray[np.float64]]:
    camera = frame(sample_surface(layer.net), SIZE, SIZE, ABOVE, True)
    target.use()
    target.clear()
    studio.painter.surfaces.draw(layer, camera, evaluator, 16, shading, scale)
    pixels = np.frombuffer(target.read(components=3, alignment=1), np.uint8)
    return camera, pixels.reshape(SIZE, SIZE, 3) / 255.0


def seen_from_above(camera: Camera, nets: Array) -> tuple[Array, Array]:
    """Normal and curvatures at the middle of each pixel; NaN beside the patches."""
    middles = np.stack(np.meshgrid(*[np.arange(SIZE) + 0.5] * 2), -1).reshape(-1, 2)
    x, y = camera.in_view(middles, SIZE, SIZE).T
    patch = np.clip(np.floor(y), 0, 1).astype(int)
    inside = (x > 0.01) & (x < 0.99) & (y - patch > 0.01) & (y - patch < 0.99)
    normal, bend = np.full((len(x), 3), np.nan), np.full((len(x), 2), np.nan)
    for k in (0, 1):
        here = inside & (patch == k)
        normal[here] = surface_normal(nets[k], x[here], y[here] - k)
        bend[here] = curvatures(nets[k], x[here], y[here] - k)
    return normal, bend


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("order", [2, 3, 4, pytest.param(10, marks=pytest.mark.slow)])
@pytest.mark.parametrize("shading", ["gauss", "mean"])
def test_curvature_colours(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, order: int, shading: Shading
) -> None:
    nets = hills(order)
    camera, found = drawn(studio, target, Patches(nets, lit=True), evaluator, shading, 2.0)
    normal, bend = seen_from_above(camera, nets)
    value = bend[:, 0 if shading == "gauss" else 1] / 2.0
    bright = 0.75 + 0.25 * np.abs(normal @ LIGHT)
    expected = diverging(value) * bright[:, None]
    inside = ~np.isnan(value)
    assert inside.sum() > 3000
    off = np.abs(found.reshape(-1, 3) - expected)[inside].max(1)
    assert np.quantile(off, 0.99) <= 1.5 / 255.0
    assert np.ptp(value[inside]) > 0.02


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_zebra_lines(studio: Studio, target: moderngl.Framebuffer, evaluator: str) -> None:
    nets = hills(4)
    camera, found = drawn(studio, target, Patches(nets, lit=True), evaluator, "zebra", 1.0)
    normal, _ = seen_from_above(camera, nets)
    wave = zebra_wave(normal).reshape(SIZE, SIZE)
    with np.errstate(invalid="ignore"):
        steep = np.maximum(*(np.abs(g) for g in np.gradient(wave)))
        clear = np.abs(wave) > 2.0 * steep + 0.02
    bright = found[..., 0] > 0.5
    assert np.count_nonzero(clear) > 1500
    assert 0.2 < bright[clear].mean() < 0.8
    assert (bright == (wave > 0.0))[clear].mean() > 0.999


def test_zebra_lines_in_perspective(studio: Studio, target: moderngl.Framebuffer) -> None:
    """In a plane mirror upright bands around the eye, which sees it at ever other angles."""
    mirror = control_net([[(-1, -1), (-1, 1)], [(1, -1), (1, 1)]])
    camera = frame(sample_surface(mirror), SIZE, SIZE, View(3.0, (0.2, 0.0), 0.0, 90.0), True, 70.0)
    target.use()
    target.clear()
    studio.painter.surfaces.draw(Patches(mirror, lit=True), camera, "vertex", 4, "zebra", 1.0)
    found = np.frombuffer(target.read(components=3, alignment=1), np.uint8)
    found = found.reshape(SIZE, SIZE, 3)[SIZE // 2, :, 0] / 255.0
    a, _, c, _ = camera.sight((0, 0, SIZE, SIZE))
    eye = np.stack([a + c * (np.arange(SIZE) + 0.5), np.zeros(SIZE), np.ones(SIZE)], -1)
    eye /= np.linalg.norm(eye, axis=-1, keepdims=True)
    wave = zebra_wave(np.array([0.0, 0.0, 1.0]), eye)
    clear = np.abs(wave) > 0.1
    assert ((found > 0.5) == (wave > 0.0))[clear].all()
    assert np.count_nonzero(np.diff(wave > 0.0)) >= 2


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("shading", ["gauss", "mean"])
def test_a_rational_sphere_has_one_colour(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, shading: Shading
) -> None:
    arc = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])
    x, y = arc[:, None, 0] * arc[:, 0], arc[:, None, 0] * arc[:, 1]
    z, w = arc[:, None, 1] * arc[:, 2], arc[:, None, 2] * arc[:, 2]
    octant = np.stack([x, y, z, w], -1).swapaxes(0, 1)  # p_u x p_v outwards
    _, found = drawn(studio, target, Patches(octant, lit=True), evaluator, shading, 1.0)
    covered = found[found.max(-1) > 0.0]
    assert len(covered) > 4000
    expected = covered[:, :1] / HIGH_COLOR[0] * HIGH_COLOR
    assert np.quantile(np.abs(covered - expected), 0.98) <= 2.0 / 255.0


def test_kinds_and_what_is_not_lit(studio: Studio, target: moderngl.Framebuffer) -> None:
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    texture = Texture(flat, Picture("checkerboard"))
    kind = Kind((0.2, 0.6, 0.4), "kind")
    _, found = drawn(
        studio, target, Patches(flat, texture, lit=True, kind=kind), "vertex", "kind", 1
    )
    bright = 0.45 + 0.55 * LIGHT[2]
    inner = found[20:-20, 20:-20]
    np.testing.assert_allclose(inner, np.broadcast_to(np.array(kind.color) * bright, inner.shape),
                               atol=1.5 / 255)  # fmt: skip
    unlit = Patches(flat, texture, kind=kind)
    pictures = [drawn(studio, target, unlit, "vertex", s, 1)[1] for s in ("light", "kind", "gauss")]
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0] == pictures[2]).all()
