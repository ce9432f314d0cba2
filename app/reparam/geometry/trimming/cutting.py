"""Graphs cut to boxes, as stretches that few numbers describe.

A stretch inside a cell is so short that four numbers of the bump say where it runs, or else it is
halved. Its ends lie on a lattice of float32: there, sums and differences of them are exact, and
the two stretches that meet agree on which side of either a point lies, whatever the rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .graphs import FIT, FLAT, SHORTEST, STEEP, TERMS, Graphs, bump_basis
from .pieces import Array, Indices

LATTICE = 2.0**23  # steps of the domain: what float32 has of [1,2]
CELL_TERMS = 4  # of the bump
CELL_NODES, TO_CELL_BUMP = bump_basis(CELL_TERMS)
CELL_CHECKS = np.array([0.5, 0.03, 0.2, 0.8, 0.97])


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


def cut_to_boxes(graphs: Graphs, index: Indices, box: Indices, low: Array, high: Array) -> Cut:
    """Graphs with these numbers, each cut to its own box [low, high] (boxes, 2); empty ones go.

    Every stretch has at most CELL_TERMS numbers in its bump, and the others 0.
    """
    axis = graphs.axis[index]
    number: Indices = np.arange(len(index))
    x, y = graphs.along(index)
    x_low, x_high = low[box][number, axis], high[box][number, axis]
    y_low, y_high = low[box][number, 1 - axis], high[box][number, 1 - axis]
    first, last = np.maximum(x.min(1), x_low), np.minimum(x.max(1), x_high)
    met = np.flatnonzero((first < last) & (y.max(1) >= y_low) & (y.min(1) <= y_high))
    index, box, axis = index[met], box[met], axis[met]
    x, first, last = x[met], first[met], last[met]
    y_low, y_high = y_low[met], y_high[met]
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
    within = (values.max(0) > y_low) & (values.min(0) < y_high) & (at[0] < at[1])
    within = within | (level & (values[0] >= y_low) & (values[0] <= y_high))
    kept = np.flatnonzero(np.asarray(within))
    turned = (x[kept, 0] > x[kept, 1])[:, None]
    ends = np.stack([at[:, kept].T, values[:, kept].T], -1)
    ends = np.where(turned[..., None], ends[:, ::-1], ends)
    return _fitted(graphs, index[kept], ends, box[kept])


def _fitted(graphs: Graphs, index: Indices, ends: Array, box: Indices) -> Cut:
    """Stretches of the graphs with these numbers, halved until they fit; ends (k, 2, 2) are
    (x, f(x))."""
    done: list[tuple[Indices, Array, Array, Indices]] = []
    while len(index):
        bump, middle, good = _fit(graphs, index, ends)
        done.append((graphs.axis[index[good]], ends[good], bump[good], box[good]))
        bad = np.flatnonzero(~good)
        index, box, ends, middle = index[bad], box[bad], ends[bad], middle[bad]
        halves = [np.stack([ends[:, 0], middle], 1), np.stack([middle, ends[:, 1]], 1)]
        ends = np.stack(halves, 1).reshape(-1, 2, 2)
        index, box = np.repeat(index, 2), np.repeat(box, 2)
    if not done:
        return Cut(graphs.take(index), box)
    axis, ends, bump, box = (np.concatenate(parts) for parts in zip(*done, strict=True))
    ends = np.where((axis == STEEP)[:, None, None], ends[..., ::-1], ends)
    return Cut(Graphs(axis, ends, bump), box)


def _fit(graphs: Graphs, index: Indices, ends: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """The bumps of stretches, the points amid them, and which of the stretches are good."""
    bump, middle = np.zeros((len(index), TERMS)), ends.mean(1)
    good = np.ones(len(index), dtype=bool)
    bent = np.flatnonzero(graphs.bump[index].any(1))
    (x0, y0), (x1, y1) = np.moveaxis(ends[bent], 0, -1)
    tau = np.concatenate([CELL_NODES, CELL_CHECKS])
    x = x0[:, None] + tau * (x1 - x0)[:, None]
    chord = y0[:, None] + tau * (y1 - y0)[:, None]
    values = graphs.values(np.repeat(index[bent], len(tau)), x.ravel()).reshape(x.shape)
    swell = (values - chord) / (tau * (1.0 - tau))
    bump[bent, :CELL_TERMS] = swell[:, :CELL_TERMS] @ TO_CELL_BUMP.T
    missed = swell[:, CELL_TERMS:] - bump[bent, :CELL_TERMS] @ (
        CELL_CHECKS ** np.arange(CELL_TERMS)[:, None]
    )
    off = np.abs(missed * CELL_CHECKS * (1.0 - CELL_CHECKS)).max(1, initial=0.0)
    good[bent] = (off <= FIT) | (np.abs(x1 - x0) < SHORTEST)
    middle[bent] = np.stack([x[:, CELL_TERMS], values[:, CELL_TERMS]], -1)
    return bump, middle, good


def to_lattice(points: Array) -> Array:
    """Points of the plane as the nearest ones of the lattice."""
    return np.asarray(np.round(points * LATTICE) / LATTICE)


def on_lattice(cut: Cut) -> Cut:
    """The same with the ends on the lattice; a graph that has no extent there is one over the
    other axis, or none."""
    graphs = cut.graphs
    ends = to_lattice(graphs.ends)
    extent = np.abs(ends[:, 1] - ends[:, 0])
    number = np.arange(len(ends))
    upright = extent[number, graphs.axis] == 0.0
    axis = np.where(upright, 1 - graphs.axis, graphs.axis)
    bump = np.where(upright[:, None], 0.0, graphs.bump)
    lasting = np.flatnonzero(extent[number, axis] > 0.0)
    return Cut(Graphs(axis, ends, bump), cut.box).take(lasting)


def leaving(cut: Cut, high: Array) -> NDArray[np.bool_]:
    """Which ends (k, 2) lie on the right edge of their box."""
    return np.asarray(cut.graphs.ends[..., 0] == high[cut.box, 0][:, None])


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
    pieces = Cut(Graphs(axis, path, np.zeros((len(number), TERMS))), box[number])
    lasting = np.flatnonzero((path[:, 0] != path[:, 1]).any(-1))
    flat = cut.graphs.axis[number] == FLAT
    return pieces.take(lasting), flat[lasting]
