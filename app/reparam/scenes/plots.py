"""Plots as layers: axes with ticks and labels, linear or logarithmic, and what is drawn on them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, floor, log10

import numpy as np
from numpy.typing import ArrayLike

from . import palette
from .layers import Array, Color, Dots, Label, Layer, Polylines, Space

Interval = tuple[float, float]

TICK = 0.016  # of the box's height
TICK_TEXT = 13.0
AXIS_TEXT = 15.0
STEPS = (1.0, 2.0, 5.0, 10.0)
TEN_WIDTH, EXPONENT_WIDTH = 10.0, 5.0  # of "10" and of one digit of its exponent


@dataclass(frozen=True)
class Plot:
    """A rectangle of data drawn on a box with its lower left corner at the origin.

    `log` axes take positive data alone; their ticks are the powers of ten. `size` is the box's
    width and height in model units.
    """

    x: Interval
    y: Interval
    x_name: str = ""
    y_name: str = ""
    log: bool = False
    size: tuple[float, float] = (1.3, 1.0)

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Where data (k,) and (k,) are drawn: points (k, 3)."""
        fractions = [self._fraction(np.asarray(v, float), w) for v, w in ((x, self.x), (y, self.y))]
        fractions = list(np.broadcast_arrays(*fractions))
        scaled = [f * s for f, s in zip(fractions, self.size, strict=True)]
        return np.stack([*scaled, np.zeros_like(scaled[0])], -1)

    def curve(self, x: ArrayLike, y: ArrayLike, color: Color, width: float = 1.8) -> Polylines:
        """Data joined by a line; it is cut off where it leaves the box, and where y is not finite
        the line pauses."""
        return Polylines(_clipped(self.at(x, y), self.size), color, width)

    def function(
        self, f: Callable[[Array], Array], color: Color, width: float = 1.8, samples: int = 512
    ) -> Polylines:
        """y = f(x) over the whole axis; f takes and returns arrays (k,)."""
        x = np.geomspace(*self.x, samples) if self.log else np.linspace(*self.x, samples)
        return self.curve(x, f(x), color, width)

    def dots(self, x: ArrayLike, y: ArrayLike, color: Color, radius: float = 3.0) -> Dots:
        """Data as dots; those outside the box are left out."""
        points = self.at(x, y)
        inside = np.all((points[:, :2] > -1e-9) & (points[:, :2] < np.add(self.size, 1e-9)), -1)
        return Dots(points[inside], color, radius)

    def axes(self) -> tuple[Layer, ...]:
        """Two axes with ticks, their numbers and names."""
        width, height = self.size
        corner = np.array([[[0.0, height, 0.0], [0.0, 0.0, 0.0], [width, 0.0, 0.0]]])
        xs, ys = (_ticks(w, self.log) for w in (self.x, self.y))
        marks: list[Array] = []
        labels: list[Label] = []
        for value in xs:
            (point,) = self.at([value], [self.y[0]])
            marks.append(np.stack([point, point - [0.0, TICK * height, 0.0]]))
            labels += self._number(value, point, (0.0, -6.0), (0.5, 1.0))
        for value in ys:
            (point,) = self.at([self.x[0]], [value])
            marks.append(np.stack([point, point - [TICK * height, 0.0, 0.0]]))
            labels += self._number(value, point, (-7.0, 0.0), (1.0, 0.5))
        layers: list[Layer] = [Polylines(corner, palette.INK, 1.0)]
        if marks:
            layers.append(Polylines(np.stack(marks), palette.INK, 1.0))
        below = (0.0, -24.0)
        name_x = Label(self.x_name, (width / 2, 0.0, 0.0), below, (0.5, 1.0), AXIS_TEXT)
        name_y = Label(self.y_name, (0.0, height, 0.0), (0.0, 9.0), (0.0, 0.0), AXIS_TEXT)
        return (*layers, *labels, name_x, name_y)

    def space(
        self,
        *layers: Layer,
        name: str = "plot",
        width: float = 1.0,
        height: float = 1.0,
        below: bool = False,
    ) -> Space:
        """The axes with layers on them, with room around for the numbers."""
        right, top = self.size
        bounds = np.array([[-0.15 * right, -0.2 * top, 0.0], [1.05 * right, 1.15 * top, 0.0]])
        return Space(name, bounds, (*self.axes(), *layers), False, width, height, below)

    def _fraction(self, values: Array, interval: Interval) -> Array:
        low, high = interval
        if self.log:
            with np.errstate(invalid="ignore", divide="ignore"):
                return np.asarray(np.log(values / low) / np.log(high / low))
        return np.asarray((values - low) / (high - low))

    def _number(
        self, value: float, at: Array, offset: tuple[float, float], anchor: tuple[float, float]
    ) -> list[Label]:
        """A tick's number; of a power of ten two labels, for the font has no raised minus."""
        x, y, z = (float(c) for c in at)
        if not self.log:
            text = f"{value:.6g}".replace("-", "−")
            return [Label(text, (x, y, z), offset, anchor, TICK_TEXT)]
        exponent = f"{round(log10(value))}".replace("-", "−")
        shift = EXPONENT_WIDTH * len(exponent)
        right = offset[0] - shift * anchor[0]
        left = right + TEN_WIDTH * (1.0 - anchor[0])
        return [
            Label("10", (x, y, z), (right, offset[1]), anchor, TICK_TEXT),
            Label(exponent, (x, y, z), (left, offset[1] + 4.0), (0.0, anchor[1]), 0.72 * TICK_TEXT),
        ]


def _ticks(interval: Interval, log: bool) -> list[float]:
    """Round numbers within the interval, about five of them."""
    low, high = interval
    if log:
        first, last = ceil(log10(low) - 1e-9), floor(log10(high) + 1e-9)
        stride = max(1, ceil((last - first + 1) / 7))
        return [10.0**k for k in range(first, last + 1, stride)]
    rough = (high - low) / 5.0
    power = 10.0 ** floor(log10(rough))
    step = next(s * power for s in STEPS if s * power >= rough * 0.999)
    count = range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)
    return [k * step for k in count]


def _clipped(points: Array, size: tuple[float, float]) -> Array:
    """Segments (k, 2, 3) or one line (1, k, 3): a polyline within the box 0..size."""
    finite = np.asarray(np.isfinite(points).all(-1))
    inside = ((points[:, :2] >= -1e-9) & (points[:, :2] <= np.add(size, 1e-9))).all(-1)
    if (finite & inside).all():
        return points[None]
    ends = np.stack([points[:-1], points[1:]], 1)[finite[:-1] & finite[1:]]
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    enter, leave = np.zeros(len(ends)), np.ones(len(ends))
    for axis, most in enumerate(size):
        with np.errstate(divide="ignore", invalid="ignore"):
            low = (0.0 - start[:, axis]) / way[:, axis]
            high = (most - start[:, axis]) / way[:, axis]
        level = way[:, axis] == 0.0
        out = level & ((start[:, axis] < 0.0) | (start[:, axis] > most))
        enter = np.where(level, enter, np.maximum(enter, np.minimum(low, high)))
        leave = np.where(
            level, np.where(out, -1.0, leave), np.minimum(leave, np.maximum(low, high))
        )
    seen = enter <= leave
    start, way, enter, leave = start[seen], way[seen], enter[seen], leave[seen]
    return np.stack([start + enter[:, None] * way, start + leave[:, None] * way], 1)
