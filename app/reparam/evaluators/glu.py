"""GLU's NURBS interface, name by name.

    from reparam.evaluators.glu import *

Each function is the method of its name of a NurbsRenderer, which C calls nobj. Besides, what it
recorded can be had as what `Evaluators.draw` draws, as arrays, and at any (u, v).
"""

from __future__ import annotations

from . import glu_constants
from .glu_constants import *  # noqa: F403
from .glu_errors import *  # noqa: F403
from .glu_errors import NURBS_ERRORS, GluError, GluInvalidEnum, GluInvalidValue, NurbsError
from .nurbs_parts import recording
from .nurbs_properties import View
from .nurbs_renderer import NurbsRenderer
from .tessellations import evaluate_at, tessellate

gluNewNurbsRenderer = NurbsRenderer
gluBeginSurface = NurbsRenderer.gluBeginSurface
gluNurbsSurface = NurbsRenderer.gluNurbsSurface
gluEndSurface = NurbsRenderer.gluEndSurface
gluBeginCurve = NurbsRenderer.gluBeginCurve
gluNurbsCurve = NurbsRenderer.gluNurbsCurve
gluEndCurve = NurbsRenderer.gluEndCurve
gluBeginTrim = NurbsRenderer.gluBeginTrim
gluPwlCurve = NurbsRenderer.gluPwlCurve
gluEndTrim = NurbsRenderer.gluEndTrim
gluNurbsProperty = NurbsRenderer.gluNurbsProperty
gluGetNurbsProperty = NurbsRenderer.gluGetNurbsProperty
gluLoadSamplingMatrices = NurbsRenderer.gluLoadSamplingMatrices
gluNurbsCallback = NurbsRenderer.gluNurbsCallback
gluNurbsCallbackData = NurbsRenderer.gluNurbsCallbackData


def gluDeleteNurbsRenderer(nurb: NurbsRenderer) -> None:
    """Python's garbage collector does it; kept so that programs need no change."""


def gluErrorString(code: int) -> str:
    """What GLU says about an error's code; "" for one that is none of these."""
    names = {GluInvalidEnum.code: "invalid enumerant", GluInvalidValue.code: "invalid value"}
    meanings = {error.code: error.meaning for error in NURBS_ERRORS.values()}
    return {**names, **meanings}.get(code, "")


__all__ = [
    "NURBS_ERRORS",
    "GluError",
    "GluInvalidEnum",
    "GluInvalidValue",
    "NurbsError",
    "NurbsRenderer",
    "View",
    "evaluate_at",
    "recording",
    "tessellate",
    *(name for name in vars(glu_constants) if name.startswith("GLU_")),
    *(error.__name__ for error in NURBS_ERRORS.values()),
    *(name for name in list(globals()) if name.startswith("glu") and name[3:4].isupper()),
]
