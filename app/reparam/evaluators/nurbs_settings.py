"""What a GLUnurbs object is set to: properties, sampling matrices, callbacks, where errors go."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from . import glu_constants as k
from .glu_errors import GluError, GluInvalidEnum, GluInvalidValue
from .nurbs_properties import UNLOADED, Properties, View, changed, value_of

CALLBACKS = (k.GLU_NURBS_ERROR, *range(k.GLU_NURBS_BEGIN, k.GLU_NURBS_END_DATA + 1))


class NurbsSettings:
    """The calls that record nothing."""

    def __init__(self, matrices: Callable[[], View] | None = None) -> None:
        self.properties = Properties()
        self._matrices = matrices
        self._view = UNLOADED
        self._callbacks: dict[int, Callable[..., None]] = {}
        self._data: Any = None

    def gluNurbsProperty(self, property: int, value: float) -> None:
        """Raises GluInvalidEnum for an unknown property, GluInvalidValue for a bad value."""
        try:
            self.properties = changed(self.properties, property, value)
        except GluError as error:
            self._fail(error)

    def gluGetNurbsProperty(self, property: int) -> float:
        """The property's value. Raises GluInvalidEnum for an unknown one."""
        return value_of(self.properties, property)

    def gluLoadSamplingMatrices(
        self, modelMatrix: ArrayLike, projMatrix: ArrayLike, viewport: ArrayLike
    ) -> None:
        """What pixels are measured by: 16 numbers each, as OpenGL has them, and four."""
        self._view = View.load(modelMatrix, projMatrix, viewport)

    def gluNurbsCallback(self, which: int, function: Callable[..., None] | None) -> None:
        """Sets a callback; None takes it away. Raises GluInvalidEnum for an unknown one."""
        if which not in CALLBACKS:
            self._fail(
                GluInvalidEnum(f"gluNurbsCallback: which: expected GLU_NURBS_..., found {which!r}")
            )
        elif not (function is None or callable(function)):
            self._fail(
                GluInvalidValue(
                    f"gluNurbsCallback: function: expected a function or None, found {function!r}"
                )
            )
        elif function is None:
            self._callbacks.pop(which, None)
        else:
            self._callbacks[which] = function

    def gluNurbsCallbackData(self, userData: Any) -> None:
        """What the GLU_NURBS_..._DATA callbacks get as their last argument."""
        self._data = userData

    def _fail(self, error: GluError) -> None:
        callback = self._callbacks.get(k.GLU_NURBS_ERROR)
        if callback is None:
            raise error
        callback(error.code)

    def _current_view(self) -> View:
        if self.properties.auto_load_matrix and self._matrices is not None:
            return self._matrices()
        return self._view
