"""NURBS as what the evaluators know: each Bezier piece a glEvalMesh, or points at parameters.

Nurbs  ->  parts (one Mesh or Collection each, of local parameters)  ->  Recording
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from ..geometry.net import Array
from .borders import inner, plan
from .constants import (
    GL_FILL,
    GL_LINE,
    GL_LINE_STRIP,
    GL_LINES,
    GL_POINTS,
    GL_TRIANGLES,
)
from .glu_constants import (
    GLU_FILL,
    GLU_NURBS_TESSELLATOR,
    GLU_OUTLINE_PATCH,
    GLU_OUTLINE_POLYGON,
)
from .grids import Axis, Grid, Walk
from .maps import FILL, Map
from .recording import HAVE_CURRENT, Collection, Current, Maps, Mesh, Recording, Trim
from .sampling import steps
from .splines import Nurbs
from .trimmed import edges_of, trimmed_pieces

WHOLE = (0.0, 1.0, 0.0, 1.0)
STILL = Walk(Axis(1, 0.0, 1.0), 0, 0)


@dataclass(frozen=True, eq=False)
class Part:
    """Something drawn within one Bezier piece, whose parameters [0,1]^2 are low + size * (u, v)."""

    item: Mesh | Collection
    low: Array  # (2,)
    size: Array  # (2,)


def parts(nurbs: Nurbs) -> list[Part]:
    """What is drawn of each piece, as the display mode says."""
    if len(nurbs.vertex.knots) == 1:
        return list(_strokes(nurbs))
    if nurbs.region is not None:
        return list(_trimmed(nurbs))
    outlined = nurbs.properties.display_mode == GLU_OUTLINE_PATCH
    return list(_outlines(nurbs) if outlined else _fillings(nurbs))


def recording(*recorded: Nurbs, current: Current | None = None) -> Recording:
    """Curves and surfaces as what `Evaluators.draw` draws, with these current values."""
    current = current or Current()

    def calls(drawn: bool) -> tuple[Mesh | Collection, ...]:
        found = [undecided(n) if drawn and by_pixel(n) else parts(n) for n in recorded]
        return tuple(chain(*(_items(those, current) for those in found)))

    late = partial(calls, drawn=False) if any(map(by_pixel, recorded)) else None
    return Recording(calls(drawn=True), late)


def by_pixel(nurbs: Nurbs) -> bool:
    """Whether the trims are a matter of pixels: of a surface that is filled. Lines are those of
    the triangles and of the chords, as GLU's are."""
    if len(nurbs.vertex.knots) == 1 or nurbs.region is None:
        return False
    properties = nurbs.properties
    return properties.display_mode == GLU_FILL and properties.mode != GLU_NURBS_TESSELLATOR


def undecided(nurbs: Nurbs) -> list[Part]:
    """A trimmed surface as if it were not: first the pieces that no trim comes near, then, with
    their trims, those that are cut; those outside are left out."""
    from ..geometry.trimming.lookup import CUT, INSIDE, boxes_kept  # few surfaces are trimmed

    region, found = nurbs.region, list(_fillings(nurbs))
    assert region is not None
    low = region.to_square(*np.reshape([part.low for part in found], (-1, 2)).T)
    high = region.to_square(*np.reshape([part.low + part.size for part in found], (-1, 2)).T)
    kept = boxes_kept(region.pack(), low, high)
    whole = [part for part, which in zip(found, kept, strict=True) if which == INSIDE]
    cut = [
        replace(found[i], item=replace(found[i].item, trim=Trim(region, low[i], high[i])))
        for i in np.flatnonzero(kept == CUT)
    ]
    return [*whole, *cut]


def parts_at(
    nurbs: Nurbs, parameters: Array, towards: Array
) -> Iterator[tuple[Part, NDArray[np.intp]]]:
    """The pieces with the points that lie in them: GL_POINTS, and which of (u, v) they are."""
    axes = range(len(nurbs.vertex.knots))
    inside = np.zeros((len(parameters), 2), np.intp)
    for axis in axes:
        inside[:, axis] = _interval(nurbs.ends(axis), towards[:, axis])
    for place, maps, low, size in _pieces(nurbs, cull=False):
        members = np.flatnonzero((inside == place).all(-1))
        if len(members):
            local = (parameters[members] - low) / np.where(size > 0.0, size, 1.0)
            yield Part(collection(GL_POINTS, maps, local), low, size), members


def _strokes(nurbs: Nurbs) -> Iterator[Part]:
    count, _ = steps(nurbs)
    for (s, t), maps, low, size in _pieces(nurbs):
        assert t == 0
        yield Part(Mesh(maps, Grid(_walk(count[s]), STILL), GL_LINE, Current()), low, size)


def _fillings(nurbs: Nurbs) -> Iterator[Part]:
    """The grid of each piece, and where it has a border of its own, a ring around it."""
    laid = plan(nurbs)
    lines = nurbs.properties.display_mode == GLU_OUTLINE_POLYGON
    lines = lines and nurbs.properties.mode != GLU_NURBS_TESSELLATOR
    for (s, t), maps, low, size in _pieces(nurbs):
        nu, nv = int(laid.nu[s]), int(laid.nv[t])
        i0, i1, j0, j1 = inner(laid.borders.get((s, t), {}), nu, nv)
        if i1 > i0 and j1 > j0:
            grid = Grid(Walk(Axis(nu, 0.0, 1.0), i0, i1), Walk(Axis(nv, 0.0, 1.0), j0, j1))
            yield Part(Mesh(maps, grid, GL_LINE if lines else GL_FILL, Current()), low, size)
        ring = laid.ring(s, t)
        if len(ring):
            corners = edges_of(ring) if lines else ring.reshape(-1, 2)
            yield Part(collection(GL_LINES if lines else GL_TRIANGLES, maps, corners), low, size)


def _outlines(nurbs: Nurbs) -> Iterator[Part]:
    """The four borders of each piece; a border that two pieces share is drawn once."""
    laid = plan(nurbs)
    for (s, t), maps, low, size in _pieces(nurbs):
        sides = laid.borders.get((s, t), {})
        for side, count, end in (
            ("bottom", laid.nu[s], 0.0), ("top", laid.nu[s], 1.0),
            ("left", laid.nv[t], 0.0), ("right", laid.nv[t], 1.0),
        ):  # fmt: skip
            if (side == "bottom" and t > 0) or (side == "left" and s > 0):
                continue
            along = sides.get(side, np.arange(count + 1) / count)
            across = np.full(len(along), end)
            points = [along, across] if side in ("bottom", "top") else [across, along]
            yield Part(collection(GL_LINE_STRIP, maps, np.stack(points, -1)), low, size)


def _trimmed(nurbs: Nurbs) -> Iterator[Part]:
    """What the trims leave of each piece: triangles, or lines."""
    mode, cut = trimmed_pieces(nurbs, *steps(nurbs))
    for place, maps, low, size in _pieces(nurbs):
        for points in cut.get(place, ()):
            yield Part(collection(mode, maps, (points - low) / size), low, size)


def _walk(count: int) -> Walk:
    return Walk(Axis(int(count), 0.0, 1.0), 0, int(count))


def _pieces(
    nurbs: Nurbs, cull: bool = True
) -> Iterator[tuple[tuple[int, int], Maps, Array, Array]]:
    """(s, t), the maps over [0,1]^2, and where that lies, of each piece that is not culled."""
    nets = {attribute: nurbs.pieces(attribute) for attribute in nurbs.by_attribute}
    surface = len(nurbs.vertex.knots) == 2
    ends = (nurbs.ends(0), nurbs.ends(1) if surface else np.array([0.0, 0.0]))
    left_out = culled(nurbs, nets["vertex"]) & cull
    for s, t in np.argwhere(~left_out).tolist():
        feeds = []
        for attribute, spline in nurbs.by_attribute.items():
            points = nets[attribute][s, t][..., : spline.target.components]
            feeds.append(Map(spline.target, points, WHOLE))
        maps = Maps(tuple(feeds), auto_normal=surface and "normal" not in nets)
        low = np.array([ends[0][s], ends[1][t]])
        high = np.array([ends[0][s + 1], ends[1][t + 1]])
        yield (s, t), maps, low, high - low


def culled(nurbs: Nurbs, nets: Array) -> NDArray[np.bool_]:
    """Which pieces (s, t) lie outside the view volume, if GLU_CULLING is on: all of their control
    points beyond one of its six planes."""
    if not nurbs.properties.culling:
        return np.zeros(nets.shape[:2], dtype=bool)
    clip = nets @ nurbs.view.clip_from_object.T
    beyond = [sign * clip[..., axis] > clip[..., 3] for axis in range(3) for sign in (-1, 1)]
    return np.asarray(np.stack(beyond).all((-2, -1)).any(0))


def _interval(ends: Array, t: Array) -> NDArray[np.intp]:
    return np.clip(np.searchsorted(ends, t, side="right") - 1, 0, len(ends) - 2)


def collection(mode: int, maps: Maps, parameters: Array) -> Collection:
    """glEvalCoord at each of (u, v), shape (k, 2), between glBegin(mode) and glEnd."""
    count = len(parameters)
    given = {a: np.broadcast_to(np.array(FILL[a]), (count, 4)) for a in FILL}
    return Collection(mode, {2: maps}, np.full(count, 2, np.int8), parameters, given)


def _items(found: list[Part], current: Current) -> list[Mesh | Collection]:
    return [_with_current(part.item, current) for part in found]


def _with_current(item: Mesh | Collection, current: Current) -> Mesh | Collection:
    if isinstance(item, Mesh):
        return replace(item, current=current)
    given = dict(item.given)
    for attribute in HAVE_CURRENT:
        given[attribute] = np.broadcast_to(current.value(attribute), given[attribute].shape)
    return replace(item, given=given)
