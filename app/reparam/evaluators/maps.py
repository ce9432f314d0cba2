"""glMap1 and glMap2: what a map is, and how its control points are taken from a user's buffer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.net import LARGEST, MAX_ORDER
from . import constants
from .arguments import Quad, integer
from .constants import name_of
from .errors import InvalidEnum, InvalidValue

Array = NDArray[np.float64]
Attribute = Literal["vertex", "normal", "color", "texcoord", "index"]

FILL: dict[Attribute, Quad] = {  # what components that a map lacks are worth
    "vertex": (0.0, 0.0, 0.0, 1.0),
    "normal": (0.0, 0.0, 1.0, 0.0),
    "color": (1.0, 1.0, 1.0, 1.0),
    "texcoord": (0.0, 0.0, 0.0, 1.0),
    "index": (1.0, 0.0, 0.0, 0.0),
}


@dataclass(frozen=True)
class Target:
    """What a map of this target feeds, from how many floats a control point."""

    name: str
    dimension: Literal[1, 2]
    attribute: Attribute
    components: int


_KINDS: tuple[tuple[str, Attribute, int], ...] = (
    # The first one enabled feeds the attribute (OpenGL 2.1 specification, section 5.1).
    ("VERTEX_4", "vertex", 4),
    ("VERTEX_3", "vertex", 3),
    ("NORMAL", "normal", 3),
    ("COLOR_4", "color", 4),
    ("TEXTURE_COORD_4", "texcoord", 4),
    ("TEXTURE_COORD_3", "texcoord", 3),
    ("TEXTURE_COORD_2", "texcoord", 2),
    ("TEXTURE_COORD_1", "texcoord", 1),
    ("INDEX", "index", 1),
)
_DIMENSIONS: tuple[Literal[1, 2], ...] = (1, 2)
TARGETS: dict[int, Target] = {
    getattr(constants, f"GL_MAP{dimension}_{kind}"): Target(
        f"GL_MAP{dimension}_{kind}", dimension, attribute, components
    )
    for dimension in _DIMENSIONS
    for kind, attribute, components in _KINDS
}


@dataclass(eq=False)  # frozen would double the time of making one, and they come in thousands
class Map:
    """A map as it was defined: control points (uorder, vorder, components) and its domain.

    A curve's has vorder 1. The domain may run backwards.
    """

    target: Target
    points: NDArray[np.float32]
    domain: Quad  # u1, u2, v1, v2

    @property
    def shape(self) -> tuple[Target, tuple[int, ...], Quad]:
        """Maps of equal shape can be evaluated in one go."""
        return self.target, self.points.shape, self.domain

    @property
    def rising(self) -> Quad:
        """The domain with both intervals rising, as `net` has it."""
        u1, u2, v1, v2 = self.domain
        return min(u1, u2), max(u1, u2), min(v1, v2), max(v1, v2)

    @cached_property
    def net(self) -> Array:
        """The homogeneous net (uorder, vorder, 4) over the domain `rising`."""
        return homogeneous(self, self.points)


def homogeneous(shape: Map, points: NDArray[np.float32]) -> Array:
    """Nets (..., uorder, vorder, 4) over the domain `rising`, of maps shaped like that one.

    A domain that runs backwards is the same surface with its control points reversed; so
    derivatives, and with them the automatic normal, have the sign of d/du and d/dv as the
    specification wants.
    """
    net = np.empty((*points.shape[:-1], 4))
    net[...] = FILL[shape.target.attribute]
    net[..., : shape.target.components] = points
    along_u = 1 if shape.domain[0] < shape.domain[1] else -1
    along_v = 1 if shape.domain[2] < shape.domain[3] else -1
    return net[..., ::along_u, ::along_v, :]


def initial_map(target: Target) -> Map:
    """What glGetMap answers before glMap: order 1, constant, over [0,1]."""
    values = np.array(FILL[target.attribute][: target.components], np.float32)
    return Map(target, values.reshape(1, 1, -1), (0.0, 1.0, 0.0, 1.0))


def find_target(call: str, target: int, dimension: int | None = None) -> Target:
    """The target of that number. Raises InvalidEnum naming it."""
    found = TARGETS.get(target)
    if found is None or dimension not in (None, found.dimension):
        wanted = f"GL_MAP{dimension or '1 or 2'}_..."
        raise InvalidEnum(f"{call}: target: expected {wanted}, found {name_of(target)}")
    return found


def array_points(call: str, target: Target, points: ArrayLike) -> NDArray[np.float32]:
    """Control points (uorder, vorder, components) from a plain array (order, k) or (m, n, k)."""
    values = _numbers(call, points)
    if values.ndim != target.dimension + 1 or values.shape[-1] != target.components:
        orders = "uorder, vorder, " if target.dimension == 2 else "order, "
        raise InvalidValue(
            f"{call}: points: expected an array ({orders}{target.components}) for {target.name}, "
            f"found shape {values.shape}; a flat buffer needs its strides and orders"
        )
    if not (min(values.shape) > 0 and max(values.shape) <= MAX_ORDER):
        _check_orders(call, target, values.shape[:-1])
    return _usable(call, values if target.dimension == 2 else values[:, None, :])


def buffer_points(
    call: str,
    target: Target,
    strides: Sequence[int],
    orders: Sequence[int],
    points: ArrayLike,
    offset: int,
) -> NDArray[np.float32]:
    """Control points (uorder, vorder, components) out of a user's buffer, as C has it.

    Strides and offset count numbers, not bytes. Raises InvalidValue for a stride less than the
    components, an order outside 1..MAX_ORDER, and a buffer that is too short.
    """
    for name, stride in zip(_names("stride", target), strides, strict=True):
        if integer(call, name, stride) < target.components:
            raise InvalidValue(
                f"{call}: {name}: expected at least {target.components}, the numbers of a "
                f"{target.name}, found {stride}"
            )
    _check_orders(call, target, orders)
    values = _numbers(call, points).ravel()
    first = integer(call, "offset", offset)
    if first < 0:
        raise InvalidValue(f"{call}: offset: expected at least 0, found {offset}")
    places, needed = _places(target.components, tuple(strides), tuple(orders))
    if first + needed > len(values):
        raise InvalidValue(
            f"{call}: points: expected at least {first + needed} numbers, found {len(values)}"
        )
    found = values[first:][places] if first else values[places]
    return _usable(call, found if target.dimension == 2 else found[:, None, :])


@lru_cache(maxsize=64)
def _places(
    components: int, strides: tuple[int, ...], orders: tuple[int, ...]
) -> tuple[NDArray[np.intp], int]:
    """Where the numbers of a net lie in a buffer, (*orders, components), and how long that is."""
    places = np.arange(components)
    for stride, order in zip(reversed(strides), reversed(orders), strict=True):
        places = stride * np.arange(order).reshape(-1, *[1] * places.ndim) + places
    return places, int(places.flat[-1]) + 1


@cache
def _names(word: str, target: Target) -> tuple[str, ...]:
    return (word,) if target.dimension == 1 else (f"u{word}", f"v{word}")


def _check_orders(call: str, target: Target, orders: Sequence[int]) -> None:
    for name, order in zip(_names("order", target), orders, strict=True):
        if not 1 <= integer(call, name, order) <= MAX_ORDER:
            raise InvalidValue(
                f"{call}: {name}: expected an order from 1 to {MAX_ORDER}, found {order}"
            )


def _numbers(call: str, points: ArrayLike) -> NDArray[np.floating[Any]]:
    """An array of float32 or float64."""
    if isinstance(points, np.ndarray) and points.dtype.char in "fd":
        return points
    try:
        return np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidValue(f"{call}: points: expected an array of numbers, found {error}") from None


def _usable(call: str, points: NDArray[np.floating[Any]]) -> NDArray[np.float32]:
    """A copy, rounded to float32. Refused: NaN, infinities, and what would overflow on the way."""
    flat = points.ravel()
    # No number is larger than the root of this, and it is quickly found.
    if not flat.dot(flat) <= LARGEST**2 and not np.abs(points).max(initial=0.0) <= LARGEST:
        index = tuple(int(i) for i in np.argwhere(~(np.abs(points) <= LARGEST))[0])
        raise InvalidValue(
            f"{call}: points: expected finite numbers up to {LARGEST:g}, "
            f"found {points[index]:g} at {list(index)}"
        )
    return points.astype(np.float32)
