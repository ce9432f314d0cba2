"""Graphs cut to boxes, as stretches that few numbers describe.

A stretch inside a cell is so short that four numbers of the bump say where it runs, or else it is
halved. Its ends lie on a lattice: 2^15 steps along the cell's side, which are 16 bits with the
margins. There sums and differences of them are exact, and the two stretches that meet agree on
which side of either a point lies, whatever the rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .graphs import FIT, FLAT, SHORTEST, STEEP, TERMS, Graphs, bump_basis, horner, moved
from .pieces import Array, Indices

STEPS = 1 << 15  # of the lattice, along a cell's side
CELL_TERMS = 4  # of the bump
PORTION = 1 << 13  # stretches at a time: what stays in a processor's cache
BUMP_STEP = 0.5  # of the lattice: what a bump's numbers are rounded to
LARGEST_BUMP = 32700.0 * BUMP_STEP
CELL_NODES, TO_CELL_BUMP = bump_basis(CELL_TERMS)
CELL_CHECKS = np.array([0.5, 0.03, 0.2, 0.8, 0.97])
_POWERS = np.arange(TERMS)[:, None]
FROM_SWELL = TO_CELL_BUMP @ (CELL_NODES**_POWERS).T  # the bump of all TERMS -> of CELL_TERMS
MISSED = (CELL_CHECKS * (1.0 - CELL_CHECKS))[:, None] * (
    (CELL_CHECKS**_POWERS).T - (CELL_CHECKS ** _POWERS[:CELL_TERMS]).T @ FROM_SWELL
)  # ... -> what is missed at CELL_CHECKS


@dataclass(frozen=True, eq=False)
class Cut:
    """Stretches of graphs inside boxes: graphs (m) and, for each, the number of its box (m,)."""

    graphs: Graphs
    box: Indices

    def take(self, index: Indices) -> Cut:
        """Some of the stretches."""
        return Cut(self.graphs.take(index), self.box[index])


def joined(first: Cut, second: Cut) -> Cut:
    """The stretches of both."""
    a, b = first.graphs, second.graphs
    graphs = Graphs(
        np.append(a.axis, b.axis),
        np.concatenate([a.ends, b.ends]),
        np.concatenate([a.bump, b.bump]),
    )
    return Cut(graphs, np.append(first.box, second.box))


@dataclass(frozen=True, eq=False)
class Stretches:
    """Parts of graphs inside boxes: which graphs and boxes (m,), and their ends as (x, f(x)) in the
    graphs' direction (m, 2, 2)."""

    index: Indices
    box: Indices
    ends: Array

    def polynomials(self, graphs: Graphs, number: Indices) -> Array:
        """f along stretches with these numbers, by s from 0 to 1: (terms + 2, k)."""
        index = self.index[number]
        start, end = (graphs.taus(index, self.ends[number, side, 0]) for side in (0, 1))
        return moved(graphs.powers[:, index], start, end - start)

    def take(self, number: Indices) -> Stretches:
        """Some of them."""
        return Stretches(self.index[number], self.box[number], self.ends[number])


def stretches_in(
    graphs: Graphs, index: Indices, box: Indices, low: Array, high: Array
) -> Stretches:
    """The parts of graphs with these numbers in their own boxes [low, high] (boxes, 2).

    What runs along the upper edge of a box of another axis than its own is not in it.
    """
    axis = graphs.axis[index]
    steep = axis == STEEP
    x_least, x_most = (each[index] for each in graphs.x_range)
    y_least, y_most = (each[index] for each in graphs.y_range)
    (u_low, v_low), (u_high, v_high) = low[box].T, high[box].T
    x_low, x_high = np.where(steep, v_low, u_low), np.where(steep, v_high, u_high)
    y_low, y_high = np.where(steep, u_low, v_low), np.where(steep, u_high, v_high)
    first, last = np.maximum(x_least, x_low), np.minimum(x_most, x_high)
    met = np.flatnonzero((first < last) & (y_most >= y_low) & (y_least <= y_high))
    index, box = index[met], box[met]
    first, last, y_low, y_high = first[met], last[met], y_low[met], y_high[met]
    at = np.stack([first, last])
    values = np.stack([graphs.values(index, first), graphs.values(index, last)])
    for side in (0, 1):
        for bound, sign in ((y_low, -1.0), (y_high, 1.0)):
            beyond = np.flatnonzero(
                (sign * (values[side] - bound) > 0.0) & (sign * (values[1 - side] - bound) < 0.0)
            )
            at[side, beyond] = graphs.solve(index[beyond], bound[beyond])
            values[side, beyond] = bound[beyond]
    level = values[0] == values[1]
    within = np.maximum(*values) > y_low
    within &= (np.minimum(*values) < y_high) & (at[0] < at[1])
    within = within | (level & (values[0] >= y_low) & (values[0] < y_high))
    kept = np.flatnonzero(np.asarray(within))
    own = graphs.x[index[kept]]
    turned = (own[:, 0] > own[:, 1])[:, None, None]
    ends = np.stack([at[:, kept].T, values[:, kept].T], -1)
    return Stretches(index[kept], box[kept], np.where(turned, ends[:, ::-1], ends))


def cut_to_boxes(
    graphs: Graphs, index: Indices, box: Indices, low: Array, high: Array, step: float
) -> Cut:
    """Graphs with these numbers, each cut to its own box [low, high] (boxes, 2); empty ones go.

    Every stretch has CELL_TERMS numbers in its bump, none above LARGEST_BUMP steps of the
    lattice.
    """
    left = stretches_in(graphs, index, box, low, high)
    done: list[tuple[Indices, Array, Array, Indices]] = []
    while len(left.index) or not done:
        bump, middle, good = _fit(graphs, left, step)
        ready = left.take(np.flatnonzero(good))
        done.append((graphs.axis[ready.index], ready.ends, bump[good], ready.box))
        bad = np.flatnonzero(~good)
        halves = [np.stack([left.ends[bad, 0], middle[bad]], 1)]
        halves.append(np.stack([middle[bad], left.ends[bad, 1]], 1))
        ends = np.stack(halves, 1).reshape(-1, 2, 2)
        left = Stretches(np.repeat(left.index[bad], 2), np.repeat(left.box[bad], 2), ends)
    axis, ends, bump, box = (np.concatenate(parts) for parts in zip(*done, strict=True))
    ends = np.where((axis == STEEP)[:, None, None], ends[..., ::-1], ends)
    return Cut(Graphs(axis, ends, bump), box)


def _fit(
    graphs: Graphs, stretches: Stretches, step: float
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """The bumps of stretches, the points amid them, and which of the stretches are good."""
    count = len(stretches.index)
    bump, middle = np.zeros((count, CELL_TERMS)), stretches.ends.mean(1)
    good = np.ones(count, dtype=bool)
    everything = np.flatnonzero(graphs.bent[stretches.index])
    for first in range(0, len(everything), PORTION):
        bent = everything[first : first + PORTION]
        (x0, y0), (x1, y1) = np.moveaxis(stretches.ends[bent], 0, -1)
        powers = stretches.polynomials(graphs, bent)
        swell = powers[1:-1].copy()  # s dy + s (1 - s) swell(s) is the polynomial less y0
        swell[0] -= y1 - y0
        for row in range(1, len(swell)):
            swell[row] += swell[row - 1]
        told = FROM_SWELL @ swell
        off = np.abs(MISSED @ swell).max(0)
        fits = (off <= max(FIT, 0.3 * step)) & (np.abs(told).max(0) <= LARGEST_BUMP * step)
        good[bent] = fits | (np.abs(x1 - x0) < min(SHORTEST, step))
        bump[bent] = np.clip(told.T, -LARGEST_BUMP * step, LARGEST_BUMP * step)
        middle[bent, 1] = horner(powers, np.full(len(bent), 0.5))
    return bump, middle, good


def to_lattice(points: Array, step: float) -> Array:
    """Points of the plane as the nearest ones of the lattice."""
    return np.asarray(np.round(points / step) * step)


def on_lattice(cut: Cut, step: float) -> Cut:
    """The same with the ends on the lattice; a graph that has no extent there is one over the
    other axis, or none."""
    graphs = cut.graphs
    ends = to_lattice(graphs.ends, step)
    extent = np.abs(ends[:, 1] - ends[:, 0])
    number = np.arange(len(ends))
    upright = extent[number, graphs.axis] == 0.0
    axis = np.where(upright, 1 - graphs.axis, graphs.axis)
    bump = np.where(upright[:, None], 0.0, graphs.bump)
    lasting = np.flatnonzero(extent[number, axis] > 0.0)
    return Cut(Graphs(axis, ends, bump), cut.box).take(lasting)


def leaving(cut: Cut, high: Array) -> NDArray[np.bool_]:
    """Which ends (k, 2) lie on the right edge of their box."""
    return np.asarray(cut.graphs.ends[..., 0] == high[cut.box, :1])


def closing_pieces(cut: Cut, low: Array, high: Array) -> tuple[Cut, NDArray[np.bool_]]:
    """The pieces along each box's right edge from where graphs cross it to its foot, and which
    of them belong to flat graphs that end there."""
    ends, box = cut.graphs.ends, cut.box
    foot = np.stack([high[:, 0], low[:, 1]], -1)
    at_edge = leaving(cut, high)
    enters, leaves = np.flatnonzero(at_edge[:, 0]), np.flatnonzero(at_edge[:, 1])
    up = np.stack([foot[box[enters]], ends[enters, 0]], 1)
    down = np.stack([ends[leaves, 1], foot[box[leaves]]], 1)
    number = np.concatenate([enters, leaves])
    path = np.concatenate([up, down])
    axis = np.full(len(number), STEEP)
    pieces = Cut(Graphs(axis, path, np.zeros((len(number), CELL_TERMS))), box[number])
    lasting = np.flatnonzero((path[:, 0] != path[:, 1]).any(-1))
    flat = cut.graphs.axis[number] == FLAT
    return pieces.take(lasting), flat[lasting]
