"""B-splines of any knots: checks, values, knot insertion.

A spline of order k (degree p = k - 1) has n control points and n + k knots; it lives on
[t_p, t_n]. Knots may be unclamped, multiple up to k times (at k the spline may jump), periodic
(the first p points again at the end). Rational splines are splines of premultiplied points.
"""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .net import MAX_ORDER, Array

Indices = NDArray[np.intp]


class KnotFault(Enum):
    """What can be wrong with a knot vector, in the order it is looked for."""

    ORDER = "order"
    TOO_FEW = "too few"
    EMPTY_RANGE = "empty range"
    DECREASING = "decreasing"
    MULTIPLICITY = "multiplicity"
    NOT_FINITE = "not finite"
    POINTS = "points"


class KnotError(ValueError):
    """A knot vector that no spline has; `fault` tells which of the rules it breaks."""

    def __init__(self, fault: KnotFault, message: str) -> None:
        super().__init__(message)
        self.fault = fault


def check_knots(
    knots: ArrayLike, order: int, points: int | None = None, max_order: int = MAX_ORDER
) -> Array:
    """The knots as float64 if they make a spline of this order (of so many points).

    Raises KnotError, whose `fault` says which rule is broken.
    """
    knots = np.asarray(knots, dtype=np.float64)
    if not 1 <= order <= max_order:
        _refuse(KnotFault.ORDER, f"an order from 1 to {max_order}", order)
    if knots.ndim != 1 or len(knots) < 2 * order:
        _refuse(KnotFault.TOO_FEW, f"at least {2 * order} knots for order {order}", knots.size)
    bad = np.flatnonzero(~np.isfinite(knots))
    if bad.size:
        _refuse(KnotFault.NOT_FINITE, f"a finite knot {bad[0]}", knots[bad[0]])
    if knots[order - 1] == knots[-order]:
        _refuse(KnotFault.EMPTY_RANGE, "a range of knots that is not empty", f"{knots[-order]:g}")
    falls = np.flatnonzero(np.diff(knots) < 0.0)
    if falls.size:
        i = int(falls[0])
        found = f"{knots[i]:g}, {knots[i + 1]:g} at {i}"
        _refuse(KnotFault.DECREASING, "knots that do not decrease", found)
    values, counts = np.unique(knots, return_counts=True)
    if counts.max() > order:
        found = f"{counts.max()} at {values[counts.argmax()]:g}"
        _refuse(KnotFault.MULTIPLICITY, f"a knot at most {order} times for order {order}", found)
    if points is not None and len(knots) != points + order:
        expected = f"{points + order} knots for {points} points of order {order}"
        _refuse(KnotFault.POINTS, expected, len(knots))
    return knots


def _refuse(fault: KnotFault, expected: str, found: object) -> None:
    raise KnotError(fault, f"knots: expected {expected}, found {found}")


def clamped_knots(points: int, order: int) -> Array:
    """Uniform knots on [0,1] whose spline begins and ends at the first and last control point."""
    inner = np.linspace(0.0, 1.0, points - order + 2)
    return np.concatenate([np.zeros(order - 1), inner, np.ones(order - 1)])


def domain(knots: Array, order: int) -> tuple[float, float]:
    """First and last parameter of the spline: (t_p, t_n)."""
    return float(knots[order - 1]), float(knots[-order])


def breakpoints(knots: Array, order: int) -> Array:
    """The different knots within the domain, both ends among them."""
    low, high = domain(knots, order)
    return np.unique(knots[(knots >= low) & (knots <= high)])


def find_span(knots: Array, order: int, t: ArrayLike) -> Indices:
    """Index i with t_i <= t < t_{i+1}, as an array of t's shape (The NURBS Book, A2.1).

    At the last parameter, and beyond the ends, the nearest span with an inside.
    """
    low, high = domain(knots, order)
    inside = np.clip(np.asarray(t, dtype=np.float64), low, high)
    last = int(np.searchsorted(knots, high, side="left")) - 1
    return np.minimum(np.searchsorted(knots, inside, side="right") - 1, last)


def basis_functions(knots: Array, order: int, t: ArrayLike) -> tuple[Indices, Array]:
    """Spans (...,) and the k basis functions N_{i-p} .. N_i there, (..., k) (A2.2)."""
    t = np.asarray(t, dtype=np.float64)
    span = find_span(knots, order, t)
    values = np.zeros((*t.shape, order))
    values[..., 0] = 1.0
    for j in range(1, order):
        carry = np.zeros(t.shape)
        for r in range(j):
            right, left = knots[span + r + 1], knots[span + 1 - j + r]
            share = values[..., r] / (right - left)
            values[..., r] = carry + (right - t) * share
            carry = (t - left) * share
        values[..., j] = carry
    return span, values


def evaluate_curve(knots: Array, points: Array, order: int, t: ArrayLike) -> Array:
    """The spline of points (n, c) at t: (..., c) (A3.1). Homogeneous if the points are."""
    span, values = basis_functions(knots, order, t)
    window = points[span[..., None] + np.arange(1 - order, 1)]
    return np.asarray(np.einsum("...k,...kc->...c", values, window))


def evaluate_surface(
    knots: tuple[Array, Array], points: Array, orders: tuple[int, int], u: ArrayLike, v: ArrayLike
) -> Array:
    """The tensor-product spline of points (m, n, c) at u, v of one shape: (..., c) (A3.5)."""
    (span_u, row), (span_v, column) = (
        basis_functions(t, order, x) for t, order, x in zip(knots, orders, (u, v), strict=True)
    )
    i = span_u[..., None] + np.arange(1 - orders[0], 1)
    j = span_v[..., None] + np.arange(1 - orders[1], 1)
    window = points[i[..., :, None], j[..., None, :]]
    return np.asarray(np.einsum("...i,...j,...ijc->...c", row, column, window))


def insert_knot(
    knots: Array, points: Array, order: int, t: float, times: int = 1
) -> tuple[Array, Array]:
    """Knots and points (n, ...) of the same spline after `times` insertions of t (A5.1, Boehm).

    Along another axis of a net: move it to the front. Raises KnotError for a t outside the
    domain or one that would stand more than `order` times.
    """
    low, high = domain(knots, order)
    if not low <= t <= high:
        _refuse(KnotFault.EMPTY_RANGE, f"a knot from {low:g} to {high:g}", t)
    if np.count_nonzero(knots == t) + times > order:
        _refuse(KnotFault.MULTIPLICITY, f"a knot at most {order} times", f"{times} more of {t:g}")
    for _ in range(times):
        span = int(find_span(knots, order, t))
        refined = np.empty((len(points) + 1, *points.shape[1:]))
        first = span - order + 2
        refined[:first] = points[:first]
        refined[span + 1 :] = points[span:]
        for i in range(first, span + 1):
            share = (t - knots[i]) / (knots[i + order - 1] - knots[i])
            refined[i] = (1.0 - share) * points[i - 1] + share * points[i]
        points = refined
        at = int(np.searchsorted(knots, t, side="right"))
        knots = np.insert(knots, at, t)
    return knots, points
