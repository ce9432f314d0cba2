"""Recorded NURBS curves and surfaces: their maps on the union of all knots, as Bezier nets.

libGLU evaluates a companion map (texture, colour, normal) wrongly if its knots differ from the
vertex map's; here each map is cut where any of them has a knot.

    vertex   |-----------|-----------|        knots of their own
    texture  |-------|---------------|
    pieces   |-------|---|-----------|        every map is one Bezier net on each
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..geometry.extraction import curve_to_bezier, extraction_between
from ..geometry.net import Array
from ..geometry.nurbs import breakpoints, domain
from ..geometry.trimming import TrimRegion, trim_region
from .maps import FILL, Attribute, Target
from .nurbs_properties import UNLOADED, Properties, View


@dataclass(frozen=True, eq=False)
class Spline:
    """One gluNurbsCurve or gluNurbsSurface: control points (n, c) or (m, n, c), checked."""

    target: Target
    knots: tuple[Array, ...]
    orders: tuple[int, ...]
    points: Array

    @cached_property
    def net(self) -> Array:
        """Four numbers a control point, as the evaluator takes them: (m, n, 4); a curve has n 1."""
        points = self.points if self.points.ndim == 3 else self.points[:, None, :]
        net = np.empty((*points.shape[:2], 4))
        net[...] = FILL[self.target.attribute]
        net[..., : self.target.components] = points
        return net


@dataclass(frozen=True, eq=False)
class PwlTrim:
    """gluPwlCurve: points (n, 2) in (u, v), projected if they came with a third number."""

    points: Array


@dataclass(frozen=True, eq=False)
class NurbsTrim:
    """gluNurbsCurve in a trim: homogeneous points (n, 3), (w u, w v, w)."""

    knots: Array
    order: int
    points: Array


TrimCurve = PwlTrim | NurbsTrim


def trim_pieces(curve: TrimCurve) -> list[Array]:
    """The curve as `trim_region` takes it: a polyline (k, 2), or Bezier curves (k, 3)."""
    if isinstance(curve, PwlTrim):
        return [curve.points]
    return list(curve_to_bezier(curve.knots, curve.points, curve.order).nets)


@dataclass(frozen=True, eq=False)
class Nurbs:
    """What stood between Begin and End: maps of one dimension, exactly one of them of vertices."""

    splines: tuple[Spline, ...]
    properties: Properties = field(default_factory=Properties)
    view: View = UNLOADED
    trims: tuple[tuple[TrimCurve, ...], ...] = ()

    @cached_property
    def by_attribute(self) -> dict[Attribute, Spline]:
        """The map that feeds each attribute: of texture coordinates the one with most numbers."""
        rising = sorted(self.splines, key=lambda spline: spline.target.components)
        return {spline.target.attribute: spline for spline in rising}

    @property
    def vertex(self) -> Spline:
        """The map whose domain is drawn."""
        return self.by_attribute["vertex"]

    @cached_property
    def region(self) -> TrimRegion | None:
        """What the trims leave, or None if there are none. Raises TrimError."""
        if not self.trims:
            return None
        loops = [[p for curve in loop for p in trim_pieces(curve)] for loop in self.trims]
        (u0, u1), (v0, v1) = (
            domain(knots, order)
            for knots, order in zip(self.vertex.knots, self.vertex.orders, strict=True)
        )
        return trim_region(loops, (u0, u1, v0, v1))

    def ends(self, axis: int) -> Array:
        """Where the pieces of an axis begin and end: all maps' knots in the vertex map's domain."""
        low, high = domain(self.vertex.knots[axis], self.vertex.orders[axis])
        all_of_them = [breakpoints(s.knots[axis], s.orders[axis]) for s in self.splines]
        every = np.unique(np.concatenate(all_of_them))
        return np.asarray(every[(every >= low) & (every <= high)])

    def pieces(self, attribute: Attribute, finer: int = 1) -> Array:
        """Nets (s, t, m, n, 4) of one map over all pieces, each cut into `finer` x `finer`."""
        spline = self.by_attribute[attribute]
        net = spline.net
        for axis, (knots, order) in enumerate(zip(spline.knots, spline.orders, strict=True)):
            ends = subdivided(self.ends(axis), finer)
            nets = extraction_between(knots, order, ends).apply(np.moveaxis(net, 2 * axis, 0))
            net = np.moveaxis(nets, 1, 2 * axis + 1)
        if len(spline.knots) == 1:  # (s, m, 1, 4)
            return net[:, None]
        # After both axes: t, s, m, n, 4
        return np.ascontiguousarray(np.swapaxes(net, 0, 1))


def subdivided(ends: Array, finer: int) -> Array:
    """`ends` with finer - 1 more between any two of them, equally spaced."""
    share = np.arange(finer) / finer
    between = ends[:-1, None] + np.diff(ends)[:, None] * share
    return np.append(between.ravel(), ends[-1])
