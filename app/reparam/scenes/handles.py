"""Handles on the control points of a net that is an array parameter of its scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Any

import numpy as np

from ..geometry.evaluate import project
from ..geometry.net import raise_degree
from ..geometry.planar_maps import ALIGNED_IDENTITY, R, morph
from .layers import Array, Handles
from .parameters import Points

COEFFICIENTS = R[..., :2]
Coefficients = Annotated[Array, Points((3, 3, 2), "the coefficients (13) of r, first index u")]

Back = Callable[[int, Array], Array]


def net_handles(name: str, net: Array, back: Back | None = None) -> Handles:
    """A handle at each control point of `net` (m, n, 4), called c00, c01 and so on.

    Dragging one sets the same point of the parameter `name`, an array (m, n, 2 or 3), to where
    it went, or to what `back(index, point)` makes of that.
    """
    rows, columns = net.shape[:2]

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        points = values[name].copy()
        row, column = divmod(index, columns)
        goal = back(index, point) if back else point
        points[row, column] = goal[: points.shape[-1]]
        return {name: points}

    names = tuple(f"c{i}{j}" for i in range(rows) for j in range(columns))
    return Handles(project(net.reshape(-1, 4)), drag, names)


def morph_handles(name: str, net: Array, weight: float) -> tuple[Handles, ...]:
    """Handles at the points of `morph(net, weight)` that move those of `net`; none at weight 0."""
    if weight == 1.0:
        return (net_handles(name, net),)
    if weight == 0.0:
        return ()
    square = raise_degree(ALIGNED_IDENTITY, net.shape[0] - 1, net.shape[1] - 1)
    start = project(square.reshape(-1, 4))

    def back(index: int, point: Array) -> Array:
        return np.asarray((point - (1.0 - weight) * start[index]) / weight)

    return (net_handles(name, morph(net, weight), back),)
