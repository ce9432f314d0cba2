"""The edges of patches, coloured by how smoothly the patches join there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.edge_pairs import edge_nets
from ..geometry.patch_joins import Joins, joins
from . import palette
from .layers import Array, Color, Polylines
from .remember import remember
from .splines import polylines

Indices = NDArray[np.intp]

WIDTHS = (2.2, 1.2)  # of what is not smooth, and of all else
COLORS: dict[str, Color] = {
    "no neighbour": palette.rgb("999999"),
    "kink": palette.SHARP,
    "folded": palette.rgb("CC79A7"),
    "G1": palette.rgb("E69F00"),
    "G2": palette.SMOOTH,
    "G3": palette.ALONG_U,
}
FOLDED = 179.9  # degrees

analysed = remember(joins)


def join_lines(nets: Array) -> tuple[tuple[Polylines, ...], tuple[tuple[Color, str], ...]]:
    """A layer for each class of edges that occurs, and what their colours mean, with counts."""
    found = analysed(nets)
    layers, words = [], []
    for name, edges in _classes(found).items():
        if len(edges):
            width = WIDTHS[0] if name in ("kink", "folded", "no neighbour") else WIDTHS[1]
            curves = polylines(edge_nets(nets, edges[:, 0], edges[:, 1]))
            layers.append(Polylines(curves, COLORS[name], width))
            words.append((COLORS[name], f"{name} {len(edges)}"))
    return tuple(layers), tuple(words)


def _classes(found: Joins) -> dict[str, Indices]:
    """(patch, side) of one side of each join, by class."""
    first = np.stack([found.patches[:, 0], found.sides[:, 0]], -1)
    folded = found.angles > FOLDED
    orders = np.where(folded, -1, found.orders)
    by_order = {"kink": 0, "folded": -1, "G1": 1, "G2": 2, "G3": 3}
    return {
        "no neighbour": found.free,
        **{name: first[orders == k] for name, k in by_order.items()},
    }
