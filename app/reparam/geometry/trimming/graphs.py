"""Trim curves as graphs of polynomials, the form in which a GPU decides in one step.

A monotone piece that is nowhere steeper than 45 degrees is a function v = f(u), the others are
u = f(v): on which side a point lies is one comparison, with no iteration. f is a polynomial of
degree 9 through both end points,

    f(x) = y0 + tau (y1 - y0) + tau (1 - tau) (b0 + b1 tau + ... + b7 tau^7),

tau = (x - x0)/(x1 - x0), on stretches so short that it is within FIT of the curve, less than
a step of float32 at 1. The slope is at most 1, so what is off in f is not less off the curve.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .pieces import STRAIGHT, Array, Indices, Mask, Pieces, on_border

FIT = 5e-8  # of the domain
SHORTEST = 1e-8
MOST_STEPS = 60
TERMS = 8  # of the bump
CHECKS = np.array([0.013, 0.07, 0.3, 0.5, 0.7, 0.93, 0.987])  # and here it is most off
FLAT, STEEP = 0, 1


def bump_basis(terms: int) -> tuple[Array, Array]:
    """Where f meets the curve, (terms,), and what makes of the swell there b0, b1 ...: (terms,
    terms)."""
    nodes = (1.0 - np.cos(np.pi * np.arange(1, terms + 1) / (terms + 1))) / 2.0
    return nodes, np.asarray(np.linalg.inv(nodes[:, None] ** np.arange(terms)), np.float64)


NODES, TO_BUMP = bump_basis(TERMS)


@dataclass(frozen=True, eq=False)
class Graphs:
    """n directed graphs: axis (n,), FLAT: v over u, STEEP: u over v; ends (n, 2, 2) as (u, v);
    bump (n, terms): b0, b1 ..."""

    axis: Indices
    ends: Array
    bump: Array

    def __len__(self) -> int:
        return len(self.axis)

    def take(self, index: Indices) -> Graphs:
        """Some of the graphs."""
        return Graphs(self.axis[index], self.ends[index], self.bump[index])

    @cached_property
    def x(self) -> Array:
        """(start, end) in the axis that the graphs are over: (n, 2)."""
        return np.where((self.axis == STEEP)[:, None], self.ends[..., 1], self.ends[..., 0])

    @cached_property
    def y(self) -> Array:
        """(start, end) in the other axis: (n, 2)."""
        return np.where((self.axis == STEEP)[:, None], self.ends[..., 0], self.ends[..., 1])

    @cached_property
    def x_range(self) -> tuple[Array, Array]:
        """From the least to the greatest x: (n,) each."""
        return np.minimum(*self.x.T), np.maximum(*self.x.T)

    @cached_property
    def y_range(self) -> tuple[Array, Array]:
        """From the least to the greatest y: (n,) each."""
        return np.minimum(*self.y.T), np.maximum(*self.y.T)

    @cached_property
    def bent(self) -> Mask:
        """Which are no straight lines: (n,)."""
        return np.asarray(self.bump.any(1))

    @cached_property
    def powers(self) -> Array:
        """f as a polynomial in tau, lowest power first: (terms + 2, n)."""
        result = np.zeros((self.bump.shape[1] + 2, len(self)))
        result[0], result[1] = self.y[:, 0], self.y[:, 1] - self.y[:, 0]
        result[1:-1] += self.bump.T
        result[2:] -= self.bump.T
        return result

    def taus(self, index: Indices, x: Array) -> Array:
        """tau of the graphs with these numbers at x: (k,)."""
        x0, x1 = self.x[index].T
        return np.asarray((x - x0) / (x1 - x0))

    def values(self, index: Indices, x: Array) -> Array:
        """f of the graphs with these numbers at x: (k,)."""
        tau, (y0, y1) = self.taus(index, x), self.y[index].T
        result = np.asarray(y0 + tau * (y1 - y0))
        bent = np.flatnonzero(self.bent[index])
        tau = tau[bent]
        result[bent] += tau * (1.0 - tau) * horner(self.bump.T[:, index[bent]], tau)
        return result

    def solve(self, index: Indices, y: Array) -> Array:
        """Where f takes the values y, as f is monotone: (k,).

        Newton's method, with bisection where it leaves the bracket.
        """
        powers, rising = self.powers[:, index], self.y[index, 1] >= self.y[index, 0]
        low, high = np.zeros(len(index)), np.ones(len(index))
        result, active = np.full(len(index), 0.5), np.arange(len(index))
        for _ in range(MOST_STEPS):
            if len(active) == 0:
                break
            tau = result[active]
            off = horner(powers, tau) - y
            below = (off < 0.0) == rising
            low, high = np.where(below, tau, low), np.where(below, high, tau)
            slope = horner(powers[1:] * np.arange(1.0, len(powers))[:, None], tau)
            after = tau - off / np.where(slope == 0.0, 1.0, slope)
            within = (slope != 0.0) & (low <= after) & (after <= high)
            after = np.where(within, after, (low + high) / 2.0)
            result[active] = after
            going = np.abs(after - tau) > 1e-13
            active, powers, y, rising = active[going], powers[:, going], y[going], rising[going]
            low, high = low[going], high[going]
        x0, x1 = self.x[index].T
        return np.asarray(x0 + result * (x1 - x0))


def horner(coefficients: Array, t: Array) -> Array:
    """Polynomials (k, n), lowest power first, at t (n,) or (m, n)."""
    result = coefficients[-1]
    for row in coefficients[-2::-1]:
        result = row + t * result
    return np.asarray(result)


def moved(powers: Array, start: Array, length: Array) -> Array:
    """Polynomials (k, n) in tau as ones in s, tau = start + s length: (k, n)."""
    result = powers.copy()
    for first in range(len(result) - 1):
        for row in range(len(result) - 2, first - 1, -1):
            result[row] += start * result[row + 1]
    scale = np.ones(len(length))
    for row in range(1, len(result)):
        scale = scale * length
        result[row] *= scale
    return result


def bump_of(interior: Array, first: Array, last: Array) -> Array:
    """Coefficients (n, TERMS) from f at the NODES (n, TERMS) and at both ends (n,)."""
    chord = first[:, None] + NODES * (last - first)[:, None]
    return np.asarray((interior - chord) / (NODES * (1.0 - NODES)) @ TO_BUMP.T)


def graphs_of(pieces: Pieces) -> Graphs:
    """The pieces as graphs, but for those along the border of the unit square.

    The region goes on beyond the border as it meets it: where a curve reaches the border, a
    straight piece leads on outwards, so that the border of the surface itself is no curve.
    """
    inner = pieces.take(~on_border(pieces.ends))
    extent = np.abs(inner.ends[:, 1] - inner.ends[:, 0])
    axis = np.where(extent[:, 1] > extent[:, 0], STEEP, FLAT)
    straight = np.flatnonzero(inner.table == STRAIGHT)
    bent = np.flatnonzero(inner.table != STRAIGHT)
    done = [Graphs(axis[straight], inner.ends[straight], np.zeros((len(straight), TERMS)))]
    ends = inner.ends[bent]
    while len(bent):
        fitted, good, middle = _fit(inner, bent, axis[bent], ends)
        done.append(Graphs(fitted.axis[good], fitted.ends[good], fitted.bump[good]))
        bent, ends, middle = bent[~good], ends[~good], middle[~good]
        halves = np.stack([np.stack([ends[:, 0], middle], 1), np.stack([middle, ends[:, 1]], 1)], 1)
        bent, ends = np.repeat(bent, 2), halves.reshape(-1, 2, 2)
    done.append(_outwards(inner.ends))
    return Graphs(
        np.concatenate([part.axis for part in done]),
        np.concatenate([part.ends for part in done]),
        np.concatenate([part.bump for part in done]),
    )


def _fit(pieces: Pieces, index: Indices, axis: Indices, ends: Array) -> tuple[Graphs, Mask, Array]:
    """Graphs of stretches of pieces, which of them are good, and the points amid them."""
    number = np.arange(len(index))
    x0, x1 = ends[number, 0, axis], ends[number, 1, axis]
    tau = np.concatenate([NODES, CHECKS])
    x = x0[:, None] + tau * (x1 - x0)[:, None]
    points = np.empty((*x.shape, 2))
    for over in (FLAT, STEEP):
        here = np.flatnonzero(axis == over)
        many = np.repeat(index[here], len(tau))
        t = pieces.solve(many, over, x[here].ravel())
        points[here] = pieces.points(many, t).reshape(len(here), len(tau), 2)
        points[here, :, over] = x[here]
    y = points[number[:, None], np.arange(len(tau)), 1 - axis[:, None]]
    bump = bump_of(y[:, :TERMS], ends[number, 0, 1 - axis], ends[number, 1, 1 - axis])
    graphs = Graphs(axis, ends, bump)
    many = np.repeat(number, len(CHECKS))
    values = graphs.values(many, x[:, TERMS:].ravel()).reshape(len(index), -1)
    off = np.abs(values - y[:, TERMS:]).max(1)
    good = (off <= FIT) | (np.abs(x1 - x0) < SHORTEST)
    return graphs, good, points[:, TERMS + len(CHECKS) // 2]


def _outwards(ends: Array) -> Graphs:
    """Segments of length 1 that lead out of the unit square where pieces (n, 2, 2) reach it."""
    leading = []
    for side in (0, 1):
        at = ends[:, side]
        way = np.where(at >= 1.0, 1.0, np.where(at <= 0.0, -1.0, 0.0))
        way[way[:, 0] != 0.0, 1] = 0.0  # at a corner, along u
        out = way.any(1)
        path = np.stack([at[out], at[out] + way[out]], 1)
        leading.append(path[:, ::-1] if side == 0 else path)
    path = np.concatenate(leading)
    axis = np.where(path[:, 0, 0] == path[:, 1, 0], STEEP, FLAT)
    return Graphs(axis, path, np.zeros((len(path), TERMS)))
