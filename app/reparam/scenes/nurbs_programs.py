"""What the NURBS programs of the OpenGL Programming Guide (the Red Book, chapter 12) share.

Sizes in pixels are those of the programs' own matrices and window, whatever the view here.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np

from ..evaluators import glu_constants as k
from ..evaluators.light import Light
from ..evaluators.matrices import perspective, rotate
from ..evaluators.nurbs_parts import recording
from ..evaluators.nurbs_renderer import NurbsRenderer
from ..evaluators.recording import Current
from ..evaluators.splines import Nurbs
from ..geometry.camera import View, orbit_rotation
from . import palette
from .layers import Array, Recorded
from .parameters import Range

VIEWPORT = (0, 0, 500, 500)
KNOTS = (0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0)
LOW, HIGH = -3.0, 3.0
# ctlpoints[4][4][3] of surface.c and trim.c: a symmetrical hill.
HILL = np.array([
    [(2.0 * u - 3.0, 2.0 * v - 3.0, HIGH if u in (1, 2) and v in (1, 2) else LOW)
     for v in range(4)] for u in range(4)
])  # fmt: skip
POINTS_HELP = "the control points ctlpoints[u][v]"
NAMES = tuple(f"ctlpoints[{u}][{v}]" for u in range(4) for v in range(4))

METHODS = {
    "path-length": k.GLU_PATH_LENGTH,
    "parametric-error": k.GLU_PARAMETRIC_ERROR,
    "domain-distance": k.GLU_DOMAIN_DISTANCE,
}
MODES = {
    "fill": k.GLU_FILL,
    "outline-polygon": k.GLU_OUTLINE_POLYGON,
    "outline-patch": k.GLU_OUTLINE_PATCH,
}
Sampling = Annotated[
    Literal["path-length", "parametric-error", "domain-distance"],
    "GLU_SAMPLING_METHOD: edges, or errors, of so many pixels; or so many steps a unit",
]
Pixels = Annotated[
    float, Range(0.5, 200, 5), "pixels of edges or errors in a window of 500 x 500; steps a unit"
]
Display = Annotated[Literal["fill", "outline-polygon", "outline-patch"], "GLU_DISPLAY_MODE"]

# surface.c and trim.c: one light from the eye, a grey that shines.
LIGHT = Light(material_diffuse=(0.7, 0.7, 0.7), material_specular=(1.0, 1.0, 1.0), shininess=100.0)
PROGRAM_TURN = rotate(330.0, 1.0, 0.0, 0.0)[:3, :3]  # glRotatef(330, 1, 0, 0)


def seen(turn: Array) -> Array:
    """A rotation (3, 3) of a program, as the untouched view of a spatial space shows it."""
    return np.asarray(orbit_rotation(View().azimuth, View().elevation).T @ turn)


def affine(linear: Array, translation: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Array:
    """The matrix (4, 4) of x -> linear x + translation."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = linear, translation
    return matrix


def new_renderer(
    sampling: str, tolerance: float, display: str, modelview: Array, projection: Array
) -> NurbsRenderer:
    """gluNewNurbsRenderer with the properties and the matrices (4, 4) of a program."""
    nurb = NurbsRenderer()
    nurb.gluNurbsProperty(k.GLU_SAMPLING_METHOD, METHODS[sampling])
    for name in (k.GLU_SAMPLING_TOLERANCE, k.GLU_PARAMETRIC_TOLERANCE, k.GLU_U_STEP, k.GLU_V_STEP):
        nurb.gluNurbsProperty(name, tolerance)
    nurb.gluNurbsProperty(k.GLU_DISPLAY_MODE, MODES[display])
    nurb.gluLoadSamplingMatrices(modelview.T, projection.T, VIEWPORT)
    return nurb


def hill_renderer(sampling: str, tolerance: float, display: str) -> NurbsRenderer:
    """That of surface.c and trim.c, for control points turned by `seen(PROGRAM_TURN)`."""
    back = PROGRAM_TURN @ seen(PROGRAM_TURN).T
    modelview = affine(0.5 * back, (0.0, 0.0, -5.0))
    return new_renderer(sampling, tolerance, display, modelview, perspective(45.0, 1.0, 3.0, 8.0))


def properties_caption(sampling: str, tolerance: float, display: str) -> str:
    """The gluNurbsProperty calls in words of C."""
    if sampling == "domain-distance":
        kept = f"GLU_U_STEP, GLU_V_STEP, {tolerance:g}"
    else:
        word = "SAMPLING" if sampling == "path-length" else "PARAMETRIC"
        kept = f"GLU_{word}_TOLERANCE, {tolerance:g}"
    method, mode = k.NAMES[METHODS[sampling]], k.NAMES[MODES[display]]
    return f"{method},   {kept},   {mode}"


def drawn(nurbs: Nurbs, light: Light) -> Recorded:
    """The surface, lit; or its lines in ink."""
    lines = nurbs.properties.display_mode != k.GLU_FILL
    current = Current(color=(*palette.INK, 1.0)) if lines else None
    return Recorded(recording(nurbs, current=current), None if lines else light, width=1.0)


def drag_hill(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
    """One control point of the hill follows the hand, back in the program's own coordinates."""
    points = values["points"].copy()
    points.reshape(-1, 3)[index] = point @ seen(PROGRAM_TURN)
    return {"points": points}
