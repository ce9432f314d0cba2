"""Curves whose arc length is a polynomial: Pythagorean hodographs.

The quintic meets end points and end derivatives, given by its first two and last two control
points; the cubic is given by three, the fourth following. Dots stand at equal arc lengths. The
speed beside it is a polynomial with Bernstein coefficients, and the length is their mean. The
average of two such curves is not one: the square of its speed has no polynomial root.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Annotated, Any, Literal

import numpy as np

from ...geometry.arclength import ArcLength
from ...geometry.curve import curve_net, curve_points, speed
from ...geometry.pythagorean import (
    PythagoreanCurve,
    exact_points,
    hermite,
    hermite_solutions,
    is_pythagorean,
    multiplicities,
    squared_speed,
)
from .. import palette
from ..claims import Claim
from ..drawing import in_space, polygon, words
from ..layers import Array, Curves, Dots, Figure, Handles, Layer, Polylines, Space
from ..parameters import Points, Range
from ..plots import Plot
from ..registry import scene

ENDS = np.array([[0.0, 0.0], [0.35, 0.75], [1.6, 0.55], [2.0, 0.0]])
LEGS = np.array([[0.0, 0.0], [0.5, 0.9], [1.3, 0.95]])
PREIMAGES: tuple[list[tuple[int, int]], ...] = ([(1, 3), (3, 2)], [(2, 1), (1, 2)])
FIRST, SECOND = palette.PIECES[:2]


@scene(
    "Length in closed form: Pythagorean hodographs",
    plates=((), ("curve=average",)),
)
def pythagorean(
    curve: Annotated[
        Literal["quintic", "cubic", "average"], "a quintic, a cubic, or two cubics averaged"
    ] = "quintic",
    ends: Annotated[Array, Points((4, 2), "the quintic's points 0, 1, 4, 5")] = ENDS,
    legs: Annotated[Array, Points((3, 2), "the cubic's points 0, 1, 2")] = LEGS,
    four: Annotated[bool, "the three other quintics with these ends, which bend more"] = False,
    dots: Annotated[int, Range(2, 60, 1), "points at equal arc lengths"] = 17,
) -> Figure:
    if curve == "average":
        return averaged(dots)
    shown = interpolant(ends) if curve == "quintic" else cubic(legs)
    net = curve_net(shown.points)
    length = ArcLength(lambda u: speed(net, u))
    others = tuple(other_quintics(ends)) if curve == "quintic" and four else ()
    layers = (
        handles("ends", ends) if curve == "quintic" else handles("legs", legs),
        *(Curves(curve_net(other.points), palette.GUIDE, 1.6) for other in others),
        *polygon(shown.points),
        Curves(net, FIRST, 3.0),
        Dots(curve_points(net, length.spaced(dots)), palette.SAMPLES, 4.0),
    )
    seen = [in_space(shown.points), *(curve_points(curve_net(x.points), EVEN) for x in others)]
    closed, summed = shown.length, length.length
    caption = (
        f"mean of the {len(shown.speed)} coefficients of the speed: length {closed:.15g}",
        f"by quadrature {summed:.15g}, {abs(closed - summed):.1e} apart",
    )
    spaces = (
        Space("physical", np.concatenate(seen), layers),
        speed_plot([(shown.speed, FIRST)], [(net, FIRST)]),
    )
    return Figure(spaces, caption)


EVEN = np.linspace(0.0, 1.0, 65)


def interpolant(ends: Array) -> PythagoreanCurve:
    """The quintic that bends least with these first two and last two control points."""
    return hermite(*hermite_data(ends))


def other_quintics(ends: Array) -> Iterator[PythagoreanCurve]:
    """The three that bend more."""
    solutions = sorted(hermite_solutions(*hermite_data(ends)), key=lambda curve: curve.bending())
    yield from solutions[1:]


def hermite_data(ends: Array) -> tuple[complex, complex, complex, complex]:
    p0, p1, p4, p5 = (complex(x, y) for x, y in ends)
    if p0 == p1 or p4 == p5:
        raise ValueError("ends: expected end derivatives other than 0, found two equal points")
    return p0, p5, 5.0 * (p1 - p0), 5.0 * (p5 - p4)


def cubic(legs: Array) -> PythagoreanCurve:
    """The cubic with these first three control points: its legs are a geometric progression."""
    p0, p1, p2 = (complex(x, y) for x, y in legs)
    if p0 == p1:
        raise ValueError("legs: expected a first leg of some length, found equal points 0 and 1")
    first = np.sqrt(3.0 * (p1 - p0))
    return PythagoreanCurve(np.array([first, 3.0 * (p2 - p1) / first]), p0)


def averaged(dots: int) -> Figure:
    """Two Pythagorean cubics and their average, which is none."""
    first, second = (exact_points(preimage) for preimage in PREIMAGES)
    mean = average(first, second)
    nets = [curve_net(np.array(points, dtype=np.float64)) for points in (first, second, mean)]
    colors = (FIRST, SECOND, palette.INK)
    layers: list[Layer] = []
    for net, color in zip(nets, colors, strict=True):
        layers.append(Curves(net, color, 3.0))
        at = ArcLength(lambda u, net=net: speed(net, u)).spaced(dots)  # type: ignore[misc]
        layers.append(Dots(curve_points(net, at), color, 3.6))
    ends = [net[-1, :3] for net in nets]
    for end, text, color in zip(ends, ("PH", "PH", "average: not PH"), colors, strict=True):
        layers.append(words(text, end, offset=(0.0, 14.0), color=color, size=15.0))
    speeds = [
        (PythagoreanCurve(np.array([complex(*w) for w in preimage])).speed, color)
        for preimage, color in zip(PREIMAGES, colors, strict=False)
    ]
    square = squared_speed(mean)
    factors = multiplicities(square)
    proof = "square-free" if factors == [len(square) - 1] else f"has factors {factors}"
    caption = (
        f"the average has x′² + y′² = {told(square)}",
        f"it is {proof}, so it is no square: the speed is no polynomial",
    )
    bounds = np.concatenate([in_space(net[:, :2]) for net in nets])
    room = 0.06 * float(np.ptp(bounds[:, 1]))  # for the words above the ends
    bounds = np.concatenate([bounds, bounds + np.array([0.0, room, 0.0])])
    spaces = (
        Space("physical", bounds, tuple(layers)),
        speed_plot(speeds, list(zip(nets, colors, strict=True))),
    )
    return Figure(spaces, caption)


def average(first: list[list[Fraction]], second: list[list[Fraction]]) -> list[list[Fraction]]:
    """The midpoints of two lists of points, exactly."""
    pairs = zip(first, second, strict=True)
    return [[(a + b) / 2 for a, b in zip(p, q, strict=True)] for p, q in pairs]


def told(polynomial: list[Fraction]) -> str:
    """A polynomial of degree at most 4 in u, highest power first."""
    powers = ("", "u", "u²", "u³", "u⁴")
    terms = [
        (f"{'−' if x < 0 else '+'} ", f"{float(abs(x)):g} {power}".rstrip())
        for x, power in zip(polynomial, powers, strict=False)
        if x
    ]
    text = " ".join(sign + term for sign, term in reversed(terms))
    return text.removeprefix("+ ")


def speed_plot(polynomials: list[tuple[Array, Any]], curves: list[tuple[Array, Any]]) -> Space:
    """The speed of each curve over u, and the Bernstein coefficients where it has some."""
    values = [speed(net, EVEN) for net, _ in curves]
    top = 1.08 * max(float(np.max(x)) for x in (*values, *(c for c, _ in polynomials)))
    low = min(0.0, *(float(c.min()) for c, _ in polynomials))
    plot = Plot((0.0, 1.0), (low, top), "u", "|x′(u)|")
    layers: list[Layer] = []
    for coefficients, color in polynomials:
        at = plot.at(np.linspace(0.0, 1.0, len(coefficients)), coefficients)
        layers += (Polylines(at, palette.GUIDE, 1.0), Dots(at, color, 3.0))
    for (_, color), value in zip(curves, values, strict=True):
        layers.append(plot.curve(EVEN, value, color, 2.4))
    return plot.space(*layers, name="speed")


def handles(name: str, points: Array) -> Handles:
    """The control points that are given."""

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        moved = values[name].copy()
        moved[index] = point[:2]
        return {name: moved}

    numbers = (0, 1, 4, 5) if len(points) == 4 else (0, 1, 2)
    return Handles(in_space(points), drag, tuple(f"P{i}" for i in numbers))


@pythagorean.claims
def claims() -> Iterator[Claim]:
    random = np.random.default_rng(3)
    closed, summed = [], []
    for degree in (1, 2, 3):
        some = PythagoreanCurve(random.normal(size=(degree + 1, 2)) @ np.array([1.0, 1.0j]))
        net = curve_net(some.points)
        closed.append(some.length)
        summed.append(ArcLength(lambda u, net=net: speed(net, u)).length)  # type: ignore[misc]
    statement = "length of a cubic, a quintic, a septic: closed form against quadrature"
    yield Claim("(5)", statement, summed, closed, 1e-14)
    shown = interpolant(ENDS)
    statement = "the quintic's first two and last two control points less those asked for"
    off = (shown.points[[0, 1, 4, 5]] - ENDS).ravel().tolist()
    yield Claim("(5)", statement, [0.0] * 8, off, 1e-15)
    first, second = (exact_points(preimage) for preimage in PREIMAGES)
    three = (first, second, average(first, second))
    statement = "which of two cubics and their average are Pythagorean, exactly: 1, 1, 0"
    yield Claim("(5)", statement, [1, 1, 0], [int(is_pythagorean(x)) for x in three], 0)
    statement = "degrees of the factors of x'² + y'² by multiplicity, of the average: square-free"
    yield Claim("(5)", statement, [4], multiplicities(squared_speed(three[2])), 0)
