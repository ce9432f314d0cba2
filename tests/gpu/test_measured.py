"""The colours of levels and of errors, fragment by fragment: against the plan, and float64."""

from __future__ import annotations

from collections.abc import Iterator

import moderngl
import numpy as np
import pytest
from closed_bodies import bulged_cube
from numpy.typing import NDArray
from truth import random_nets

from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.gpu.accuracy import Drawn, deviations, located, surface_points
from reparam.gpu.plans import Plan, Tolerance, uniform_plan
from reparam.gpu.surfaces import Fine
from reparam.scenes.layers import Patches
from reparam.scenes.shading import Scale, Shading, error_color, level_color
from reparam.snapshot import Studio

SIZE = (200, 150)
SNAP = 0.006  # pixels: the rasteriser has vertices on a grid of 1/256
EVALUATORS = ["vertex", "tessellation"]
NETS = random_nets(np.random.default_rng(1), (3, 2), False, 3)
NETS *= np.linspace(1.0, 1.5, 4)[:, None, None]  # weights
# One level, one each, and one each above the hardware's: how fine, and how near.
CASES: list[tuple[Fine, float]] = [(3, 1), (Tolerance(8.0, SIZE), 1), (Tolerance(2.0, SIZE), 40)]


@pytest.fixture
def target(studio: Studio) -> Iterator[moderngl.Framebuffer]:
    color, depth = studio.ctx.renderbuffer(SIZE), studio.ctx.depth_renderbuffer(SIZE)
    framebuffer = studio.ctx.framebuffer([color], depth)
    yield framebuffer
    studio.ctx.extra.use()
    for part in (framebuffer, color, depth):
        part.release()


def drawn(
    studio: Studio,
    target: moderngl.Framebuffer,
    camera: Camera,
    evaluator: str,
    fine: Fine,
    look: tuple[Shading, float],
) -> NDArray[np.float64]:
    target.use()
    target.clear(depth=1.0)
    with studio.ctx.scope(target, moderngl.DEPTH_TEST):
        studio.painter.surfaces.draw(
            Patches(NETS), camera, evaluator, fine, look[0], Scale(full=look[1])
        )
        pixels = np.frombuffer(target.read(components=3, alignment=1), np.uint8)
    return pixels.reshape(SIZE[1], SIZE[0], 3) / 255.0


def planned(studio: Studio, camera: Camera, evaluator: str, fine: Fine) -> Plan:
    layer = Patches(NETS)
    if isinstance(fine, int):
        return uniform_plan(layer, fine)
    return studio.painter.surfaces.adaptive.plan(layer, camera, evaluator, fine)


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize(("fine", "zoom"), CASES, ids=["one", "each", "fine"])
def test_error_colours_are_the_float64_distance(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, fine: Fine, zoom: float
) -> None:
    camera = frame(sample_surface(NETS), *SIZE, View(zoom), True)
    plan = planned(studio, camera, evaluator, fine)
    alone = Drawn(studio.painter, Patches(NETS), camera, evaluator, plan, SIZE)
    places, _ = located(alone)
    rows, columns = np.nonzero(places[..., 3] == 1.0)
    exact = surface_points(alone, places[rows, columns])
    off = np.linalg.norm(exact - np.stack([columns, rows], -1) - 0.5, axis=-1)
    scale = float(np.quantile(off, 0.7))
    found = drawn(studio, target, camera, evaluator, fine, ("error", scale))[rows, columns]
    sure = np.abs(off - scale) > SNAP  # where the colour jumps, rounding decides
    wrong = np.abs(found - error_color(off / scale))[sure].max(1)
    assert len(wrong) > 3000
    assert np.quantile(wrong, 0.999) < 0.01 + 1.5 * SNAP / scale
    assert scale > 10.0 * SNAP
    assert 0.2 < np.mean(off > scale) < 0.4


@pytest.mark.parametrize("evaluator", EVALUATORS)
@pytest.mark.parametrize(("fine", "zoom"), CASES, ids=["one", "each", "fine"])
def test_level_colours_are_the_plan_s(
    studio: Studio, target: moderngl.Framebuffer, evaluator: str, fine: Fine, zoom: float
) -> None:
    """Inside the patch's own, at the rims those of the edges."""
    camera = frame(sample_surface(NETS), *SIZE, View(zoom), True)
    plan = planned(studio, camera, evaluator, fine)
    inner, edges = plan.inner, plan.edges
    alone = Drawn(studio.painter, Patches(NETS), camera, evaluator, plan, SIZE)
    places, _ = located(alone)
    found = drawn(studio, target, camera, evaluator, fine, ("level", 1e9))  # as wide as may be
    patch, u, v = np.moveaxis(places[..., :3], -1, 0)
    covered = places[..., 3] == 1.0
    seen = 0
    for number, (own, around) in enumerate(zip(inner, edges, strict=True)):
        here = covered & (patch == plan.patches[number])
        away = np.stack([u, v, 1.0 - u, 1.0 - v])
        inside = here & (away.min(0) > 0.1)
        seen += int(inside.sum())
        expected = level_color(np.sqrt(own.prod()))
        assert np.abs(found[inside] - expected).max(initial=0.0) < 0.012
        for edge, steps in enumerate(around):
            others = np.delete(away, edge, 0).min(0)
            rim = here & (away[edge] < 0.07) & (away[edge] >= 0.0) & (others > 0.1)
            assert np.abs(found[rim] - level_color(steps)).max(initial=0.0) < 0.012
    assert seen > 2000
    assert isinstance(fine, int) or zoom == 1.0 or edges.max() > 64


def test_with_multisampling_no_error_is_made_up(studio: Studio) -> None:
    """A pixel's centre may lie outside its triangle, where the map is extrapolated, and far off if
    the triangle is seen from its edge."""
    if studio.painter.capabilities.samples < 4:
        pytest.skip("no multisampling")
    nets = bulged_cube(2, rational=True, mixed=False).nets
    camera = frame(sample_surface(nets), *SIZE, View(), True)
    parts = [studio.ctx.renderbuffer(SIZE, samples=4), studio.ctx.depth_renderbuffer(SIZE, 4)]
    target = studio.ctx.framebuffer(parts[:1], parts[1])
    resolved = studio.ctx.framebuffer([studio.ctx.renderbuffer(SIZE)])
    for evaluator in EVALUATORS:
        tolerance, layer = Tolerance(1.0, SIZE), Patches(nets)
        plan = studio.painter.surfaces.adaptive.plan(layer, camera, evaluator, tolerance)
        off = deviations(Drawn(studio.painter, layer, camera, evaluator, plan, SIZE))
        worst = 2.0 * float(np.quantile(off, 0.999))
        with studio.ctx.scope(target, moderngl.DEPTH_TEST):
            target.clear(1.0, 1.0, 1.0)
            studio.painter.surfaces.draw(
                layer, camera, evaluator, tolerance, "error", Scale(full=worst)
            )
        studio.ctx.copy_framebuffer(resolved, target)
        pixels = np.frombuffer(resolved.read(components=3, alignment=1), np.uint8).reshape(-1, 3)
        assert (pixels[:, 2] > 0.6 * 255).all()  # no orange
        assert pixels[:, 0].min() < 0.9 * 255  # some blue
    studio.ctx.extra.use()
    for part in (target, *parts, *resolved.color_attachments, resolved):
        part.release()
