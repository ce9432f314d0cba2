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

import numpy as np

from .cutting import Cut
from .graphs import FLAT, STEEP, TERMS, Graphs
from .pieces import Array, Indices, Mask
from .winding import WindingIndex, expand

MARGIN = 0.26  # of a cell, on each side: pixels up to half a cell wide
MANY = 16  # graphs in a leaf: it is divided
DIVISION = 4  # into so many by so many
DEPTH = 5
COARSEST, FINEST = 16, 256  # cells along a side of the first grid
NEAR = 3e-7
PLACES = np.array([[0.4142, 0.6180], [0.7321, 0.2361], [0.1459, 0.4495], [0.8541, 0.9271]])
BETA = 1.0 / (np.arange(TERMS) + 2.0) / (np.arange(TERMS) + 3.0)  # integrals of tau^(k+1) (1-tau)


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
    """+1 or -1 where the ray to the right from a point (k, 2) meets the graph beside it, else 0."""
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
