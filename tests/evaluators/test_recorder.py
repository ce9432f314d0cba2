"""The calls and their state: no OpenGL is needed to record."""

from __future__ import annotations

import numpy as np
import pytest

import reparam.evaluators as ev
from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_COEFF,
    GL_DOMAIN,
    GL_FILL,
    GL_LINE,
    GL_MAP1_VERTEX_3,
    GL_MAP2_COLOR_4,
    GL_MAP2_INDEX,
    GL_MAP2_NORMAL,
    GL_MAP2_TEXTURE_COORD_1,
    GL_MAP2_TEXTURE_COORD_3,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    GL_ORDER,
    GL_POINTS,
    Recorder,
)
from reparam.evaluators.maps import TARGETS
from reparam.evaluators.recording import Batch, Collection, Mesh

RANDOM = np.random.default_rng(1)
NET = RANDOM.uniform(-1, 1, (4, 5, 3)).astype(np.float32)


@pytest.fixture
def gl() -> Recorder:
    recorder = Recorder()
    recorder.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET)
    recorder.glEnable(GL_MAP2_VERTEX_3)
    return recorder


def recorded(gl: Recorder) -> list[Mesh | Collection]:
    return list(gl.take().items)


def coefficients(gl: Recorder, target: int = GL_MAP2_VERTEX_3) -> np.ndarray:
    return gl.glGetMapfv(target, GL_COEFF)


def test_numbers_are_opengl_s() -> None:
    assert (ev.GL_MAP1_COLOR_4, ev.GL_MAP1_VERTEX_4) == (0x0D90, 0x0D98)
    assert (ev.GL_MAP2_COLOR_4, ev.GL_MAP2_VERTEX_4) == (0x0DB0, 0x0DB8)
    assert (GL_AUTO_NORMAL, GL_FILL, GL_COEFF) == (0x0D80, 0x1B02, 0x0A00)
    assert len(TARGETS) == 18


def test_plain_arrays_flat_buffers_and_lists_are_one(gl: Recorder) -> None:
    packed = coefficients(gl)
    assert (packed == NET.ravel()).all()
    for points in (NET, NET.ravel(), NET.ravel().tolist(), NET.astype(np.float64)):
        gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 15, 4, 0, 1, 3, 5, points)
        assert (coefficients(gl) == packed).all()
    gl.glMap2d(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET[::-1, ::-1])
    assert (coefficients(gl) == NET[::-1, ::-1].ravel()).all()


def test_strides_and_offset_count_numbers(gl: Recorder) -> None:
    buffer = np.full(4 * 41 + 60, np.nan, np.float32)
    for i in range(4):
        for j in range(5):
            buffer[3 + i * 41 + j * 7 :][:3] = NET[i, j]
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 41, 4, 0, 1, 7, 5, buffer, offset=3)
    assert (coefficients(gl) == NET.ravel()).all()
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 41, 4, 0, 1, 7, 5, buffer[3:])
    assert (coefficients(gl) == NET.ravel()).all()
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 5, 0, 1, 15, 4, NET)  # swapped: transposed
    assert (coefficients(gl) == NET.swapaxes(0, 1).ravel()).all()


def test_points_are_copied_at_the_call(gl: Recorder) -> None:
    points = NET.copy()
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, points)
    gl.glEvalMesh2(GL_FILL, 0, 1, 0, 1)
    points[:] = 7.0
    assert (coefficients(gl) == NET.ravel()).all()
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, points)
    (mesh,) = recorded(gl)
    assert isinstance(mesh, Mesh)
    assert (mesh.maps.by_attribute["vertex"].points == NET).all()


def test_queries(gl: Recorder) -> None:
    gl.glMap1f(GL_MAP1_VERTEX_3, 5, 2.5, 3, 2, [1, 2, 3, 4, 5, 6.5])
    assert gl.glGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER).tolist() == [2]
    assert gl.glGetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN).tolist() == [5.0, 2.5]
    assert gl.glGetMapiv(GL_MAP1_VERTEX_3, GL_COEFF).tolist() == [1, 2, 3, 4, 5, 6]
    assert gl.glGetMapiv(GL_MAP2_VERTEX_3, GL_ORDER).tolist() == [4, 5]
    assert gl.glGetMapfv(GL_MAP2_VERTEX_3, GL_DOMAIN).tolist() == [0, 1, 0, 1]
    assert gl.glIsEnabled(GL_MAP2_VERTEX_3)
    assert not gl.glIsEnabled(GL_AUTO_NORMAL)
    gl.glMapGrid2f(7, 0, 2, 3, 1, -1)
    assert gl.glGetIntegerv(ev.GL_MAP2_GRID_SEGMENTS).tolist() == [7, 3]
    assert gl.glGetFloatv(ev.GL_MAP2_GRID_DOMAIN).tolist() == [0, 2, 1, -1]
    assert gl.glGetDoublev(ev.GL_MAP1_GRID_DOMAIN).tolist() == [0, 1]
    assert gl.glGetIntegerv(ev.GL_MAP1_GRID_SEGMENTS) == 1
    assert gl.glGetIntegerv(ev.GL_MAX_EVAL_ORDER) == 32
    assert gl.glGetIntegerv(GL_MAP2_VERTEX_3) == 1


def test_what_a_query_answers_is_a_copy(gl: Recorder) -> None:
    gl.glGetMapdv(GL_MAP2_VERTEX_3, GL_COEFF)[:] = 7.0
    gl.glGetMapfv(GL_MAP2_VERTEX_3, GL_COEFF)[:] = 7.0
    assert (coefficients(gl) == NET.ravel()).all()


def test_initial_maps() -> None:
    gl = Recorder()
    initial = {
        "VERTEX_3": [0, 0, 0],
        "VERTEX_4": [0, 0, 0, 1],
        "NORMAL": [0, 0, 1],
        "COLOR_4": [1, 1, 1, 1],
        "INDEX": [1],
        "TEXTURE_COORD_1": [0],
        "TEXTURE_COORD_2": [0, 0],
        "TEXTURE_COORD_3": [0, 0, 0],
        "TEXTURE_COORD_4": [0, 0, 0, 1],
    }
    for dimension in (1, 2):
        for name, values in initial.items():
            target = getattr(ev, f"GL_MAP{dimension}_{name}")
            assert coefficients(gl, target).tolist() == values
            assert gl.glGetMapiv(target, GL_ORDER).tolist() == [1] * dimension
            assert gl.glGetMapfv(target, GL_DOMAIN).tolist() == [0, 1] * dimension
            assert not gl.glIsEnabled(target)


def test_priorities(gl: Recorder) -> None:
    for target in (
        GL_MAP2_TEXTURE_COORD_1,
        GL_MAP2_TEXTURE_COORD_3,
        GL_MAP2_NORMAL,
        GL_MAP2_VERTEX_4,
        GL_MAP2_COLOR_4,
        GL_MAP2_INDEX,
    ):
        gl.glEnable(target)
    gl.glEvalMesh2(GL_FILL, 0, 1, 0, 1)
    gl.glEnable(GL_AUTO_NORMAL)
    gl.glDisable(GL_MAP2_TEXTURE_COORD_3)
    gl.glDisable(GL_MAP2_VERTEX_4)
    gl.glEvalMesh2(GL_FILL, 0, 1, 0, 1)
    one, two = recorded(gl)
    assert isinstance(one, Mesh)
    assert isinstance(two, Mesh)
    assert {f.target.name for f in one.maps.feeds} == {
        "GL_MAP2_VERTEX_4",
        "GL_MAP2_TEXTURE_COORD_3",
        "GL_MAP2_NORMAL",
        "GL_MAP2_COLOR_4",
        "GL_MAP2_INDEX",
    }
    assert two.maps.auto_normal
    assert set(two.maps.by_attribute) == {"vertex", "texcoord", "color", "index"}
    assert two.maps.by_attribute["vertex"].target.name == "GL_MAP2_VERTEX_3"


def test_without_a_vertex_map_there_is_no_vertex(gl: Recorder) -> None:
    gl.glEvalMesh1(GL_LINE, 0, 1)
    gl.glDisable(GL_MAP2_VERTEX_3)
    gl.glEnable(GL_MAP2_COLOR_4)
    gl.glEvalMesh2(GL_FILL, 0, 1, 0, 1)
    gl.glBegin(GL_POINTS)
    gl.glEvalCoord2f(0, 0)
    gl.glEvalCoord1f(0)
    gl.glEnd()
    assert recorded(gl) == []


def test_meshes_of_one_shape_become_one_batch(gl: Recorder) -> None:
    gl.glMapGrid2f(8, 0, 1, 8, 0, 1)
    for _ in range(3):
        gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, RANDOM.normal(size=(3, 3, 3)))
        gl.glEvalMesh2(GL_FILL, 0, 8, 0, 8)
    gl.glColor3f(1, 0, 0)
    gl.glEvalMesh2(GL_FILL, 0, 8, 0, 8)
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET)
    gl.glEvalMesh2(GL_FILL, 0, 8, 0, 8)
    gl.glEvalMesh2(GL_FILL, 0, 8, 0, 7)
    batches = gl.take().batches
    assert [len(b.meshes) for b in batches if isinstance(b, Batch)] == [3, 1, 1, 1]


def test_attributes_are_pushed_and_popped(gl: Recorder) -> None:
    gl.glMapGrid1f(5, 0, 1)
    gl.glColor3f(0.5, 0.25, 0)
    gl.glPushAttrib(ev.GL_EVAL_BIT | ev.GL_CURRENT_BIT)
    gl.glDisable(GL_MAP2_VERTEX_3)
    gl.glEnable(GL_AUTO_NORMAL)
    gl.glMapGrid1f(7, 3, 4)
    gl.glColor3f(1, 1, 1)
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET + 1)
    gl.glPopAttrib()
    assert gl.glIsEnabled(GL_MAP2_VERTEX_3)
    assert not gl.glIsEnabled(GL_AUTO_NORMAL)
    assert gl.glGetIntegerv(ev.GL_MAP1_GRID_SEGMENTS) == 5
    assert gl.glGetFloatv(ev.GL_CURRENT_COLOR).tolist() == [0.5, 0.25, 0, 1]
    assert (coefficients(gl) == (NET + 1).ravel()).all()  # control points are not in the group
    gl.glPushAttrib(ev.GL_ENABLE_BIT)
    gl.glDisable(GL_MAP2_VERTEX_3)
    gl.glMapGrid1f(9, 0, 1)
    gl.glPopAttrib()
    assert gl.glIsEnabled(GL_MAP2_VERTEX_3)
    assert gl.glGetIntegerv(ev.GL_MAP1_GRID_SEGMENTS) == 9
    for _ in range(16):
        gl.glPushAttrib(ev.GL_ALL_ATTRIB_BITS)
    with pytest.raises(ev.StackOverflow, match="glPushAttrib: expected at most 16"):
        gl.glPushAttrib(0)
    for _ in range(16):
        gl.glPopAttrib()
    with pytest.raises(ev.StackUnderflow, match="glPopAttrib"):
        gl.glPopAttrib()


def test_colours_in_bytes_and_whole_numbers(gl: Recorder) -> None:
    gl.glColor3ub(255, 0, 51)
    np.testing.assert_allclose(gl.glGetFloatv(ev.GL_CURRENT_COLOR), [1, 0, 0.2, 1], atol=1e-7)
    gl.glColor4ubv([0, 255, 0, 0])
    assert gl.glGetFloatv(ev.GL_CURRENT_COLOR).tolist() == [0, 1, 0, 0]
    gl.glTexCoord2i(3, 4)
    gl.glBegin(GL_POINTS)
    gl.glVertex2i(1, 2)
    gl.glEnd()
    (point,) = recorded(gl)
    assert isinstance(point, Collection)
    assert point.given["vertex"].tolist() == [[1, 2, 0, 1]]
    assert point.given["texcoord"].tolist() == [[3, 4, 0, 1]]
