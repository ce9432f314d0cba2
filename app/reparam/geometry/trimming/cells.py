"""A tree of cells over the graphs of a region, so that a fragment tests few of them.

The unit square is a grid; a cell with many graphs is a grid again. Each leaf has its own graphs,
cut off where they leave the cell and a margin around it, which is there for the pixels whose
middle lies in the cell:

        +-------------------+
        |  +-------------+  |      The winding number of a point of the leaf is that of the
        |  |   cell      | \\|      leaf plus the graphs that a ray to the right meets. Where a
        |  |         ____|__*      graph leaves by the right edge (*) a straight piece leads
        |  +--------/----+  |      down along the edge, and where one enters a piece leads up:
        +---------/---------+      so no graph outside the leaf counts.

(W. Schollmeyer and B. Froehlich, Direct trimming of NURBS surfaces on the GPU, SIGGRAPH 2009,
sort by v and then by u; a grid finds most fragments' answer with one look, and the pieces around
a pixel too, for antialiasing.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .graphs import FLAT, NODES, POWERS, STEEP, TERMS, Graphs, bump_of
from .pieces import Array, Indices, Mask
from .winding import WindingIndex, expand

MARGIN = 0.26  # of a cell, on each side: pixels up to half a cell wide
MANY = 16  # graphs in a leaf: it is divided
DIVISION = 4  # into so many by so many
DEPTH = 5
COARSEST, FINEST = 16, 256  # cells along a side of the first grid
NEAR = 1e-7
PLACES = np.array([[0.4142, 0.6180], [0.7321, 0.2361], [0.1459, 0.4495], [0.8541, 0.9271]])
BETA = 1.0 / (POWERS + 2.0) / (POWERS + 3.0)  # integrals of tau^(k+1) (1-tau)


@dataclass(frozen=True, eq=False)
class Cut:
    """Stretches of graphs inside boxes: graphs (m) and, for each, the number of its box (m,)."""

    graphs: Graphs
    box: Indices

    def take(self, index: Indices) -> Cut:
        """Some of the stretches."""
        return Cut(self.graphs.take(index), self.box[index])


def cut_to_boxes(graphs: Graphs, index: Indices, box: Indices, low: Array, high: Array) -> Cut:
    """Graphs with these numbers, each cut to its own box [low, high] (boxes, 2); empty ones go."""
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
    forward = x[:, 0] <= x[:, 1]
    start, end = (np.stack([a, v], -1) for a, v in zip(at, values, strict=True))
    ends = np.stack(
        [np.where(forward[:, None], start, end), np.where(forward[:, None], end, start)], 1
    )
    kept = np.flatnonzero(np.asarray(within))
    bump = _bump_between(graphs, index[kept], ends[kept])
    steep = axis[kept] == STEEP
    ends = np.where(steep[:, None, None], ends[kept][..., ::-1], ends[kept])
    return Cut(Graphs(axis[kept], ends, bump), box[kept])


def _bump_between(graphs: Graphs, index: Indices, ends: Array) -> Array:
    """The bumps of stretches whose ends are given as (x, f(x)): (k, 2, 2)."""
    x = ends[:, :1, 0] + NODES * (ends[:, 1:, 0] - ends[:, :1, 0])
    interior = graphs.values(np.repeat(index, TERMS), x.ravel()).reshape(-1, TERMS)
    bump = bump_of(interior, ends[:, 0, 1], ends[:, 1, 1])
    bent = np.abs(graphs.bump[index]).max(1, keepdims=True) > 0.0
    return np.where(bent, bump, 0.0)


def close_on_the_right(cut: Cut, low: Array, high: Array) -> Cut:
    """With them, the pieces along each box's right edge from where graphs cross it to its foot."""
    graphs, box = cut.graphs, cut.box
    at_edge = graphs.ends[..., 0] == high[box, 0][:, None]
    foot = np.stack([high[:, 0], low[:, 1]], -1)
    enters, leaves = np.flatnonzero(at_edge[:, 0]), np.flatnonzero(at_edge[:, 1])
    up = np.stack([foot[box[enters]], graphs.ends[enters, 0]], 1)
    down = np.stack([graphs.ends[leaves, 1], foot[box[leaves]]], 1)
    ends = np.concatenate([graphs.ends, up, down])
    axis = np.append(graphs.axis, np.full(len(up) + len(down), STEEP))
    bump = np.concatenate([graphs.bump, np.zeros((len(up) + len(down), TERMS))])
    box = np.concatenate([box, box[enters], box[leaves]])
    lasting = np.flatnonzero((ends[:, 0] != ends[:, 1]).any(-1))
    return Cut(Graphs(axis, ends, bump), box).take(lasting)


def cells_met(graphs: Graphs, side: int, margin: float) -> tuple[Indices, Indices]:
    """Which graphs may come into which cells (row * side + column) of a grid, with its margin.

    Column by column for the flat ones, as they rise by no more than a cell in each, and row by
    row for the steep ones.
    """
    everything = np.arange(len(graphs))
    x, _ = graphs.along(everything)
    first, last = _span_of_cells(x.min(1), x.max(1), side, margin)
    number, major = expand(first, (last - first + 1).clip(0))
    ends_x, _ = graphs.along(number)
    bound = np.stack([major - margin, major + 1.0 + margin], -1) / side
    bound = np.clip(bound, ends_x.min(1)[:, None], ends_x.max(1)[:, None])
    values = np.stack([graphs.values(number, edge) for edge in bound.T], -1)
    first, last = _span_of_cells(values.min(1), values.max(1), side, margin)
    again, minor = expand(first, (last - first + 1).clip(0))
    number, major = number[again], major[again]
    flat = graphs.axis[number] == FLAT
    return number, np.where(flat, minor * side + major, major * side + minor)


def _span_of_cells(low: Array, high: Array, side: int, margin: float) -> tuple[Indices, Indices]:
    first = np.floor(np.clip(low * side - margin, 0, side) - 1e-9)
    last = np.floor(np.clip(high * side + margin, -1, side - 1) + 1e-9)
    return np.maximum(first, 0).astype(np.intp), last.astype(np.intp)


def corners_of(low: Array, size: float, division: int) -> Array:
    """Lower corners (n * division^2, 2) of the cells in squares (n, 2), row by row."""
    step = np.arange(division) * (size / division)
    cell = np.stack(np.meshgrid(step, step), -1).reshape(-1, 2)
    return np.asarray((low[:, None] + cell).reshape(-1, 2))


def first_side(graphs: Graphs) -> int:
    """Cells along a side of the first grid: about four for a graph."""
    wanted = np.log2(max(4 * len(graphs), 1)) / 2.0
    return int(np.clip(2 ** round(wanted), COARSEST, FINEST))


def base_windings(index: WindingIndex, cut: Cut, low: Array, size: float) -> Indices:
    """The winding numbers (n,) of cells with corners low (n, 2): that of a point in each, less
    what its ray meets in `cut`, which has no pieces without extent."""
    points = low + size * PLACES[0]
    for place in PLACES[1:]:
        near = np.zeros(len(low), dtype=bool)
        near[cut.box[near_graphs(cut.graphs, points[cut.box])]] = True
        points[near] = low[near] + size * place
    met = np.bincount(cut.box, ray_crossings(cut.graphs, points[cut.box]), len(low))
    return np.asarray(index.winding(points) - met.round().astype(np.intp))


def near_graphs(graphs: Graphs, points: Array) -> Mask:
    """Which graphs come so near to points (k, 2) that rounding may tell the side wrong."""
    x, _ = graphs.along(np.arange(len(graphs)))
    steep = graphs.axis == STEEP
    here = np.where(steep, points[:, 1], points[:, 0])
    value = graphs.values(np.arange(len(graphs)), np.clip(here, x.min(1), x.max(1)))
    return np.asarray(np.abs(value - np.where(steep, points[:, 0], points[:, 1])) < NEAR)


def ray_crossings(graphs: Graphs, points: Array) -> Indices:
    """+1 or -1 where the ray to the right from a point (k, 2) meets the graph beside it, else 0.

    Twin: ray_crossing in shaders/lib/trim.glsl.
    """
    everything = np.arange(len(graphs))
    x, y = graphs.along(everything)
    u, v = points.T
    start, end = graphs.ends[:, 0, 1], graphs.ends[:, 1, 1]
    steep = graphs.axis == STEEP
    here = np.clip(np.where(steep, v, u), x.min(1), x.max(1))
    value = graphs.values(everything, here)
    rising = (y[:, 1] > y[:, 0]) == (x[:, 1] > x[:, 0])
    met = np.where(steep, value > u, np.where(rising, value <= v, value > v))
    return np.where(((start <= v) != (end <= v)) & met, np.where(end > start, 1, -1), 0)


def areas_beside(graphs: Graphs, left: Array) -> Array:
    """Integrals of (u - left) dv along graphs (n,), left (n,)."""
    everything = np.arange(len(graphs))
    x, y = graphs.along(everything)
    run = x[:, 1] - x[:, 0]
    under = run * ((y[:, 0] + y[:, 1]) / 2.0 + graphs.bump @ BETA)  # of f dx
    steep = under - left * run
    flat = (x[:, 1] - left) * y[:, 1] - (x[:, 0] - left) * y[:, 0] - under
    return np.where(graphs.axis == STEEP, steep, flat)
