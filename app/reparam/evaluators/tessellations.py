"""NURBS as what the evaluators know: each Bezier piece a glEvalMesh; and its results in one.

Nurbs  ->  parts (one Mesh or Collection each, of local parameters)  ->  Recording
       ->  read (GPU, or float64)  ->  Tessellation: arrays over all parts  ->  callbacks
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import evaluate
from ..geometry.net import Array
from ..geometry.normal import surface_normal
from .borders import inner, plan
from .constants import (
    GL_FILL,
    GL_LINE,
    GL_LINE_STRIP,
    GL_LINES,
    GL_POINTS,
    GL_QUAD_STRIP,
    GL_TRIANGLES,
)
from .glu_constants import (
    GLU_FILL,
    GLU_NURBS_TESSELLATOR,
    GLU_OUTLINE_PATCH,
    GLU_OUTLINE_POLYGON,
)
from .grids import Axis, Grid, Indices, Walk, grid_points, mesh_indices, pairs, primitive_indices
from .maps import FILL, Map
from .recording import HAVE_CURRENT, Collection, Current, Evaluated, Maps, Mesh, Recording, Trim
from .sampling import steps
from .splines import Nurbs
from .trimmed import edges_of, trimmed_pieces

Single = NDArray[np.float32]
Read = Callable[[Recording], list[Evaluated]]
Vertices = NDArray[np.intp]

WHOLE = (0.0, 1.0, 0.0, 1.0)
STILL = Walk(Axis(1, 0.0, 1.0), 0, 0)


@dataclass(frozen=True, eq=False)
class Part:
    """Something drawn within one Bezier piece, whose parameters [0,1]^2 are low + size * (u, v)."""

    item: Mesh | Collection
    low: Array  # (2,)
    size: Array  # (2,)


@dataclass(frozen=True, eq=False)
class Strip:
    """What comes between two GLU_NURBS_BEGIN and _END: GL_QUAD_STRIP, ..., and its vertices."""

    mode: int
    vertices: Vertices


@dataclass(frozen=True, eq=False)
class Tessellation:
    """The vertices of a curve or surface and how they are joined; float32 but the parameters.

    `parameters` (k, 2) in the user's knots (v is 0 on a curve); `vertices` (k, 4) homogeneous;
    `normals` (k, 3), `colors` (k, 4), `texcoords` (k, c), each None without its map (normals of
    surfaces are always there); `primitives` (p, 3) triangles, counter-clockwise in (u, v), or
    (p, 2) lines; `strips`, the same as the callbacks get it.
    """

    parameters: Array
    vertices: Single
    normals: Single | None
    colors: Single | None
    texcoords: Single | None
    primitives: Indices
    strips: tuple[Strip, ...]

    @property
    def points(self) -> Single:
        """(x/w, y/w, z/w): shape (k, 3)."""
        w = self.vertices[:, 3:]
        return np.asarray(self.vertices[:, :3] / np.where(w == 0.0, np.float32(1.0), w))


def parts(nurbs: Nurbs) -> list[Part]:
    """What is drawn of each piece, as the display mode says."""
    if len(nurbs.vertex.knots) == 1:
        return list(_strokes(nurbs))
    if nurbs.region is not None:
        return list(_trimmed(nurbs))
    outlined = nurbs.properties.display_mode == GLU_OUTLINE_PATCH
    return list(_outlines(nurbs) if outlined else _fillings(nurbs))


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


def recording(*recorded: Nurbs, current: Current | None = None) -> Recording:
    """Curves and surfaces as what `Evaluators.draw` draws, with these current values."""
    current = current or Current()
    items = [_items(parts(nurbs), current) for nurbs in recorded]
    if not any(map(by_pixel, recorded)):
        return Recording(tuple(chain(*items)))
    untrimmed = [
        _items(undecided(nurbs), current) if by_pixel(nurbs) else those
        for nurbs, those in zip(recorded, items, strict=True)
    ]
    return Recording(tuple(chain(*items)), tuple(chain(*untrimmed)))


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


def _items(found: list[Part], current: Current) -> list[Mesh | Collection]:
    return [_with_current(part.item, current) for part in found]


def _with_current(item: Mesh | Collection, current: Current) -> Mesh | Collection:
    if isinstance(item, Mesh):
        return replace(item, current=current)
    given = dict(item.given)
    for attribute in HAVE_CURRENT:
        given[attribute] = np.broadcast_to(current.value(attribute), given[attribute].shape)
    return replace(item, given=given)


def tessellate(nurbs: Nurbs, read: Read) -> Tessellation:
    """The curve or surface as its properties sample it, evaluated by `read`."""
    return _joined(nurbs, parts(nurbs), read)


def evaluate_at(
    nurbs: Nurbs, parameters: Array, read: Read, towards: Array | None = None
) -> Tessellation:
    """The curve or surface at any (u, v) of shape (k, 2), evaluated by `read`.

    Where a map jumps or bends, the limit from `towards` (k, 2) is taken; by default from above,
    at the ends from inside. Beyond the domain it is extrapolated. There are no primitives; v is
    not looked at on a curve.
    """
    where = np.array(parameters, dtype=np.float64).reshape(-1, 2)
    if len(nurbs.vertex.knots) == 1:
        where[:, 1] = 0.0
    within = list(parts_at(nurbs, where, where if towards is None else towards))
    found = [part for part, _ in within]
    order = [np.zeros(0, np.intp), *(members for _, members in within)]
    made = _joined(nurbs, found, read)
    back = np.argsort(np.concatenate(order))

    def sorted_back(values: Single | None) -> Single | None:
        return None if values is None else values[back]

    return Tessellation(
        where,
        made.vertices[back],
        sorted_back(made.normals),
        sorted_back(made.colors),
        sorted_back(made.texcoords),
        np.zeros((0, 1), np.int32),
        (),
    )


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


def _interval(ends: Array, t: Array) -> NDArray[np.intp]:
    return np.clip(np.searchsorted(ends, t, side="right") - 1, 0, len(ends) - 2)


def collection(mode: int, maps: Maps, parameters: Array) -> Collection:
    """glEvalCoord at each of (u, v), shape (k, 2), between glBegin(mode) and glEnd."""
    count = len(parameters)
    given = {a: np.broadcast_to(np.array(FILL[a]), (count, 4)) for a in FILL}
    return Collection(mode, {2: maps}, np.full(count, 2, np.int8), parameters, given)


def _joined(nurbs: Nurbs, found: list[Part], read: Read) -> Tessellation:
    """What `read` makes of all parts, in one."""
    items = [part.item for part in found]
    results = read(Recording(tuple(items))) if items else []
    starts = np.cumsum([0, *(len(result.vertices) for result in results)])[:-1]
    attributes = nurbs.by_attribute

    def joined(name: str, width: int, wanted: bool = True) -> Single | None:
        arrays = [getattr(result, name)[:, :width] for result in results]
        return np.concatenate([np.zeros((0, width), np.float32), *arrays]) if wanted else None

    corners = max((result.primitives.shape[1] for result in results), default=3)
    primitives = [r.primitives + start for r, start in zip(results, starts, strict=True)]
    parameters = [p.low + p.size * r.parameters for p, r in zip(found, results, strict=True)]
    texture = attributes["texcoord"].target.components if "texcoord" in attributes else 0
    vertices = joined("vertices", 4)
    assert vertices is not None
    return Tessellation(
        np.concatenate([np.zeros((0, 2)), *parameters]),
        vertices,
        joined("normals", 3, len(nurbs.vertex.knots) == 2 or "normal" in attributes),
        joined("colors", 4, "color" in attributes),
        joined("texcoords", texture, texture > 0),
        np.concatenate([np.zeros((0, corners), np.int32), *primitives]).astype(np.int32),
        tuple(
            Strip(strip.mode, strip.vertices + start)
            for item, start in zip(items, starts.tolist(), strict=True)
            for strip in strips(item)
        ),
    )


def strips(item: Mesh | Collection) -> Iterator[Strip]:
    """A part as GLU hands it out: strips along u, counter-clockwise; triangles; line strips."""
    if isinstance(item, Collection):
        yield Strip(item.mode, np.arange(len(item.dimensions)))
        return
    nu, nv = item.grid.shape
    number = np.arange(nu * nv).reshape(nu, nv)
    if item.mode == GL_FILL:
        for j in range(nv - 1):
            yield Strip(GL_QUAD_STRIP, number[:, [j + 1, j]].ravel())
        return
    lines = [*number.T, *number] if nu > 1 and nv > 1 else [number.ravel()]
    for line in lines:
        yield Strip(GL_LINE_STRIP, line)


def read_float64(recording: Recording) -> list[Evaluated]:
    """What `Recordings.read` does, in float64 and without OpenGL."""
    return [_read(item) for item in recording.items]


def _read(item: Mesh | Collection) -> Evaluated:
    if isinstance(item, Mesh):
        maps, parameters = item.maps, grid_points(item.grid)
        indices = mesh_indices(item.grid.shape, item.mode, item.grid.turned)
    else:
        (maps,), parameters = item.maps.values(), item.parameters
        _, indices = primitive_indices(item.mode, len(parameters))
    found = {}
    for attribute in ("vertex", *HAVE_CURRENT):
        feed = maps.by_attribute.get(attribute)
        if feed is None:
            found[attribute] = np.broadcast_to(FILL[attribute], (len(parameters), 4))
            continue
        u, _, v, _ = pairs(parameters, feed.rising).T
        found[attribute] = evaluate(feed.net, u, v)
        if attribute == "vertex" and maps.auto_normal:
            normals = surface_normal(feed.net, u, v)
    if maps.auto_normal:
        found["normal"] = normals
    single = {name: values.astype(np.float32) for name, values in found.items()}
    return Evaluated(
        single["vertex"], single["normal"][:, :3], single["color"], single["texcoord"],
        single["index"][:, 0], parameters, indices,
    )  # fmt: skip
