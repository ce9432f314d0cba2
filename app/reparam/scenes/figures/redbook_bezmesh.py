"""bezmesh of the OpenGL Programming Guide: a lit, filled mesh with automatic normals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from ...evaluators.constants import GL_AUTO_NORMAL, GL_FILL, GL_MAP2_VERTEX_3
from ...evaluators.light import Light
from ...evaluators.recorder import Recorder
from ..claims import Claim
from ..layers import Array, Figure, Recorded
from ..parameters import Points, Range
from ..redbook import POINTS_HELP, SURFACE, define_surface, evaluated_mesh, outline, surface_figure
from ..registry import scene

# Its initlights(): the model's ambient light is OpenGL's own.
LIGHT = Light(
    position=(0.0, 0.0, 2.0, 1.0),
    ambient=(0.2, 0.2, 0.2),
    material_diffuse=(0.6, 0.6, 0.6),
    material_specular=(1.0, 1.0, 1.0),
    shininess=50.0,
)


@scene("The Red Book's bezmesh: glEvalMesh2, lit")
def redbook_bezmesh(
    grid: Annotated[int, Range(1, 256), "segments of glMapGrid2 in each direction"] = 20,
    points: Annotated[Array, Points((4, 4, 3), POINTS_HELP)] = SURFACE,
) -> Figure:
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, points)
    gl.glEnable(GL_AUTO_NORMAL)
    gl.glMapGrid2f(grid, 0, 1, grid, 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, grid, 0, grid)
    return surface_figure(
        points,
        (Recorded(gl.take(), LIGHT), outline(points)),
        f"glEnable(GL_AUTO_NORMAL);   glMapGrid2f({grid}, 0, 1, {grid}, 0, 1);",
        f"glEvalMesh2(GL_FILL, 0, {grid}, 0, {grid});",
    )


@redbook_bezmesh.claims
def claims() -> Iterator[Claim]:
    """x = 3u - 3/2 and y = 3v - 3/2, so it is the graph of z; z_x and z_y by differences."""
    gl = Recorder()
    define_surface(gl, GL_MAP2_VERTEX_3, SURFACE)
    gl.glEnable(GL_AUTO_NORMAL)
    _, normals, _ = evaluated_mesh(gl)
    for place, vertex, slopes in (
        ("in the middle", 12, (-1 / 4, -5 / 16)),
        ("at (0,0)", 0, (-2.0, -3.0)),
        ("at (1,1)", 24, (-1.0, -5.0)),
    ):
        normal = np.array([-slopes[0], -slopes[1], 1.0])
        expected = (normal / np.linalg.norm(normal)).tolist()
        statement = f"GL_AUTO_NORMAL {place} is (-z_x, -z_y, 1), normalised"
        yield Claim("bezmesh.c", statement, expected, normals[vertex].tolist(), 1e-6)
