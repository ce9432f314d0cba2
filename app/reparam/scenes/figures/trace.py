"""Motion at constant speed along a curve: the change of variables u(s), s its arc length.

Equal steps of u make a camera hurry and dawdle, and a cutter burn and chatter; equal steps of s do
not. The markers by arc length are found on the GPU, from a table of u(s).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from typing import Annotated, Any, Literal

import numpy as np

from ...geometry.arclength import integrate
from ...geometry.curve import circular_arc, curve_net
from ...geometry.paths import Path, bezier_path
from .. import palette
from ..claims import Claim, Measure
from ..drawing import words
from ..layers import (
    Array,
    Color,
    ControlNet,
    Curves,
    Dots,
    Figure,
    Handles,
    Layer,
    Polylines,
    Space,
    Traced,
)
from ..parameters import Points, Range
from ..plots import Plot
from ..registry import scene
from ..remember import remember

OWN = np.array([[0.0, 0.0], [0.3, 1.3], [0.55, -0.7], [0.9, -0.2], [1.0, 1.0]])
HALF = np.stack([circular_arc(0.5, pi, pi / 2.0), circular_arc(0.5, pi / 2.0, 0.0)])
NETS: dict[str, Array] = {
    "near-cusp": curve_net([[0.0, 0.0], [1.05, 1.0], [-0.05, 1.0], [1.0, 0.0]]),
    "rational": curve_net([[0.0, 0.0], [0.1, 1.2], [0.9, -0.6], [1.0, 0.8]], [1.0, 0.3, 4.0, 1.0]),
}
LENGTH = 0.11  # of a camera's arrow
CUTTER = 0.06  # radius
FIELD = 0.35  # of a camera's view, radians to each side
FASTEST = 4.0  # of the plot, in mean speeds


@scene(
    "Constant speed along any curve",
    animates="time",
    plates=((), ("curve=near-cusp", "use=cutter"), ("curve=rational", "use=camera")),
)
def trace(
    curve: Annotated[Literal["own", "near-cusp", "rational"], "which curve"] = "own",
    use: Annotated[Literal["markers", "camera", "cutter"], "what moves along it"] = "markers",
    markers: Annotated[int, Range(2, 200), "equal steps; a marker at each end of one"] = 16,
    time: Annotated[float, Range(0, 1, 0.05, clock=True), "where in the motion"] = 0.35,
    points: Annotated[Array, Points((None, 2), "control points of curve=own")] = OWN,
) -> Figure:
    path = own_path(points) if curve == "own" else bezier_path(NETS[curve])
    fractions = np.arange(markers + 1) / markers
    s = fractions * path.arc.length
    by_length = path.arc.u(s)
    now_u, now_s = np.array([time]), path.arc.u([time * path.arc.length])
    own = own_handles(points) if curve == "own" else ()
    first = drawn(path, use, fractions, now_u, "equal steps of u")
    second = drawn(path, use, by_length, now_s, "equal steps of arc length s")
    traced = Traced(path.nets, path.table, fractions, palette.SAMPLES, 3.2)
    second = (*second, traced) if use == "markers" else second
    first = (
        (*first, Dots(path.points(fractions), palette.SAMPLES, 3.2)) if use == "markers" else first
    )
    bounds = seen(path)
    spaces = (
        Space("physical u", bounds, (*first, *walker(path, now_u), *own)),
        Space("physical s", bounds, (*second, *walker(path, now_s))),
        speeds(path, time),
    )
    spacing = np.abs(np.diff(path.arc.s(by_length)) - path.arc.length / markers).max()
    caption = (
        f"length {path.arc.length:.9f}; {markers} steps of {path.arc.length / markers:.9f}, "
        f"equal to {max(float(spacing), 1e-16):.0e}",
        "s(u) by Gauss and Legendre, u(s) by Newton; on the GPU a table of 1024 u(s)",
    )
    return Figure(spaces, caption)


@remember
def own_path(points: Array) -> Path:
    """The user's curve. Raises ValueError if it has too few or too many points, or no length."""
    if not 2 <= len(points) <= 32:
        raise ValueError(f"points: expected 2 to 32 control points, found {len(points)}")
    path = bezier_path(curve_net(points))
    if path.arc.length == 0.0:
        raise ValueError("points: expected a curve of some length, found a point")
    return path


def own_handles(points: Array) -> tuple[Layer, ...]:
    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        moved = values["points"].copy()
        moved[index] = point[:2]
        return {"points": moved}

    net = curve_net(points)
    return ControlNet(net[:, None]), Handles(np.pad(points, ((0, 0), (0, 1))), drag)


def seen(path: Path) -> Array:
    at = path.points(np.linspace(0.0, len(path.nets), 129))
    low, high = at.min(0), at.max(0)
    room = 0.1 * float((high - low).max())
    return np.stack([low - room, high + room * np.array([1.0, 2.2, 0.0])])


def drawn(path: Path, use: str, u: Array, now: Array, title: str) -> tuple[Layer, ...]:
    """The curve and what moves along it, at parameters u and at `now`."""
    size = float(np.ptp(path.points(np.linspace(0.0, len(path.nets), 129)), axis=0).max())
    corner = seen(path)
    at = (float(corner[0, 0]) + 0.1 * size, float(corner[1, 1]))
    layers: list[Layer] = [
        Curves(path.nets, palette.INK, 1.6),
        words(title, at, anchor=(0.0, 1.0), size=16.0),
    ]
    if use == "camera":
        layers.append(arrows(path, u, LENGTH * size, palette.ALONG_U))
        layers.append(view(path, now, 2.5 * LENGTH * size))
    if use == "cutter":
        layers += [Polylines(discs(path, u, CUTTER * size), palette.SAMPLES, 0.8, closed=True)]
    return tuple(layers)


def arrows(path: Path, u: Array, length: float, color: Color) -> Polylines:
    """Where a camera looks that faces the way it goes."""
    start = path.points(u)
    return Polylines(
        np.stack([start, start + length * path.tangents(u)], 1), color, 1.0, arrow=True
    )


def view(path: Path, u: Array, length: float) -> Polylines:
    """The camera's field of view."""
    (at,), (way,) = path.points(u), path.tangents(u)
    angle = np.arctan2(way[1], way[0]) + np.array([-FIELD, FIELD])
    ends = at + length * np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], -1)
    return Polylines(np.stack([ends[0], at, ends[1]]), palette.MOVING, 1.6)


def discs(path: Path, u: Array, radius: float) -> Array:
    """The cutter's outline at each place: (k, 48, 3)."""
    angle = np.linspace(0.0, 2.0 * pi, 49)[:-1]
    circle = radius * np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], -1)
    return np.asarray(path.points(u)[:, None] + circle)


def walker(path: Path, u: Array) -> tuple[Layer, ...]:
    at = path.points(u)
    return Dots(at, palette.INK, 6.0), Dots(at, palette.MOVING, 5.0)


def speeds(path: Path, time: float) -> Space:
    """The speed over time, by u and by arc length."""
    length, u = path.arc.length, np.linspace(0.0, 1.0, 401)
    values = path.speed(u * len(path.nets)) * len(path.nets)
    top = 1.1 * min(float(values.max()), FASTEST * length)
    plot = Plot((0.0, 1.0), (0.0, top), "time", size=(1.0, 1.1))
    return plot.space(
        plot.curve([time, time], plot.y, palette.GUIDE, 1.0),
        plot.curve(u, values, palette.ALONG_U, 1.6),
        plot.curve([0.0, 1.0], [length, length], palette.DERIVATIVE, 2.2),
        plot.dots([time], [length], palette.MOVING, 4.0),
        words("by u", (0.0, 1.1), offset=(8.0, 22.0), anchor=(0.0, 0.5), color=palette.ALONG_U),
        words("by s", (0.0, 1.1), offset=(56.0, 22.0), anchor=(0.0, 0.5), color=palette.DERIVATIVE),
        words("speed", (0.0, 1.1), offset=(-8.0, 22.0), anchor=(1.0, 0.5), size=14.0),
        width=1.05,
    )


@trace.claims
def claims() -> Iterator[Claim]:
    paths = [own_path(OWN), *map(bezier_path, NETS.values()), bezier_path(HALF)]
    worst = []
    for path in paths:
        u = path.arc.spaced(101)
        ends = np.linspace(u[:-1], u[1:], 65)  # lengths anew, by 64 panels a step
        steps = integrate(path.speed, ends[:-1].ravel(), ends[1:].ravel()).reshape(64, -1).sum(0)
        worst.append(float(np.abs(steps / (path.arc.length / 100) - 1.0).max()))
    statement = "100 steps of four curves, by how much they are not equal"
    yield Claim("(5)", statement, [0.0] * 4, worst, 1e-10)
    (half,) = paths[-1:]
    at = half.points(half.arc.spaced(7))[:, :2]
    angle = pi - np.arange(7) * pi / 6.0
    exact = 0.5 * np.stack([np.cos(angle), np.sin(angle)], -1)
    statement = "six equal steps on a half circle of two rational pieces: 30 degrees each"
    yield Claim("(5)", statement, 0.0, float(np.abs(at - exact).max()), 1e-14)
    statement = "share of the markers that the GPU's table puts where Newton does, to a pixel"
    yield Claim("(5)", statement, 1.0, placed, 0)


def placed(measure: Measure) -> float:
    """The share of markers by arc length seen in a plain picture, by their centres' colour."""
    size, path = 512, own_path(OWN)
    picture = measure.picture("trace", (size, size), time=0.0, markers=16) / 255.0
    bounds = seen(path)
    middle = bounds.mean(0)
    scale = size / (float(np.ptp(bounds, axis=0).max()) * 1.08)
    at = (path.points(path.arc.spaced(17)) - middle)[1:] * scale + size / 2.0
    colors = [picture[size - 1 - int(y), int(x)] for x, y, _ in at]
    return float(np.mean([np.abs(c - palette.SAMPLES).max() < 0.05 for c in colors]))
