"""Changes of variables of the unit interval: u goes from 0 to 1 at another pace.

A change is increasing, takes 0 to 0 and 1 to 1, and so leaves the image of a curve as it is; only
speed and sampling change: by the chain rule |(x o c)'| = |x' o c| c'.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arclength import ArcLength, Speed
from .formula import Formula
from .parsing import parse

Array = NDArray[np.float64]
Map = Callable[[Array], Array]

ARC_LENGTH = "arclength"
NAMED = {  # name: (formula, the inverse's formula, as it is printed)
    "identity": ("u", "u", "u"),
    "square": ("u**2", "sqrt(u)", "u²"),
    "root": ("sqrt(u)", "u**2", "√u"),
    "smoothstep": ("u**2 (3 - 2u)", "1/2 - sin(asin(1 - 2u) / 3)", "u² (3 − 2u)"),
    "tangent": ("tan(pi u / 4)", "4 atan(u) / pi", "tan(πu/4)"),
}
NAMES = (*NAMED, ARC_LENGTH)

CHECKED = 513  # parameters at which a formula is tried
INWARD = 1e-9  # from an end where the derivative is not defined
BISECTIONS = 60


@dataclass(frozen=True)
class Change:
    """A change of variables: its map, its derivative and its inverse, for arrays (k,) in [0,1].

    `text` is its formula as it is printed; `formula`, where there is one, writes its GLSL twin.
    """

    name: str
    text: str
    forward: Map
    derivative: Map
    inverse: Map
    formula: Formula | None = None


def named_change(name: str, speed: Speed | None = None) -> Change:
    """The change of that name, or the one that a formula in u stands for.

    `arclength` makes the speed constant of the curve whose `speed` is given. Raises ValueError
    with one line that says what was expected and what was found.
    """
    if name == ARC_LENGTH:
        if speed is None:
            raise ValueError(f"expected a curve for the change {ARC_LENGTH}, found none")
        return arc_length_change(ArcLength(speed))
    if name in NAMED:
        formula, inverse, text = NAMED[name]
        back = parse(inverse)
        return _from_formula(name, text, parse(formula), lambda v: back(u=v))
    return formula_change(name)


def formula_change(text: str) -> Change:
    """The change that a user's formula in u stands for. Raises ValueError as `named_change`."""
    try:
        formula = parse(text)
    except ValueError as fault:
        names = ", ".join(NAMES)
        raise ValueError(f"change: {fault}; or one of {names}") from None
    _check(formula, text)

    def inverse(v: Array) -> Array:
        low, high = np.zeros_like(v), np.ones_like(v)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2.0
            less = formula(u=middle) < v
            low, high = np.where(less, middle, low), np.where(less, high, middle)
        return (low + high) / 2.0

    return _from_formula(text, text.replace("**", "^"), formula, inverse)


def arc_length_change(arc: ArcLength) -> Change:
    """The change u(s) that runs through a curve with parameter 0..1 at constant speed."""

    def forward(u: Array) -> Array:
        return arc.u(np.asarray(u, float) * arc.length)

    def derivative(u: Array) -> Array:
        with np.errstate(divide="ignore"):
            return np.asarray(arc.length / arc.speed(forward(u)))

    def inverse(v: Array) -> Array:
        return arc.s(v) / arc.length

    return Change(ARC_LENGTH, "u(s), s = arc length", forward, derivative, inverse)


def _from_formula(name: str, text: str, formula: Formula, inverse: Map) -> Change:
    slope = formula.derivative("u")

    def forward(u: ArrayLike) -> Array:
        return formula(u=u)

    def derivative(u: ArrayLike) -> Array:
        u = np.asarray(u, float)
        values = slope(u=u)
        near = slope(u=np.clip(u, INWARD, 1.0 - INWARD))
        return np.where(np.isnan(values), near, values)

    return Change(name, text, forward, derivative, inverse, formula)


def _check(formula: Formula, text: str) -> None:
    u = np.linspace(0.0, 1.0, CHECKED)
    values, slopes = formula(u=u), formula.derivative("u")(u=u[1:-1])
    for at, value in zip(u, values, strict=True):
        if not np.isfinite(value):
            raise ValueError(
                f"change: expected {text} to be finite on [0,1], found {value:g} at u = {at:g}"
            )
    for end, value in ((0, values[0]), (1, values[-1])):
        if abs(value - end) > 1e-9:
            raise ValueError(f"change: expected {text} to be {end} at u = {end}, found {value:g}")
    falling = np.flatnonzero(~(slopes > -1e-12))
    level = np.flatnonzero(~(np.diff(values) > 0.0))
    if len(falling) or len(level):
        at = u[1:-1][falling[0]] if len(falling) else u[level[0]]
        raise ValueError(
            f"change: expected {text} to increase on [0,1], found that it does not at u = {at:g}"
        )
