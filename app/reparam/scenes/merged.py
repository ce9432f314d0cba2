"""The patches of a surface spline as they are shown: all, or those that are one as one."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from ..geometry.merging import Merging, merging
from ..geometry.surface_spline import Indices, SurfaceSpline
from .layers import Array
from .remember import remember

Merged = Annotated[bool, "four patches that are one as one: fewer, but with T-junctions"]


class Shown(NamedTuple):
    """Nets, texture nets if there are any, sizes of the facets they touch, and what the nets'
    points are called: those of neighbours are the same along their edge."""

    nets: Array
    maps: Array | None
    facet: Indices
    names: Indices


def shown(spline: SurfaceSpline, nets: Array, maps: Array | None, merged: bool) -> Shown:
    """The spline's own nets and maps (P, ...), or the fewer ones."""
    if not merged:
        return Shown(nets, maps, spline.facet, spline.index)
    one = merging_of(spline)
    fewer = None if maps is None else fewer_nets(one, maps)
    return Shown(fewer_nets(one, nets), fewer, facets_of(one, spline), index_of(one, spline))


@remember
def merging_of(spline: SurfaceSpline) -> Merging:
    """Which patches are one."""
    return merging(spline)


@remember
def fewer_nets(one: Merging, nets: Array) -> Array:
    """The nets that are left."""
    return one.nets(nets)


@remember
def facets_of(one: Merging, spline: SurfaceSpline) -> Indices:
    """The size of the facet that each touches."""
    return one.of_patch(spline.facet)


@remember
def index_of(one: Merging, spline: SurfaceSpline) -> Indices:
    """What their points are called."""
    return one.index(spline.index)
