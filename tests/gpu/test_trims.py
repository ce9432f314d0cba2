"""Trimmed surfaces on the GPU: pixel centres against float64, shares of pixels, both evaluators."""

from __future__ import annotations

import shutil
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam import assets
from reparam.geometry.camera import Camera
from reparam.geometry.net import Array, control_net
from reparam.geometry.trimming import TrimRegion, trim_region
from reparam.geometry.trimming.lookup import CUT, INSIDE, OUTSIDE, boxes_kept, pixel_coverage
from reparam.gpu.painter import Painter
from reparam.gpu.plans import Tolerance, uniform_plan
from reparam.gpu.surfaces import Fine
from reparam.gpu.targets import Target
from reparam.gpu.trims import Trims
from reparam.scenes.display import Display
from reparam.scenes.layers import Figure, Patches, Space
from reparam.snapshot import Studio
from trim_cases import CASES, SQUARE, circle, region_of, reverse, star

EVALUATORS = ["vertex", "tessellation"]
SIZE = 256
FLAT = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
WHOLE = Camera(np.eye(3), np.array([0.5, 0.5, 0.0]), 0.5, 0.5, 4.0)
TELLING = """
uniform vec4 color;
out vec4 fragment;
#ifdef TRIMMED
#include "lib/trim.glsl"
in vec2 trim_parameters;
void main() { fragment = vec4(trim_parameters, winding_number(trim_parameters), 1.0); }
#else
void main() { discard; }   // a part that no curve comes near
#endif
"""


def drawn(
    studio: Studio, layers: list[Patches], evaluator: str, samples: int, *,
    camera: Camera = WHOLE, spatial: bool = False, level: Fine = 7, wireframe: bool = False,
) -> NDArray[np.uint8]:  # fmt: skip
    """The layers on black, (SIZE, SIZE, 3), lowest row first."""
    ctx, surfaces = studio.ctx, studio.painter.surfaces
    if samples > max(1, studio.painter.capabilities.samples):
        pytest.skip("no multisampling")
    target = Target(ctx, (SIZE, SIZE), samples, studio.painter.capabilities)
    target.framebuffer.use()
    target.framebuffer.clear(0.0, 0.0, 0.0, 1.0, depth=1.0)
    ctx.enable_only(moderngl.BLEND | (moderngl.DEPTH_TEST if spatial else 0))
    ctx.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
    for layer in layers:
        if wireframe:
            surfaces.draw_wireframe(layer, camera, evaluator, level, (1.0, 1.0, 1.0))
        else:
            surfaces.draw(layer, camera, evaluator, level, by_sample=spatial)
    target.resolve()
    pixels = target.pixels()[::-1].copy()
    ctx.enable_only(moderngl.NOTHING)
    ctx.extra.use()
    target.release()
    return pixels


def middles() -> Array:
    t = (np.arange(SIZE) + 0.5) / SIZE
    return np.stack(np.meshgrid(t, t), -1)


def wrong_pixels(region: TrimRegion, kept: NDArray[np.bool_]) -> int:
    """Pixel centres on the wrong side, of those more than 1e-3 pixels off every curve."""
    u, v = np.moveaxis(middles(), -1, 0)
    bad = kept != region.inside(u, v)
    return int((np.abs(region.signed_distance(u[bad], v[bad])) * SIZE > 1e-3).sum())


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", CASES)
def test_pixel_centres_against_float64(studio: Studio, evaluator: str, name: str) -> None:
    region = region_of(name)
    pixels = drawn(studio, [Patches(FLAT, trim=region)], evaluator, 1)
    assert np.isin(pixels, [0, 255]).all()
    assert wrong_pixels(region, pixels[..., 0] > 0) == 0


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize("name", ["red book", "cusps", "slivers"])
def test_shares_of_pixels(studio: Studio, evaluator: str, name: str) -> None:
    """What lookup.py says in float64, which is held to many samples."""
    region = region_of(name)
    pixels = drawn(studio, [Patches(FLAT, trim=region)], evaluator, 4)[..., 0]
    step = np.tile([1.0 / SIZE, 0.0], (SIZE**2, 1))
    expected = pixel_coverage(region.pack(), middles().reshape(-1, 2), step, step[:, ::-1])
    assert np.abs(pixels - 255.0 * expected.reshape(SIZE, SIZE)).max() < 1.5


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_seen_so_small_that_pixels_are_larger_than_cells(studio: Studio, evaluator: str) -> None:
    """Sixty-four holes on 40 x 40 pixels: what lookup.py says, and all in all the right area."""
    region, zoom = region_of("sixty-four"), SIZE / 40.0
    camera = Camera(np.eye(3), np.array([0.5, 0.5, 0.0]), 0.5 * zoom, 0.5 * zoom, 4.0)
    layer = Patches(FLAT, trim=region)
    pixels = drawn(studio, [layer], evaluator, 4, camera=camera)[108:148, 108:148, 0] / 255.0
    t = (np.arange(40) + 0.5) / 40
    places = np.stack(np.meshgrid(t, t), -1).reshape(-1, 2)
    step = np.tile([1.0 / 40, 0.0], (1600, 1))
    expected = pixel_coverage(region.pack(), places, step, step[:, ::-1]).reshape(40, 40)
    assert np.abs(pixels - expected).max() < 0.01
    assert pixels.mean() == pytest.approx(region.area(), abs=0.015)


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_a_turned_and_zoomed_view(studio: Studio, evaluator: str) -> None:
    turn, zoom = 0.7, 0.05
    rotation = np.array(
        [[np.cos(turn), np.sin(turn), 0.0], [-np.sin(turn), np.cos(turn), 0.0], [0, 0, 1]]
    )
    region = trim_region([circle()])
    camera = Camera(rotation, np.array([0.5 + 0.3 * np.sqrt(0.5)] * 2 + [0.0]), zoom, zoom, 4.0)
    kept = drawn(studio, [Patches(FLAT, trim=region)], evaluator, 1, camera=camera)[..., 0] > 0
    offset = (middles() * 2.0 - 1.0) * zoom
    u, v = np.moveaxis(offset @ rotation[:2, :2] + camera.center[:2], -1, 0)
    away = np.abs(np.hypot(u - 0.5, v - 0.5) - 0.3) * SIZE / (2.0 * zoom)
    assert (kept == region.inside(u, v))[away > 5e-3].all()
    assert 0.4 < kept.mean() < 0.6


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_patches_share_a_region(studio: Studio, evaluator: str) -> None:
    """Four patches of one surface, in a domain of its own, as one patch."""
    stretch = np.array([[3.0, 0, 0], [0, 0.5, 0], [100.0, -1.0, 1.0]])
    square, hole = CASES["cusps"]()
    square = [np.column_stack([piece, np.ones(len(piece))]) @ stretch for piece in square]
    loops = [[piece[:, :2] for piece in square], [piece @ stretch for piece in hole]]
    region = trim_region(loops, (100.0, 103.0, -1.0, -0.5))
    split = 0.3
    corners = [(0, split, 0, 0.5), (split, 1, 0, 0.5), (0, split, 0.5, 1), (split, 1, 0.5, 1)]
    nets = np.stack([control_net([[(a, c), (a, d)], [(b, c), (b, d)]]) for a, b, c, d in corners])
    domains = np.array(corners) * [3.0, 3.0, 0.5, 0.5] + [100.0, 100.0, -1.0, -1.0]
    layer = Patches(nets, domains=domains, trim=region)
    unit = region_of("cusps")
    for samples in (1, 4):
        parts = drawn(studio, [layer], evaluator, samples).astype(int)
        whole = drawn(studio, [Patches(FLAT, trim=unit)], evaluator, samples)
        assert np.abs(parts - whole).max() <= 2
    assert wrong_pixels(unit, drawn(studio, [layer], evaluator, 1)[..., 0] > 0) == 0


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_curved_surfaces_by_the_fragments_own_parameters(
    studio: Studio, evaluator: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(assets.root() / "shaders", tmp_path / "shaders")
    (tmp_path / "shaders" / "patch.frag").write_text(TELLING)
    monkeypatch.setattr(assets, "root", lambda: tmp_path)
    random = np.random.default_rng(3)
    nets = np.ones((2, 4, 3, 4))
    nets[..., :3] = random.uniform(0.0, 1.0, nets[..., :3].shape)
    nets *= 10.0 ** random.uniform(-0.5, 0.5, (*nets.shape[:3], 1))
    domains = np.array([[0.0, 0.6, 0.0, 1.0], [0.6, 1.0, 0.0, 1.0]])
    region = region_of("blobs")
    ctx, painter = studio.ctx, Painter(studio.ctx)
    texture = ctx.texture((SIZE, SIZE), 4, dtype="f4")
    framebuffer = ctx.framebuffer([texture])
    framebuffer.use()
    framebuffer.clear()
    painter.surfaces.draw(Patches(nets, domains=domains, trim=region), WHOLE, evaluator, 13)
    told = np.frombuffer(texture.read(), np.float32).reshape(-1, 4)
    ctx.extra.use()
    framebuffer.release()
    texture.release()
    u, v, winding, covered = told[told[:, 3] > 0.0].T.astype(np.float64)
    assert covered.sum() > 0.05 * SIZE**2
    assert (u < 0.59).any()
    assert (u > 0.61).any()
    bad = (winding != 0) != region.inside(u, v)
    assert (np.abs(region.signed_distance(u[bad], v[bad])) < 5e-7).all()
    assert set(np.unique(winding)) == {0.0, 1.0}


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_what_is_behind_shows_in_the_edge(studio: Studio, evaluator: str) -> None:
    """In space the front is drawn first, and no ground shines through its rim."""
    front = FLAT + np.array([0.0, 0.0, 0.5, 0.0])
    region = trim_region([SQUARE, reverse(circle()), star((0.5, 0.5), 0.2)])
    red = Patches(front, color=(1.0, 0.0, 0.0), trim=region)
    green = Patches(FLAT, color=(0.0, 1.0, 0.0))
    for samples in (1, 4):
        pixels = drawn(studio, [red, green], evaluator, samples, spatial=True).astype(int)
        assert (np.abs(pixels[..., :2].sum(-1) - 255) <= 1).all()
        mixed = ((pixels[..., 0] > 0) & (pixels[..., 0] < 255)).sum()
        assert mixed == 0 if samples == 1 else mixed > 300
        share = pixels[..., 0].mean() / 255.0
        assert share == pytest.approx(region.area(), abs=2e-3)


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_surfaces_that_share_a_trim_curve_leave_no_crack(studio: Studio, evaluator: str) -> None:
    hole = [reverse(circle()), star((0.5, 0.5), 0.2)]
    regions = trim_region([SQUARE, *hole]), trim_region([reverse(loop) for loop in hole])
    colors = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    layers = [Patches(FLAT, color=c, trim=r) for c, r in zip(colors, regions, strict=True)]
    pixels = drawn(studio, layers, evaluator, 4, spatial=True).astype(int)
    assert (np.abs(pixels[..., :2].sum(-1) - 255) <= 1).all()
    assert ((pixels[..., 0] > 0) & (pixels[..., 0] < 255)).sum() > 300


def test_neighbours_in_the_plane_show_no_seam(studio: Studio) -> None:
    """Two shares of a pixel, blended one after the other, would let the ground shine through."""
    if studio.painter.capabilities.samples < 4:
        pytest.skip("no multisampling")
    hole = [reverse(circle()), star((0.5, 0.5), 0.2)]
    regions = trim_region([SQUARE, *hole]), trim_region([reverse(loop) for loop in hole])
    layers = tuple(Patches(FLAT, color=(0.0, 0.45, 0.7), trim=region) for region in regions)
    target = Target(studio.ctx, (SIZE, SIZE), 4, studio.painter.capabilities)
    kinds = []
    for shown in (layers, layers[:1]):
        figure = Figure((Space("plane", np.array([(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)]), shown),))
        studio.painter.draw(figure, target, Display(), plain=True)
        pixels = target.pixels()[40:-40, 40:-40].reshape(-1, 3)
        kinds.append(len(np.unique(pixels, axis=0)))
    target.release()
    studio.ctx.extra.use()
    assert kinds[0] == 1
    assert kinds[1] > 20  # one alone has an edge of many shares


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_the_wireframe_is_trimmed(studio: Studio, evaluator: str) -> None:
    region = trim_region([reverse(circle())])
    whole = drawn(studio, [Patches(FLAT)], evaluator, 1, wireframe=True)[..., 0] > 0
    part = drawn(studio, [Patches(FLAT, trim=region)], evaluator, 1, wireframe=True)[..., 0] > 0
    u, v = np.moveaxis(middles(), -1, 0)
    away = np.abs(np.hypot(u - 0.5, v - 0.5) - 0.3) * SIZE > 1.5
    assert (part == whole & region.inside(u, v))[away].all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_levels_by_tolerance(studio: Studio, evaluator: str) -> None:
    region = region_of("cusps")
    fine = Tolerance(0.5, (SIZE, SIZE))
    pixels = drawn(studio, [Patches(FLAT, trim=region)], evaluator, 1, level=fine)
    assert wrong_pixels(region, pixels[..., 0] > 0) == 0


def test_by_tolerance_only_patches_that_are_cut_are_decided(studio: Studio) -> None:
    low = np.stack(np.divmod(np.arange(64), 8), -1) / 8.0
    domains = np.stack([low, low + 1.0 / 8.0], -1).reshape(64, 4)
    layer = Patches(np.repeat(FLAT[None], 64, 0), domains=domains, trim=trim_region([circle()]))
    (_, whole), (cut, some) = Trims(studio.ctx).planned(layer, uniform_plan(layer, 3))
    assert cut
    corners = domains[:, [[0, 2], [0, 3], [1, 2], [1, 3]]]
    inside = (np.hypot(*np.moveaxis(corners - 0.5, -1, 0)) < 0.3).all(1)
    assert len(whole.patches) >= 4
    assert inside[whole.patches].all()
    assert set(np.flatnonzero(inside)) <= {*whole.patches, *some.patches}
    assert len(whole.patches) + len(some.patches) < 64


def test_boxes_that_no_curve_comes_near() -> None:
    region = region_of("sixty-four")
    random = np.random.default_rng(4)
    low = random.uniform(0.0, 0.99, (400, 2))
    high = np.minimum(low + random.uniform(0.0, 0.03, (400, 2)), 1.0)
    found = boxes_kept(region.pack(), low, high)
    assert set(np.unique(found)) == {OUTSIDE, INSIDE, CUT}
    for share in np.random.default_rng(5).uniform(0.0, 1.0, (30, 2)):
        inside = region.inside(*(low + share * (high - low)).T)
        assert inside[found == INSIDE].all()
        assert not inside[found == OUTSIDE].any()


def test_bad_domains_are_refused() -> None:
    with pytest.raises(ValueError, match=r"expected domains \(1, 4\), found \(2, 4\)"):
        Patches(FLAT, domains=np.zeros((2, 4)))
