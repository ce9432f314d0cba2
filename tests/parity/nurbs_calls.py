"""A case's NURBS called on ours: properties, matrices, maps and trims."""

from __future__ import annotations

from typing import Any

import numpy as np

from reparam import evaluators
from reparam.evaluators import glu
from reparam.evaluators.splines import Nurbs

UNCHECKED = {"SAMPLING_TOLERANCE", "PARAMETRIC_TOLERANCE", "U_STEP", "V_STEP"}


def constant(name: object, prefix: str) -> int:
    """GL_MAP2_VERTEX_3 for "VERTEX_3"; GLU_MAP1_TRIM_2 for "MAP1_TRIM_2"; a number for itself."""
    for module, full in ((evaluators, f"{prefix}{name}"), (glu, f"GLU_{name}")):
        if hasattr(module, full):
            return int(getattr(module, full))
    return int(str(name))


def new_renderer(inputs: dict[str, Any]) -> tuple[glu.NurbsRenderer, list[int]]:
    """An object with a case's properties and matrices, and the list of its errors to come.

    libGLU takes any number for the properties in UNCHECKED; ours says so where it is none to draw
    by, and keeps the one before.
    """
    nurb, errors = glu.gluNewNurbsRenderer(), []
    nurb.gluNurbsCallback(glu.GLU_NURBS_ERROR, errors.append)
    view = inputs.get("view") or (np.eye(4), np.eye(4), (0, 0, 256, 256))
    nurb.gluNurbsProperty(glu.GLU_AUTO_LOAD_MATRIX, 0)
    nurb.gluLoadSamplingMatrices(*view)
    for name, value in (inputs.get("props") or {}).items():
        value = constant(value, "") if isinstance(value, str) else value
        before = len(errors)
        nurb.gluNurbsProperty(constant(name, ""), value)
        if name in UNCHECKED and not value > 0.0:
            assert errors[before:] == [glu.GLU_INVALID_VALUE]
            del errors[before:]
    return nurb, errors


def call_curve(inputs: dict[str, Any]) -> tuple[tuple[Nurbs, ...], list[int]]:
    nurb, errors = new_renderer(inputs)
    nurb.gluBeginCurve()
    own = (inputs.get("type", "VERTEX_3"), inputs["knots"], inputs["ctrl"], inputs["order"])
    for kind, knots, points, order in [*inputs.get("extra", ()), own]:
        points = np.array(points, np.float32)
        target = constant(kind, "GL_MAP1_")
        nurb.gluNurbsCurve(len(knots), knots, points.shape[-1], points, order, target)
    nurb.gluEndCurve()
    return nurb.take(), errors


def call_surface(inputs: dict[str, Any]) -> tuple[tuple[Nurbs, ...], list[int]]:
    nurb, errors = new_renderer(inputs)
    nurb.gluBeginSurface()
    own = (inputs.get("type", "VERTEX_3"), inputs["sknots"], inputs["tknots"], inputs["ctrl"],
           inputs["sorder"], inputs["torder"])  # fmt: skip
    drawn = inputs.get("mode") == "renderer"  # there GL_AUTO_NORMAL is OpenGL's, and goes first
    hidden = "NORMAL" if drawn and inputs.get("auto_normal") else None
    maps = [
        *((extra, None) for extra in inputs.get("extra", ()) if extra[0] != hidden),
        (own, inputs.get("strides")),
    ]
    for (kind, u_knots, v_knots, points, *orders), strides in maps:
        points = np.array(points, np.float32)
        if strides is None:
            strides = (points.shape[1] * points.shape[2], points.shape[2])
        target = constant(kind, "GL_MAP2_")
        nurb.gluNurbsSurface(
            len(u_knots), u_knots, len(v_knots), v_knots, *strides, points, *orders, target
        )
    for loop in inputs.get("trims", ()):
        nurb.gluBeginTrim()
        for kind, *data in loop:
            width = len(data[0 if kind == "pwl" else 1][0])
            target = constant(f"MAP1_TRIM_{width}", "")
            if kind == "pwl":
                nurb.gluPwlCurve(len(data[0]), np.array(data[0]), width, target)
            else:
                knots, points, order = data
                nurb.gluNurbsCurve(len(knots), knots, width, np.array(points), order, target)
        nurb.gluEndTrim()
    nurb.gluEndSurface()
    return nurb.take(), errors
