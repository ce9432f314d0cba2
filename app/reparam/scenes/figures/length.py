"""The length of a curve, (5), and of the polygons that are inscribed into it, (6).

Halving the chords quarters what is missing: the error is a line of slope -2 in a log-log plot.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import asinh, log2, pi, sqrt
from typing import Annotated, Literal

import numpy as np

from ...geometry.arclength import polygon_length
from ...geometry.curve import circular_arc, curve_net, curve_points
from ...geometry.paths import bezier_path
from .. import palette
from ..claims import Claim
from ..drawing import words
from ..layers import Array, Curves, Dots, Figure, Polylines, Space, plane
from ..parameters import Range
from ..plots import Plot
from ..registry import scene

NETS: dict[str, Array] = {
    "parabola": curve_net([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]),
    "S": curve_net([[0.0, 0.1], [0.5, 1.9], [0.5, -0.9], [1.0, 0.9]]),
    "arc": circular_arc(1.0, 0.0, pi / 2.0),
    "loop": curve_net([[0.05, 0.05], [1.6, 1.15], [-0.6, 1.15], [0.95, 0.05]]),
}
COUNTS = 2 ** np.arange(11)


@scene(
    "The length of a curve, and of its polygons",
    animates="chords",
    plates=(("chords=4",), ("curve=loop", "chords=12")),
)
def length(
    chords: Annotated[float, Range(1, 64, 1), "chords of the polygon, whole"] = 4.0,
    curve: Annotated[Literal["parabola", "S", "arc", "loop"], "which curve"] = "S",
) -> Figure:
    net, n = NETS[curve], round(chords)
    exact = bezier_path(net).arc.length
    corners = inscribed(net, n)
    found = float(polygon_length(corners))
    image = (
        Curves(net, palette.GUIDE, 3.0),
        Polylines(corners, palette.INK, 1.6),
        Dots(corners, palette.SAMPLES, max(1.6, 3.4 - n / 32.0)),
        words(f"{n} chords", (0.0, 1.0), offset=(0.0, 20.0), anchor=(0.0, 0.5), size=17.0),
    )
    plot = Plot((1.0, 1000.0), (1e-7, 1.0), "chords n", "", log=True, size=(1.0, 1.0))
    errors = missing(net, COUNTS)
    space = plot.space(
        plot.curve(COUNTS, errors[-1] * (COUNTS[-1] / COUNTS) ** 2.0, palette.GUIDE, 1.2),
        plot.dots(COUNTS, errors, palette.DERIVATIVE, 3.0),
        plot.dots(np.array([n]), missing(net, np.array([n])), palette.MOVING, 5.0),
        words("length − sum of the chords", (0.0, 1.0), offset=(0.0, 22.0), anchor=(0.0, 0.5)),
        words("slope −2", (0.56, 0.62), size=14.0, anchor=(0.0, 0.5)),
    )
    caption = (
        f"(5)  ∫ |x′(u)| du = {exact:.9f}",
        f"(6)  sum of {n} chords = {found:.9f},   {exact - found:.3e} less",
    )
    return Figure((Space("physical", plane(-0.08, -0.05, 1.08, 1.2), image), space), caption)


def inscribed(net: Array, n: int) -> Array:
    """Corners (n + 1, 3) at equal steps of the parameter."""
    return curve_points(net, np.arange(n + 1) / n)


def missing(net: Array, counts: Array | np.ndarray[tuple[int], np.dtype[np.int64]]) -> Array:
    """By how much polygons of so many chords are too short."""
    exact = bezier_path(net).arc.length
    return np.array([exact - float(polygon_length(inscribed(net, int(n)))) for n in counts])


@length.claims
def claims() -> Iterator[Claim]:
    found = bezier_path(NETS["parabola"]).arc.length
    yield Claim(
        "(5)", "length of (u, u²): √5/2 + asinh(2)/4", sqrt(5) / 2 + asinh(2) / 4, found, 1e-14
    )
    found = bezier_path(NETS["arc"]).arc.length
    yield Claim("(5)", "length of a quarter of the circle: π/2", pi / 2.0, found, 1e-14)
    orders = []
    for net in NETS.values():
        coarse, fine = missing(net, np.array([256, 512]))
        orders.append(log2(coarse / fine))
    statement = "order of (6), from 256 and 512 chords of four curves: 2"
    yield Claim("(6)", statement, [2.0] * len(NETS), orders, 1e-3)
