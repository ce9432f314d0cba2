"""What becomes of a NURBS curve or surface: arrays over all of its parts, as callbacks get them.

parts  ->  Recording  ->  read (GPU, or float64)  ->  Tessellation
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import evaluate
from ..geometry.net import Array
from ..geometry.normal import surface_normal
from .constants import (
    GL_FILL,
    GL_LINE_STRIP,
    GL_QUAD_STRIP,
)
from .grids import Indices, grid_points, mesh_indices, pairs, primitive_indices
from .maps import FILL
from .nurbs_parts import Part, parts, parts_at
from .recording import HAVE_CURRENT, Collection, Evaluated, Mesh, Recording
from .splines import Nurbs

Single = NDArray[np.float32]
Read = Callable[[Recording], list[Evaluated]]
Vertices = NDArray[np.intp]


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
