"""Large layers are drawn in batches, maps are shared or not: no picture may tell."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from truth import random_nets

from reparam import assets
from reparam.geometry.camera import View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import Array
from reparam.gpu import batches
from reparam.gpu.painter import Painter
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

EVALUATORS = ["vertex", "tessellation"]
SIZE = 160
CHECKS = Picture(scale=1.0, filter="nearest")
Draw = Callable[..., NDArray[np.uint8]]


def tiled(count: int) -> Array:
    """`count` by `count` patches, each its own cell of [-1,1]^2, bumpy."""
    t = (np.arange(count)[:, None] + [0.0, 0.5, 1.0]) / count * 2.0 - 1.0
    nets = np.ones((count, count, 3, 3, 4))
    nets[..., 0] = t[None, :, None, :]
    nets[..., 1] = -t[:, None, :, None]
    nets[..., 2] = np.random.default_rng(1).uniform(-0.2, 0.2, nets.shape[:-1])
    return nets.reshape(-1, 3, 3, 4)


@pytest.fixture
def draw(studio: Studio) -> Iterator[Draw]:
    """Draws a layer, seen from above, by a painter that has kept nothing or by the one given."""
    framebuffer = studio.ctx.framebuffer([studio.ctx.renderbuffer((SIZE, SIZE))])

    def picture(
        layer: Patches, evaluator: str, level: int, painter: Painter | None = None
    ) -> NDArray[np.uint8]:
        studio.ctx.disable(moderngl.BLEND | moderngl.DEPTH_TEST)
        studio.ctx.extra.use()
        framebuffer.use()
        framebuffer.clear(1.0, 0.0, 1.0)
        camera = frame(sample_surface(layer.net), SIZE, SIZE, View(), False)
        (painter or Painter(studio.ctx)).surfaces.draw(layer, camera, evaluator, level)
        data = framebuffer.read(components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(SIZE, SIZE, 3)

    yield picture
    studio.ctx.extra.use()
    color = framebuffer.color_attachments[0]
    framebuffer.release()
    color.release()


def textured(nets: Array) -> Patches:
    """Every patch with a map of its own."""
    maps = random_nets(np.random.default_rng(2), (1, 2), False, len(nets))
    return Patches(nets, Texture(maps, CHECKS), lit=True)


@pytest.mark.parametrize("kept_bytes", [1 << 29, 0])
def test_batches(draw: Draw, monkeypatch: pytest.MonkeyPatch, kept_bytes: int) -> None:
    layer = textured(tiled(5))
    whole = draw(layer, "vertex", 4)
    assert len(np.unique(whole.reshape(-1, 3), axis=0)) > 50
    monkeypatch.setattr(batches, "BATCH_VERTICES", 3 * 25)
    monkeypatch.setattr(batches, "KEPT_BYTES", kept_bytes)
    assert (draw(layer, "vertex", 4) == whole).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_more_patches_than_a_batch(draw: Draw, evaluator: str) -> None:
    side = 1 + int(np.sqrt(batches.BATCH_VERTICES // 9))
    picture = draw(Patches(tiled(side) * [1.0, 1.0, 0.0, 1.0]), evaluator, 2)
    margin = SIZE // 20
    assert (picture[margin:-margin, margin:-margin] == 255).all()
    assert (picture[0, 0] == [255, 0, 255]).all()


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_one_map_for_all_patches(draw: Draw, evaluator: str) -> None:
    nets = tiled(3)
    one = random_nets(np.random.default_rng(3), (1, 2), True, 1)
    shared = draw(Patches(nets, Texture(one[0], CHECKS), lit=True), evaluator, 4)
    copied = draw(Patches(nets, Texture(np.repeat(one, 9, 0), CHECKS), lit=True), evaluator, 4)
    assert (shared == copied).all()
    assert (shared != draw(textured(nets), evaluator, 4)).any(-1).mean() > 0.1


@pytest.mark.tessellation
def test_the_evaluators_draw_the_same(draw: Draw) -> None:
    """But for the diagonals of the cells, which tessellation turns in three of four quarters."""
    layer = textured(tiled(3))
    one, two = (draw(layer, evaluator, 32).astype(int) for evaluator in EVALUATORS)
    assert (np.abs(one - two).max(-1) > 8).mean() < 0.01


@pytest.mark.parametrize("evaluator", EVALUATORS)
def test_a_reload_evaluates_anew(
    studio: Studio, draw: Draw, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, evaluator: str
) -> None:
    shutil.copytree(assets.root() / "shaders", tmp_path / "shaders")
    monkeypatch.setattr(assets, "root", lambda: tmp_path)
    painter, layer = Painter(studio.ctx), Patches(tiled(1))
    before = draw(layer, evaluator, 4, painter)
    file = tmp_path / "shaders" / "lib" / "net.glsl"
    file.write_text(file.read_text().replace(", 0);", ", 0) * vec4(0.5, 0.5, 0.5, 1.0);"))
    assert (draw(layer, evaluator, 4, painter) == before).all()
    painter.reload_shaders()
    after = draw(layer, evaluator, 4, painter)
    share = (after == 255).all(-1).mean() / (before == 255).all(-1).mean()
    assert share == pytest.approx(0.25, abs=0.02)
