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
from .graphs import FLAT, STEEP, Graphs
from .pieces import Array, Indices, Mask
from .winding import WindingIndex, expand

MARGIN = 0.25  # of a cell, on each side: pixels up to half a cell wide
MANY = 16  # graphs in a leaf: it is divided
DIVISION = 4  # into so many by so many
MOST_DIVIDED = 1 << 14  # graphs in all the cells of a size that are divided: the fullest ones
DEPTH = 5
COARSEST = 16  # cells along a side of the coarsest grid
EXACT = 256  # and of the finest: its lattice is that of float32
CROWDED = 512  # of the only one, where there are so many graphs that EXACT would be the coarsest
NEAR = 3e-7
PLACES = np.array([[0.4142, 0.6180], [0.7321, 0.2361], [0.1459, 0.4495], [0.8541, 0.9271]])


def cells_met(graphs: Graphs, side: int, margin: float) -> tuple[Indices, Indices]:
    """Which graphs may come into which cells (row * side + column) of a grid, with its margin.

    Column by column for the flat ones, as they rise by no more than a cell in each, and row by
    row for the steep ones.
    """
    first, last = _span_of_cells(*graphs.x_range, side, margin)
    number, major = expand(first, (last - first + 1).clip(0))
    bound = np.stack([major - margin, major + 1.0 + margin], -1) / side
    bound = np.clip(bound, *(each[number, None] for each in graphs.x_range))
    values = [graphs.values(number, edge) for edge in bound.T]
    first, last = _span_of_cells(np.minimum(*values), np.maximum(*values), side, margin)
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


def sides_of_grids(graphs: Graphs) -> list[int]:
    """Cells along a side, the finest grid first: the coarsest has about four for a graph.

    Coarse grids are for large pixels. Where there are very many graphs, a cell for a large pixel
    has more of them than one likes to ask, and one fine grid is faster for the small pixels.
    """
    wanted = np.log2(max(4 * len(graphs), 1)) / 2.0
    sides = [max(2 ** round(wanted), COARSEST)]
    if sides[0] >= EXACT:
        return [CROWDED]
    while sides[0] < EXACT:
        sides.insert(0, 2 * sides[0])
    return sides


def base_windings(
    index: WindingIndex, cut: Cut, low: Array, size: float, told: Indices, step: float
) -> Indices:
    """The winding numbers (n,) of cells with corners low (n, 2): that of a point in each, less
    what its ray meets in `cut`, which has no pieces without extent.

    `told` are those of the points at PLACES[0], which count where no curve is near.
    """
    points, told = low + size * PLACES[0], told.copy()
    near, met = ray_crossings(cut.graphs, points[cut.box], NEAR + 2.0 * step)
    met = np.bincount(cut.box, met, len(low)).round().astype(np.intp)
    places = iter(PLACES[1:])
    boxes = np.unique(cut.box[near])
    chosen = np.flatnonzero(np.isin(cut.box, boxes)) if len(boxes) else boxes
    again = boxes
    while len(again):
        place = next(places, None)
        if place is None:
            break
        points[again] = low[again] + size * place
        near, crossed = ray_crossings(
            cut.graphs.take(chosen), points[cut.box[chosen]], NEAR + 2.0 * step
        )
        box = cut.box[chosen]
        met[again] = np.bincount(box, crossed, len(low))[again].round().astype(np.intp)
        again = np.unique(box[near])
        chosen = chosen[np.isin(box, again)]
    if len(boxes):
        told[boxes] = index.winding(points[boxes])
    return np.asarray(told - met)


def ray_crossings(graphs: Graphs, points: Array, margin: float) -> tuple[Mask, Indices]:
    """Which graphs come so near to points (k, 2) that rounding may tell the side wrong; and +1 or
    -1 where the ray to the right from a point meets the graph beside it, else 0: (k,) each."""
    x, y = graphs.x, graphs.y
    u, v = points.T
    start, end = graphs.ends[:, 0, 1], graphs.ends[:, 1, 1]
    steep = graphs.axis == STEEP
    along, across = np.where(steep, v, u), np.where(steep, u, v)
    here = np.clip(along, *graphs.x_range)
    value = graphs.values(np.arange(len(graphs)), here)
    rising = (y[:, 1] > y[:, 0]) == (x[:, 1] > x[:, 0])
    met = np.where(steep, value > u, np.where(rising, value <= v, value > v))
    crossed = np.where(((start <= v) != (end <= v)) & met, np.where(end > start, 1, -1), 0)
    return np.asarray(np.abs(value - across) < margin), crossed


def grid_windings(graphs: Graphs, border: Array, side: int) -> Indices:
    """The winding numbers (side^2,) of the points at PLACES[0] of a grid's cells, row by row.

    Where curves cross the horizontal lines through these points, counted from the right; `border`
    (n, 2, 2) are pieces along the square's own border, which are no graphs. A steep graph is asked
    where it crosses each line; a flat one where it is above each point of a row, and it crosses
    the lines between these heights before the next point.
    """
    u, v = ((np.arange(side) + place) / side for place in PLACES[0])
    rows, columns, signs = [], [], []

    def count(column: Indices, start: Array, end: Array, forward: Mask) -> None:
        """Crossings of what goes from height to height, with so many points on their left."""
        first, last = np.searchsorted(v, start), np.searchsorted(v, end)
        number, row = expand(np.minimum(first, last), np.abs(last - first))
        rows.append(row)
        columns.append(column[number])
        signs.append(np.where(((end > start) == forward)[number], 1, -1))

    upward = graphs.ends[:, 1, 1] > graphs.ends[:, 0, 1]
    low, high = graphs.ends[..., 1].min(1), graphs.ends[..., 1].max(1)
    steep = np.flatnonzero(graphs.axis == STEEP)
    first, last = np.searchsorted(v, low[steep]), np.searchsorted(v, high[steep])
    number, row = expand(first, last - first)
    rows.append(row)
    columns.append(np.searchsorted(u, graphs.values(steep[number], v[row])))
    signs.append(np.where(upward[steep[number]], 1, -1))

    flat = np.flatnonzero(graphs.axis == FLAT)
    x, y = graphs.x[flat], graphs.y[flat]
    turned = x[:, 0] > x[:, 1]
    y = np.where(turned[:, None], y[:, ::-1], y)
    first, last = np.searchsorted(u, x.min(1)), np.searchsorted(u, x.max(1))
    number, column = expand(first, last - first + 1)  # the stretch before each point, and the last
    begins, ends = column == first[number], column == last[number]
    inner = np.flatnonzero(~ends)
    height = y[number, 1]
    height[inner] = graphs.values(flat[number[inner]], u[column[inner]])
    before = np.where(begins, y[number, 0], np.roll(height, 1))
    count(column, before, height, ~turned[number])

    right = border[(border[..., 0] == 1.0).all(1)]
    beyond = np.full(len(right), side)
    count(beyond, right[:, 0, 1], right[:, 1, 1], np.ones(len(right), dtype=bool))
    place = np.concatenate(rows) * (side + 1) + np.concatenate(columns)
    met = np.bincount(place, np.concatenate(signs), side * (side + 1)).reshape(side, side + 1)
    from_right = met[:, ::-1].cumsum(1)[:, ::-1]
    return np.asarray(from_right[:, 1:].round().astype(np.intp).ravel())
