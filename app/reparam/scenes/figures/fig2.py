"""Figure 2: the circle, exactly; by cosine and sine; and by stereographic projection.

    (a) x^2 + y^2 = 1, in four rational quadratic pieces
    (b) (cos 2 pi u, sin 2 pi u)
    (c) ((1 - t^2), 2 t) / (1 + t^2) at t = 8u - 4

Both polygons have ten chords at equal steps of u. t = tan(angle/2) turns one parameterisation into
the other: `morph` goes there continuously, each point on the circle.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import atan, hypot, pi, sin
from typing import Annotated

import numpy as np

from ...geometry.arclength import polygon_length
from ...geometry.curve import circular_arc, curve_points
from ...geometry.formula import Formula
from ...geometry.parsing import parse
from ...geometry.regions import region_centers
from .. import palette
from ..claims import Claim, Measure
from ..drawing import words
from ..layers import Array, Curves, Dots, Figure, Layer, Parametric, Polylines, Space, plane
from ..parameters import Range
from ..registry import scene

QUARTERS = np.stack([circular_arc(1.0, k * pi / 2.0, (k + 1) * pi / 2.0) for k in range(4)])
STEREOGRAPHIC = np.array(
    [[-15.0, -8.0, 0.0, 17.0], [17.0, 0.0, 0.0, -15.0], [-15.0, 8.0, 0.0, 17.0]]
)
"""(1 - t^2, 2t, 0, 1 + t^2) at t = 8u - 4, in Bernstein form. A negative weight: the arc is more
than half the circle, and the denominator is positive all the same."""

CIRCULAR = (parse("cos(2 pi u)"), parse("sin(2 pi u)"))
T = parse("8u - 4")
STEREO = (parse("(1 - u^2) / (1 + u^2)"), parse("2u / (1 + u^2)"))  # (4), in u for t
RATIONAL = (STEREO[0].substitute(u=T), STEREO[1].substitute(u=T))
ANGLE = parse("(1 - w) (2 pi u - pi) + 2w atan(8u - 4)", ("u", "w"))
BETWEEN = (parse("cos(u)").substitute(u=ANGLE), parse("sin(u)").substitute(u=ANGLE))
BOUNDS = plane(-1.25, -1.5, 1.25, 1.5)


@scene(
    "The circle, parameterised twice",
    figure=2,
    animates="morph",
    plates=((), ("morph=0.5", "steps=24")),
)
def fig2(
    steps: Annotated[int, Range(3, 200), "chords, at equal steps of u"] = 10,
    morph: Annotated[float, Range(0, 1, 0.1), "of (c): 0 the angle, 1 stereographic"] = 1.0,
) -> Figure:
    third = RATIONAL if morph == 1.0 else BETWEEN
    u = np.arange(steps + 1) / steps
    lengths = [polygon(CIRCULAR, u, 0.0), polygon(third, u, morph)]
    open_by = gap(third, morph)
    way = "(c)  t = 8u − 4" if morph == 1.0 else f"(c)  on the way, w = {morph:.3g}"
    below = f"length {lengths[0]:.6f}", f"length {lengths[1]:.6f}, gap {open_by:.6f}"
    exact: tuple[Layer, ...] = (Curves(QUARTERS, palette.INK, 2.0), *ends(QUARTERS))
    spaces = (
        circle("a", exact, "(a)  x² + y² = 1", "length 2π = 6.283185"),
        circle("b", samples(CIRCULAR, u, 0.0), "(b)  (cos 2πu, sin 2πu)", below[0]),
        circle("c", samples(third, u, morph), way, below[1]),
    )
    caption = (
        "(c):  x = (1 − t²)/(1 + t²),  y = 2t/(1 + t²);   t = tan(angle/2) turns (b) into it",
        f"(b) and (c) at u = k/{steps}, k = 0 … {steps}: {steps} chords",
    )
    return Figure(spaces, caption)


def circle(name: str, layers: tuple[Layer, ...], title: str, below: str) -> Space:
    axes = np.array([[[-1.2, 0.0, 0.0], [1.2, 0.0, 0.0]], [[0.0, -1.2, 0.0], [0.0, 1.2, 0.0]]])
    around: tuple[Layer, ...] = (
        Polylines(axes, palette.GUIDE, 0.7),
        *layers,
        words(title, (0.0, 1.36), size=16.0),
        words(below, (0.0, -1.38), size=15.0),
    )
    return Space(f"physical {name}", BOUNDS, around)


def samples(formulas: tuple[Formula, Formula], u: Array, w: float) -> tuple[Layer, ...]:
    """The circle, the polygon and its corners, these two from the formulas' own GLSL."""
    under = QUARTERS if formulas is not RATIONAL else STEREOGRAPHIC
    return (
        Curves(under, palette.GUIDE, 1.2),
        Parametric(*formulas, u, w, palette.INK, 1.6, 0.0),
        Parametric(*formulas, u, w, palette.SAMPLES, 0.0, max(1.5, min(3.6, 90.0 / len(u)))),
    )


def ends(arcs: Array) -> tuple[Layer]:
    return (Dots(curve_points(arcs, [0.0])[:, 0], palette.INK, 3.0),)


def points(formulas: tuple[Formula, Formula], u: Array, w: float) -> Array:
    """(x(u), y(u)) in float64: shape (k, 2)."""
    return np.stack([formula(u=u, w=w) for formula in formulas], -1)


def polygon(formulas: tuple[Formula, Formula], u: Array, w: float) -> float:
    return float(polygon_length(points(formulas, u, w)))


def gap(formulas: tuple[Formula, Formula], w: float) -> float:
    """From the last point to the first."""
    first, last = points(formulas, np.array([0.0, 1.0]), w)
    return hypot(*(last - first))


@fig2.claims
def claims() -> Iterator[Claim]:
    u = np.arange(11) / 10
    statement = "length of the ten chords by cosine and sine: 20 sin(π/10)"
    yield Claim("Fig. 2b", statement, 20.0 * sin(pi / 10), polygon(CIRCULAR, u, 0.0), 1e-14)
    statement = "length of the ten chords at t = 8u − 4"
    yield Claim("Fig. 2c", statement, 5.074040511947, polygon(RATIONAL, u, 1.0), 1e-12)
    fine = np.linspace(0.0, 1.0, 100_001)
    statement = "length of the arc at t = 8u − 4: 4 atan 4"
    yield Claim("Fig. 2c", statement, 4.0 * atan(4.0), polygon(RATIONAL, fine, 1.0), 1e-8)
    yield Claim("Fig. 2c", "what stays open: 16/17", 16.0 / 17.0, gap(RATIONAL, 1.0), 1e-15)
    off = [
        np.abs((points(formulas, fine, w) ** 2).sum(-1) - 1.0).max()
        for formulas, w in ((CIRCULAR, 0.0), (RATIONAL, 1.0), (BETWEEN, 0.3))
    ]
    off.append(np.abs((curve_points(QUARTERS, fine[::100]) ** 2).sum(-1) - 1.0).max())
    statement = "x² + y² − 1 of (b), (c), between them, and of the circle's four rational pieces"
    yield Claim("Fig. 2", statement, [0.0] * 4, [float(value) for value in off], 1e-15)
    residual = np.abs((curve_points(STEREOGRAPHIC, fine[::100]) ** 2).sum(-1) - 1.0).max()
    statement = "x² + y² − 1 of (c) as one rational piece, whose negative weight costs digits"
    yield Claim("Fig. 2c", statement, 0.0, float(residual), 1e-14)
    angle = np.linspace(-3.0, 3.0, 1001)
    half = parse("tan(u/2)")
    substituted = STEREO[0].substitute(u=half), STEREO[1].substitute(u=half)
    difference = points(substituted, angle, 1.0) - np.stack([np.cos(angle), np.sin(angle)], -1)
    statement = "t = tan(u/2) turns (4) into (cos u, sin u): largest difference"
    yield Claim("(4)", statement, 0.0, float(np.abs(difference).max()), 1e-15)
    statement = "length of the ten chords of (c), from the dots' pixels, in model units"
    yield Claim("Fig. 2c", statement, 5.074040511947, seen_length, PIXEL)


SEEN = 600  # pixels a side
PIXEL = 3.0 * 1.08 / SEEN


def seen_length(measure: Measure) -> float:
    """From the centres of the dots in a plain picture of (c), in the order of their angles."""
    picture = measure.picture("fig2", (SEEN, SEEN)) / 255.0
    dots = np.abs(picture - palette.SAMPLES).max(-1) < 0.1
    centers = region_centers(dots) * PIXEL
    around = centers - PIXEL * SEEN / 2.0
    angle = np.arctan2(-around[:, 0], around[:, 1])
    return float(polygon_length(around[np.argsort(angle)]))
