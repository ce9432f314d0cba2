"""What the callbacks of the tessellator mode are told."""

from __future__ import annotations

from typing import Any

from reparam.evaluators.constants import (
    GL_LINE_STRIP,
    GL_MAP1_VERTEX_4,
    GL_MAP2_TEXTURE_COORD_3,
    GL_MAP2_VERTEX_4,
    GL_QUAD_STRIP,
)
from reparam.evaluators.glu_constants import (
    GLU_DOMAIN_DISTANCE,
    GLU_NURBS_BEGIN,
    GLU_NURBS_BEGIN_DATA,
    GLU_NURBS_COLOR,
    GLU_NURBS_END,
    GLU_NURBS_MODE,
    GLU_NURBS_NORMAL,
    GLU_NURBS_TESSELLATOR,
    GLU_NURBS_TEXTURE_COORD,
    GLU_NURBS_VERTEX,
    GLU_SAMPLING_METHOD,
    GLU_U_STEP,
    GLU_V_STEP,
)
from reparam.evaluators.nurbs_renderer import NurbsRenderer


def tessellator() -> NurbsRenderer:
    """One step a unit."""
    nurb = NurbsRenderer()
    nurb.gluNurbsProperty(GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE)
    nurb.gluNurbsProperty(GLU_U_STEP, 1)
    nurb.gluNurbsProperty(GLU_V_STEP, 1)
    nurb.gluNurbsProperty(GLU_NURBS_MODE, GLU_NURBS_TESSELLATOR)
    return nurb


def test_callbacks_in_order() -> None:
    nurb = tessellator()
    heard: list[tuple[Any, ...]] = []
    nurb.gluNurbsCallback(GLU_NURBS_BEGIN, lambda mode: heard.append(("begin", mode)))
    nurb.gluNurbsCallback(GLU_NURBS_END, lambda: heard.append(("end",)))
    for which, name in ((GLU_NURBS_TEXTURE_COORD, "texture"), (GLU_NURBS_COLOR, "color"),
                        (GLU_NURBS_NORMAL, "normal"), (GLU_NURBS_VERTEX, "vertex")):  # fmt: skip
        nurb.gluNurbsCallback(which, lambda v, name=name: heard.append((name, v.tolist())))
    nurb.gluBeginSurface()
    ends = [0, 0, 1, 1]
    nurb.gluNurbsSurface(ends, ends, [[[2, 0, 0, 2], [2, 6, 0, 2]], [[4, 0, 0, 2], [4, 6, 0, 2]]],
                         GL_MAP2_VERTEX_4)  # fmt: skip
    nurb.gluNurbsSurface([0, 1], [0, 1], [[[1, 2, 3]]], GL_MAP2_TEXTURE_COORD_3)
    nurb.gluEndSurface()
    first = [("begin", GL_QUAD_STRIP), ("texture", [1, 2, 3]), ("normal", [0, 0, 1]),
             ("vertex", [1, 3, 0, 0, 1])]  # fmt: skip
    assert heard[:4] == first
    vertices = [values for name, *values in heard if name == "vertex"]
    assert vertices == [[[1, 3, 0, 0, 1]], [[1, 0, 0, 0, 0]], [[2, 3, 0, 1, 1]], [[2, 0, 0, 1, 0]]]
    assert heard[-1] == ("end",)


def test_callbacks_with_data_and_undivided_curves() -> None:
    nurb = tessellator()
    heard: list[Any] = []
    nurb.gluNurbsCallback(GLU_NURBS_BEGIN, lambda mode: heard.append(("plain", mode)))
    nurb.gluNurbsCallback(GLU_NURBS_BEGIN_DATA, lambda mode, data: heard.append((mode, data)))
    nurb.gluNurbsCallback(GLU_NURBS_VERTEX, lambda values: heard.append(values.tolist()))
    nurb.gluNurbsCallback(GLU_NURBS_END, lambda: heard.append("end"))
    nurb.gluNurbsCallback(GLU_NURBS_END, None)
    nurb.gluNurbsCallbackData("mine")
    nurb.gluNurbsCurve([0, 0, 1, 1], [[2, 0, 0, 2], [4, 6, 0, 2]], GL_MAP1_VERTEX_4)
    assert heard == [(GL_LINE_STRIP, "mine"), [2, 0, 0, 2], [4, 6, 0, 2]]
