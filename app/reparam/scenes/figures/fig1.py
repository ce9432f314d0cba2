"""Figure 1: one curve, sampled by u and by a change of variables c(u).

The image stays the same; where equal steps of u land, and how fast an ant walks that is at x(c(u))
at time u, does not: by the chain rule its speed is |x'(c(u))| c'(u).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt
from typing import Annotated, Literal

import numpy as np

from ...geometry import change as changes
from ...geometry.arclength import ArcLength, Speed, polygon_length
from ...geometry.change import Change, named_change
from ...geometry.curve import curve_net, curve_points, speed
from .. import palette
from ..claims import Claim, Measure
from ..drawing import words
from ..layers import Array, Color, Curves, Dots, Figure, Label, Layer, Polylines, Space, plane
from ..parameters import Presets, Range
from ..plots import Plot
from ..registry import scene

NETS: dict[str, Array] = {
    "diagonal": curve_net([[0.0, 0.0], [1.0, 1.0]]),
    "parabola": curve_net([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]),
    "S": curve_net([[0.0, 0.0], [1.1, 0.0], [-0.1, 1.0], [1.0, 1.0]]),
}
NAMES = {"diagonal": "x(u) = (u, u)", "parabola": "x(u) = (u, u²)", "S": "x a cubic"}
IDENTITY = named_change("identity")
STEEPEST = 4.0  # of the plot, in mean speeds


@scene(
    "One curve, two samplings",
    figure=1,
    animates="time",
    plates=((), ("change=tangent", "curve=S", "steps=24")),
)
def fig1(
    change: Annotated[
        str, Presets(changes.NAMES), "the change of variables c, by name or as a formula in u"
    ] = "square",
    steps: Annotated[int, Range(2, 200), "equal steps of u; a dot at each end of one"] = 10,
    time: Annotated[float, Range(0, 1, 0.1, clock=True), "where in its walk the ant is"] = 0.6,
    curve: Annotated[
        Literal["diagonal", "parabola", "S"], "the curve that is sampled"
    ] = "diagonal",
) -> Figure:
    net = NETS[curve]
    chosen = named_change(change, lambda u: speed(net, u))
    u = np.arange(steps + 1) / steps
    spaces = (
        *column(net, IDENTITY, u, time, "", "by u"),
        *column(net, chosen, u, time, " 2", f"by c(u) = {chosen.text}"),
        speeds(net, chosen, time),
    )
    lengths = [float(polygon_length(curve_points(net, c.forward(u)))) for c in (IDENTITY, chosen)]
    caption = (
        f"{NAMES[curve]} at {steps + 1} equally spaced u, and x(c(u)): the image is the same",
        f"length of the two polygons, by (6): {lengths[0]:.6f} and {lengths[1]:.6f}",
    )
    return Figure(spaces, caption)


def column(
    net: Array, change: Change, u: Array, time: float, suffix: str, title: str
) -> tuple[Space, Space]:
    """The image with the dots at x(c(u)), and beneath it the domain with the dots at u."""
    ant = np.array([time])
    image: tuple[Layer, ...] = (
        Curves(net, palette.INK, 1.8),
        Dots(curve_points(net, change.forward(u)), palette.SAMPLES, 3.4),
        *walker(curve_points(net, change.forward(ant))),
        Label(title, (0.0, 1.0, 0.0), (0.0, 18.0), (0.0, 0.0), 17.0),
    )
    interval = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    dots = np.stack([u, 0.0 * u, 0.0 * u], -1)
    domain: tuple[Layer, ...] = (
        Polylines(interval, palette.ALONG_U, 1.8),
        Dots(dots, palette.ALONG_U, 3.4),
        *walker(np.array([[time, 0.0, 0.0]])),
        words("0", (0.0, 0.0), offset=(0.0, -15.0), size=14.0),
        words("1", (1.0, 0.0), offset=(0.0, -15.0), size=14.0),
        words("u", (0.5, 0.0), offset=(0.0, -16.0), size=16.0, color=palette.ALONG_U, italic=True),
    )
    return (
        Space(f"physical{suffix}", plane(-0.1, -0.06, 1.1, 1.26), image, height=1.0),
        Space(f"domain{suffix}", plane(-0.1, -0.14, 1.1, 0.06), domain, height=0.24, below=True),
    )


def walker(at: Array) -> tuple[Layer, Layer]:
    """The ant: a dot with a rim, larger than the others."""
    return Dots(at, palette.INK, 6.2), Dots(at, palette.MOVING, 5.2)


def speeds(net: Array, change: Change, time: float) -> Space:
    """|x'(u)| and |(x o c)'(u)| over u: the areas below are both the curve's length."""

    changed = with_change(net, change)
    u = np.linspace(0.0, 1.0, 513)
    values = changed(u)
    length = ArcLength(lambda t: speed(net, t)).length
    highest = min(float(np.nanmax(values[np.isfinite(values)])), STEEPEST * length)
    plot = Plot(
        (0.0, 1.0), (0.0, 1.1 * max(highest, float(speed(net, u).max()))), "u", size=(1.0, 1.1)
    )
    now = np.array([time])
    guide = plot.curve([time, time], plot.y, palette.GUIDE, 1.0)
    return plot.space(
        guide,
        plot.curve(u, speed(net, u), palette.ALONG_U, 1.6),
        plot.curve(u, values, palette.DERIVATIVE, 2.2),
        Dots(plot.dots(now, speed(net, now), palette.MOVING, 4.2).at, palette.MOVING, 4.2),
        plot.dots(now, changed(now), palette.MOVING, 4.2),
        words("|x′(u)|", (0.0, 1.1), offset=(8.0, 22.0), anchor=(0.0, 0.5), color=palette.ALONG_U),
        words(
            "|x′(c(u))| c′(u)",
            (0.0, 1.1),
            offset=(70.0, 22.0),
            anchor=(0.0, 0.5),
            color=palette.DERIVATIVE,
        ),
        width=1.1,
    )


def legend(text: str, shift: float, color: Color) -> Label:
    return words(text, (0.0, 1.1), offset=(shift, 22.0), anchor=(0.0, 0.5), color=color)


@fig1.claims
def claims() -> Iterator[Claim]:
    net, u = NETS["diagonal"], np.arange(11) / 10
    square = named_change("square")
    lengths = [float(polygon_length(curve_points(net, c.forward(u)))) for c in (IDENTITY, square)]
    statement = "length of the diagonal, sampled by u and by u²"
    yield Claim("(6)", statement, [sqrt(2)] * 2, lengths, 1e-15)
    steps = np.linalg.norm(np.diff(curve_points(net, u**2), axis=0), axis=-1)
    statement = "shortest and longest of the ten chords by u²: √2/100 and 19√2/100"
    expected = [sqrt(2) / 100, 19 * sqrt(2) / 100]
    yield Claim("Fig. 1", statement, expected, [float(steps.min()), float(steps.max())], 1e-15)
    areas = [area(NETS["S"], name) for name in ("identity", "square", "smoothstep", "tangent")]
    statement = "area below the cubic's speed by u, u², u²(3−2u), tan(πu/4): its length each time"
    yield Claim("(5)", statement, [areas[0]] * 4, areas, 1e-13)
    yield Claim("Fig. 1", "share of the dots that are where the formula puts them", 1.0, placed, 0)


def area(net: Array, name: str) -> float:
    return ArcLength(with_change(net, named_change(name))).length


def with_change(net: Array, change: Change) -> Speed:
    """|(x o c)'|, by the chain rule; NaN where a vanishing speed meets an infinite derivative."""

    def speeds(u: Array) -> Array:
        with np.errstate(invalid="ignore"):
            return speed(net, change.forward(u)) * change.derivative(u)

    return speeds


def placed(measure: Measure) -> float:
    """The samples by u^2 that are seen in a plain picture, each by the colour of its centre."""
    size = 512
    picture = measure.picture("fig1", (size, size), time=0.55).astype(float)
    middle = np.array([0.5, 0.6])  # of the bounds
    scale = size / (1.32 * 1.08)
    found = []
    for u in np.arange(11) / 10:
        x, y = (np.array([u * u, u * u]) - middle) * scale + size / 2
        color = picture[size - 1 - int(y), int(x)] / 255.0
        found.append(np.abs(color - palette.SAMPLES).max() < 0.05)
    return float(np.mean(found))
