"""The calls that make vertices: recorded here, evaluated by gpu/.

    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, points)
    gl.glEnable(GL_MAP2_VERTEX_3)
    gl.glMapGrid2f(20, 0, 1, 20, 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, 20, 0, 20)

docs/porting.md says where this is right and the originals were not.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import constants as k
from .arguments import Quad, integer, numbers, padded, single
from .constants import PRIMITIVES, name_of
from .errors import InvalidEnum, InvalidValue
from .grids import Axis, Grid, Walk, grid_of
from .maps import FILL, Array, Attribute
from .phase import Vertices
from .recording import HAVE_CURRENT, Collection, Mesh, Recording
from .state import State

MOST_POINTS = 1 << 26  # of one mesh


class Recorder(State):
    """The evaluators' state, and the calls that record a mesh. No OpenGL is needed."""

    def __init__(self) -> None:
        super().__init__()
        self._items: list[Mesh | Collection] = []

    def take(self) -> Recording:
        """All that was recorded since the last time, to be drawn or read as often as one likes.

        Raises InvalidOperation inside glBegin/glEnd.
        """
        self._outside("take")
        recording, self._items = Recording(tuple(self._items)), []
        return recording

    # Meshes ----------------------------------------------------------------------------------

    def glEvalMesh1(self, mode: int, i1: int, i2: int) -> None:
        """Record points i1..i2 of the grid as GL_POINT, or joined as GL_LINE.

        Indices outside the grid extrapolate. Without a vertex map, nothing. Raises InvalidEnum
        for another mode, InvalidOperation inside glBegin/glEnd.
        """
        self._mesh_mode("glEvalMesh1", mode, (k.GL_POINT, k.GL_LINE))
        first, last = integer("glEvalMesh1", "i1", i1), integer("glEvalMesh1", "i2", i2)
        self._record_mesh(1, mode, grid_of(*self._grids[1], first, last, Axis(), 0, 0))

    def glEvalMesh2(self, mode: int, i1: int, i2: int, j1: int, j2: int) -> None:
        """Record points (i1..i2, j1..j2) of the grid as GL_POINT, GL_LINE or GL_FILL.

        The triangles of GL_FILL wind counter-clockwise about d/du x d/dv.
        """
        self._mesh_mode("glEvalMesh2", mode, (k.GL_POINT, k.GL_LINE, k.GL_FILL))
        u, v = self._grids[2]
        along_u = (integer("glEvalMesh2", "i1", i1), integer("glEvalMesh2", "i2", i2))
        along_v = (integer("glEvalMesh2", "j1", j1), integer("glEvalMesh2", "j2", j2))
        self._record_mesh(2, mode, grid_of(u, *along_u, v, *along_v))

    def _mesh_mode(self, call: str, mode: int, allowed: tuple[int, ...]) -> None:
        self._outside(call)
        if mode not in allowed:
            expected = " or ".join(name_of(one) for one in allowed)
            raise InvalidEnum(f"{call}: mode: expected {expected}, found {name_of(mode)}")

    def _record_mesh(self, dimension: int, mode: int, grid: Grid) -> None:
        maps = self._fed(dimension)
        if grid.shape[0] * grid.shape[1] > MOST_POINTS:
            raise InvalidValue(
                f"glEvalMesh{dimension}: expected at most {MOST_POINTS} points, "
                f"found {grid.shape[0] * grid.shape[1]}"
            )
        if maps.makes_vertices and min(grid.shape) > 0:
            self._items.append(Mesh(maps, grid, mode, self._current))

    # glBegin, glEvalCoord, glEnd -------------------------------------------------------------

    def glBegin(self, mode: int) -> None:
        """Begin GL_POINTS ... GL_POLYGON, of vertices that glEvalCoord, glEvalPoint, glVertex give.

        Raises InvalidEnum for another mode, InvalidOperation inside glBegin/glEnd.
        """
        self._outside("glBegin")
        if mode not in PRIMITIVES:
            raise InvalidEnum(
                f"glBegin: mode: expected GL_POINTS ... GL_POLYGON, found {name_of(mode)}"
            )
        self._begun = Vertices(mode)

    def glEnd(self) -> None:
        """Record what was begun. Raises InvalidOperation without glBegin."""
        begun, self._begun = self._inside("glEnd"), None
        if not begun.positions:
            return
        given: dict[Attribute, Array] = {"vertex": np.array(begun.positions)}
        for attribute in HAVE_CURRENT:
            given[attribute] = np.array([c.value(attribute) for c in begun.currents])
        dimensions = np.array(begun.dimensions, np.int8)
        maps = {dimension: self._fed(dimension) for dimension in set(begun.dimensions) - {0}}
        parameters = np.array(begun.parameters)
        self._items.append(Collection(begun.mode, maps, dimensions, parameters, given))

    def glEvalCoord1f(self, u: float) -> None:
        """A vertex of the curve at u, with all that its maps feed; the current values stay.

        Without a vertex map, none. Raises InvalidOperation outside glBegin/glEnd.
        """
        self._evaluate("glEvalCoord1f", 1, single("glEvalCoord1f", "u", u), 0.0)

    def glEvalCoord2f(self, u: float, v: float) -> None:
        """A vertex of the surface at (u,v)."""
        call = "glEvalCoord2f"
        self._evaluate(call, 2, single(call, "u", u), single(call, "v", v))

    def glEvalCoord1fv(self, u: ArrayLike) -> None:
        """glEvalCoord1f of a sequence of one number."""
        self.glEvalCoord1f(*numbers("glEvalCoord1fv", "u", u, (1,)))

    def glEvalCoord2fv(self, u: ArrayLike) -> None:
        """glEvalCoord2f of a sequence of two numbers."""
        self.glEvalCoord2f(*numbers("glEvalCoord2fv", "u", u, (2,)))

    def glEvalPoint1(self, i: int) -> None:
        """glEvalCoord1 at point i of the grid: the same bits as glEvalMesh1 has there."""
        walk = _walk("glEvalPoint1", self._grids[1][0], "i", i)
        self._evaluate("glEvalPoint1", 1, float(walk.values()[0]), 0.0)

    def glEvalPoint2(self, i: int, j: int) -> None:
        """glEvalCoord2 at point (i,j) of the grid."""
        u, v = self._grids[2]
        at = (_walk("glEvalPoint2", u, "i", i), _walk("glEvalPoint2", v, "j", j))
        self._evaluate("glEvalPoint2", 2, *(float(walk.values()[0]) for walk in at))

    def _evaluate(self, call: str, dimension: int, u: float, v: float) -> None:
        begun = self._inside(call)
        if self._fed(dimension).makes_vertices:
            self._add(begun, dimension, (u, v), FILL["vertex"])

    def _add(
        self, begun: Vertices, dimension: int, parameters: tuple[float, float], position: Quad
    ) -> None:
        begun.dimensions.append(dimension)
        begun.parameters.append(parameters)
        begun.positions.append(position)
        begun.currents.append(self._current)

    def glVertex(self, *position: Any) -> None:
        """A plain vertex between evaluated ones: 2, 3 or 4 numbers, or one sequence of them."""
        begun = self._inside("glVertex")
        x, y, z, w = padded("glVertex", "position", position, (2, 3, 4), FILL["vertex"])
        self._add(begun, 0, (np.nan, np.nan), (x, y, z, w))

    glVertex2i = glVertex3i = glVertex4i = glVertex2iv = glVertex3iv = glVertex4iv = glVertex
    glVertex2f = glVertex2d = glVertex2fv = glVertex2dv = glVertex
    glVertex3f = glVertex3d = glVertex3fv = glVertex3dv = glVertex
    glVertex4f = glVertex4d = glVertex4fv = glVertex4dv = glVertex

    glEvalCoord1d, glEvalCoord2d = glEvalCoord1f, glEvalCoord2f
    glEvalCoord1dv, glEvalCoord2dv = glEvalCoord1fv, glEvalCoord2fv


def _walk(call: str, axis: Axis, name: str, index: object) -> Walk:
    number = integer(call, name, index)
    return Walk(axis, number, number)
