"""Every GLU_NURBS_ERROR: raised as its exception, or told to the callback; none else can occur."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from ctypes.util import find_library

import numpy as np
import pytest

from reparam.evaluators.constants import (
    GL_MAP1_TEXTURE_COORD_2,
    GL_MAP1_VERTEX_3,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
)
from reparam.evaluators.glu import (
    GLU_DISPLAY_MODE,
    GLU_MAP1_TRIM_2,
    GLU_NURBS_ERROR,
    GLU_NURBS_MODE,
    GLU_SAMPLING_METHOD,
    GLU_SAMPLING_TOLERANCE,
    NURBS_ERRORS,
    GluError,
    GluInvalidEnum,
    GluInvalidValue,
    NurbsError,
    NurbsRenderer,
    gluErrorString,
)

KNOTS = [0.0, 0.0, 1.0, 1.0]
LINE = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
SQUARE = [[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]]
BORDER = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
CUBIC = np.arange(24.0).reshape(8, 3)


def curve(nurb: NurbsRenderer, kind: int = GL_MAP1_VERTEX_3) -> None:
    nurb.gluNurbsCurve(KNOTS, LINE, kind)


def surface(nurb: NurbsRenderer, kind: int = GL_MAP2_VERTEX_3) -> None:
    nurb.gluNurbsSurface(KNOTS, KNOTS, SQUARE, kind)


def knots(values: list[float], order: int) -> Callable[[NurbsRenderer], None]:
    return lambda nurb: nurb.gluNurbsCurve(
        len(values), values, 3, np.zeros(99), order, GL_MAP1_VERTEX_3
    )


def begin_surface(nurb: NurbsRenderer) -> None:
    nurb.gluBeginSurface()
    surface(nurb)


def begin_trim(nurb: NurbsRenderer) -> None:
    begin_surface(nurb)
    nurb.gluBeginTrim()


def two_vertex_maps(nurb: NurbsRenderer) -> None:
    begin_surface(nurb)
    nurb.gluNurbsSurface(KNOTS, KNOTS, np.ones((2, 2, 4)), GL_MAP2_VERTEX_4)
    nurb.gluEndSurface()


def texture_alone(nurb: NurbsRenderer) -> None:
    nurb.gluNurbsCurve(KNOTS, [[0, 0], [1, 1]], GL_MAP1_TEXTURE_COORD_2)


def empty_curve(nurb: NurbsRenderer) -> None:
    nurb.gluBeginCurve()
    nurb.gluEndCurve()


def open_trim(nurb: NurbsRenderer) -> None:
    begin_trim(nurb)
    nurb.gluPwlCurve(BORDER, GLU_MAP1_TRIM_2)
    nurb.gluEndSurface()


def improper_trim(nurb: NurbsRenderer) -> None:
    begin_trim(nurb)
    curve(nurb)


def trim_twice(nurb: NurbsRenderer) -> None:
    begin_trim(nurb)
    nurb.gluPwlCurve(BORDER, GLU_MAP1_TRIM_2)
    nurb.gluBeginTrim()


def empty_trim(nurb: NurbsRenderer) -> None:
    begin_trim(nurb)
    nurb.gluEndTrim()


def mixed(first: str, second: str) -> Callable[[NurbsRenderer], None]:
    def calls(nurb: NurbsRenderer) -> None:
        begin_trim(nurb)
        nurb.gluBeginCurve()
        for kind in (first, second):
            if kind == "pwl":
                nurb.gluPwlCurve(BORDER, GLU_MAP1_TRIM_2)
            else:
                nurb.gluNurbsCurve(KNOTS, [[0, 0], [1, 0]], GLU_MAP1_TRIM_2)

    return calls


def in_trim(*points: list[float]) -> Callable[[NurbsRenderer], None]:
    def calls(nurb: NurbsRenderer) -> None:
        begin_trim(nurb)
        nurb.gluPwlCurve(list(points), GLU_MAP1_TRIM_2)
        nurb.gluEndTrim()
        nurb.gluEndSurface()

    return calls


CASES: list[tuple[int, Callable[[NurbsRenderer], None], str]] = [
    (1, knots([0, 1], 0), "order from 1 to 24, found 0"),
    (1, knots([0.0] * 25 + [1.0] * 25, 25), "found 25"),
    (2, knots([0, 0, 0, 1, 1, 1], 4), "at least 8 knots for order 4, found 6"),
    (3, knots([1, 1, 1, 1], 2), "not empty"),
    (4, knots([0, 0, 1, 0.5, 2, 2], 2), "found 1, 0.5 at 2"),
    (5, knots([0, 0, 0, 0, 0, 1, 1, 1, 1], 4), "5 at 0"),
    (6, lambda n: (n.gluBeginCurve(), curve(n), n.gluBeginCurve()), "twice"),
    (7, NurbsRenderer.gluEndCurve, "outside a curve"),
    (8, two_vertex_maps, "expected one vertex map, found 2"),
    (8, texture_alone, "expected one vertex map, found 0"),
    (9, empty_curve, "empty"),
    (12, open_trim, "a trim is open"),
    (13, NurbsRenderer.gluEndSurface, "outside a surface"),
    (14, improper_trim, "a trim's, found GL_MAP1_VERTEX_3"),
    (15, NurbsRenderer.gluBeginTrim, "outside a surface"),
    (16, trim_twice, "twice"),
    (17, NurbsRenderer.gluEndTrim, "outside a trim"),
    (18, empty_trim, "the trim is empty"),
    (19, lambda n: n.gluPwlCurve(BORDER, GLU_MAP1_TRIM_2), "outside a trim"),
    (21, mixed("nurbs", "pwl"), "after gluNurbsCurve"),
    (22, lambda n: n.gluPwlCurve(LINE, GL_MAP1_VERTEX_3), "GLU_MAP1_TRIM_2 or _3"),
    (24, mixed("pwl", "nurbs"), "after gluPwlCurve"),
    (27, lambda n: (begin_surface(n), n.gluBeginSurface()), "twice"),
    (32, knots([0, 0, np.nan, 1, 1], 2), "finite knot 2"),
    (33, lambda n: n.gluPwlCurve(-1, BORDER, 2, GLU_MAP1_TRIM_2), "found -1"),
    (34, lambda n: n.gluNurbsCurve(KNOTS, -3, LINE, 2, GL_MAP1_VERTEX_3), "found -3"),
    (35, lambda n: curve(n, 4242), "expected GL_MAP1_..., found 4242"),
    (35, lambda n: surface(n, GL_MAP1_VERTEX_3), "expected GL_MAP2_..., found GL_MAP1_VERTEX_3"),
    (36, lambda n: n.gluNurbsCurve(4, KNOTS, 3, None, 2, GL_MAP1_VERTEX_3), "found None"),
    (37, in_trim(*BORDER[:2], *BORDER[1:]), r"\[1.0, 0.0\] at 1 and 2"),
]  # fmt: skip


@pytest.mark.parametrize(("number", "calls", "message"), CASES)
def test_raised(number: int, calls: Callable[[NurbsRenderer], None], message: str) -> None:
    with pytest.raises(NurbsError, match=message) as caught:
        calls(NurbsRenderer())
    assert type(caught.value) is NURBS_ERRORS[number]
    assert caught.value.code == 100250 + number
    assert str(caught.value).startswith(f"GLU_NURBS_ERROR{number}: {caught.value.meaning}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("number", "calls", "message"), CASES)
def test_told_to_the_callback(
    number: int, calls: Callable[[NurbsRenderer], None], message: str
) -> None:
    """And nothing that had an error in it is recorded, but for what was merely left open."""
    nurb, codes = NurbsRenderer(), []
    nurb.gluNurbsCallback(GLU_NURBS_ERROR, codes.append)
    calls(nurb)
    assert codes[0] == 100250 + number
    assert len(nurb.take()) == (1 if number in (6, 12, 27) else 0), message


def test_the_table_is_complete() -> None:
    assert sorted(NURBS_ERRORS) == list(range(1, 38))
    cannot = [number for number, error in NURBS_ERRORS.items() if not error.occurs]
    assert cannot == [10, 11, 20, 23, 25, 26, 30]
    tested = {number for number, *_ in CASES} | {28, 29, 31}  # in test_nurbs_trims.py
    assert tested == set(range(1, 38)) - set(cannot)
    for error in NURBS_ERRORS.values():
        assert error.__doc__
        assert error.occurs != error.__doc__.startswith("Cannot occur: ")


@pytest.mark.skipif(find_library("GLU") is None, reason="no libGLU here to compare with")
def test_meanings_are_glu_s() -> None:
    glu = ctypes.CDLL(find_library("GLU"))
    glu.gluErrorString.restype = ctypes.c_char_p
    codes = [*(error.code for error in NURBS_ERRORS.values()), 100900, 100901]
    for code in codes:
        assert gluErrorString(code) == glu.gluErrorString(ctypes.c_uint(code)).decode()


def test_a_call_that_raises_changes_nothing() -> None:
    nurb = NurbsRenderer()
    begin_surface(nurb)
    for calls in (NurbsRenderer.gluBeginSurface, NurbsRenderer.gluEndTrim, texture_alone):
        with pytest.raises(NurbsError):
            calls(nurb)
    with pytest.raises(NurbsError):
        nurb.gluNurbsSurface([0, 1], KNOTS, SQUARE, GL_MAP2_VERTEX_3)
    nurb.gluEndSurface()
    assert len(nurb.take()) == 1
    curve(nurb)
    assert [len(nurbs.splines) for nurbs in nurb.take()] == [1]


def test_an_end_that_raises_ends() -> None:
    nurb = NurbsRenderer()
    for calls in (two_vertex_maps, empty_curve, two_vertex_maps, empty_curve):
        with pytest.raises(NurbsError):
            calls(nurb)
    begin_trim(nurb)
    with pytest.raises(NurbsError, match="empty"):
        nurb.gluEndTrim()
    nurb.gluEndSurface()
    assert len(nurb.take()) == 1


@pytest.mark.parametrize(
    ("property", "value", "error", "message"),
    [
        (4242, 1, GluInvalidEnum, "one of GLU_SAMPLING_METHOD.*found 4242"),
        (GLU_NURBS_MODE, 7, GluInvalidEnum, "GLU_NURBS_RENDERER or GLU_NURBS_TESSELLATOR"),
        (GLU_SAMPLING_METHOD, 7, GluInvalidValue, "GLU_PATH_LENGTH or .*, found 7"),
        (GLU_DISPLAY_MODE, 7, GluInvalidValue, "GLU_FILL or GLU_OUTLINE_POLYGON or"),
        (GLU_SAMPLING_TOLERANCE, -1, GluInvalidValue, "above 0, found -1"),
        (GLU_SAMPLING_TOLERANCE, 0, GluInvalidValue, "above 0, found 0"),
        (GLU_SAMPLING_TOLERANCE, np.nan, GluInvalidValue, "above 0, found nan"),
    ],
)
def test_bad_properties(property: int, value: float, error: type[GluError], message: str) -> None:
    nurb, codes = NurbsRenderer(), []
    before = nurb.properties
    with pytest.raises(error, match=message):
        nurb.gluNurbsProperty(property, value)
    nurb.gluNurbsCallback(GLU_NURBS_ERROR, codes.append)
    nurb.gluNurbsProperty(property, value)
    assert codes == [error.code]
    assert nurb.properties == before


def test_bad_names() -> None:
    nurb = NurbsRenderer()
    with pytest.raises(GluInvalidEnum, match="property: expected one of"):
        nurb.gluGetNurbsProperty(4242)
    with pytest.raises(GluInvalidEnum, match="found 4242"):
        nurb.gluNurbsCallback(4242, print)


@pytest.mark.parametrize(
    ("calls", "message"),
    [
        (lambda n: n.gluNurbsCurve(9, KNOTS, 3, LINE, 2, GL_MAP1_VERTEX_3), "9 numbers, found 4"),
        (lambda n: n.gluNurbsCurve(KNOTS, 9, LINE, 2, GL_MAP1_VERTEX_3), "at least 12 .* found 6"),
        (lambda n: n.gluNurbsCurve(KNOTS, [[0, 1]] * 2, GL_MAP1_VERTEX_3), r"\(2, 3\), found"),
        (lambda n: n.gluNurbsCurve(KNOTS, [[0, np.inf, 0]] * 2, GL_MAP1_VERTEX_3), r"inf at \[0"),
        (lambda n: n.gluLoadSamplingMatrices(np.eye(3), np.eye(4), [0, 0, 1, 1]), "found 9"),
        (lambda n: n.gluLoadSamplingMatrices(np.eye(4), np.eye(4), [0, 0, -1, 1]), "width, height"),
    ],
)  # fmt: skip
def test_bad_arrays(calls: Callable[[NurbsRenderer], None], message: str) -> None:
    with pytest.raises(GluInvalidValue, match=message):
        calls(NurbsRenderer())


def test_bad_forms() -> None:
    nurb = NurbsRenderer()
    for call in (nurb.gluNurbsCurve, nurb.gluNurbsSurface, nurb.gluPwlCurve):
        with pytest.raises(TypeError, match=r"\(nurb, "):
            call(1)
