"""texturesurf of the OpenGL Programming Guide: a second map attaches a picture."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from ...evaluators.constants import GL_FILL, GL_MAP2_TEXTURE_COORD_2, GL_MAP2_VERTEX_3
from ...evaluators.recorder import Recorder
from ..claims import Claim
from ..layers import Array, Figure, Picture, Recorded
from ..parameters import Points, Range
from ..redbook import POINTS_HELP, SURFACE, define_surface, evaluated_mesh, outline, surface_figure
from ..registry import scene

TEXTURE_POINTS = np.array([[(0.0, 0.0), (0.0, 1.0)], [(1.0, 0.0), (1.0, 1.0)]])
WAVES = Picture("waves", filter="nearest")


@scene("The Red Book's texturesurf: GL_MAP2_TEXTURE_COORD_2")
def redbook_texturesurf(
    grid: Annotated[int, Range(1, 256), "segments of glMapGrid2 in each direction"] = 20,
    points: Annotated[Array, Points((4, 4, 3), POINTS_HELP)] = SURFACE,
    texpts: Annotated[
        Array, Points((2, 2, 2), "the map's control points, texpts[i][j], j going with u")
    ] = TEXTURE_POINTS,
) -> Figure:
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, points)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 2, 2, 0, 1, 4, 2, texpts)
    gl.glEnable(GL_MAP2_TEXTURE_COORD_2)
    gl.glMapGrid2f(grid, 0, 1, grid, 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, grid, 0, grid)
    return surface_figure(
        points,
        (Recorded(gl.take(), picture=WAVES), outline(points)),
        "glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 2, 2, 0, 1, 4, 2, texpts);",
        f"glMapGrid2f({grid}, 0, 1, {grid}, 0, 1);   glEvalMesh2(GL_FILL, 0, {grid}, 0, {grid});",
    )


@redbook_texturesurf.claims
def claims() -> Iterator[Claim]:
    """x = 3u - 3/2, y = 3v - 3/2, and texpts[i][j], j going with u, is (i, j)."""
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, SURFACE)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 2, 2, 0, 1, 4, 2, TEXTURE_POINTS)
    gl.glEnable(GL_MAP2_TEXTURE_COORD_2)
    points, _, texcoords = evaluated_mesh(gl)
    some = [0, 8, 11, 17, 24]
    for column, name, axis in ((0, "s is y/3 + 1/2", 1), (1, "t is x/3 + 1/2", 0)):
        expected = (points[some, axis] / 3.0 + 0.5).tolist()
        found = texcoords[some, column].tolist()
        yield Claim("texturesurf.c", f"{name}, at five points", expected, found, 1e-6)
