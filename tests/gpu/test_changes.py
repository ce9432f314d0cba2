"""After an edit only what it changed travels to the GPU and is evaluated, bit for bit as anew."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
from truth import random_nets

from reparam.geometry.camera import Camera
from reparam.geometry.net import Array
from reparam.gpu import batches, changes
from reparam.gpu.changes import changed_runs, runs
from reparam.gpu.context import bound
from reparam.gpu.painter import Painter
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

PATCHES = 2400  # of 3 x 4 points: seven rows of texels and more
LEVEL = 2
SIZE = (96, 96)
CAMERA = Camera(np.eye(3), np.zeros(3), 1.1, 1.1, 4.0)
ROUNDS = 9


def edited(random: np.random.Generator, nets: Array, most: int) -> Array:
    """Some control points moved: scattered, neighbours, the first or the last patch."""
    after = nets.copy()
    count = int(random.integers(1, most))
    chosen = random.choice(len(nets), count, replace=False)
    if random.random() < 0.5:
        chosen = (chosen[0] + np.arange(count)) % len(nets)
    for patch in (*chosen, random.choice([0, len(nets) - 1])):
        after[patch, random.integers(3), random.integers(4), random.integers(3)] += 0.1
    return after


@pytest.mark.parametrize("most_runs", [3, 48])
def test_the_changed_patches_are_found(monkeypatch: pytest.MonkeyPatch, most_runs: int) -> None:
    monkeypatch.setattr(changes, "CHUNK", 64)
    monkeypatch.setattr(changes, "MOST_RUNS", most_runs)
    random = np.random.default_rng(1)
    before = random_nets(random, (2, 3), True, 500)
    for _ in range(50):
        after = edited(random, before, 40)
        found = changed_runs(before, after)
        expected = np.flatnonzero((before != after).any((1, 2, 3)))
        assert found is not None
        assert len(found) <= most_runs
        covered = np.concatenate([[*run] for run in found])
        assert (np.diff(covered) > 0).all()
        assert np.isin(expected, covered).all()
        if len(runs(expected)) < most_runs:
            assert covered.tolist() == expected.tolist()


def test_the_widest_gaps_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(changes, "MOST_RUNS", 3)
    numbers = np.array([1, 3, 10, 11, 13, 90])
    assert runs(numbers) == [range(1, 4), range(10, 14), range(90, 91)]


def test_what_is_better_done_anew() -> None:
    nets = random_nets(np.random.default_rng(2), (2, 2), False, 10)
    assert changed_runs(nets, nets.copy()) == []
    zero = np.zeros_like(nets)
    assert changed_runs(zero, np.where(np.arange(10)[:, None, None, None] == 4, -0.0, zero)) == [
        range(4, 5)
    ]
    moved = nets.copy()
    moved[:5] += 1.0
    assert changed_runs(nets, moved) == [range(5)]
    moved[7] += 1.0
    assert changed_runs(nets, moved) is None
    assert changed_runs(nets, nets[:9]) is None
    assert changed_runs(nets[0], nets[0].copy()) is None


@pytest.fixture
def travelled(monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """Bytes uploaded to textures and vertices evaluated from now on."""
    counted = {"bytes": 0, "vertices": 0}
    write, transform, make = (
        moderngl.Texture.write, moderngl.VertexArray.transform, moderngl.Context.texture
    )  # fmt: skip

    def counted_write(texture, data, *rest, **more):  # type: ignore[no-untyped-def]
        counted["bytes"] += len(data)
        return write(texture, data, *rest, **more)

    def counted_make(ctx, size, components, data=None, **more):  # type: ignore[no-untyped-def]
        counted["bytes"] += len(data or b"")
        return make(ctx, size, components, data, **more)

    def counted_transform(array, buffer, mode, vertices, instances=1, **more):  # type: ignore[no-untyped-def]
        counted["vertices"] += vertices * instances
        return transform(array, buffer, mode, vertices, instances=instances, **more)

    monkeypatch.setattr(moderngl.Texture, "write", counted_write)
    monkeypatch.setattr(moderngl.Context, "texture", counted_make)
    monkeypatch.setattr(moderngl.VertexArray, "transform", counted_transform)
    return counted


def kept(painter: Painter, net: Array) -> list[bytes]:
    """What the GPU keeps of a net: texels, points, points with normals."""
    found = [painter.evaluation.texture(net).read()]
    for normals in (False, True):
        evaluated = painter.surfaces._batches.evaluated(net, LEVEL, len(net), normals)
        found.append(b"".join(batch.vertices.read() for batch in evaluated))
    return found


def test_random_edits_leave_what_a_fresh_painter_makes(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, travelled: dict[str, int]
) -> None:
    monkeypatch.setattr(batches, "BATCH_VERTICES", 350 * (LEVEL + 1) ** 2)
    painter, random = Painter(studio.ctx), np.random.default_rng(3)
    nets = random_nets(random, (2, 3), True, PATCHES)
    with bound(studio.ctx, painter.nowhere):
        kept(painter, nets)
        for number in range(ROUNDS):
            painter.evaluation.sweep()
            painter.surfaces.sweep()
            before, nets = nets, edited(random, nets, 30)
            if number % 4 == 0:
                nets[(first := random.integers(1200)) : first + 1100] += 0.1  # whole rows of texels
            changed = int((before != nets).any((1, 2, 3)).sum())
            travelled.update(bytes=0, vertices=0)
            found = kept(painter, nets)
            assert travelled == {"bytes": changed * 12 * 16, "vertices": changed * 2 * 9}, number
            assert found == kept(Painter(studio.ctx), nets), number


@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
def test_a_dragged_point_moves_a_few_texels(
    studio: Studio, travelled: dict[str, int], evaluator: str
) -> None:
    """Position and texture map; the same picture as a fresh painter's; of the map, back again."""
    random = np.random.default_rng(4)
    nets, maps = (random_nets(random, (2, 3), False, PATCHES) for _ in range(2))
    nets[..., :3] = 0.1 * nets[..., :3] + random.uniform(-0.9, 0.9, (PATCHES, 1, 1, 3))
    color = studio.ctx.renderbuffer(SIZE)
    framebuffer = studio.ctx.framebuffer([color], studio.ctx.depth_renderbuffer(SIZE))
    painter = Painter(studio.ctx)
    picture = Picture(filter="nearest")

    def drawn(by: Painter, nets: Array, maps: Array) -> bytes:
        framebuffer.use()
        studio.ctx.enable_only(moderngl.DEPTH_TEST)
        framebuffer.clear(1.0, 1.0, 1.0)
        layer = Patches(nets, Texture(maps, picture), lit=True)
        by.surfaces.draw(layer, CAMERA, evaluator, LEVEL)
        by.evaluation.sweep()
        by.surfaces.sweep()
        return framebuffer.read()

    before = drawn(painter, nets, maps)
    travelled.update(bytes=0, vertices=0)
    moved, turned = nets.copy(), maps.copy()
    moved[700:704, 1, 1, :2] += 0.5
    turned[3] += 0.3
    after = drawn(painter, moved, turned)
    assert travelled["bytes"] == (4 + 1) * 12 * 16
    assert travelled["vertices"] == ((4 + 1) * 9 if evaluator == "vertex" else 0)
    assert after != before
    assert after == drawn(Painter(studio.ctx), moved, turned)
    assert drawn(painter, nets, maps.copy()) == before
    studio.ctx.extra.use()
    framebuffer.release()


def test_two_layers_that_are_alike_keep_their_own(studio: Studio) -> None:
    """What this frame has used is not taken over: a layer and its twin, one of them edited."""
    painter = Painter(studio.ctx)
    one = random_nets(np.random.default_rng(5), (2, 2), False, 8)
    two = one + np.eye(8)[:, :1, None, None]
    for _ in range(3):
        textures = [painter.evaluation.texture(net) for net in (one, two)]
        assert textures[0] is not textures[1]
        for net, texture in zip((one, two), textures, strict=True):
            texels = np.frombuffer(texture.read(), np.float32)
            assert (texels == net.astype(np.float32).ravel()).all()
        painter.evaluation.sweep()
        two = two + np.eye(8)[:, 3:4, None, None]
