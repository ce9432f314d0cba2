"""gluNurbsProperty: the properties with GLU's names, defaults and allowed values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike

from ..geometry.net import Array
from .glu_constants import (
    GLU_AUTO_LOAD_MATRIX,
    GLU_CULLING,
    GLU_DISPLAY_MODE,
    GLU_DOMAIN_DISTANCE,
    GLU_FILL,
    GLU_NURBS_MODE,
    GLU_NURBS_RENDERER,
    GLU_NURBS_TESSELLATOR,
    GLU_OBJECT_PARAMETRIC_ERROR,
    GLU_OBJECT_PATH_LENGTH,
    GLU_OUTLINE_PATCH,
    GLU_OUTLINE_POLYGON,
    GLU_PARAMETRIC_ERROR,
    GLU_PARAMETRIC_TOLERANCE,
    GLU_PATH_LENGTH,
    GLU_SAMPLING_METHOD,
    GLU_SAMPLING_TOLERANCE,
    GLU_U_STEP,
    GLU_V_STEP,
    NAMES,
)
from .glu_errors import GluError, GluInvalidEnum, GluInvalidValue


@dataclass(frozen=True)
class Properties:
    """What a surface or curve is drawn by: the properties when it ends.

    Tolerances are in pixels, or in object units with the GLU_OBJECT_ methods; steps are samples
    per unit of the parameter.
    """

    sampling_method: int = GLU_PATH_LENGTH
    sampling_tolerance: float = 50.0
    parametric_tolerance: float = 0.5
    u_step: float = 100.0
    v_step: float = 100.0
    culling: bool = False
    auto_load_matrix: bool = True
    display_mode: int = GLU_FILL
    mode: int = GLU_NURBS_RENDERER


SAMPLING_METHODS = (GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR, GLU_DOMAIN_DISTANCE,
                    GLU_OBJECT_PATH_LENGTH, GLU_OBJECT_PARAMETRIC_ERROR)  # fmt: skip
DISPLAY_MODES = (GLU_FILL, GLU_OUTLINE_POLYGON, GLU_OUTLINE_PATCH)
MODES = (GLU_NURBS_RENDERER, GLU_NURBS_TESSELLATOR)


def _positive(value: float) -> float | None:
    return value if isfinite(value) and value > 0.0 else None


def _one_of(*values: int) -> Callable[[float], int | None]:
    return lambda value: int(value) if value in values else None


def _names(values: tuple[int, ...]) -> str:
    return " or ".join(NAMES[value] for value in values)


# property: field, the value as it is kept (None: refused), what is expected, the error
_TABLE: dict[int, tuple[str, Callable[[float], float | None], str, type[GluError]]] = {
    GLU_SAMPLING_METHOD: (
        "sampling_method", _one_of(*SAMPLING_METHODS), _names(SAMPLING_METHODS), GluInvalidValue),
    GLU_SAMPLING_TOLERANCE: (
        "sampling_tolerance", _positive, "a number above 0", GluInvalidValue),
    GLU_PARAMETRIC_TOLERANCE: (
        "parametric_tolerance", _positive, "a number above 0", GluInvalidValue),
    GLU_U_STEP: ("u_step", _positive, "a number above 0", GluInvalidValue),
    GLU_V_STEP: ("v_step", _positive, "a number above 0", GluInvalidValue),
    GLU_CULLING: ("culling", bool, "true or false", GluInvalidValue),
    GLU_AUTO_LOAD_MATRIX: ("auto_load_matrix", bool, "true or false", GluInvalidValue),
    GLU_DISPLAY_MODE: (
        "display_mode", _one_of(*DISPLAY_MODES), _names(DISPLAY_MODES), GluInvalidValue),
    GLU_NURBS_MODE: ("mode", _one_of(*MODES), _names(MODES), GluInvalidEnum),
}  # fmt: skip


def _row(call: str, name: int) -> tuple[str, Callable[[float], float | None], str, type[GluError]]:
    if name not in _TABLE:
        wanted = ", ".join(NAMES[known] for known in _TABLE)
        raise GluInvalidEnum(f"{call}: property: expected one of {wanted}, found {name!r}")
    return _TABLE[name]


def changed(properties: Properties, name: int, value: float) -> Properties:
    """With one property set. Raises GluInvalidEnum or GluInvalidValue."""
    field, keep, expected, error = _row("gluNurbsProperty", name)
    try:
        kept, found = keep(float(value)), f"{value:g}"
    except (TypeError, ValueError):
        kept, found = None, repr(value)
    if kept is None:
        raise error(f"gluNurbsProperty: {NAMES[name]}: expected {expected}, found {found}")
    return replace(properties, **{field: kept})  # type: ignore[arg-type]


def value_of(properties: Properties, name: int) -> float:
    """A property as gluGetNurbsProperty hands it back. Raises GluInvalidEnum."""
    return float(getattr(properties, _row("gluGetNurbsProperty", name)[0]))


def _numbers(values: ArrayLike) -> Array:
    """In one row; none where they are no numbers."""
    try:
        return np.asarray(values, dtype=np.float64).ravel()
    except (TypeError, ValueError):
        return np.zeros(0)


@dataclass(frozen=True, eq=False)
class View:
    """The sampling matrices, (4, 4) acting on columns, and the viewport (x, y, width, height)."""

    modelview: Array
    projection: Array
    viewport: tuple[int, int, int, int]

    @staticmethod
    def load(modelview: ArrayLike, projection: ArrayLike, viewport: ArrayLike) -> View:
        """From what gluLoadSamplingMatrices takes: 16 numbers each, column after column.

        (A (4, 4) numpy array counts by rows, so it is the transposed matrix, as for glLoadMatrix.)
        Raises GluInvalidValue.
        """
        matrices = []
        for name, numbers in (("modelMatrix", modelview), ("projMatrix", projection)):
            matrix = _numbers(numbers)
            if matrix.shape != (16,) or not np.isfinite(matrix).all():
                raise GluInvalidValue(
                    f"gluLoadSamplingMatrices: {name}: expected 16 finite numbers, "
                    f"found {matrix.size}"
                )
            matrices.append(matrix.reshape(4, 4).T)
        corners = _numbers(viewport)
        if len(corners) != 4 or not np.isfinite(corners).all() or min(corners[2:]) < 0.0:
            raise GluInvalidValue(
                "gluLoadSamplingMatrices: viewport: expected x, y, width, height, "
                f"found {viewport!r}"
            )
        corners = corners.astype(int).tolist()
        return View(matrices[0], matrices[1], (corners[0], corners[1], corners[2], corners[3]))

    @property
    def clip_from_object(self) -> Array:
        """(4, 4), from homogeneous points to clip coordinates."""
        return np.asarray(self.projection @ self.modelview)

    @property
    def pixels_from_object(self) -> Array:
        """(3, 4), from homogeneous points to homogeneous pixels (w px, w py, w)."""
        x, y, width, height = self.viewport
        pixels = np.array([[width / 2, 0.0, 0.0, x + width / 2],
                           [0.0, height / 2, 0.0, y + height / 2],
                           [0.0, 0.0, 0.0, 1.0]])  # fmt: skip
        return np.asarray(pixels @ self.clip_from_object)


UNLOADED = View(np.eye(4), np.eye(4), (0, 0, 512, 512))
"""Before matrices are loaded: the model in [-1,1]^3, on a picture of 512 x 512."""
