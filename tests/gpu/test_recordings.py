"""Recorded evaluator calls, read back; where the originals are wrong, ours are right.

The numbers in brackets are those of Mesa 22.3 and are not wanted.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam import evaluators as ev
from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_LINE,
    GL_MAP1_COLOR_4,
    GL_MAP1_VERTEX_3,
    GL_MAP1_VERTEX_4,
    GL_MAP2_INDEX,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    GL_POINT,
    Evaluators,
)
from reparam.geometry.net import control_net
from reparam.geometry.normal import surface_normal
from reparam.geometry.planar_maps import R
from reparam.snapshot import Studio

RANDOM = np.random.default_rng(11)
NET = RANDOM.uniform(-1, 1, (4, 3, 3))
SQUARE = np.array([[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0)]], float)
PATHS = ["vertex", "tessellation"]


@pytest.fixture
def gl(studio: Studio) -> Evaluators:
    return Evaluators(painter=studio.painter)


def surface(gl: Evaluators, net: np.ndarray, *, auto: bool = True, **domain: float) -> None:
    target = GL_MAP2_VERTEX_4 if net.shape[-1] == 4 else GL_MAP2_VERTEX_3
    ends = {"u1": 0.0, "u2": 1.0, "v1": 0.0, "v2": 1.0, **domain}
    gl.glMap2f(target, *ends.values(), net)
    gl.glEnable(target)
    (gl.glEnable if auto else gl.glDisable)(GL_AUTO_NORMAL)


def areas(mesh: ev.Evaluated) -> NDArray[np.float64]:
    """Twice the area of each triangle, along the normal of its first corner."""
    a, b, c = (mesh.points[mesh.primitives[:, k]].astype(float) for k in range(3))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), mesh.normals[mesh.primitives[:, 0]])


@pytest.mark.parametrize("evaluator", PATHS)
@pytest.mark.parametrize("ends", [(0, 1, 0, 1), (1, 0, 0, 1), (0, 1, 1, 0), (1, 0, 1, 0)])
@pytest.mark.parametrize("domain", [(0, 1, 0, 1), (1, 0, 0, 1), (1, 0, 1, 0)])
def test_fill_winds_with_its_normal(
    gl: Evaluators, evaluator: str, ends: tuple[int, ...], domain: tuple[int, ...]
) -> None:
    """(clockwise)"""
    surface(gl, SQUARE, **dict(zip(("u1", "u2", "v1", "v2"), domain, strict=True)))
    gl.glMapGrid2f(4, *ends[:2], 3, *ends[2:])
    gl.glEvalMesh2(GL_FILL, 0, 4, 0, 3)
    (mesh,) = gl.read(evaluator=evaluator)
    assert mesh.mode == ev.GL_TRIANGLES
    np.testing.assert_allclose(areas(mesh), 1 / 12, rtol=1e-5)


def test_the_normal_turns_with_a_reversed_domain(gl: Evaluators) -> None:
    """(does not)"""
    normals = []
    for u2 in (1.0, -1.0):
        surface(gl, SQUARE, u2=u2)
        gl.glEvalMesh2(GL_POINT, 0, 1, 0, 1)
        normals.append(gl.read()[0].normals)
    assert (normals[0] == [0, 0, 1]).all()
    assert (normals[1] == [0, 0, -1]).all()


@pytest.mark.parametrize("evaluator", PATHS)
@pytest.mark.parametrize("segments", [7, 100, 1000])
def test_the_grid_hits_its_last_value(gl: Evaluators, evaluator: str, segments: int) -> None:
    """(0.99999934 of a hundred, 0.9999907 of a thousand)"""
    gl.glMap1f(GL_MAP1_VERTEX_3, 2, 5, [(2, 0, 0), (5, 0, 0)])
    gl.glEnable(GL_MAP1_VERTEX_3)
    gl.glMapGrid1f(segments, 2, 5)
    gl.glEvalMesh1(GL_POINT, 0, segments)
    gl.glEvalMesh1(GL_POINT, segments // 2, segments)
    whole, tail = gl.read(evaluator=evaluator)
    assert whole.vertices[0, 0] == 2.0
    assert whole.vertices[-1, 0] == 5.0
    assert whole.parameters[-1, 0] == 5.0
    assert (whole.vertices[segments // 2 :] == tail.vertices).all()  # (off by 3e-6)
    np.testing.assert_allclose(whole.vertices[:, 0], whole.parameters[:, 0], atol=1e-6)


@pytest.mark.parametrize("evaluator", PATHS)
def test_points_of_the_grid_are_the_mesh_s(gl: Evaluators, evaluator: str) -> None:
    surface(gl, NET)
    gl.glMapGrid2f(7, -0.25, 1.5, 3, 1, 0)
    gl.glEvalMesh2(GL_POINT, -2, 9, 1, 4)
    gl.glBegin(ev.GL_POINTS)
    for j in range(1, 5):
        for i in range(-2, 10):
            gl.glEvalPoint2(i, j)
    gl.glEnd()
    mesh, points = gl.read(evaluator=evaluator)
    order = mesh.primitives[:, 0]
    assert (mesh.vertices[order] == points.vertices).all()
    assert (mesh.normals[order] == points.normals).all()
    assert (mesh.parameters[order] == points.parameters).all()


@pytest.mark.parametrize("evaluator", PATHS)
def test_normals_do_not_move_points(gl: Evaluators, evaluator: str) -> None:
    """(in the last bits, at 1526 of 1600 points)"""
    gl.glMapGrid2f(39, 0, 1, 39, 0, 1)
    for auto in (False, True):
        surface(gl, NET, auto=auto)
        gl.glEvalMesh2(GL_POINT, 0, 39, 0, 39)
    without, with_normals = gl.read(evaluator=evaluator)
    assert (without.vertices == with_normals.vertices).all()
    assert (without.normals == [0, 0, 1]).all()


@pytest.mark.parametrize("evaluator", PATHS)
def test_singular_points_have_the_limit_as_normal(gl: Evaluators, evaluator: str) -> None:
    """(the zero vector)"""
    surface(gl, R[..., :3])
    gl.glEvalMesh2(GL_POINT, 0, 1, 0, 1)
    (corners,) = gl.read(evaluator=evaluator)
    np.testing.assert_allclose(np.abs(corners.normals), [[0, 0, 1]] * 4, atol=1e-3)


@pytest.mark.parametrize("evaluator", PATHS)
@pytest.mark.parametrize("order", [4, 8, 12])
def test_normals_far_outside_the_domain(gl: Evaluators, evaluator: str, order: int) -> None:
    """Slopes of the basis, thousands there, sum to 0 but for rounding, which turned the normal."""
    net = np.random.default_rng(order).normal(size=(order, order, 3))
    surface(gl, net)
    at = np.float32([(-1.5, 0.4), (0.3, -1.5), (0.3, 2.5)])
    gl.glBegin(ev.GL_POINTS)
    for u, v in at:
        gl.glEvalCoord2f(u, v)
    gl.glEnd()
    (found,) = gl.read(evaluator=evaluator)
    exact = surface_normal(control_net(np.float32(net)), *at.astype(float).T)
    np.testing.assert_allclose(found.normals, exact, atol=2e-6)


@pytest.mark.parametrize("evaluator", PATHS)
def test_points_at_infinity_make_no_nan(gl: Evaluators, evaluator: str) -> None:
    net = np.ones((3, 3, 4))
    net[..., :3] = RANDOM.normal(size=(3, 3, 3))
    net[0, 0, 3] = net[1, 1, 3] = 0.0
    net[2, 2, 3] = -1.0
    net[0, 2] = 0.0
    surface(gl, net)
    gl.glMapGrid2f(8, 0, 1, 8, 0, 1)
    gl.glEvalMesh2(GL_POINT, 0, 8, 0, 8)
    (found,) = gl.read(evaluator=evaluator)
    assert (found.vertices[0] == np.float32([*net[0, 0, :3], 0.0])).all()
    assert np.isfinite(found.vertices).all()
    np.testing.assert_allclose(np.linalg.norm(found.normals, axis=-1), 1.0, atol=1e-6)
    limit = surface_normal(net, 1e-3, 1e-3)
    np.testing.assert_allclose(found.normals[0], limit, atol=1e-2)


@pytest.mark.parametrize("evaluator", PATHS)
def test_high_orders_and_extrapolation(gl: Evaluators, evaluator: str) -> None:
    points = RANDOM.uniform(-1, 1, (32, 4))
    points[:, 3] = RANDOM.uniform(0.5, 2, 32)
    gl.glMap1d(GL_MAP1_VERTEX_4, 1, -1, points)
    gl.glEnable(GL_MAP1_VERTEX_4)
    gl.glBegin(ev.GL_LINE_STRIP)
    for u in (1.0, -1.0, 0.3, 1.02):
        gl.glEvalCoord1d(u)
    gl.glEnd()
    (found,) = gl.read(evaluator=evaluator)
    t = (1 - np.float32([1.0, -1.0, 0.3, 1.02]).astype(float)) / 2
    rows = points.astype(np.float32).astype(float)
    expected = []
    for s in t:
        p = rows
        while len(p) > 1:
            p = (1 - s) * p[:-1] + s * p[1:]
        expected.append(p[0])
    np.testing.assert_allclose(found.vertices, expected, atol=1e-5)
    assert found.primitives.tolist() == [[0, 1], [1, 2], [2, 3]]


def test_collections_mix_evaluated_and_plain_vertices(gl: Evaluators) -> None:
    gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, [(0, 0, 0), (1, 2, 3)])
    gl.glMap1f(GL_MAP1_COLOR_4, 0, 1, [(0, 0, 0, 0), (1, 1, 1, 1)])
    gl.glEnable(GL_MAP1_VERTEX_3)
    surface(gl, SQUARE)
    gl.glColor3f(1, 0.5, 0)
    gl.glNormal3f(0, 1, 0)
    gl.glBegin(ev.GL_TRIANGLE_FAN)
    gl.glEvalCoord1f(0.5)
    gl.glVertex3fv([7, 8, 9])
    gl.glColor4f(0, 1, 0, 0.5)
    gl.glEvalCoord2f(1, 0)
    gl.glTexCoord2f(3, 4)
    gl.glVertex4f(1, 2, 3, 4)
    gl.glEnd()
    gl.glEnable(GL_MAP1_COLOR_4)
    gl.glBegin(ev.GL_POINTS)
    gl.glEvalCoord1f(0.25)
    gl.glVertex2f(1, 1)
    gl.glEnd()
    fan, points = gl.read()
    assert fan.vertices.tolist() == [[0.5, 1, 1.5, 1], [7, 8, 9, 1], [1, 0, 0, 1], [1, 2, 3, 4]]
    assert fan.colors.tolist() == [[1, 0.5, 0, 1]] * 2 + [[0, 1, 0, 0.5]] * 2
    assert fan.normals.tolist() == [[0, 1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 0]]
    assert fan.texcoords.tolist() == [[0, 0, 0, 1]] * 3 + [[3, 4, 0, 1]]
    assert fan.primitives.tolist() == [[0, 1, 2], [0, 2, 3]]
    # what was evaluated is not the current value
    assert points.colors.tolist() == [[0.25] * 4, [0, 1, 0, 0.5]]


@pytest.mark.parametrize("evaluator", PATHS)
def test_many_patches_are_one_batch(gl: Evaluators, evaluator: str) -> None:
    nets = RANDOM.uniform(-1, 1, (70, 3, 2, 3)).astype(np.float32)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, SQUARE[..., :2])
    gl.glMap2f(GL_MAP2_INDEX, 0, 1, 0, 1, [[[3.0]], [[5.0]]])
    gl.glEnable(GL_MAP2_TEXTURE_COORD_2)
    gl.glEnable(GL_MAP2_INDEX)
    gl.glMapGrid2f(2, 0, 1, 1, 0, 1)
    for net in nets:
        surface(gl, net)
        gl.glEvalMesh2(GL_LINE, 0, 2, 0, 1)
    recording = gl.take()
    assert len(recording.batches) == 1
    meshes = gl.read(recording, evaluator=evaluator)
    assert len(meshes) == 70
    for net, mesh in zip(nets, meshes, strict=True):
        corners = mesh.vertices.reshape(3, 2, 4)[::2, :, :3]
        assert (corners == net[::2]).all()
        assert mesh.texcoords.reshape(3, 2, 4)[1, 1].tolist() == [0.5, 1, 0, 1]
        assert mesh.indices.tolist() == [3, 3, 4, 4, 5, 5]
    assert len(meshes[0].primitives) == 2 * 2 + 3


@pytest.mark.parametrize("evaluator", PATHS)
@pytest.mark.parametrize("orders", [(1, 3), (4, 1), (1, 1)])
def test_a_map_of_order_1_is_constant_in_its_direction(
    gl: Evaluators, evaluator: str, orders: tuple[int, int]
) -> None:
    """(With GL_AUTO_NORMAL memory beyond its points is read: 1e30, NaN.)"""
    net = NET[:1, :1].repeat(orders[0], 0).repeat(orders[1], 1)
    net = net + 0.25 * np.add.outer(np.arange(orders[0]), np.arange(orders[1]))[..., None]
    surface(gl, net)
    gl.glMapGrid2f(4, 0, 1, 4, 0, 1)
    gl.glEvalMesh2(GL_POINT, 0, 4, 0, 4)
    (mesh,) = gl.read(evaluator=evaluator)
    along = np.add.outer(np.arange(5) * (orders[0] - 1), np.arange(5) * (orders[1] - 1)) / 4
    np.testing.assert_allclose(mesh.points, NET[0, 0] + 0.25 * along.reshape(-1, 1), atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=-1), 1.0, atol=1e-6)
