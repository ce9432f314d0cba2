"""What the tessellator draws: patches in tiles, and how many of them at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

HARDWARE_LEVEL = 64  # what every OpenGL 4 promises

# llvmpipe's tessellator is quadratic in the patches of a draw, and counts vertices by 16 bits.
SOFTWARE_PATCHES, SOFTWARE_VERTICES = 64, 1 << 16

Tile = tuple[int, int, int, int]  # first step in u, in v; steps in u, in v
Tiles = NDArray[np.int32]  # (r, 5): a patch, and a tile of it


def tiles(level: int, largest: int = HARDWARE_LEVEL) -> list[Tile]:
    """The tiles that a level is drawn in."""
    starts = range(0, level, largest)
    steps = {start: min(largest, level - start) for start in starts}
    return [(u, v, steps[u], steps[v]) for u in starts for v in starts]


def tile_rows(patches: int, tiles: list[Tile], chosen: NDArray[np.bool_] | None = None) -> Tiles:
    """All tiles of all patches, tile by tile, or the chosen ones (patches, tiles)."""
    if chosen is None:
        chosen = np.ones((patches, len(tiles)), dtype=bool)
    tile, patch = np.nonzero(chosen.T)
    return np.column_stack([patch, np.array(tiles)[tile]]).astype(np.int32)


def draws(vertices: NDArray[np.int32], software: bool) -> Iterator[tuple[int, int]]:
    """The first patch and the number of patches of each draw, for patches that the tessellator
    makes so many vertices of."""
    if not software:
        yield 0, len(vertices)
        return
    ends, first = np.cumsum(vertices, dtype=np.int64), 0
    while first < len(vertices):
        before = ends[first] - vertices[first]
        fit = int(np.searchsorted(ends, before + SOFTWARE_VERTICES, "right")) - first
        count = min(max(fit, 1), SOFTWARE_PATCHES)
        yield first, min(count, len(vertices) - first)
        first += count
