"""The evaluators' state under OpenGL's names: maps, enables, grids, current values, queries.

As in the OpenGL 2.1 specification, section 5.1 and its tables of state. Numbers are rounded to
float32 when they come in, as OpenGL did, in the calls ending in d as well.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.net import MAX_ORDER
from . import constants as k
from .arguments import Quad, integer, interval, padded, single
from .constants import name_of
from .errors import InvalidEnum, InvalidOperation, InvalidValue, StackOverflow, StackUnderflow
from .grids import Axis
from .maps import (
    FILL,
    TARGETS,
    Array,
    Attribute,
    Map,
    Target,
    array_points,
    buffer_points,
    find_target,
    initial_map,
)
from .recording import Current, Maps, Single

STACK_DEPTH = 16
CAPABILITIES = frozenset(TARGETS) | {k.GL_AUTO_NORMAL}


@dataclass
class Vertices:
    """Between glBegin and glEnd."""

    mode: int
    dimensions: list[int] = field(default_factory=list)
    parameters: list[tuple[float, float]] = field(default_factory=list)
    positions: list[Quad] = field(default_factory=list)
    currents: list[Current] = field(default_factory=list)


class State:
    """What OpenGL keeps for its evaluators. Every call here is refused inside glBegin/glEnd, but
    for the current values."""

    def __init__(self) -> None:
        self._maps: dict[int, Map] = {t: initial_map(target) for t, target in TARGETS.items()}
        self._enabled: frozenset[int] = frozenset()
        self._feeding: dict[int, Maps] = {}
        self._winners: dict[int, list[int]] = {}
        self._grids: dict[int, tuple[Axis, ...]] = {1: (Axis(),), 2: (Axis(), Axis())}
        self._current = Current()
        self._unit = 0
        self._stack: list[tuple[int, frozenset[int], dict[int, tuple[Axis, ...]], Current]] = []
        self._begun: Vertices | None = None

    # Maps ------------------------------------------------------------------------------------

    def glMap1f(self, target: int, u1: float, u2: float, *rest: Any, offset: int = 0) -> None:
        """A curve: (target, u1, u2, stride, order, points) as in C, `points` any flat sequence
        or array; or (target, u1, u2, points) with an array (order, components).

        stride and offset count numbers. The points are copied. Raises InvalidEnum for a target
        that is none, InvalidValue for u1 = u2, an order outside 1..32, a stride less than the
        components, too few points, numbers that are not finite; InvalidOperation in glBegin.
        """
        found = self._target_to_define("glMap1f", target, 1)
        domain = (*interval("glMap1f", "u", u1, u2), 0.0, 1.0)
        if len(rest) == 1:
            points = array_points("glMap1f", found, rest[0])
        elif len(rest) == 3:
            points = buffer_points("glMap1f", found, rest[:1], rest[1:2], rest[2], offset)
        else:
            raise TypeError("glMap1f(target, u1, u2, [stride, order,] points)")
        self._define(target, Map(found, points, domain))

    def glMap2f(self, target: int, u1: float, u2: float, *rest: Any, offset: int = 0) -> None:
        """A surface: (target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points) as in C;
        or (target, u1, u2, v1, v2, points) with an array (uorder, vorder, components).

        Raises what glMap1f raises.
        """
        found = self._target_to_define("glMap2f", target, 2)
        along_u = interval("glMap2f", "u", u1, u2)
        if len(rest) == 3:
            along_v = interval("glMap2f", "v", *rest[:2])
            points = array_points("glMap2f", found, rest[2])
        elif len(rest) == 7:
            ustride, uorder, v1, v2, vstride, vorder, buffer = rest
            along_v = interval("glMap2f", "v", v1, v2)
            strides, orders = (ustride, vstride), (uorder, vorder)
            points = buffer_points("glMap2f", found, strides, orders, buffer, offset)
        else:
            raise TypeError(
                "glMap2f(target, u1, u2, [ustride, uorder,] v1, v2, [vstride, vorder,] points)"
            )
        self._define(target, Map(found, points, (*along_u, *along_v)))

    def _target_to_define(self, call: str, target: int, dimension: int) -> Target:
        self._outside(call)
        if self._unit != 0:
            raise InvalidOperation(
                f"{call}: expected GL_ACTIVE_TEXTURE to be GL_TEXTURE0, found {self._unit} above it"
            )
        return find_target(call, target, dimension)

    def _define(self, target: int, new: Map) -> None:
        self._maps[target] = new
        if target in self._enabled:
            self._feeding.pop(new.target.dimension, None)

    def glGetMapfv(self, target: int, query: int) -> Single:
        """GL_COEFF: the control points, packed, u slowest; GL_ORDER; GL_DOMAIN: float32."""
        return self._get_map("glGetMapfv", target, query).astype(np.float32)

    def glGetMapdv(self, target: int, query: int) -> Array:
        """The same as float64."""
        return self._get_map("glGetMapdv", target, query)

    def glGetMapiv(self, target: int, query: int) -> NDArray[np.int32]:
        """The same, rounded to the nearest whole numbers."""
        return np.rint(self._get_map("glGetMapiv", target, query)).astype(np.int32)

    def _get_map(self, call: str, target: int, query: int) -> Array:
        self._outside(call)
        found = find_target(call, target)
        asked = self._maps[target]
        if query == k.GL_COEFF:
            return asked.points.ravel().astype(np.float64)  # a copy: the map is OpenGL's
        if query == k.GL_ORDER:
            return np.array(asked.points.shape[: found.dimension], np.float64)
        if query == k.GL_DOMAIN:
            return np.array(asked.domain[: 2 * found.dimension])
        raise InvalidEnum(
            f"{call}: query: expected GL_COEFF, GL_ORDER or GL_DOMAIN, found {name_of(query)}"
        )

    # Capabilities ----------------------------------------------------------------------------

    def glEnable(self, cap: int) -> None:
        """Turn a map target or GL_AUTO_NORMAL on. Raises InvalidEnum for what is not ours."""
        self._enable(self._enabled | {self._capability("glEnable", cap)})

    def glDisable(self, cap: int) -> None:
        """Turn it off."""
        self._enable(self._enabled - {self._capability("glDisable", cap)})

    def glIsEnabled(self, cap: int) -> bool:
        """Whether it is on."""
        return self._capability("glIsEnabled", cap) in self._enabled

    def _capability(self, call: str, cap: int) -> int:
        self._outside(call)
        if cap not in CAPABILITIES:
            raise InvalidEnum(
                f"{call}: cap: expected a map target or GL_AUTO_NORMAL, found {name_of(cap)}; "
                "what does not concern evaluators is moderngl's"
            )
        return int(cap)

    def _fed(self, dimension: int) -> Maps:
        """The maps in force; of those for one attribute TARGETS has the winner first."""
        if dimension not in self._feeding:
            if dimension not in self._winners:
                self._winners[dimension] = self._win(dimension)
            auto = dimension == 2 and k.GL_AUTO_NORMAL in self._enabled
            feeds = tuple([self._maps[number] for number in self._winners[dimension]])
            self._feeding[dimension] = Maps(feeds, auto)
        return self._feeding[dimension]

    def _win(self, dimension: int) -> list[int]:
        """The enabled targets that feed something."""
        found: dict[Attribute, int] = {}
        for number, target in TARGETS.items():
            if target.dimension == dimension and number in self._enabled:
                found.setdefault(target.attribute, number)
        if dimension == 2 and k.GL_AUTO_NORMAL in self._enabled:
            found.pop("normal", None)
        return list(found.values())

    def _enable(self, enabled: frozenset[int]) -> None:
        self._enabled = enabled
        self._feeding.clear()
        self._winners.clear()

    # Grids ------------------------------------------------------------------------------------

    def glMapGrid1f(self, un: int, u1: float, u2: float) -> None:
        """The grid of glEvalMesh1 and glEvalPoint1: un segments from u1 to u2.

        Raises InvalidValue for un < 1.
        """
        self._outside("glMapGrid1f")
        self._grids[1] = (_axis("glMapGrid1f", "u", un, u1, u2),)

    def glMapGrid2f(self, un: int, u1: float, u2: float, vn: int, v1: float, v2: float) -> None:
        """The grid of glEvalMesh2 and glEvalPoint2."""
        self._outside("glMapGrid2f")
        along_u = _axis("glMapGrid2f", "u", un, u1, u2)
        self._grids[2] = (along_u, _axis("glMapGrid2f", "v", vn, v1, v2))

    # Current values --------------------------------------------------------------------------

    def glColor(self, *color: Any) -> None:
        """The colour of what no map colours: 3 or 4 numbers, or one sequence of them."""
        self._set_current("glColor", "color", color, (3, 4))

    def glNormal(self, *normal: Any) -> None:
        """The normal of what no map gives one: 3 numbers, or one sequence of them."""
        self._set_current("glNormal", "normal", normal, (3,))

    def glTexCoord(self, *texcoord: Any) -> None:
        """The texture coordinates of what no map gives any: 1 to 4 numbers, or one sequence."""
        self._set_current("glTexCoord", "texcoord", texcoord, (1, 2, 3, 4))

    def glIndex(self, *index: Any) -> None:
        """The colour index of what no map gives one."""
        self._set_current("glIndex", "index", index, (1,))

    def _set_current(
        self, call: str, attribute: Attribute, values: tuple[Any, ...], counts: tuple[int, ...]
    ) -> None:
        new = padded(call, attribute, values, counts, FILL[attribute])
        self._current = replace(self._current, **{attribute: new})

    glColor3f = glColor3d = glColor3fv = glColor3dv = glColor
    glColor4f = glColor4d = glColor4fv = glColor4dv = glColor
    glNormal3f = glNormal3d = glNormal3fv = glNormal3dv = glNormal
    glTexCoord1f = glTexCoord1d = glTexCoord2f = glTexCoord2d = glTexCoord
    glTexCoord3f = glTexCoord3d = glTexCoord4f = glTexCoord4d = glTexCoord
    glTexCoord1fv = glTexCoord2fv = glTexCoord3fv = glTexCoord4fv = glTexCoord
    glIndexf = glIndexd = glIndex

    # State -----------------------------------------------------------------------------------

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

    def _outside(self, call: str) -> None:
        if self._begun is not None:
            raise InvalidOperation(f"{call}: expected outside glBegin/glEnd, found inside")

    def _inside(self, call: str) -> Vertices:
        if self._begun is None:
            raise InvalidOperation(f"{call}: expected between glBegin and glEnd, found outside")
        return self._begun

    glMap1d, glMap2d = glMap1f, glMap2f
    glMapGrid1d, glMapGrid2d = glMapGrid1f, glMapGrid2f


def _axis(call: str, letter: str, segments: object, start: object, end: object) -> Axis:
    count = integer(call, f"{letter}n", segments)
    if count < 1:
        raise InvalidValue(f"{call}: {letter}n: expected at least 1, found {count}")
    return Axis(count, single(call, f"{letter}1", start), single(call, f"{letter}2", end))
