"""Zebra lines, curvature colours and kinds, fragment by fragment, against float64."""

from __future__ import annotations

from collections.abc import Iterator

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from reparam.files.picture import find_picture
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.curvature import curvatures
from reparam.geometry.distortion import distortions
from reparam.geometry.evaluate import evaluate, project, sample_surface
from reparam.geometry.net import Array, control_net
from reparam.geometry.normal import surface_normal
from reparam.geometry.parsing import parse
from reparam.gpu.plans import Tolerance
from reparam.gpu.surfaces import Fine
from reparam.scenes.layers import Kind, Patches, Picture, Ramp, Texture
from reparam.scenes.shading import (
    DISTORTION,
    HIGH_COLOR,
    PLAIN_SCALE,
    Scale,
    Shading,
    diverging,
    zebra_wave,
)
from reparam.snapshot import Studio

SIZE = 96
LIGHT = np.array([-0.35, 0.45, 1.0]) / np.linalg.norm([-0.35, 0.45, 1.0])
ABOVE = View(0.98, (0.0, 0.0), 0.0, 90.0)
EVALUATORS = ["vertex", "tessellation"]
slow = pytest.mark.slow


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
    scale: Scale,
    fine: Fine = 16,
) -> tuple[Camera, NDArray[np.float64]]:
    camera = frame(sample_surface(layer.net), SIZE, SIZE, ABOVE, True)
    target.use()
    target.clear()
    studio.painter.surfaces.draw(layer, camera, evaluator, fine, shading, scale)
    pixels = np.frombuffer(target.read(components=3, alignment=1), np.uint8)
    return camera, pixels.reshape(SIZE, SIZE, 3) / 255.0


def seen_from_above(camera: Camera, nets: Array) -> tuple[Array, Array]:
    """Normal and curvatures at the middle of each pixel; NaN beside the patches."""
    normal, bend = np.full((SIZE * SIZE, 3), np.nan), np.full((SIZE * SIZE, 2), np.nan)
    for k, here, u, v in pixels_of_patches(camera):
        normal[here] = surface_normal(nets[k], u, v)
        bend[here] = curvatures(nets[k], u, v)
    return normal, bend


def in_model(camera: Camera) -> tuple[Array, Array]:
    """x and y of the middle of each pixel, (SIZE SIZE,), seen from above."""
    middles = np.stack(np.meshgrid(*[np.arange(SIZE) + 0.5] * 2), -1).reshape(-1, 2)
    x, y = camera.in_view(middles, SIZE, SIZE).T
    return x, y


def pixels_of_patches(camera: Camera) -> Iterator[tuple[int, NDArray[np.bool_], Array, Array]]:
    """Of each patch of `hills`: its number, the pixels well inside it, their parameters."""
    x, y = in_model(camera)
    for k in (0, 1):
        here = (x > 0.01) & (x < 0.99) & (y - k > 0.01) & (y - k < 0.99)
        yield k, here, x[here], y[here] - k


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("order", [2, 3, 4, pytest.param(10, marks=pytest.mark.slow)])
@pytest.mark.parametrize("shading", ["gauss", "mean"])
def test_curvature_colours(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, order: int, shading: Shading
) -> None:
    nets = hills(order)
    camera, found = drawn(
        studio, target, Patches(nets, lit=True), evaluator, shading, Scale(0.0, 2.0)
    )
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
    camera, found = drawn(studio, target, Patches(nets, lit=True), evaluator, "zebra", PLAIN_SCALE)
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
    studio.painter.surfaces.draw(Patches(mirror, lit=True), camera, "vertex", 4, "zebra")
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
    _, found = drawn(studio, target, Patches(octant, lit=True), evaluator, shading, PLAIN_SCALE)
    covered = found[found.max(-1) > 0.0]
    assert len(covered) > 4000
    expected = covered[:, :1] / HIGH_COLOR[0] * HIGH_COLOR
    assert np.quantile(np.abs(covered - expected), 0.98) <= 2.0 / 255.0


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize(
    ("order", "map_order"),
    [(3, 2), pytest.param(2, 4, marks=slow), pytest.param(3, 10, marks=slow)],
)
@pytest.mark.parametrize("shading", DISTORTION)
@pytest.mark.parametrize("fine", [16, Tolerance(0.5, (SIZE, SIZE))])
def test_what_a_texture_map_does(
    studio: Studio,
    target: moderngl.Framebuffer,
    evaluator: str,
    order: int,
    map_order: int,
    shading: Shading,
    fine: Fine,
) -> None:
    nets, maps = hills(order), hills(map_order)
    maps[..., :2] += 0.6 * maps[..., 2:3]
    layer = Patches(nets, Texture(maps, Picture("checkerboard")))  # not lit: the bare colours
    scale = Scale(0.2, 40.0 if shading == "angle" else 1.5)
    camera, found = drawn(studio, target, layer, evaluator, shading, scale, fine)
    inside, value = np.zeros(SIZE * SIZE, bool), np.full(SIZE * SIZE, np.nan)
    for k, here, u, v in pixels_of_patches(camera):
        value[here] = distortions(nets[k], maps[k], u, v)[:, DISTORTION[shading]]
        inside |= here
    expected = diverging((value - scale.middle) / scale.full)
    off = np.abs(found.reshape(-1, 3) - expected)[inside].max(1)
    assert inside.sum() > 3000
    assert np.quantile(off, 0.99) <= 1.5 / 255.0
    assert np.ptp(value[inside]) > 0.3


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("formula", ["", "3x + sin(4 x y)"])
@pytest.mark.parametrize("fine", [2, Tolerance(4.0, (SIZE, SIZE))])
def test_a_field_at_every_fragment(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, formula: str, fine: Fine
) -> None:
    nets, maps = hills(2), hills(4)
    nets[..., 2] = 0.0
    maps[..., :2] += maps[..., 2:3]
    low, high = -0.3, 1.4
    ramp = Ramp(low, high, parse(formula, ("x", "y")) if formula else None)
    layer = Patches(nets, Texture(maps, ramp, exact=True))
    camera, found = drawn(studio, target, layer, evaluator, "light", PLAIN_SCALE, fine)
    worst = []
    for k, here, u, v in pixels_of_patches(camera):
        x, y, _ = np.moveaxis(project(evaluate(maps[k], u, v)), -1, 0)
        value = ramp.formula(x=x, y=y) if ramp.formula else x
        expected = ramp_colors((value - low) / (high - low))
        worst.append(np.abs(found.reshape(-1, 3)[here] - expected).max())
    assert max(worst) <= 2.5 / 255.0


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_a_given_field_needs_but_two_triangles(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str
) -> None:
    """Interpolated as (x,y) is, the map r has (s,t) = (x,y) at any level."""
    net = control_net([[(0, 0), (0.2, 1)], [(1, 0.3), (1, 1)]])
    ramp = Ramp(-1.0, 1.0, parse("sin(5x) cos(3y)", ("x", "y")))
    layer = Patches(net, Texture(net, ramp))
    for level in (1, 32):
        camera, picture = drawn(studio, target, layer, evaluator, "light", PLAIN_SCALE, level)
        x, y = in_model(camera)
        covered = (picture > 0.0).any(-1).ravel()
        assert covered.sum() > 2000
        expected = ramp_colors((np.sin(5.0 * x) * np.cos(3.0 * y) + 1.0) / 2.0)
        assert np.abs(picture.reshape(-1, 3) - expected)[covered].max() <= 2.5 / 255.0


def ramp_colors(share: Array) -> Array:
    """The colours of the ramp from 0 to 1, (k, 3)."""
    colors = np.asarray(Image.open(find_picture("ramp")).convert("RGB"))[0] / 255.0
    at = (0.002 + 0.996 * np.clip(share, 0.0, 1.0)) * len(colors) - 0.5
    return np.stack([np.interp(at, np.arange(len(colors)), c) for c in colors.T], -1)


def test_contours_are_where_the_field_has_their_values(
    studio: Studio, target: moderngl.Framebuffer
) -> None:
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    pictures = [
        drawn(studio, target, Patches(flat, Texture(flat, Ramp(0.0, 1.0, contours=n))), "vertex",
              "light", PLAIN_SCALE)
        for n in (0, 5)
    ]  # fmt: skip
    x, _ = in_model(pictures[0][0])
    dark = pictures[1][1].sum(-1) < 0.8 * pictures[0][1].sum(-1)
    places = np.unique(np.round(x.reshape(SIZE, SIZE)[dark], 3))
    step = np.diff(x.reshape(SIZE, SIZE)[0]).max()
    for line in (0.2, 0.4, 0.6, 0.8):
        assert np.abs(places - line).min() <= step
    assert np.abs(places - np.round(5.0 * places) / 5.0).max() <= step


def test_kinds_and_what_is_not_lit(studio: Studio, target: moderngl.Framebuffer) -> None:
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    texture = Texture(flat, Picture("checkerboard"))
    kind = Kind((0.2, 0.6, 0.4), "kind")
    _, found = drawn(
        studio, target, Patches(flat, texture, lit=True, kind=kind), "vertex", "kind", PLAIN_SCALE
    )
    bright = 0.45 + 0.55 * LIGHT[2]
    inner = found[20:-20, 20:-20]
    np.testing.assert_allclose(inner, np.broadcast_to(np.array(kind.color) * bright, inner.shape),
                               atol=1.5 / 255)  # fmt: skip
    unlit = Patches(flat, texture, kind=kind)
    pictures = [
        drawn(studio, target, unlit, "vertex", s, PLAIN_SCALE)[1]
        for s in ("light", "kind", "gauss")
    ]
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0] == pictures[2]).all()
