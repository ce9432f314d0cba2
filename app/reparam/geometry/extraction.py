"""Splines as Bezier pieces, cut where one likes.

Bezier extraction (Borden, Scott, Evans, Hughes, Isogeometric finite element data structures
based on Bezier extraction, 2011): on each span with an inside, the Bezier points are

    b_j = f(a, ..., a, b, ..., b)      b_0 = spline at a,  b_p = spline at b
            p - j     j

the blossom f of the polynomial there (L. Ramshaw, 1989), and f is an average of k neighbouring
control points: all weights are in [0,1], so nothing is lost to rounding at any order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .net import Array
from .nurbs import Indices, breakpoints, check_knots, domain, find_span


@dataclass(frozen=True, eq=False)
class Extraction:
    """How the Bezier points of each span come from the control points.

    intervals (s, 2); `first` (s,), the first control point that each span takes part in;
    matrices (s, k, k), nets = matrices @ points[first : first + k]; `joined` (s,), whether a
    span begins where the one before ends (not at the first, nor where the spline may jump).
    """

    intervals: Array
    first: Indices
    matrices: Array
    joined: NDArray[np.bool_]

    def apply(self, points: Array) -> Array:
        """Bezier points (s, k, ...) of control points (n, ...).

        What two spans share is the same, bit for bit.
        """
        order = self.matrices.shape[1]
        window = points[self.first[:, None] + np.arange(order)]
        nets = np.einsum("sjk,sk...->sj...", self.matrices, window)
        for span in np.flatnonzero(self.joined):
            nets[span, 0] = nets[span - 1, -1]
        return np.asarray(nets)


def extraction(knots: Array, order: int, cuts: ArrayLike = ()) -> Extraction:
    """The Bezier extraction of checked knots, cut at parameters `cuts` of the domain as well."""
    low, high = domain(knots, order)
    more = np.asarray(cuts, dtype=np.float64)
    inside = more[(more >= low) & (more <= high)]
    return extraction_between(knots, order, np.union1d(breakpoints(knots, order), inside))


def extraction_between(knots: Array, order: int, ends: Array) -> Extraction:
    """The Bezier extraction of checked knots over the intervals between rising `ends`.

    Among the ends are the spline's own knots, as far as the ends reach; so splines of different
    knots come as pieces over the same intervals. Beyond its domain a spline is extrapolated, as
    OpenGL's maps are.
    """
    intervals = np.stack([ends[:-1], ends[1:]], -1)
    span = find_span(knots, order, intervals[:, 0])
    jumps = np.array([np.count_nonzero(knots == t) >= order for t in ends[:-1]])
    jumps[0] = True
    return Extraction(intervals, span - order + 1, _matrices(knots, order, span, intervals), ~jumps)


def _matrices(knots: Array, order: int, span: Indices, intervals: Array) -> Array:
    """De Boor's recursion on unit points, its r-th step taken at the r-th blossom argument.

    Row j takes the right end j times, last: then a row that meets a full knot is a unit vector.
    """
    degree = order - 1
    weights = np.broadcast_to(np.eye(order), (len(span), order, order, order)).copy()
    arguments = np.empty((len(span), order, degree))  # span, row j, step
    for j in range(order):
        arguments[:, j, : degree - j] = intervals[:, :1]
        arguments[:, j, degree - j :] = intervals[:, 1:]
    for step in range(1, order):
        for i in range(degree, step - 1, -1):
            left, right = knots[span - degree + i], knots[span + 1 + i - step]
            share = (arguments[:, :, step - 1] - left[:, None]) / (right - left)[:, None]
            share = share[..., None]
            weights[:, :, i] = (1.0 - share) * weights[:, :, i - 1] + share * weights[:, :, i]
    return weights[:, :, degree]


@dataclass(frozen=True, eq=False)
class BezierCurves:
    """Pieces of a spline curve: nets (s, k, c) over the intervals (s, 2)."""

    nets: Array
    intervals: Array


@dataclass(frozen=True, eq=False)
class BezierSurfaces:
    """Pieces of a spline surface: nets (s, t, m, n, c) over u_ (s, 2) times v_intervals (t, 2)."""

    nets: Array
    u_intervals: Array
    v_intervals: Array

    def patches(self) -> Array:
        """All nets in a row, v fastest: (s t, m, n, c)."""
        return self.nets.reshape(-1, *self.nets.shape[2:])

    def domains(self) -> Array:
        """(u, v) at the corners [iu, iv] of each of these patches: (s t, 2, 2, 2)."""
        s, t = len(self.u_intervals), len(self.v_intervals)
        u = np.broadcast_to(self.u_intervals[:, None, :, None], (s, t, 2, 2))
        v = np.broadcast_to(self.v_intervals[None, :, None, :], (s, t, 2, 2))
        return np.stack([u, v], -1).reshape(-1, 2, 2, 2)


def curve_to_bezier(
    knots: ArrayLike, points: ArrayLike, order: int, cuts: ArrayLike = ()
) -> BezierCurves:
    """A spline of points (n, c) as Bezier curves, cut at its knots and at `cuts`.

    Raises KnotError.
    """
    points = np.asarray(points, dtype=np.float64)
    pieces = extraction(check_knots(knots, order, len(points)), order, cuts)
    return BezierCurves(pieces.apply(points), pieces.intervals)


def surface_to_bezier(
    knots: tuple[ArrayLike, ArrayLike],
    points: ArrayLike,
    orders: tuple[int, int],
    cuts: tuple[ArrayLike, ArrayLike] = ((), ()),
) -> BezierSurfaces:
    """A tensor-product spline of points (m, n, c) as Bezier patches, cut at knots and `cuts`.

    Neighbours share their edge's control points bit for bit. Raises KnotError.
    """
    points = np.asarray(points, dtype=np.float64)
    in_u, in_v = (
        extraction(check_knots(knots[axis], orders[axis], points.shape[axis]), orders[axis], c)
        for axis, c in enumerate(cuts)
    )
    rows = in_u.apply(points)  # (s, m, n, c)
    nets = in_v.apply(np.moveaxis(rows, 2, 0))  # (t, n', s, m', c)
    nets = nets.transpose(2, 0, 3, 1, 4)
    return BezierSurfaces(np.ascontiguousarray(nets), in_u.intervals, in_v.intervals)


def restricted(net: Array, low: ArrayLike, high: ArrayLike) -> Array:
    """A Bezier patch (m, n, c) over rectangles from low to high (r, 2): nets (r, m, n, c)."""
    rectangles = np.stack([np.asarray(low, np.float64), np.asarray(high, np.float64)], -1)
    matrices = []
    for axis in (0, 1):
        order = net.shape[axis]
        knots = np.repeat([0.0, 1.0], order)
        span = np.full(len(rectangles), order - 1)
        matrices.append(_matrices(knots, order, span, rectangles[:, axis]))
    return np.asarray(np.einsum("rij,rkl,jlc->rikc", *matrices, net, optimize=True))
