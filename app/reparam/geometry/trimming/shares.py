"""What share of the cells of grids stays, for pixels that are larger than the cells of curves."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .cells import cells_met, corners_of
from .cutting import stretches_in
from .graphs import STEEP, Graphs
from .pieces import Array

WHOLE = 255


def cell_shares(graphs: Graphs, border: Array, side: int) -> Array:
    """The share of each cell of a grid that stays, (side, side): Green's theorem within the cell,
    and to the left of what leads through its row; `border` as in grid_windings."""
    low, size = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side
    stretches = stretches_in(graphs, *cells_met(graphs, side, 0.0), low, low + size)
    x, y = np.moveaxis(stretches.ends, -1, 0)
    powers = stretches.polynomials(graphs, np.arange(len(stretches.index)))
    run = x[:, 1] - x[:, 0]
    under = run * (powers / np.arange(1.0, len(powers) + 1.0)[:, None]).sum(0)  # of f dx
    left = low[stretches.box, 0]
    steep = graphs.axis[stretches.index] == STEEP
    area = np.where(
        steep, under - left * run, (x[:, 1] - left) * y[:, 1] - (x[:, 0] - left) * y[:, 0] - under
    )
    rise = np.where(steep, run, y[:, 1] - y[:, 0])
    own = np.bincount(stretches.box, area, side**2).reshape(side, side)
    through = np.bincount(stretches.box, rise, side**2).reshape(side, side)
    from_right = np.cumsum(through[:, ::-1], 1)[:, ::-1]
    beyond = np.append(from_right[:, 1:], np.zeros((side, 1)), 1) + _rises(border, side)[:, None]
    return np.asarray(np.clip(own / size**2 + beyond / size, 0.0, 1.0), np.float64)


def _rises(border: Array, side: int) -> Array:
    """How far pieces along the right border rise in each row: (side,)."""
    rows = np.arange(side + 1) / side
    right = border[(border[..., 0] == 1.0).all(1), :, 1]
    start, end = (np.clip(right[:, side, None], rows[:-1], rows[1:]) for side in (0, 1))
    return np.asarray((end - start).sum(0))


def halved(shares: Array) -> Iterator[Array]:
    """A square of shares, and half as large ones down to one."""
    yield shares
    while len(shares) > 1:
        shares = (
            shares[::2, ::2] + shares[::2, 1::2] + shares[1::2, ::2] + shares[1::2, 1::2]
        ) / 4.0
        yield shares


def corner_shares(shares: Array) -> NDArray[np.uint8]:
    """At each (i, j) the shares of (i-1, j-1), (i-1, j), (i, j-1), (i, j), of WHOLE, the outermost
    going on outside: (n + 1, n + 1, 4). Between four middles of cells one of them tells all."""
    wide = np.pad(np.round(shares * WHOLE).astype(np.uint8), 1, mode="edge")
    return np.stack([wide[:-1, :-1], wide[:-1, 1:], wide[1:, :-1], wide[1:, 1:]], -1)
