"""What surface splines make of a mesh's vertices, made again only where an edit touches it.

The results of a moment ago are kept: an edit of few vertices computes the points that depend on
them, bit for bit as all of them, and the nets that come out differ from the last in few patches.
"""

from __future__ import annotations

from dataclasses import replace
from functools import reduce
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..geometry.layout import Layout, identity_scale, layout
from ..geometry.mesh import Topology
from ..geometry.surface_spline import SurfaceSpline, edge_ratios, surface_spline
from .layers import Array, Picture
from .remember import remember

FEW = 8  # a part of the vertices, so small that the rest need not be computed again


@remember
def ratios_of(t: Topology, ratio: float, creases: Array) -> Array:
    """The ratio of each edge."""
    return edge_ratios(t, ratio, creases)


@remember
def spline_of(t: Topology, ratios: Array) -> SurfaceSpline:
    """The spline; as long as the ratios are the same, moving a vertex is one sparse product."""
    return surface_spline(t, ratios)


class Linear(Protocol):
    """Nets whose points are stencils over rows: over a mesh's vertices, over places in charts."""

    @property
    def index(self) -> NDArray[np.intp]:
        """Which points the nets pick, (P, m, m)."""
        ...

    def points(self, rows: Array, /) -> Array:
        """All points."""
        ...

    def points_after(self, points: Array, rows: Array, moved: NDArray[np.intp], /) -> Array:
        """The points after some rows have moved."""
        ...


class Dragged:
    """The nets that were made last, and from what."""

    def __init__(self) -> None:
        self._last: tuple[Linear, Array, Array, Array] | None = None

    def forget(self) -> None:
        """Make the next ones anew."""
        self._last = None

    def nets(self, of: Linear, rows: Array) -> Array:
        """The nets (P, m, m, 4) over these rows."""
        points = nets = None
        if self._last and self._last[0] is of:
            _, before, points_before, nets_before = self._last
            moved = np.flatnonzero(different(before, rows))
            if not len(moved):
                return nets_before
            if len(moved) <= len(rows) // FEW:
                points = of.points_after(points_before, rows, moved)
                touched = np.flatnonzero(different(points_before, points)[of.index])
                patches = np.unique(touched // of.index[0].size)
                nets = nets_before.copy()
                nets[patches] = points[of.index[patches]]
        if points is None or nets is None:
            points = of.points(rows)
            nets = points[of.index]
        self._last = (of, rows, points, nets)
        return nets


def different(before: Array, after: Array) -> NDArray[np.bool_]:
    """Which rows (k, d) differ."""
    return reduce(np.logical_or, (before != after).T)


_nets, _maps = Dragged(), Dragged()


@remember
def nets_of(spline: SurfaceSpline, vertices: Array) -> Array:
    """The control nets."""
    return _nets.nets(spline, vertices)


@remember
def layout_of(spline: SurfaceSpline) -> Layout:
    """What stays of the layout while vertices move."""
    return layout(spline)


@remember
def maps_of(spline: SurfaceSpline, vertices: Array) -> Array:
    """The layout as texture nets, in lengths of the mesh: an edit changes only those it touches."""
    of = layout_of(spline)
    return _maps.nets(of, of.places(vertices))


@remember
def scaled(picture: Picture, maps: Array) -> Picture:
    """The picture as large on the layout as on the identity's patches, on average."""
    return replace(picture, scale=picture.scale * identity_scale(maps))
