"""Trim curves cut into pieces that are monotone in u and in v, and never change from flat to steep.

A piece is a stretch [t0, t1] of a rational Bezier curve in the plane, or a straight segment. Its
end points are kept beside it, and neighbours in a loop have them in common bit for bit, so that
a horizontal line meets a closed loop as often upwards as downwards, whatever the rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
from numpy.typing import NDArray

from ..bernstein import bernstein, bernstein_derivative
from ..roots import bernstein_roots, multiply

Array = NDArray[np.float64]
Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]

STRAIGHT = -1
MOST_STEPS = 110
NO_STEP, ROUNDING = 4e-16, 1.2e-16  # of the parameter; of a coordinate up to 1
PORTION = 1 << 12  # of curves at a time: what stays in a processor's cache
LEAST_SPAN = 1e-9  # turning within so short a stretch is less than rounding


@dataclass(frozen=True, eq=False)
class Pieces:
    """n directed pieces, in the order of their loops.

    curves: tables (m, k, 3) of homogeneous control points, one for each order k that occurs;
    table, row (n,): where a piece's curve stands, table STRAIGHT for a segment; span (n, 2): its
    parameters; ends (n, 2, 2): start and end (u, v); loop, source (n,): which loop it belongs
    to, and which piece of it as given.
    """

    curves: tuple[Array, ...]
    table: Indices
    row: Indices
    span: Array
    ends: Array
    loop: Indices
    source: Indices

    def __len__(self) -> int:
        return len(self.table)

    def take(self, index: Indices | Mask) -> Pieces:
        """Some of the pieces."""
        return replace(
            self,
            table=self.table[index],
            row=self.row[index],
            span=self.span[index],
            ends=self.ends[index],
            loop=self.loop[index],
            source=self.source[index],
        )

    def points(self, index: Indices, t: Array) -> Array:
        """(u, v) of the pieces with these numbers at parameters t in their spans: (k, 2)."""
        return self._each(index, t, curve_points, self._on_segment)

    def velocities(self, index: Indices, t: Array) -> Array:
        """d(u, v)/dt of the pieces with these numbers: (k, 2)."""
        return self._each(
            index, t, curve_velocities, lambda i, _: self.ends[i, 1] - self.ends[i, 0]
        )

    def _on_segment(self, index: Indices, t: Array) -> Array:
        start, end = self.ends[index, 0], self.ends[index, 1]
        return cast(Array, start + t[:, None] * (end - start))

    def _each(
        self,
        index: Indices,
        t: Array,
        curved: Callable[[Array, Array], Array],
        straight: Callable[[Indices, Array], Array],
    ) -> Array:
        result = np.empty((len(index), 2))
        table = self.table[index]
        here = table == STRAIGHT
        result[here] = straight(index[here], t[here])
        for number, curves in enumerate(self.curves):
            here = table == number
            if here.any():
                result[here] = curved(curves[self.row[index[here]]], t[here])
        return result

    def solve(self, index: Indices, axis: int, value: Array) -> Array:
        """The parameters (k,) where coordinate `axis` (0: u, 1: v) of pieces takes these values.

        Newton's method, with bisection where it leaves the span or does not get on. Values
        beyond a piece's ends give its ends.
        """
        start, end = self.ends[index, 0, axis], self.ends[index, 1, axis]
        chord = np.where(end != start, end - start, 1.0)
        low, high = self.span[index].T
        t: Array = low + np.clip((value - start) / chord, 0.0, 1.0) * (high - low)
        table, sign = self.table[index], np.sign(chord)
        for number, curves in enumerate(self.curves):
            members = np.flatnonzero(table == number)
            for first in range(0, len(members), PORTION):
                here = members[first : first + PORTION]
                nets = np.moveaxis(curves[self.row[index[here]]][..., [axis, 2]], 0, -1)
                span = low[here], high[here]
                t[here] = _solved(nets, value[here], sign[here], t[here], *span)
        return t

    def split(self, index: Indices, t: Array, at: Array) -> Pieces:
        """Pieces with these numbers (each at most once, rising) cut at t, where they pass `at`."""
        times = np.ones(len(self), dtype=np.intp)
        times[index] = 2
        result = self.take(np.repeat(np.arange(len(self)), times))
        first = index + np.arange(len(index))
        result.span[first, 1] = result.span[first + 1, 0] = t
        result.ends[first, 1] = result.ends[first + 1, 0] = at
        straight = result.table[first] == STRAIGHT
        result.span[first[straight]] = result.span[first[straight] + 1] = (0.0, 1.0)
        return result

    def without_points(self) -> Pieces:
        """The pieces of some length; the others are points, and the loops stay closed."""
        return self.take((self.ends[:, 0] != self.ends[:, 1]).any(-1))


def curve_points(curves: Array, t: Array) -> Array:
    """(u, v) of rational Bezier curves (n, k, 3) at their t (n,): shape (n, 2)."""
    point = np.einsum("nk,nkc->nc", bernstein(curves.shape[1] - 1, t), curves)
    return np.asarray(point[:, :2] / point[:, 2:])


def curve_velocities(curves: Array, t: Array) -> Array:
    """d(u, v)/dt of rational Bezier curves (n, k, 3) at their t (n,): shape (n, 2)."""
    degree = curves.shape[1] - 1
    point = np.einsum("nk,nkc->nc", bernstein(degree, t), curves)
    slope = np.einsum("nk,nkc->nc", bernstein_derivative(degree, t), curves)
    w = point[:, 2:]
    return np.asarray((slope[:, :2] - slope[:, 2:] * point[:, :2] / w) / w)


def _solved(nets: Array, value: Array, sign: Array, t: Array, low: Array, high: Array) -> Array:
    """Where coordinates with control points nets (k, 2, n), of (w x, w), take values (n,), from
    t on within [low, high]: (n,). `sign` says whether they rise or fall."""
    result, active, last = t.copy(), np.arange(len(t)), high - low
    for _ in range(MOST_STEPS):
        if len(active) == 0:
            break
        x, slope = _coordinate(nets, t)
        off, slope = (x - value) * sign, slope * sign
        low, high = np.where(off < 0.0, t, low), np.where(off < 0.0, high, t)
        after = t - off / np.where(slope > 0.0, slope, 1.0)
        newton = (slope > 0.0) & (low <= after) & (after <= high)
        newton &= np.abs(after - t) <= last / 2.0
        after = np.where(newton, after, (low + high) / 2.0)
        found = np.abs(off) < ROUNDING
        after = np.where(found, t, after)
        last = np.abs(after - t)
        result[active] = t = after
        going = last > NO_STEP
        if not going.all():
            active, nets = active[going], nets[..., going]
            value, sign, t = value[going], sign[going], t[going]
            low, high, last = low[going], high[going], last[going]
    return result


def _coordinate(nets: Array, t: Array) -> tuple[Array, Array]:
    """x and dx/dt of rational curves by their control points (k, 2, n) of (w x, w): (n,) each."""
    degree = len(nets) - 1
    for _ in range(degree - 1):
        nets = nets[:-1] + t * (nets[1:] - nets[:-1])
    way = nets[1] - nets[0]
    (x, w), (dx, dw) = nets[0] + t * way, degree * way
    x = x / w
    return x, (dx - dw * x) / w


def turning_points(curves: Array) -> tuple[Indices, Array]:
    """Rows and parameters where curves (n, k, 3) turn in u or v, or from flat to steep.

    With (x, y, w) the homogeneous curve, u' has the sign of  x' w - x w',  a polynomial; v'
    likewise; and the curve turns from flat to steep where u' = v' or u' = -v'.
    """
    degree = curves.shape[1] - 1
    slope = degree * np.diff(curves, axis=1)
    x, y, w = np.moveaxis(curves, -1, 0)
    dx, dy, dw = np.moveaxis(slope, -1, 0)
    along_u = multiply(dx, w) - multiply(x, dw)
    along_v = multiply(dy, w) - multiply(y, dw)
    found = [bernstein_roots(p) for p in (along_u, along_v, along_u - along_v, along_u + along_v)]
    return np.concatenate([row for row, _ in found]), np.concatenate([t for _, t in found])


@dataclass(frozen=True, eq=False)
class Chain:
    """Curves end to end: control points, the corners (u, v) they start and end at, and names."""

    curves: Sequence[Array]  # each (k, 3)
    corners: Array  # (n, 2, 2), shared bit for bit
    loop: Indices
    source: Indices


def monotone_pieces(chain: Chain) -> Pieces:
    """The curves of a chain, cut where they turn; points are left out."""
    order = np.array([len(curve) for curve in chain.curves])
    table = np.full(len(order), STRAIGHT)
    row = np.zeros(len(order), dtype=np.intp)
    tables: list[Array] = []
    cut_curve, cut_at = [np.empty(0, dtype=np.intp)], [np.empty(0)]
    for k in np.unique(order[order > 2]):
        members = np.flatnonzero(order == k)
        table[members], row[members] = len(tables), np.arange(len(members))
        tables.append(np.stack([chain.curves[i] for i in members.tolist()]))
        rows, t = turning_points(tables[-1])
        inner = (t > LEAST_SPAN) & (t < 1.0 - LEAST_SPAN)
        rows, t = rows[inner], t[inner]
        cut_curve.append(members[rows])
        cut_at.append(t)
    curve, t = np.concatenate(cut_curve), np.concatenate(cut_at)
    everything = np.arange(len(order))
    curve = np.concatenate([everything, curve])
    start = np.concatenate([np.zeros(len(order)), t])
    by_place = np.lexsort((start, curve))
    curve, start = curve[by_place], start[by_place]
    fresh = np.ones(len(curve), dtype=bool)
    fresh[1:] = (curve[1:] != curve[:-1]) | (np.diff(start) > LEAST_SPAN)
    curve, start = curve[fresh], start[fresh]
    last = np.asarray(curve != np.append(curve[1:], -1)[: len(curve)])
    end = np.where(last, 1.0, np.append(start[1:], 1.0)[: len(curve)])
    pieces = Pieces(
        tuple(tables), table[curve], row[curve], np.stack([start, end], -1),
        chain.corners[curve], chain.loop[curve], chain.source[curve],
    )  # fmt: skip
    followed = np.flatnonzero(~last)
    joint = pieces.points(followed, end[followed])
    pieces.ends[followed, 1] = pieces.ends[followed + 1, 0] = joint
    return pieces.without_points()


def clamp_to_square(pieces: Pieces) -> Pieces:
    """The loops drawn in from outside [0,1]^2 onto its border, where they are straight.

    The winding number about a point inside the square stays what it was.
    """
    for axis in (0, 1):
        for value in (0.0, 1.0):
            side = np.sign(pieces.ends[:, :, axis] - value)
            index = np.flatnonzero(side[:, 0] * side[:, 1] < 0.0)
            t = pieces.solve(index, axis, np.full(len(index), value))
            at = pieces.points(index, t)
            at[:, axis] = value
            pieces = pieces.split(index, t, at)
    ends = np.clip(pieces.ends, 0.0, 1.0)
    outside = (ends != pieces.ends).any((1, 2))
    outside |= on_border(ends)
    table = np.where(outside, STRAIGHT, pieces.table)
    span = np.where(outside[:, None], [0.0, 1.0], pieces.span)
    return replace(pieces, table=table, span=span, ends=ends).without_points()


def on_border(ends: Array) -> Mask:
    """Which pieces (n, 2, 2) run along one side of the unit square."""
    return np.asarray(((ends == 0.0).all(1) | (ends == 1.0).all(1)).any(-1))
