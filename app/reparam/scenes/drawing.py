"""What drawings of curves are made of: polygons, arrows and the words beside them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import palette
from .layers import Array, Color, Dots, Label, Layer, Polylines


def in_space(points: ArrayLike) -> Array:
    """Points (k, 2 or 3) as (k, 3)."""
    values = np.atleast_2d(np.asarray(points, dtype=np.float64))
    return np.pad(values, ((0, 0), (0, 3 - values.shape[-1])))


def words(
    text: str,
    at: ArrayLike,
    *,
    offset: tuple[float, float] = (0.0, 0.0),
    anchor: tuple[float, float] = (0.5, 0.5),
    size: float = 16.0,
    color: Color = palette.INK,
    italic: bool = False,
) -> Label:
    """A label at a point (2,) or (3,)."""
    x, y, z = in_space(at)[0].tolist()
    return Label(text, (x, y, z), offset, anchor, size, color, italic)


def polygon(
    points: ArrayLike,
    color: Color = palette.CONTROL_NET,
    width: float = 1.0,
    dot: float = 3.0,
    closed: bool = False,
) -> tuple[Layer, ...]:
    """A control polygon (k, 2 or 3): its legs and its points."""
    at = in_space(points)
    return Polylines(at, color, width, closed), Dots(at, color, dot)


def arrow(start: ArrayLike, vector: ArrayLike, color: Color, width: float = 1.8) -> Polylines:
    """A vector drawn from a point."""
    tail = in_space(start)
    return Polylines(np.concatenate([tail, tail + in_space(vector)]), color, width, arrow=True)
