"""bezcurve of the OpenGL Programming Guide: a cubic by glMap1 and glEvalCoord1."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any

import numpy as np

from ...evaluators.constants import GL_LINE_STRIP, GL_MAP1_VERTEX_3, GL_POINT, GL_POINTS
from ...evaluators.recorder import Recorder
from ...evaluators.tessellations import read_float64
from .. import palette
from ..claims import Claim
from ..layers import Array, Figure, Handles, Polylines, Recorded, Space
from ..parameters import Points, Range
from ..registry import scene

CONTROL_POINTS = np.array([(-4.0, -4.0, 0.0), (-2.0, 4.0, 0.0), (2.0, -4.0, 0.0), (4.0, 4.0, 0.0)])
WINDOW = np.array([(-5.0, -5.0, 0.0), (5.0, 5.0, 0.0)])  # its glOrtho


@scene("The Red Book's bezcurve: glMap1 and glEvalCoord1")
def redbook_bezcurve(
    segments: Annotated[int, Range(1, 100), "pieces of the line strip"] = 30,
    points: Annotated[Array, Points((4, 3), "the control points")] = CONTROL_POINTS,
) -> Figure:
    gl = Recorder()
    gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4, points)
    gl.glEnable(GL_MAP1_VERTEX_3)
    gl.glColor3f(*palette.ALONG_U)
    gl.glBegin(GL_LINE_STRIP)
    for i in range(segments + 1):
        gl.glEvalCoord1f(i / segments)
    gl.glEnd()
    gl.glColor3f(*palette.INK)
    gl.glBegin(GL_POINTS)
    for point in points:
        gl.glVertex3fv(point)
    gl.glEnd()
    layers = (
        Polylines(points, palette.GUIDE, 1.0),
        Recorded(gl.take(), width=2.4, radius=4.0),
        Handles(points, drag_point),
    )
    calls = (
        "glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4, ctrlpoints);",
        f"glBegin(GL_LINE_STRIP);   glEvalCoord1f(i/{segments}), i = 0 … {segments};   glEnd();",
    )
    return Figure((Space("physical", np.concatenate([WINDOW, points]), layers),), calls)


@redbook_bezcurve.claims
def claims() -> Iterator[Claim]:
    """x' = 6 (1 + 2 t (1-t)) and y' = 24 (2t - 1)^2: the curve rises, and rests in the middle."""
    t = np.arange(7) / 6.0
    gl = Recorder()
    gl.glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4, CONTROL_POINTS)
    gl.glEnable(GL_MAP1_VERTEX_3)
    gl.glMapGrid1f(6, 0, 1)
    gl.glEvalMesh1(GL_POINT, 0, 6)
    (curve,) = read_float64(gl.take())
    x, y, _ = curve.points.T.tolist()
    expected = 6.0 * t + 6.0 * t**2 - 4.0 * t**3 - 4.0
    yield Claim("bezcurve.c", "x at i/6 is 6t + 6t^2 - 4t^3 - 4", expected.tolist(), x, 1e-6)
    yield Claim("bezcurve.c", "y at i/6 is 4 (2t - 1)^3", (4 * (2 * t - 1) ** 3).tolist(), y, 1e-6)


def drag_point(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
    points = values["points"].copy()
    points[index] = point
    return {"points": points}
