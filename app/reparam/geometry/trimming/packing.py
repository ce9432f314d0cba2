"""A trim region as arrays for the GPU. Twin: shaders/lib/trim.glsl reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

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
    corners_of,
    first_side,
)
from .cutting import (
    CELL_TERMS,
    closing_pieces,
    cut_to_boxes,
    joined,
    leaving,
    on_lattice,
    to_lattice,
)
from .graphs import FLAT, Graphs, graphs_of
from .pieces import Array, Indices, Pieces
from .winding import WindingIndex

WINDING, KIND = 1 << 24, 1 << 10
UNTOLD = -1
KINDS = STEEP_PIECE, CLOSING_PIECE, FLAT_PIECE = 0, 1, 2
NONE = np.empty(0, dtype=np.intp)


@dataclass(frozen=True, eq=False)
class PackedTrim:
    """side: cells along a side of the first grid.

    nodes (n, 2) int32: the first grid's cells row by row, then those that divide a cell, and so
    on. A node is its first piece + WINDING times its winding number, and how many pieces it has,
    steep + KIND times closing + KIND^2 times flat; they come in this order. A closing piece is a
    flat one that leaves the cell's box by its right edge, where the winding number of what lies
    below changes for good. A node too crowded for that has UNTOLD. divisions (n,) int32: the
    first of the cells that divide it, or 0. pieces (m, 2, 4) float32: (x0, x1, y0, y1 - y0), x
    being the axis that one is over, and the bump b0 .. b3. shares: what share stays of
    the cells of a grid twice as fine, (2 side, 2 side), of four of them together, and so on up to
    the whole.
    """

    side: int
    nodes: NDArray[np.int32]
    divisions: NDArray[np.int32]
    pieces: NDArray[np.float32]
    shares: tuple[Array, ...]

    @cached_property
    def divided(self) -> bool:
        """Whether any cell is."""
        return bool(self.divisions.any())


def pack(pieces: Pieces, index: WindingIndex) -> PackedTrim:
    """The region bounded by pieces in the unit square; `index` holds the same pieces.

    Raises ValueError where more pieces meet in one place than a node can tell of.
    """
    graphs = graphs_of(pieces)
    side = first_side(graphs)
    low, size = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side
    number, cell = cells_met(graphs, side, MARGIN)
    level = _Level(index, graphs, number, cell, low, size)
    nodes, divisions, parts, cells, listed = [], [], [], 0, 0
    for depth in range(DEPTH):
        cells += len(level.low)
        divided = np.flatnonzero(level.counts > MANY) if depth < DEPTH - 1 else NONE
        nodes.append(level.nodes(listed, divided))
        divisions.append(np.zeros(len(level.low), dtype=np.int32))
        divisions[-1][divided] = cells + DIVISION**2 * np.arange(len(divided))
        parts.append(level.pieces())
        listed += len(parts[-1])
        if len(divided) == 0:
            break
        level = level.below(divided)
    return PackedTrim(
        side,
        np.concatenate(nodes).astype(np.int32),
        np.concatenate(divisions),
        np.concatenate(parts),
        tuple(_halved(_shares(index, graphs, 2 * side))),
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
        bottom, top = (to_lattice(self.low + m) for m in (-margin, self.size + margin))
        inner = on_lattice(cut_to_boxes(self.graphs, self.number, self.cell, bottom, top))
        closing, of_flat = closing_pieces(inner, bottom, top)
        self.winding = base_windings(self.index, joined(inner, closing), self.low, self.size)
        cut = joined(inner, closing.take(np.flatnonzero(~of_flat)))
        closes = (cut.graphs.axis == FLAT) & leaving(cut, top).any(1)
        kind = np.where(closes, CLOSING_PIECE, np.where(cut.graphs.axis == FLAT, FLAT_PIECE, 0))
        order = np.lexsort((kind, cut.box))
        self.cut = cut.take(order)
        cells = len(self.low)
        self.kinds = np.bincount(self.cut.box * 3 + kind[order], minlength=3 * cells)
        self.kinds = self.kinds.reshape(cells, 3)
        self.counts = self.kinds.sum(1)

    def nodes(self, listed: int, divided: Indices) -> Indices:
        """Nodes (n, 2), whose pieces are numbered from `listed`."""
        begin = listed + np.cumsum(self.counts) - self.counts
        told = (self.kinds.max(1) < KIND) & (np.abs(self.winding) < 128)
        untold = np.setdiff1d(np.flatnonzero(~told), divided)
        if len(untold):
            raise ValueError(
                f"trim loops: expected fewer than {KIND} pieces in one place, "
                f"found {self.kinds[untold].max()}"
            )
        kinds = np.where(told, self.kinds @ [1, KIND, KIND**2], UNTOLD)
        return np.stack([begin + WINDING * np.where(told, self.winding, 0), kinds], -1)

    def pieces(self) -> NDArray[np.float32]:
        """The pieces (m, 2, 4), cell by cell."""
        graphs = self.cut.graphs
        x, y = graphs.along(np.arange(len(graphs)))
        numbers = [x, y[:, :1], y[:, 1:] - y[:, :1], graphs.bump[:, :CELL_TERMS]]
        return np.concatenate(numbers, 1).reshape(-1, 2, 4).astype(np.float32)

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
    """The share of each cell that stays, (side, side): Green's theorem within the cell."""
    low, size = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side
    cut = cut_to_boxes(graphs, *cells_met(graphs, side, 0.0), low, low + size)
    cut = joined(cut, closing_pieces(cut, low, low + size)[0])
    winding = base_windings(index, cut, low, size)
    area = np.bincount(cut.box, areas_beside(cut.graphs, low[cut.box, 0]), len(low))
    return np.clip(winding + area / size**2, 0.0, 1.0).reshape(side, side)


def _halved(shares: Array) -> Iterator[Array]:
    """A square of shares, and half as large ones down to one."""
    yield shares
    while len(shares) > 1:
        shares = shares.reshape(len(shares) // 2, 2, -1, 2).mean((1, 3))
        yield shares


def corner_shares(shares: Array) -> Array:
    """At each (i, j) the shares of (i-1, j-1), (i-1, j), (i, j-1), (i, j), the outermost going on
    outside: (n + 1, n + 1, 4). Between four middles of cells one of them tells all."""
    wide = np.pad(shares, 1, mode="edge")
    return np.stack([wide[:-1, :-1], wide[:-1, 1:], wide[1:, :-1], wide[1:, 1:]], -1)
