"""Bad calls: OpenGL's own error, which names the argument and what was found."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import reparam.evaluators as ev
from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_COEFF,
    GL_FILL,
    GL_LINE,
    GL_MAP1_VERTEX_3,
    GL_MAP2_COLOR_4,
    GL_MAP2_VERTEX_3,
    GL_ORDER,
    GL_POINTS,
    InvalidEnum,
    InvalidOperation,
    InvalidValue,
    Recorder,
)

NET = np.arange(60, dtype=np.float32).reshape(4, 5, 3)


@pytest.fixture
def gl() -> Recorder:
    recorder = Recorder()
    recorder.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET)
    recorder.glEnable(GL_MAP2_VERTEX_3)
    return recorder


BAD: list[tuple[type[Exception], str, Callable[[Recorder], object]]] = [
    (InvalidValue, "glMap1f: u1, u2: expected two different numbers, found 2 twice",
     lambda gl: gl.glMap1f(GL_MAP1_VERTEX_3, 2, 2, NET[0])),
    (InvalidValue, "glMap2f: v1, v2: expected two different",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 1, 1 + 1e-9, NET)),
    (InvalidValue, "glMap2f: u2: expected a finite number, found nan",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, np.nan, 0, 1, NET)),
    (InvalidValue, "glMap1f: order: expected an order from 1 to 32, found 0",
     lambda gl: gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 0, NET)),
    (InvalidValue, "glMap2f: vorder: expected an order from 1 to 32, found 33",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 99, 1, 0, 1, 3, 33, np.zeros(99))),
    (InvalidValue, "glMap2f: uorder: expected an order from 1 to 32, found 33",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, np.zeros((33, 2, 3)))),
    (InvalidValue, "glMap1f: stride: expected at least 3, the numbers of a GL_MAP1_VERTEX_3, fou",
     lambda gl: gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, 2, 4, NET)),
    (InvalidValue, "glMap2f: vstride: expected at least 4",
     lambda gl: gl.glMap2f(GL_MAP2_COLOR_4, 0, 1, 12, 2, 0, 1, 3, 2, NET)),
    (InvalidValue, "glMap2f: points: expected at least 60 numbers, found 59",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 15, 4, 0, 1, 3, 5, NET.ravel()[1:])),
    (InvalidValue, r"glMap2f: points: expected finite numbers up to 1e\+18, found nan at \[1, 2, 0",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, broken(np.nan))),
    (InvalidValue, r"found inf at \[1, 2, 0\]",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, broken(np.inf))),
    (InvalidValue, r"glMap2f: points: expected an array \(uorder, vorder, 3\).*found shape \(4, 5,",
     lambda gl: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, np.zeros((4, 5, 4)))),
    (InvalidValue, "glMap1f: points: expected an array of numbers",
     lambda gl: gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, ["a", "b"])),
    (InvalidValue, "glMap1f: offset: expected at least 0, found -1",
     lambda gl: gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, NET, offset=-1)),
    (InvalidEnum, "glMap1f: target: expected GL_MAP1_..., found GL_MAP2_VERTEX_3",
     lambda gl: gl.glMap1f(GL_MAP2_VERTEX_3, 0, 1, NET[0])),
    (InvalidEnum, "glMap2f: target: expected GL_MAP2_..., found 0x1234",
     lambda gl: gl.glMap2f(0x1234, 0, 1, 0, 1, NET)),
    (InvalidValue, "glMapGrid1f: un: expected at least 1, found 0",
     lambda gl: gl.glMapGrid1f(0, 0, 1)),
    (InvalidValue, "glMapGrid2f: vn: expected at least 1, found -3",
     lambda gl: gl.glMapGrid2f(1, 0, 1, -3, 0, 1)),
    (InvalidValue, "glMapGrid2f: un: expected a whole number, found 2.5",
     lambda gl: gl.glMapGrid2f(2.5, 0, 1, 3, 0, 1)),  # type: ignore[arg-type]
    (InvalidEnum, "glEvalMesh1: mode: expected GL_POINT or GL_LINE, found GL_FILL",
     lambda gl: gl.glEvalMesh1(GL_FILL, 0, 1)),
    (InvalidEnum, "glEvalMesh2: mode: .*, found 0x0000",
     lambda gl: gl.glEvalMesh2(GL_POINTS, 0, 1, 0, 1)),
    (InvalidEnum, "glEnable: cap: expected a map target or GL_AUTO_NORMAL, found 0x0B50",
     lambda gl: gl.glEnable(0x0B50)),
    (InvalidEnum, "glGetMapfv: query: expected GL_COEFF, GL_ORDER or GL_DOMAIN, found GL_FILL",
     lambda gl: gl.glGetMapfv(GL_MAP2_VERTEX_3, GL_FILL)),
    (InvalidEnum, "glGetMapfv: target", lambda gl: gl.glGetMapfv(GL_FILL, GL_ORDER)),
    (InvalidEnum, "glGet: pname", lambda gl: gl.glGetFloatv(0x1234)),
    (InvalidEnum, "glBegin: mode: expected GL_POINTS ... GL_POLYGON, found 0x000A",
     lambda gl: gl.glBegin(10)),
    (InvalidOperation, "glEnd: expected between glBegin and glEnd", lambda gl: gl.glEnd()),
    (InvalidOperation, "glEvalCoord2f: expected between", lambda gl: gl.glEvalCoord2f(0, 0)),
    (InvalidOperation, "glEvalPoint1: expected between", lambda gl: gl.glEvalPoint1(0)),
    (InvalidOperation, "glMap2f: expected GL_ACTIVE_TEXTURE to be GL_TEXTURE0",
     lambda gl: [gl.glActiveTexture(ev.GL_TEXTURE1), gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, 0)]),
    (InvalidValue, "glEvalMesh2: expected at most 67108864 points, found 10000200001",
     lambda gl: gl.glEvalMesh2(GL_FILL, 0, 100000, 0, 100000)),
]  # fmt: skip


def broken(value: float) -> np.ndarray:
    net = NET.copy()
    net[1, 2, 0] = value
    return net


@pytest.mark.parametrize(("error", "message", "call"), BAD)
def test_bad_calls_raise_opengl_s_error_and_change_nothing(
    gl: Recorder, error: type[Exception], message: str, call: Callable[[Recorder], object]
) -> None:
    with pytest.raises(error, match=message):
        call(gl)
    gl.glActiveTexture(ev.GL_TEXTURE0)
    assert (gl.glGetMapfv(GL_MAP2_VERTEX_3, GL_COEFF) == NET.ravel()).all()
    assert gl.glGetIntegerv(ev.GL_MAP2_GRID_SEGMENTS).tolist() == [1, 1]
    assert not gl.take().items


def test_what_is_refused_between_begin_and_end(gl: Recorder) -> None:
    gl.glBegin(GL_POINTS)
    for call in (
        lambda: gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, NET),
        lambda: gl.glEvalMesh2(GL_FILL, 0, 1, 0, 1),
        lambda: gl.glEvalMesh1(GL_LINE, 0, 1),
        lambda: gl.glMapGrid1f(1, 0, 1),
        lambda: gl.glMapGrid2f(1, 0, 1, 1, 0, 1),
        lambda: gl.glEnable(GL_AUTO_NORMAL),
        lambda: gl.glBegin(GL_POINTS),
        lambda: gl.glGetMapfv(GL_MAP2_VERTEX_3, GL_ORDER),
        lambda: gl.glPushAttrib(0),
        gl.take,
    ):
        with pytest.raises(InvalidOperation, match="expected outside glBegin/glEnd, found inside"):
            call()
    gl.glEvalCoord2f(0.5, 0.5)
    gl.glEnd()
    assert len(gl.take().items) == 1


def test_errors_have_opengl_s_numbers() -> None:
    numbers = {
        ev.InvalidEnum: 0x0500,
        ev.InvalidValue: 0x0501,
        ev.InvalidOperation: 0x0502,
        ev.StackOverflow: 0x0503,
        ev.StackUnderflow: 0x0504,
    }
    for error, code in numbers.items():
        assert error.code == code
        assert issubclass(error, ev.OpenGLError)
