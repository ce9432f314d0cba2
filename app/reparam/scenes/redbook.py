"""What the evaluator programs of the OpenGL Programming Guide (the Red Book, chapter 12) share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..evaluators.recorder import Recorder
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


def rotation(degrees: float, axis: tuple[float, float, float]) -> Array:
    """The matrix (3, 3) of glRotate, for column vectors (Rodrigues)."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    a = np.radians(degrees)
    turn = np.eye(3) + np.sin(a) * cross + (1.0 - np.cos(a)) * cross @ cross
    return np.asarray(turn)


# glRotatef(85, 1, 1, 1), as the untouched view of a spatial space sees it. Turning the control
# points turns the surface.
TURN = orbit_rotation(View().azimuth, View().elevation).T @ rotation(85.0, (1.0, 1.0, 1.0))


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
