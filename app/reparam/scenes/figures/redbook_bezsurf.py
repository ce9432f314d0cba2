"""bezsurf of the OpenGL Programming Guide: lines on a bicubic surface by glEvalCoord2."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from ...evaluators.constants import GL_LINE_STRIP, GL_MAP2_VERTEX_3
from ...evaluators.recorder import Recorder
from .. import palette
from ..claims import Claim
from ..layers import Array, Figure, Recorded
from ..parameters import Points, Range
from ..redbook import POINTS_HELP, SURFACE, define_surface, evaluated_mesh, surface_figure
from ..registry import scene


@scene("The Red Book's bezsurf: lines by glEvalCoord2")
def redbook_bezsurf(
    lines: Annotated[int, Range(1, 32), "pieces between the lines of each direction"] = 8,
    segments: Annotated[int, Range(1, 100), "pieces of a line"] = 30,
    points: Annotated[Array, Points((4, 4, 3), POINTS_HELP)] = SURFACE,
) -> Figure:
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, points)
    for j in range(lines + 1):
        gl.glColor3f(*palette.ALONG_U)
        gl.glBegin(GL_LINE_STRIP)
        for i in range(segments + 1):
            gl.glEvalCoord2f(i / segments, j / lines)
        gl.glEnd()
        gl.glColor3f(*palette.ALONG_V)
        gl.glBegin(GL_LINE_STRIP)
        for i in range(segments + 1):
            gl.glEvalCoord2f(j / lines, i / segments)
        gl.glEnd()
    return surface_figure(
        points,
        (Recorded(gl.take(), width=1.6),),
        "glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, ctrlpoints);",
        f"glEvalCoord2f(i/{segments}, j/{lines}),   glEvalCoord2f(j/{lines}, i/{segments})",
    )


@redbook_bezsurf.claims
def claims() -> Iterator[Claim]:
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, SURFACE)
    points, _, _ = evaluated_mesh(gl)
    for name, vertex, at in (("(0,0)", 0, (0, 0)), ("(1,0)", 20, (0, 3)), ("(0,1)", 4, (3, 0))):
        i, j = at
        statement = f"the corner {name} is ctrlpoints[{i}][{j}]"
        yield Claim("bezsurf.c", statement, SURFACE[at].tolist(), points[vertex].tolist(), 1e-6)
    middle = [0.0, 0.0, 78.0 / 64.0]  # weights 1, 3, 3, 1 over 8, both ways
    yield Claim("bezsurf.c", "the middle of the surface", middle, points[12].tolist(), 1e-6)
