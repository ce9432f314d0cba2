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

import numpy as np

from .pieces import STRAIGHT, Array, Indices, Mask, Pieces, on_border

FIT = 5e-8  # of the domain
SHORTEST = 1e-8
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
    bump (n, TERMS): b0, b1 ..."""

    axis: Indices
    ends: Array
    bump: Array

    def __len__(self) -> int:
        return len(self.axis)

    def take(self, index: Indices) -> Graphs:
        """Some of the graphs."""
        return Graphs(self.axis[index], self.ends[index], self.bump[index])

    def along(self, index: Indices) -> tuple[Array, Array]:
        """(start, end) in the axis that the graphs are over, and in the other: (k, 2) each."""
        number = np.arange(len(index))
        ends, axis = self.ends[index], self.axis[index]
        return ends[number, :, axis], ends[number, :, 1 - axis]

    def values(self, index: Indices, x: Array) -> Array:
        """f of the graphs with these numbers at x: (k,)."""
        (x0, x1), (y0, y1) = (pair.T for pair in self.along(index))
        tau = (x - x0) / (x1 - x0)
        return np.asarray(y0 + tau * (y1 - y0 + (1.0 - tau) * horner(self.bump[index], tau)))

    def solve(self, index: Indices, y: Array) -> Array:
        """Where f takes the values y, by bisection, as f is monotone: (k,)."""
        (x0, x1), (y0, y1) = (pair.T for pair in self.along(index))
        bump, low, high = self.bump[index], np.zeros(len(index)), np.ones(len(index))
        sign = np.where(y1 >= y0, 1.0, -1.0)
        for _ in range(50):
            tau = (low + high) / 2.0
            value = y0 + tau * (y1 - y0 + (1.0 - tau) * horner(bump, tau))
            before = (value - y) * sign < 0.0
            low, high = np.where(before, tau, low), np.where(before, high, tau)
        return np.asarray(x0 + (low + high) / 2.0 * (x1 - x0))


def horner(coefficients: Array, t: Array) -> Array:
    """Polynomials (n, k), lowest power first, at t (n,)."""
    result = coefficients[:, -1]
    for column in coefficients.T[-2::-1]:
        result = column + t * result
    return np.asarray(result)


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
