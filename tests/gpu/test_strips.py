"""Grids evaluated strip by strip: the points of the evaluator, on the edges bit for bit."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
from truth import random_nets

from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    Evaluators,
)
from reparam.geometry.bernstein import bernstein
from reparam.geometry.evaluate import curve_point, evaluate, evaluate_derivatives, iso_curve, pair
from reparam.geometry.net import Array
from reparam.gpu import evaluation
from reparam.snapshot import Studio


@pytest.fixture(autouse=True)
def always(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(evaluation, "STRIPS_FROM", 1)


def grid(rows: int, row: int) -> Array:
    u, v = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, row), indexing="ij")
    return np.stack([*pair(u), *pair(v)], -1).reshape(-1, 4)


def read(buffer: moderngl.Buffer, *shape: int) -> np.ndarray:
    values = np.frombuffer(buffer.read(), np.float32).reshape(shape)
    buffer.release()
    return values


@pytest.mark.parametrize("normals", [False, True])
@pytest.mark.parametrize("degrees", [(2, 3), (3, 1)])
def test_strips_are_the_evaluator_s_points(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, degrees: tuple[int, int], normals: bool
) -> None:
    nets = random_nets(np.random.default_rng(degrees), degrees, True, patches=5)
    nets[1, 0] = nets[1, 0, :1]  # a pole: the normal there is a limit
    parameters, shape = grid(4, 15), (4, 15)
    machine = studio.painter.evaluation
    names = []
    get = machine._programs.get
    monkeypatch.setattr(
        machine._programs, "get", lambda name, **more: names.append(name) or get(name, **more)
    )
    found, reference = (
        read(buffer, 3, 4, 15, 7 if normals else 4)
        for buffer in (
            machine.run_grid(nets, parameters, shape, range(1, 4), normals=normals),
            machine.run(nets, parameters, range(1, 4), normals=normals),
        )
    )
    assert names == ["strip.vert", "evaluate.vert"]
    for edge in (np.s_[:, [0, -1]], np.s_[:, :, [0, -1]]):
        assert (found[edge][..., :4] == reference[edge][..., :4]).all()
    size = np.abs(nets).max()
    np.testing.assert_allclose(found[..., :4], reference[..., :4], atol=3e-7 * size)
    np.testing.assert_allclose(found[..., 4:], reference[..., 4:], atol=2e-5)


def test_a_shared_map_is_evaluated_once_and_repeated(studio: Studio) -> None:
    net = random_nets(np.random.default_rng(1), (1, 2), False, patches=1)[0]
    machine, parameters = studio.painter.evaluation, grid(2, 6)
    one = read(machine.run_grid(net, parameters, (2, 6), range(1)), 12, 4)
    many = read(machine.run_grid(net, parameters, (2, 6), range(7)), 7, 12, 4)
    assert (many == one).all()


def test_rows_are_filled_up_but_not_drawn(studio: Studio) -> None:
    """13 points a row make no long strips."""
    segments = (2, 12)
    gl = Evaluators(painter=studio.painter)
    net = np.random.default_rng(2).normal(size=(3, 4, 3))
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, net)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, net[:2, :2, :2])
    for cap in (GL_MAP2_VERTEX_3, GL_AUTO_NORMAL, GL_MAP2_TEXTURE_COORD_2):
        gl.glEnable(cap)
    gl.glMapGrid2f(segments[0], 0, 1, segments[1], 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, segments[0], 0, segments[1])
    recording = gl.take()
    (mesh,) = gl.read(recording)
    (drawable,) = studio.painter.recordings._drawables(recording)
    indices = np.frombuffer(drawable.indices.buffer.read(), np.int32)
    assert len(indices) == 6 * segments[0] * segments[1]
    points = np.frombuffer(drawable.streams["vertex"][0].read(), np.float32).reshape(-1, 7)
    maps = np.frombuffer(drawable.streams["texcoord"][0].read(), np.float32).reshape(-1, 4)
    assert len(points) == len(maps) > len(mesh.vertices)
    expected = mesh.primitives.ravel()
    np.testing.assert_allclose(points[indices, :4], mesh.vertices[expected], atol=2e-6)
    np.testing.assert_allclose(points[indices, 4:], mesh.normals[expected], atol=2e-5)
    np.testing.assert_allclose(maps[indices], mesh.texcoords[expected], atol=2e-6)


def test_the_twins() -> None:
    net = random_nets(np.random.default_rng(3), (3, 2), True)[0]
    curve, across = iso_curve(net, 0.3)
    v = np.linspace(-0.5, 1.5, 7)
    basis = bernstein(2, v)
    np.testing.assert_allclose(curve_point(basis, curve), evaluate(net, 0.3 + 0 * v, v), atol=1e-12)
    along_u, _ = evaluate_derivatives(net, 0.3 + 0 * v, v)
    np.testing.assert_allclose(curve_point(basis, across), along_u, atol=1e-12)
