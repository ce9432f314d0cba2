"""The forms that GLU's arguments may have, and those that are refused by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reparam.evaluators.constants import GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3
from reparam.evaluators.glu import (
    GLU_MAP1_TRIM_2,
    GLU_NURBS_ERROR,
    GLU_SAMPLING_TOLERANCE,
    GluInvalidValue,
    gluNewNurbsRenderer,
)

ENDS = [0.0, 0.0, 1.0, 1.0]
PLANE = np.zeros((2, 2, 3))


def test_argument_forms_agree() -> None:
    """C's, C's without the counts, PyOpenGL's; strides swapped and padded."""
    points = np.random.default_rng(11).normal(size=(4, 5, 3)).astype(np.float32)
    padded = np.zeros((5, 4, 7), np.float32)
    padded[..., :3] = points.swapaxes(0, 1)
    u, v = [0, 0, 0, 0, 1, 1, 1, 1], [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]
    forms = [
        (8, u, 9, v, 15, 3, points.ravel(), 4, 4, GL_MAP2_VERTEX_3),
        (8, [*u, 7.0], 9, v, 7, 28, padded, 4, 4, GL_MAP2_VERTEX_3),
        (u, v, 15, 3, points, 4, 4, GL_MAP2_VERTEX_3),
        (u, v, points, GL_MAP2_VERTEX_3),
    ]
    found = []
    for form in forms:
        nurb = gluNewNurbsRenderer()
        nurb.gluNurbsSurface(*form)
        (nurbs,) = nurb.take()
        (spline,) = nurbs.splines
        found.append((spline.orders, [k.tolist() for k in spline.knots], spline.points.tolist()))
    assert all(form == found[0] for form in found)
    assert found[0][2] == points.tolist()


@pytest.mark.parametrize(
    ("call", "arguments", "message"),
    [
        ("gluNurbsSurface", (ENDS, ENDS, PLANE[0], GL_MAP2_VERTEX_3), r"points: .*\(m, n, 3\)"),
        ("gluNurbsSurface", (ENDS, ENDS, "four", GL_MAP2_VERTEX_3), "points: .* array of numbers"),
        ("gluNurbsSurface", (4.0, ENDS, 4, ENDS, 6, 3, PLANE, 2, 2, GL_MAP2_VERTEX_3),
         "knot count: expected a whole number, found 4.0"),
        ("gluNurbsSurface", (4, ENDS, 4, ENDS, 6, 3, PLANE, 2, "2", GL_MAP2_VERTEX_3),
         "order: expected a whole number, found '2'"),
        ("gluNurbsCurve", (4, ENDS, 1.5, PLANE, 2, GL_MAP1_VERTEX_3), "stride: expected a whole"),
        ("gluNurbsCurve", (["a"] * 4, PLANE[0], GL_MAP1_VERTEX_3), "knots: .* array of numbers"),
        ("gluPwlCurve", (2.5, PLANE, 2, GLU_MAP1_TRIM_2), "count: expected a whole number, foun"),
        ("gluNurbsProperty", (GLU_SAMPLING_TOLERANCE, "fine"), "above 0, found 'fine'"),
        ("gluNurbsCallback", (GLU_NURBS_ERROR, 5), "function: expected a function or None, fou"),
        ("gluLoadSamplingMatrices", (np.eye(4), np.eye(4), "abcd"), "viewport: .* found 'abcd'"),
        ("gluLoadSamplingMatrices", (np.eye(4), np.eye(4), (0, 0, np.nan, 1)), "viewport: "),
        ("gluLoadSamplingMatrices", (np.eye(3), np.eye(4), (0, 0, 1, 1)), "modelMatrix: .*found 9"),
    ],
)  # fmt: skip
def test_what_is_no_number_is_named(call: str, arguments: tuple[Any, ...], message: str) -> None:
    nurb = gluNewNurbsRenderer()
    with pytest.raises(GluInvalidValue, match=f"{call}: .*{message}"):
        getattr(nurb, call)(*arguments)
    assert not nurb.take()
