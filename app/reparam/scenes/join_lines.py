"""The edges of patches, coloured by how smoothly the patches join there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.edge_pairs import edge_nets
from ..geometry.net import raise_degree
from ..geometry.patch_joins import Joins, joins
from . import palette
from .layers import Array, Color, Figure, Patches, Polylines, Space
from .legend import legend
from .linked import together
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
TITLED = 2.4  # times as high is a strip where all spaces leave room for titles

analysed = remember(joins)
_before: list[tuple[list[Array], Array]] = []  # the layers' nets that were put together last


def joined(figure: Figure) -> Figure:
    """The figure with the edges of its subject's patches in the colours of their joins, and above
    it what these mean; the figure itself where there are no whole patches."""
    subject = figure.spaces[-1]
    layers = [layer for layer in subject.layers if isinstance(layer, Patches)]
    nets = [layer.net for layer in layers if layer.trim is None]
    if not nets:
        return figure
    lines, words = join_lines(_square(nets))
    shown = replace(subject, layers=(*subject.layers, *lines))
    if any(space.map is not None for space in figure.spaces):  # notes leave no room for a strip
        told = "edges: " + ", ".join(name for _, name in words)
        return replace(figure, spaces=(*figure.spaces[:-1], shown), caption=(*figure.caption, told))
    strip = replace(_strip(figure, words), width=subject.width, below=subject.below)
    return replace(figure, spaces=(*figure.spaces[:-1], strip, replace(shown, below=True)))


def _strip(figure: Figure, words: Sequence[tuple[Color, str]]) -> Space:
    """What the colours mean, as high as words are in a column of the figure."""
    columns = sum(not space.below for space in figure.spaces)
    last = max(k for k, space in enumerate(figure.spaces) if not space.below)
    rows = sum(space.height >= 1.0 for space in figure.spaces[last:])
    strip = legend("joins", "", words, rows, columns)
    room = TITLED if any(space.title for space in figure.spaces) else 1.0
    return replace(strip, height=room * strip.height)


def _square(nets: list[Array]) -> Array:
    """All patches of some layers, of one degree in u and in v; the same array for the same nets."""
    if _before:
        known, whole = _before[0]
        if len(known) == len(nets) and all(a is b for a, b in zip(known, nets, strict=True)):
            return whole
    whole = together(nets)
    degree = max(whole.shape[-3:-1]) - 1
    whole = raise_degree(whole, degree, degree).reshape(-1, degree + 1, degree + 1, 4)
    _before[:] = [(nets, whole)]
    return whole


def join_lines(nets: Array) -> tuple[tuple[Polylines, ...], tuple[tuple[Color, str], ...]]:
    """A layer for each class of edges that occurs, and what their colours mean, with counts."""
    found = analysed(nets)
    layers, words = [], []
    for name, edges in _classes(found).items():
        if len(edges):
            width = WIDTHS[0] if name in ("kink", "folded", "no neighbour") else WIDTHS[1]
            curves = polylines(edge_nets(nets, edges[:, 0], edges[:, 1]))
            layers.append(Polylines(curves, COLORS[name], width, lift=1))
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
