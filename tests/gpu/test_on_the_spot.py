"""Control points as attributes of an instance: no number and no pixel may tell."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from truth import random_nets

from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_MAP2_COLOR_4,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    Evaluators,
    Light,
    Recording,
)
from reparam.geometry.net import Array
from reparam.gpu import evaluation
from reparam.snapshot import Studio

SIZE = 96
PATCHES = 5
Picture = Callable[[Recording], NDArray[np.uint8]]


def grid(rows: int, row: int) -> Array:
    u, v = np.meshgrid(np.arange(rows), np.arange(row), indexing="ij")
    m, n = rows - 1, row - 1
    return np.stack([u / m, (m - u) / m, v / n, (n - v) / n], -1).reshape(-1, 4)


@pytest.mark.parametrize("normals", [False, True])
@pytest.mark.parametrize(
    ("degrees", "components"), [((3, 3), 3), ((2, 2), 4), ((1, 4), 3), ((1, 1), 2), ((0, 2), 1)]
)
def test_attributes_and_texture_give_the_same_numbers(
    studio: Studio, degrees: tuple[int, int], components: int, normals: bool
) -> None:
    nets = random_nets(np.random.default_rng(degrees), degrees, components == 4, PATCHES)
    nets[..., components:] = (0.0, 0.0, 0.0, 1.0)[components:]
    nets[1, 0] = nets[1, 0, :1]  # a pole: the normal there is a limit
    machine, parameters = studio.painter.evaluation, grid(4, 6)
    carried = machine.carry(nets, components)
    assert carried is not None
    carried.buffer.release()
    found, expected = (
        np.frombuffer(buffer.read(), np.float32)
        for buffer in (
            machine.run_map(nets, components, parameters, PATCHES, normals=normals),
            machine.run(nets, parameters, range(PATCHES), normals=normals),
        )
    )
    assert len(found) == PATCHES * 24 * (7 if normals else 4)
    assert (found == expected).all()


@pytest.mark.parametrize("vectors", [evaluation.MOST_VECTORS, 0])
def test_a_shared_map_is_evaluated_once_and_repeated(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, vectors: int
) -> None:
    monkeypatch.setattr(evaluation, "MOST_VECTORS", vectors)
    net = random_nets(np.random.default_rng(1), (1, 2), False, patches=1)[0]
    machine, parameters = studio.painter.evaluation, grid(2, 6)
    one = machine.run_map(net, 3, parameters, 1).read()
    assert machine.run_map(net, 3, parameters, 7).read() == 7 * one


def test_what_does_not_fit_stays_a_texture(studio: Studio) -> None:
    for degrees, components, fits in (
        ((3, 3), 3, True), ((3, 3), 4, False), ((4, 4), 3, False), ((9, 0), 3, False),
    ):  # fmt: skip
        net = random_nets(np.random.default_rng(2), degrees, False)
        carried = studio.painter.evaluation.carry(net, components)
        assert (carried is not None) == fits
        if carried is not None:
            carried.buffer.release()


@pytest.fixture
def picture(studio: Studio) -> Iterator[Picture]:
    """Lit, textured and seen in perspective, always by the same shaders but for the evaluation."""
    ctx, gl = studio.ctx, Evaluators(painter=studio.painter)
    parts = [ctx.renderbuffer((SIZE, SIZE), 3), ctx.depth_renderbuffer((SIZE, SIZE))]
    framebuffer = ctx.framebuffer(parts[:1], parts[1])
    texture = ctx.texture((4, 4), 3, bytes(range(0, 240, 5)), alignment=1)
    eye = np.array([[1, 0.1, 0, 0], [0, 1, 0.2, 0], [0, -0.2, 1, -4], [0, 0, 0, 1.0]])
    lens = np.array([[1.5, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, -1.2, -4], [0, 0, -1, 0.0]])

    def draw(recording: Recording) -> NDArray[np.uint8]:
        with ctx.scope(framebuffer, moderngl.DEPTH_TEST):
            framebuffer.clear(1.0, 0.0, 1.0, depth=1.0)
            gl.draw(recording, projection=lens, modelview=eye, light=Light(), texture=texture)
        return np.frombuffer(framebuffer.read(alignment=1), np.uint8).reshape(SIZE, SIZE, 3)

    yield draw
    for part in (framebuffer, *parts, texture):
        part.release()


def recorded(target: int, degrees: tuple[int, int], colors: int) -> Recording:
    """PATCHES patches, with one colour map for all or so many different ones."""
    gl = Evaluators()
    random = np.random.default_rng(degrees)
    nets = random_nets(random, degrees, target == GL_MAP2_VERTEX_4, PATCHES)
    nets[..., 0] += nets[..., 3] * np.arange(-2, 3)[:, None, None] / 2
    for cap in (target, GL_AUTO_NORMAL, GL_MAP2_TEXTURE_COORD_2):
        gl.glEnable(cap)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, random.uniform(size=(2, 2, 2)))
    if colors:
        gl.glEnable(GL_MAP2_COLOR_4)
    gl.glMapGrid2f(5, 0, 1, 7, 0, 1)
    for k, net in enumerate(nets):
        if k < colors:
            gl.glMap2f(GL_MAP2_COLOR_4, 0, 1, 0, 1, random.uniform(size=(2, 2, 4)))
        gl.glMap2f(target, -1, 1, 2, 0, net[..., : 4 if target == GL_MAP2_VERTEX_4 else 3])
        gl.glMap2f(target, 0, 1, 1, 0, net[..., : 4 if target == GL_MAP2_VERTEX_4 else 3])
        gl.glEvalMesh2(GL_FILL, 0, 5, 0, 7)
    return gl.take()


@pytest.mark.parametrize(
    ("target", "degrees", "colors", "spot"),
    [
        (GL_MAP2_VERTEX_3, (3, 3), 0, True),
        (GL_MAP2_VERTEX_4, (2, 2), 1, True),
        (GL_MAP2_VERTEX_3, (2, 1), PATCHES, False),
        (GL_MAP2_VERTEX_4, (3, 3), 0, False),
    ],
)
def test_drawn_on_the_spot_or_evaluated_beforehand(
    studio: Studio,
    picture: Picture,
    monkeypatch: pytest.MonkeyPatch,
    target: int,
    degrees: tuple[int, int],
    colors: int,
    spot: bool,
) -> None:
    """On the spot all patches are instances of one grid, and no vertex is kept."""
    recording = recorded(target, degrees, colors)
    found = picture(recording)
    (drawable,) = studio.painter.recordings.drawables.of(recording, on_the_spot=True)
    assert (drawable.spot is not None) == spot
    assert drawable.instances == (PATCHES if spot else 1)
    assert ("vertex" in drawable.streams) != spot
    monkeypatch.setattr(evaluation, "MOST_VECTORS", 0)
    assert len(np.unique(found.reshape(-1, 3), axis=0)) > 100
    assert (picture(Recording(recording.items)) == found).all()
