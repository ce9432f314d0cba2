"""glMap, glEnable, glMapGrid and glGetMap: which maps there are, and which feed what."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import constants as k
from .arguments import integer, interval, single
from .constants import name_of
from .errors import InvalidEnum, InvalidOperation, InvalidValue
from .grids import Axis
from .maps import (
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
from .phase import Phase
from .recording import Maps, Single

CAPABILITIES = frozenset(TARGETS) | {k.GL_AUTO_NORMAL}


class Definitions(Phase):
    """The maps, the enables and the grids. Every call here is refused inside glBegin/glEnd."""

    def __init__(self) -> None:
        super().__init__()
        self._maps: dict[int, Map] = {t: initial_map(target) for t, target in TARGETS.items()}
        self._enabled: frozenset[int] = frozenset()
        self._feeding: dict[int, Maps] = {}
        self._winners: dict[int, list[int]] = {}
        self._grids: dict[int, tuple[Axis, ...]] = {1: (Axis(),), 2: (Axis(), Axis())}
        self._unit = 0

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

    glMap1d, glMap2d = glMap1f, glMap2f
    glMapGrid1d, glMapGrid2d = glMapGrid1f, glMapGrid2f


def _axis(call: str, letter: str, segments: object, start: object, end: object) -> Axis:
    count = integer(call, f"{letter}n", segments)
    if count < 1:
        raise InvalidValue(f"{call}: {letter}n: expected at least 1, found {count}")
    return Axis(count, single(call, f"{letter}1", start), single(call, f"{letter}2", end))
