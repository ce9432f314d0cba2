"""A trim region as arrays for the GPU. Twin: shaders/lib/trim.glsl reads them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cells import (
    DEPTH,
    DIVISION,
    MANY,
    MARGIN,
    areas_beside,
    base_windings,
    cells_met,
    close_on_the_right,
    corners_of,
    cut_to_boxes,
    first_side,
)
from .graphs import FLAT, Graphs, graphs_of
from .pieces import Array, Indices, Pieces
from .winding import WindingIndex

FLAT_UNIT = 1 << 16
NONE = np.empty(0, dtype=np.intp)


@dataclass(frozen=True, eq=False)
class PackedTrim:
    """side: cells along a side of the first grid.

    nodes (n, 4) int32: the first grid's cells row by row, then those that divide a cell, and so
    on. A node is (its first piece, how many are steep, which come first, + FLAT_UNIT times how
    many are flat, its winding number, the first of the cells that divide it or 0). pieces
    (m, 3, 4) float32: (u0, v0, u1, v1) and the bump b0 .. b7. shares (side, side): the
    share of each cell of the first grid that stays.
    """

    side: int
    nodes: NDArray[np.int32]
    pieces: NDArray[np.float32]
    shares: Array


def pack(pieces: Pieces, index: WindingIndex) -> PackedTrim:
    """The region bounded by pieces in the unit square; `index` holds the same pieces."""
    graphs = graphs_of(pieces)
    side = first_side(graphs)
    low, size = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side
    number, cell = cells_met(graphs, side, MARGIN)
    level = _Level(index, graphs, number, cell, low, size)
    nodes, parts, cells, listed = [], [], 0, 0
    for depth in range(DEPTH):
        cells += len(level.low)
        divided = np.flatnonzero(level.counts > MANY) if depth < DEPTH - 1 else NONE
        nodes.append(level.nodes(listed, divided, cells))
        parts.append(level.pieces())
        listed += len(parts[-1])
        if len(divided) == 0:
            break
        level = level.below(divided)
    return PackedTrim(
        side,
        np.concatenate(nodes).astype(np.int32),
        np.concatenate(parts),
        _shares(index, graphs, side),
    )


@dataclass
class _Level:
    """The cells of one depth: lower corners (n, 2), size, and the graphs cut to them."""

    index: WindingIndex
    graphs: Graphs
    number: Indices
    cell: Indices
    low: Array
    size: float

    def __post_init__(self) -> None:
        margin = MARGIN * self.size
        bottom, top = self.low - margin, self.low + (self.size + margin)
        cut = cut_to_boxes(self.graphs, self.number, self.cell, bottom, top)
        cut = close_on_the_right(cut, bottom, top)
        x, _ = cut.graphs.along(np.arange(len(cut.graphs)))
        lasting = np.flatnonzero(x[:, 0].astype(np.float32) != x[:, 1].astype(np.float32))
        flat = cut.graphs.axis[lasting] == FLAT
        self.cut = cut.take(lasting[np.lexsort((flat, cut.box[lasting]))])
        self.counts = np.bincount(self.cut.box, minlength=len(self.low))

    def nodes(self, listed: int, divided: Indices, below: int) -> Indices:
        """Nodes (n, 4): pieces are numbered from `listed`, cells that divide from `below`."""
        flat = self.cut.graphs.axis == FLAT
        flats = np.bincount(self.cut.box[flat], minlength=len(self.low))
        begin = listed + np.cumsum(self.counts) - self.counts
        winding = base_windings(self.index, self.cut, self.low, self.size)
        under = np.zeros(len(self.low), dtype=np.intp)
        under[divided] = below + DIVISION**2 * np.arange(len(divided))
        return np.stack([begin, self.counts - flats + FLAT_UNIT * flats, winding, under], -1)

    def pieces(self) -> NDArray[np.float32]:
        """The pieces (m, 3, 4), cell by cell, the steep ones first."""
        graphs = self.cut.graphs
        numbers = np.concatenate([graphs.ends.reshape(-1, 4), graphs.bump], 1)
        return numbers.reshape(-1, 3, 4).astype(np.float32)

    def below(self, divided: Indices) -> _Level:
        """The level of the cells that divided ones are divided into."""
        order = np.full(len(self.low), -1)
        order[divided] = np.arange(len(divided))
        number = np.flatnonzero(order[self.cell] >= 0)
        children = DIVISION**2
        cell = order[self.cell[number], None] * children + np.arange(children)
        low = corners_of(self.low[divided], self.size, DIVISION)
        return _Level(
            self.index, self.graphs, np.repeat(self.number[number], children), cell.ravel(),
            low, self.size / DIVISION,
        )  # fmt: skip


def _shares(index: WindingIndex, graphs: Graphs, side: int) -> Array:
    """The share of each cell of the first grid that stays (Green's theorem within the cell)."""
    low, size = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side
    cut = cut_to_boxes(graphs, *cells_met(graphs, side, 0.0), low, low + size)
    cut = close_on_the_right(cut, low, low + size)
    winding = base_windings(index, cut, low, size)
    area = np.bincount(cut.box, areas_beside(cut.graphs, low[cut.box, 0]), len(low))
    return np.clip(winding + area / size**2, 0.0, 1.0).reshape(side, side)
