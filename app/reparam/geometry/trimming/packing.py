"""A trim region as arrays for the GPU. Twin: shaders/lib/trim.glsl reads them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .cells import (
    DEPTH,
    DIVISION,
    MANY,
    MARGIN,
    MOST_DIVIDED,
    PLACES,
    base_windings,
    cells_met,
    corners_of,
    grid_windings,
    sides_of_grids,
)
from .cutting import (
    BUMP_STEP,
    STEPS,
    closing_pieces,
    cut_to_boxes,
    joined,
    leaving,
    on_lattice,
)
from .graphs import FLAT, Graphs, graphs_of
from .pieces import Array, Indices, Pieces, on_border
from .shares import cell_shares, halved
from .winding import WindingIndex

WINDING = 1 << 16
MOST = WINDING - 1  # pieces in a node
STEEP_PIECE, CLOSING_PIECE, FLAT_PIECE = 0, 1, 2
KINDS = 4
NONE = np.empty(0, dtype=np.intp)


@dataclass(frozen=True, eq=False)
class PackedTrim:
    """sides: cells along a side of the grids, the finest first, each twice the next.

    nodes (n, 2) int32: the grids' cells row by row, then those that divide a cell of the finest,
    and so on. A node is its first piece, and how many it has + WINDING times its winding number.
    divisions (n,) int32: the first of the cells that divide it, or 0.

    pieces (m, 4) int32, two numbers of 16 bits in each, the first in the lower ones: (x0, x1),
    (y0, y1), (b0, b1), (b2, b3), x being the axis that one is over. Ends are in steps of the
    lattice from the middle of the cell, of which there are STEPS along its side; the bump is in
    BUMP_STEP of them, and the last two bits of b3 are the piece's kind. A closing piece is a flat
    one that leaves the cell's box by its right edge, where the winding number of what lies below
    changes for good.

    shares: what share stays of the cells of a grid twice as fine as the coarsest of the others,
    (2 side, 2 side), of four of them together, and so on up to the whole.
    """

    sides: tuple[int, ...]
    nodes: NDArray[np.int32]
    divisions: NDArray[np.int32]
    pieces: NDArray[np.int32]
    shares: tuple[Array, ...]

    @cached_property
    def divided(self) -> bool:
        """Whether any cell is."""
        return bool(self.divisions.any())

    @cached_property
    def cells(self) -> int:
        """How many the grids have."""
        return sum(side**2 for side in self.sides)


def pack(pieces: Pieces, index: WindingIndex) -> PackedTrim:
    """The region bounded by pieces in the unit square; `index` holds the same pieces.

    Raises ValueError where more than MOST pieces meet in one place.
    """
    graphs, border = graphs_of(pieces), pieces.ends[on_border(pieces.ends)]
    sides = sides_of_grids(graphs)
    grids = [_grid(index, graphs, border, side) for side in sides]
    levels = [grids[0]]  # from cells to those that divide them
    while len(levels) < DEPTH and len(levels[-1].crowded):
        levels.append(levels[-1].below())
    nodes, divisions, parts, listed = [], [], [], 0
    cells = sum(len(grid.low) for grid in grids)
    for level in [*grids, *levels[1:]]:
        divided = level.crowded if level in levels[:-1] else NONE
        nodes.append(level.nodes(listed))
        divisions.append(np.zeros(len(level.low), dtype=np.int32))
        divisions[-1][divided] = cells + DIVISION**2 * np.arange(len(divided))
        cells += DIVISION**2 * len(divided)
        parts.append(level.pieces())
        listed += len(parts[-1])
    return PackedTrim(
        tuple(sides),
        np.concatenate(nodes).astype(np.int32),
        np.concatenate(divisions),
        np.concatenate(parts),
        tuple(halved(cell_shares(graphs, border, 2 * sides[-1]))),
    )


def _grid(index: WindingIndex, graphs: Graphs, border: Array, side: int) -> _Level:
    low = corners_of(np.zeros((1, 2)), 1.0, side)
    told = grid_windings(graphs, border, side)
    return _Level(index, graphs, *cells_met(graphs, side, MARGIN), low, 1.0 / side, told)


@dataclass(eq=False)
class _Level:
    """Cells of one size: lower corners (n, 2), size, the graphs cut to them, and the winding
    numbers of the points at PLACES[0]."""

    index: WindingIndex
    graphs: Graphs
    number: Indices
    cell: Indices
    low: Array
    size: float
    told: Indices

    def __post_init__(self) -> None:
        margin, step = MARGIN * self.size, self.size / STEPS
        bottom, top = self.low - margin, self.low + (self.size + margin)
        inner = cut_to_boxes(self.graphs, self.number, self.cell, bottom, top, step)
        inner = on_lattice(inner, step)
        closing, of_flat = closing_pieces(inner, bottom, top)
        self.winding = base_windings(
            self.index, joined(inner, closing), self.low, self.size, self.told, step
        )
        cut = joined(inner, closing.take(np.flatnonzero(~of_flat)))
        flat = cut.graphs.axis == FLAT
        closes = flat & leaving(cut, top).any(1)
        kind = np.where(closes, CLOSING_PIECE, np.where(flat, FLAT_PIECE, STEEP_PIECE))
        order = np.argsort(cut.box, kind="stable")
        self.cut, self.kind = cut.take(order), kind[order]
        self.counts = np.bincount(cut.box, minlength=len(self.low))
        crowded = np.flatnonzero(self.counts > MANY)
        most_first = crowded[np.argsort(-self.counts[crowded], kind="stable")]
        within = np.cumsum(self.counts[most_first]) <= MOST_DIVIDED
        self.crowded = np.sort(most_first[within])

    def nodes(self, listed: int) -> Indices:
        """Nodes (n, 2), whose pieces are numbered from `listed`."""
        begin = listed + np.cumsum(self.counts) - self.counts
        most = max(self.counts.max(initial=0), 2 * np.abs(self.winding).max(initial=0))
        if most > MOST:
            raise ValueError(f"trim loops: expected up to {MOST} pieces in one place, found {most}")
        return np.stack([begin, self.counts + WINDING * self.winding], -1)

    def pieces(self) -> NDArray[np.int32]:
        """The pieces (m, 4), cell by cell."""
        graphs, step = self.cut.graphs, self.size / STEPS
        middle = self.low[self.cut.box] + self.size / 2.0
        steep = (graphs.axis != FLAT)[:, None]
        x = graphs.x - np.where(steep, middle[:, 1:], middle[:, :1])
        y = graphs.y - np.where(steep, middle[:, :1], middle[:, 1:])
        bump = np.round(graphs.bump / (BUMP_STEP * step)).astype(np.int32)
        bump[:, -1] = bump[:, -1] // KINDS * KINDS + self.kind
        numbers = np.concatenate([np.round(np.append(x, y, 1) / step).astype(np.int32), bump], 1)
        return np.asarray((numbers[:, ::2] & 0xFFFF) | (numbers[:, 1::2] << 16))

    def below(self) -> _Level:
        """The level of the cells that crowded ones are divided into."""
        divided = self.crowded
        order = np.full(len(self.low), -1)
        order[divided] = np.arange(len(divided))
        number = np.flatnonzero(order[self.cell] >= 0)
        children = DIVISION**2
        cell = order[self.cell[number], None] * children + np.arange(children)
        low, size = corners_of(self.low[divided], self.size, DIVISION), self.size / DIVISION
        return _Level(
            self.index, self.graphs, np.repeat(self.number[number], children), cell.ravel(),
            low, size, self.index.winding(low + size * PLACES[0]),
        )  # fmt: skip
