"""One-sided derivatives of curves at a parameter, in float64 or exactly.

Exact where all numbers are whole or fractions: such arrays have dtype object. The curves may be
polynomial or rational Bezier curves, B-splines, or NURBS curves; points in any dimension.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[Any]  # float64, or object: fractions
Number = Any
End = Literal[0, 1]
Side = Literal["left", "right"]
Values = ArrayLike | Sequence[Any]  # numbers, fractions among them

FAR = 1e-6  # how far off the origin counts, beside the extent: coordinates are rounded there


@dataclass(frozen=True, eq=False)
class Jet:
    """`derivatives` (k + 1, d) of a curve at one parameter, the position first.

    `sizes` (k + 1,) tell how large the numbers were that each was computed from: rounding is
    measured against them.
    """

    derivatives: Numbers
    sizes: Numbers

    @property
    def order(self) -> int:
        """The highest derivative it knows."""
        return len(self.derivatives) - 1

    @property
    def exact(self) -> bool:
        """Whether its numbers are fractions."""
        return bool(self.derivatives.dtype == object)


def exceeds(vector: Numbers, size: Number, tolerance: float) -> bool:
    """Whether it is more than rounding: not zero if exact, else above tolerance * size."""
    if vector.dtype == object:
        return bool(vector.any())
    return bool(np.abs(vector).max() > tolerance * size)


def as_numbers(values: Values) -> Numbers:
    """The array in float64 or, if all its numbers are whole or fractions, in fractions.

    Raises ValueError for numbers that are not finite.
    """
    array = np.asarray(values)
    if array.dtype.kind in "iu":
        array = array.astype(object)
    if array.dtype == object and all(isinstance(x, int | Fraction) for x in array.flat):
        return np.array([Fraction(x) for x in array.flat], dtype=object).reshape(array.shape)
    array = np.asarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        raise ValueError("expected finite numbers, found NaN or infinity")
    return array


def jet(derivatives: Values) -> Jet:
    """A jet from derivatives (k + 1, d), each one's own length taken for its size."""
    values = as_numbers(derivatives)
    if values.ndim != 2 or len(values) < 2:
        raise ValueError(f"expected derivatives (k + 1, d), k at least 1, found {values.shape}")
    return Jet(values, np.abs(values).max(1))


def bezier_jet(points: Values, end: End, order: int, width: Number = 1) -> Jet:
    """The jet at parameter 0 or 1 of the Bezier curve with points (n, d).

    The m-th derivative is d!/(d-m)! times the m-th difference at that end, over `width`^m, the
    length of the parameter interval.
    """
    values = _points(points)
    start = values[-end]
    sizes = np.abs(values - start).max(1)
    if values.dtype != object:
        sizes = sizes + FAR * np.abs(start).max()
    return Jet(
        _end_derivatives(values, end, order, width),
        _end_derivatives(sizes, end, order, width, sign=1),
    )


def rational_jet(net: Values, end: End, order: int, width: Number = 1) -> Jet:
    """The jet at parameter 0 or 1 of the rational Bezier curve with the net (n, d + 1).

    From X = w x, premultiplied, follows x^(m) w = X^(m) - sum_{j>0} C(m,j) w^(j) x^(m-j) (The
    NURBS Book, equation 4.8); x is counted from the end point. Raises ValueError if the weight
    there is not positive.
    """
    values = _points(net)
    weights, weight = values[:, -1], values[-end, -1]
    if weight <= 0:
        raise ValueError(f"expected a positive weight at the end, found {weight}")
    start = values[-end, :-1] / weight
    upper = bezier_jet(values[:, :-1] - weights[:, None] * start, end, order, width)
    lower = _end_derivatives(weights, end, order, width)
    lower_sizes = _end_derivatives(np.abs(weights), end, order, width, sign=1)
    found, sizes = [start * 0], [upper.sizes[0]]
    for m in range(1, order + 1):
        value, size = upper.derivatives[m], upper.sizes[m]
        for j in range(1, m + 1):
            value = value - comb(m, j) * lower[j] * found[m - j]
            size = size + comb(m, j) * lower_sizes[j] * sizes[m - j]
        found.append(value / weight)
        sizes.append(size / weight)
    return Jet(np.array([start, *found[1:]]), np.array(sizes))


def spline_jet(
    knots: Values,
    points: Values,
    t: Number,
    order: int,
    side: Side,
    *,
    rational: bool = False,
) -> Jet:
    """The jet at t, from one side, of the B-spline with knots (n + degree + 1,), points (n, d).

    That is the jet of the Bezier curve of the piece between t and the next different knot on
    that side. `rational`: the points are premultiplied, (n, d + 1), the last one the weight.
    Raises ValueError where there is no such piece.
    """
    points, places = _points(points), as_numbers(knots)
    if (points.dtype == object) != (places.dtype == object):
        points, places = points.astype(np.float64), places.astype(np.float64)
    degree = len(places) - len(points) - 1
    if degree < 1 or (places[1:] < places[:-1]).any():
        found = f"{len(places)} knots for {len(points)} points"
        raise ValueError(f"expected knots that do not decrease, points + degree + 1, found {found}")
    t = Fraction(t) if places.dtype == object else float(t)
    for span in range(degree, len(points)):
        a, b = places[span], places[span + 1]
        if a < b and (a < t <= b if side == "left" else a <= t < b):
            break
    else:
        raise ValueError(f"expected a parameter with a piece on its {side}, found {t}")
    local, around = points[span - degree : span + 1], places[span - degree + 1 : span + degree + 1]
    a, b = (a, t) if side == "left" else (t, b)
    ends = [[a] * (degree - i) + [b] * i for i in range(degree + 1)]
    net = np.array([blossom(local, around, arguments) for arguments in ends])
    end: End = 1 if side == "left" else 0
    return (rational_jet if rational else bezier_jet)(net, end, order, b - a)


def blossom(points: Numbers, knots: Numbers, arguments: list[Number]) -> Numbers:
    """The blossom of one polynomial piece: de Boor's algorithm, an argument of its own a step.

    `points` (degree + 1, d), `knots` the 2 degree around the piece. With (a, .., a, b, .., b) it
    gives the piece's Bezier points over [a, b]. (Ramshaw, Blossoms are polar forms, 1989.)
    """
    for t in arguments:
        low, high = knots[: len(points) - 1], knots[len(points) - 1 :]
        share = ((t - low) / (high - low))[:, None]
        points = (1 - share) * points[:-1] + share * points[1:]
        knots = knots[1:-1]
    return np.asarray(points[0])


def _points(points: Values) -> Numbers:
    values = as_numbers(points)
    if values.ndim != 2 or len(values) < 2:
        raise ValueError(f"expected at least two points, (n, d), found shape {values.shape}")
    return values


def _end_derivatives(
    coefficients: Numbers, end: End, order: int, width: Number, sign: int = -1
) -> Numbers:
    """Derivatives 0..order at one end; with sign 1, sums take the place of differences."""
    degree, found = len(coefficients) - 1, [coefficients[-end]]
    factor: Number = Fraction(1) if coefficients.dtype == object else 1.0
    for m in range(1, order + 1):
        if m > degree:
            found.append(found[0] * 0)
            continue
        factor = factor * (degree - m + 1) / width
        coefficients = coefficients[1:] + sign * coefficients[:-1]
        found.append(factor * coefficients[-end])
    return np.array(found)
