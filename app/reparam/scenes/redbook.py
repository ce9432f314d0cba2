"""What the evaluator programs of the OpenGL Programming Guide (the Red Book, chapter 12) share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..evaluators.constants import GL_POINT
from ..evaluators.matrices import rotate
from ..evaluators.recorder import Recorder
from ..evaluators.tessellations import read_float64
from ..geometry.camera import View, orbit_rotation
from ..geometry.evaluate import sample_surface
from ..geometry.net import control_net
from . import palette
from .layers import Array, ControlNet, Figure, Handles, IsoLines, Layer, Space

# ctrlpoints[4][4][3] of bezsurf.c, bezmesh.c and texturesurf.c. Their glMap2f has ustride 3 and
# vstride 12: u goes with the last index.
SURFACE = np.array([
    [(-1.5, -1.5, 4.0), (-0.5, -1.5, 2.0), (0.5, -1.5, -1.0), (1.5, -1.5, 2.0)],
    [(-1.5, -0.5, 1.0), (-0.5, -0.5, 3.0), (0.5, -0.5, 0.0), (1.5, -0.5, -1.0)],
    [(-1.5, 0.5, 4.0), (-0.5, 0.5, 0.0), (0.5, 0.5, 3.0), (1.5, 0.5, 4.0)],
    [(-1.5, 1.5, -2.0), (-0.5, 1.5, -2.0), (0.5, 1.5, 0.0), (1.5, 1.5, -1.0)],
])  # fmt: skip
NAMES = tuple(f"ctrlpoints[{i}][{j}]" for i in range(4) for j in range(4))
POINTS_HELP = "the control points ctrlpoints[i][j], j going with u"


# glRotatef(85, 1, 1, 1), as the untouched view of a spatial space sees it. Turning the control
# points turns the surface.
TURN = orbit_rotation(View().azimuth, View().elevation).T @ rotate(85.0, 1.0, 1.0, 1.0)[:3, :3]


def turned(points: Array) -> Array:
    """Control points (..., 3) in the programs' view."""
    return np.asarray(points @ TURN.T)


def drag_point(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
    """One control point follows the hand, back in the program's own coordinates."""
    points = values["points"].copy()
    points.reshape(-1, 3)[index] = point @ TURN
    return {"points": points}


def define_surface(gl: Recorder, target: int, points: Array) -> None:
    """The programs' glMap2f and glEnable, of the turned points."""
    gl.glMap2f(target, 0, 1, 3, 4, 0, 1, 12, 4, turned(points))
    gl.glEnable(target)


def evaluated_mesh(gl: Recorder) -> tuple[Array, Array, Array]:
    """The programs' glEvalMesh2 of 4 x 4 cells, as points (25, 3), unit normals (25, 3) and texture
    coordinates (25, 4), in the program's own coordinates: turned back."""
    gl.glMapGrid2f(4, 0, 1, 4, 0, 1)
    gl.glEvalMesh2(GL_POINT, 0, 4, 0, 4)
    (mesh,) = read_float64(gl.take())
    points, normals = (values.astype(np.float64) @ TURN for values in (mesh.points, mesh.normals))
    return points, normals, mesh.texcoords.astype(np.float64)


def outline(points: Array) -> IsoLines:
    """The edges of the surface: a bright one stands out from the ground."""
    net = control_net(turned(points))
    return IsoLines(net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.0)


def surface_figure(points: Array, layers: tuple[Layer, ...], *calls: str) -> Figure:
    """The surface with its handles; the calls that draw it stand beneath."""
    shown = turned(points)
    net = control_net(shown)
    hand = Handles(shown.reshape(-1, 3), drag_point, NAMES, quiet=True)
    layers = (*layers, ControlNet(net, palette.CONTROL_NET), hand)
    return Figure((Space("physical", sample_surface(net), layers, spatial=True),), calls)
