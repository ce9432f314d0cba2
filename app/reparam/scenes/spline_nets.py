"""What surface splines make of a mesh's vertices, made again only where an edit touches it.

The results of a moment ago are kept: an edit of few vertices computes the points that depend on
them, bit for bit as all of them, and the nets that come out differ from the last in few patches.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

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


@remember
def nets_of(spline: SurfaceSpline, vertices: Array) -> Array:
    """The control nets."""
    return points_of(spline, vertices)[spline.index]


_last: list[tuple[SurfaceSpline, Array, Array]] = []  # the points made before, from what


def points_of(spline: SurfaceSpline, vertices: Array) -> Array:
    """The points of the nets; after an edit of few vertices what these touch is made anew."""
    points = None
    if _last and _last[0][0] is spline:
        _, before, points_before = _last[0]
        moved = np.flatnonzero((before != vertices).any(-1))
        if len(moved) <= len(vertices) // FEW:
            points = (
                spline.points_after(points_before, vertices, moved) if len(moved) else points_before
            )
    if points is None:
        points = spline.points(vertices)
    _last[:] = [(spline, vertices, points)]
    return points


@remember
def layout_of(spline: SurfaceSpline) -> Layout:
    """What stays of the layout while vertices move."""
    return layout(spline)


@remember
def maps_of(spline: SurfaceSpline, vertices: Array) -> Array:
    """The layout as texture nets, in lengths of the mesh: an edit changes only those it touches."""
    of = layout_of(spline)
    return map_points(of, of.places(vertices))[of.index]


_last_map: list[tuple[Layout, Array, Array]] = []  # the points made before, from what places


def map_points(of: Layout, places: Array) -> Array:
    """The points of the maps; after an edit what it touches is made anew."""
    points = None
    if _last_map and _last_map[0][0] is of:
        _, before, points_before = _last_map[0]
        moved = np.flatnonzero((before != places).any(-1))
        if len(moved) <= len(places) // FEW:
            points = of.points_after(points_before, places, moved) if len(moved) else points_before
    if points is None:
        points = of.points(places)
    _last_map[:] = [(of, places, points)]
    return points


@remember
def scaled(picture: Picture, maps: Array) -> Picture:
    """The picture as large on the layout as on the identity's patches, on average."""
    return replace(picture, scale=picture.scale * identity_scale(maps))
