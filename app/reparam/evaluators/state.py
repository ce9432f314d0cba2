"""The evaluators' state under OpenGL's names: what is pushed, popped and asked for by glGet.

As in the OpenGL 2.1 specification, section 5.1 and its tables of state. Numbers are rounded to
float32 when they come in, as OpenGL did, in the calls ending in d as well.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.net import MAX_ORDER
from . import constants as k
from .constants import name_of
from .current_values import CurrentValues
from .definitions import CAPABILITIES, Definitions
from .errors import InvalidEnum, StackOverflow, StackUnderflow
from .grids import Axis
from .maps import Array
from .recording import Current, Single

STACK_DEPTH = 16


class State(Definitions, CurrentValues):
    """What OpenGL keeps for its evaluators. Every call here is refused inside glBegin/glEnd, but
    for the current values."""

    def __init__(self) -> None:
        super().__init__()
        self._stack: list[tuple[int, frozenset[int], dict[int, tuple[Axis, ...]], Current]] = []

    def glActiveTexture(self, texture: int) -> None:
        """Evaluators feed GL_TEXTURE0 alone: glMap is refused while another unit is active."""
        self._outside("glActiveTexture")
        if not k.GL_TEXTURE0 <= texture < k.GL_TEXTURE0 + 32:
            raise InvalidEnum(
                f"glActiveTexture: texture: expected GL_TEXTURE0 + 0..31, found {name_of(texture)}"
            )
        self._unit = texture - k.GL_TEXTURE0

    def glPushAttrib(self, mask: int) -> None:
        """Keep GL_EVAL_BIT (enables and grids; the maps stay), GL_ENABLE_BIT, GL_CURRENT_BIT.

        Raises StackOverflow the 17th time.
        """
        self._outside("glPushAttrib")
        if len(self._stack) == STACK_DEPTH:
            raise StackOverflow(f"glPushAttrib: expected at most {STACK_DEPTH} without a pop")
        self._stack.append((mask, self._enabled, dict(self._grids), self._current))

    def glPopAttrib(self) -> None:
        """Put back what the last glPushAttrib kept. Raises StackUnderflow without one."""
        self._outside("glPopAttrib")
        if not self._stack:
            raise StackUnderflow("glPopAttrib: expected a glPushAttrib before it, found none")
        mask, enabled, grids, current = self._stack.pop()
        if mask & (k.GL_EVAL_BIT | k.GL_ENABLE_BIT):
            self._enable(enabled)
        if mask & k.GL_EVAL_BIT:
            self._grids = grids
        if mask & k.GL_CURRENT_BIT:
            self._current = current

    def glGetDoublev(self, pname: int) -> Array:
        """A state value as an array of float64: grids, GL_MAX_EVAL_ORDER, current values,
        enables, stack depth, active texture. Raises InvalidEnum for others."""
        self._outside("glGet")
        if pname in CAPABILITIES:
            return np.array([float(pname in self._enabled)])
        axes = {k.GL_MAP1_GRID_DOMAIN: 1, k.GL_MAP2_GRID_DOMAIN: 2}
        if pname in axes:
            return np.array([(a.start, a.end) for a in self._grids[axes[pname]]]).ravel()
        axes = {k.GL_MAP1_GRID_SEGMENTS: 1, k.GL_MAP2_GRID_SEGMENTS: 2}
        if pname in axes:
            return np.array([float(axis.segments) for axis in self._grids[axes[pname]]])
        values: dict[int, tuple[float, ...]] = {
            k.GL_MAX_EVAL_ORDER: (MAX_ORDER,),
            k.GL_CURRENT_COLOR: self._current.color,
            k.GL_CURRENT_NORMAL: self._current.normal[:3],
            k.GL_CURRENT_TEXTURE_COORDS: self._current.texcoord,
            k.GL_CURRENT_INDEX: self._current.index[:1],
            k.GL_ATTRIB_STACK_DEPTH: (len(self._stack),),
            k.GL_MAX_ATTRIB_STACK_DEPTH: (STACK_DEPTH,),
            k.GL_ACTIVE_TEXTURE: (k.GL_TEXTURE0 + self._unit,),
        }
        if pname not in values:
            raise InvalidEnum(
                f"glGet: pname: expected a state of the evaluators, found {name_of(pname)}"
            )
        return np.array(values[pname], np.float64)

    def glGetFloatv(self, pname: int) -> Single:
        """The same as float32."""
        return self.glGetDoublev(pname).astype(np.float32)

    def glGetIntegerv(self, pname: int) -> NDArray[np.int32]:
        """The same, rounded to the nearest whole numbers."""
        return np.rint(self.glGetDoublev(pname)).astype(np.int32)
