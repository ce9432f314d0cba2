"""What the scenes of surface splines share: their parameters, layers and handles."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..geometry.bernstein import bernstein
from ..geometry.body import Body, body, face_patches
from ..geometry.distortion import sampled_distortions
from ..geometry.evaluate import project
from ..geometry.mesh import Mesh, Topology
from ..geometry.meshes import MESHES
from ..geometry.surface_spline import SurfaceSpline
from . import palette
from .layers import (
    Array,
    Color,
    Dial,
    Dots,
    Handles,
    Kind,
    Layer,
    Patches,
    Picture,
    Polylines,
    Texture,
)
from .merged import facets_of, merging_of, shown
from .parameters import Points, Range
from .remember import remember
from .spline_nets import maps_of, nets_of, scaled

Ratio = Annotated[float, Range(0.02, 0.98, 0.02), "blend ratio: to 0 a sharp edge, 1/2 the spline"]
Creases = Annotated[
    Array, Points((None, 3), "ratios of single edges: vertex, vertex, from 0, ratio")
]
Moved = Annotated[Array, Points((None, 4), "vertices moved: vertex, from 0, x, y, z")]
Map = Annotated[
    Literal["layout", "identity"],
    "the mesh laid flat, by the same stencils, or each patch's (u, v)",
]
NO_CREASES, NONE_MOVED = np.zeros((0, 3)), np.zeros((0, 4))
IDENTITY = np.array([[[-1.0, 1, 0, 1], [1, 1, 0, 1]], [[-1, -1, 0, 1], [1, -1, 0, 1]]])
for _array in (NO_CREASES, NONE_MOVED, IDENTITY):
    _array.flags.writeable = False
OF_FACE, OF_EDGE, OF_VERTEX = (palette.rgb(h) for h in ("A9D6F0", "F6DDB0", "8FD0BC"))
SIDES = {3: "triangles", 5: "pentagons", 6: "hexagons", 7: "heptagons", 8: "octagons"}
LEAST, MOST = 0.02, 0.98  # ratios that a hand can give
MANY = 512  # patches: from here on fewer samples tell how a texture map lies on them
OUTLINE_POINTS = 8_000  # of all outlines of a body together

built_in = lru_cache(maxsize=None)(lambda name: MESHES[name]())


def moved_mesh(control: Mesh, moved: Array, name: str = "moved") -> Mesh:
    """The mesh with vertices (vertex, x, y, z) moved. Raises ValueError for an unknown vertex."""
    if not len(moved):
        return control
    vertices = control.vertices.copy()
    for index, *point in moved:
        if index not in range(len(vertices)):
            expected = f"expected a vertex from 0 to {len(vertices) - 1}"
            raise ValueError(f"{name}: {expected}, found {index:g}")
        vertices[int(index)] = point
    return Mesh(vertices, control.topology)


def mesh_layers(control: Mesh, color: Color) -> tuple[Layer, ...]:
    """The faces, flat, with their edges."""
    faces = faces_of(control.vertices, control.topology)
    return Patches(faces.nets, color=color, lit=True), edges_of(control)


@remember
def faces_of(vertices: Array, t: Topology) -> Body:
    """The faces as bilinear patches."""
    return body(face_patches(vertices, t.faces()))


def edges_of(control: Mesh, color: Color = palette.INK, width: float = 1.4) -> Polylines:
    """The edges of a mesh."""
    return Polylines(control.vertices[control.topology.ends], color, width)


def cut_layers(control: Mesh, spline: SurfaceSpline) -> tuple[Layer, ...]:
    """The mesh after the first cut, coloured by what its faces come from."""
    t, points = spline.cuts[0], spline.cut_vertices(control.vertices)
    faces = t.faces()
    count = len(control.topology.sizes)
    phantom = spline.whole.face[t.origin] >= count
    real = np.bincount(t.face, phantom, len(faces)) == 0
    kinds = np.repeat([0, 1, 2], _kind_counts(spline.whole))
    layers: list[Layer] = []
    for kind, color in enumerate((OF_FACE, OF_EDGE, OF_VERTEX)):
        chosen = [faces[i] for i in np.flatnonzero(real & (kinds == kind))]
        if chosen:
            layers.append(Patches(body(face_patches(points, chosen)).nets, color=color, lit=True))
    ends = t.ends[~(phantom_vertices(spline, count)[t.ends]).any(1)]
    return (*layers, Polylines(points[ends], palette.INK, 1.0), edges_of(control, width=0.5))


def phantom_vertices(spline: SurfaceSpline, count: int) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Which vertices of the first cut belong to phantom faces."""
    return np.asarray(spline.whole.face >= count)


def _kind_counts(whole: Topology) -> list[int]:
    inner = int(np.count_nonzero(whole.twin > np.arange(len(whole.twin))))
    vertices = int(np.count_nonzero((whole.valence > 0) & ~whole.on_boundary))
    return [len(whole.sizes), inner, vertices]


def net_layers(control: Mesh, spline: SurfaceSpline) -> tuple[Layer, ...]:
    """The control nets, each in its own degree, over the faint surface."""
    own, facet = spline.own_nets(control.vertices), spline.facet
    nets = nets_of(spline, control.vertices)
    layers: list[Layer] = [Patches(nets, color=(0.96, 0.96, 0.94), lit=True)]
    for size in np.unique(facet).tolist():
        points = np.stack([own[i] for i in np.flatnonzero(facet == size)])[..., :3]
        m = points.shape[1]
        color = palette.ALONG_U if size == 4 else palette.ALONG_V
        legs = np.concatenate([points, points.swapaxes(1, 2)]).reshape(-1, m, 3)
        layers += [Polylines(legs, color, 0.7), Dots(points.reshape(-1, 3), color, 1.6)]
    return tuple(layers)


def patch_layers(
    spline: SurfaceSpline,
    vertices: Array,
    texture: str,
    picture: Picture,
    outline: float = 0.5,
    merged: bool = False,
    solid: bool = False,
) -> tuple[Layer, ...]:
    """The surface with its texture, one layer for each kind of patch, and the patches' edges,
    unless `outline`, their width, is 0. `solid`: see Patches."""
    maps = None
    if texture == "layout":
        maps = maps_of(spline, vertices)
        picture = scaled(picture, maps)
    nets, maps, facet, index = shown(spline, nets_of(spline, vertices), maps, merged)
    layers: list[Layer] = []
    for size, part, own in parts(facet, nets, maps):
        words = "regular" if size == 4 else f"around {SIDES.get(size, f'{size}-gons')}"
        kind = Kind(palette.FACETS.get(size, palette.FACETS[7]), words)
        layers.append(Patches(part, Texture(own, picture), lit=True, kind=kind, solid=solid))
    if outline:
        layers.append(Polylines(outlines(index, nets), palette.INK, outline))
    return tuple(layers)


@remember
def outlines(index: NDArray[np.intp], nets: Array) -> Array:
    """The patches' edges, each once, as polylines (E, k, 3).

    `index` (P, m, m) says which points of the spline the nets pick: shared edges pick the same.
    """
    sides = np.stack([nets[:, 0], nets[:, -1], nets[:, :, 0], nets[:, :, -1]])
    return polylines(sides.reshape(-1, *sides.shape[2:])[edges_once(index)])


@remember
def edges_once(index: NDArray[np.intp]) -> NDArray[np.intp]:
    """One of each two sides that pick the same points: side s of patch p is s P + p."""
    sides = np.concatenate([index[:, 0], index[:, -1], index[:, :, 0], index[:, :, -1]])
    forwards = np.where(sides[:, :1] > sides[:, -1:], sides[:, ::-1], sides)
    return np.unique(forwards, axis=0, return_index=True)[1]


def polylines(curves: Array) -> Array:
    """Bezier curves (E, m, 4) as points (E, k, 3), the fewer the more curves there are."""
    count = int(np.clip(OUTLINE_POINTS // len(curves), 4, 64))
    basis = bernstein(curves.shape[1] - 1, np.linspace(0.0, 1.0, count + 1))
    return project(np.einsum("ki,eic->ekc", basis, curves))


@remember
def parts(
    facet: NDArray[np.intp], nets: Array, maps: Array | None
) -> list[tuple[int, Array, Array]]:
    """Facet size, nets and texture nets of each kind of patch."""
    sizes = np.unique(facet).tolist()
    if len(sizes) == 1:
        return [(sizes[0], nets, IDENTITY if maps is None else maps)]
    found = []
    for size in sizes:
        chosen = facet == size
        found.append((size, nets[chosen], IDENTITY if maps is None else maps[chosen]))
    return found


def vertex_handles(control: Mesh, parameter: str = "moved") -> Handles:
    """A handle at each vertex, into a parameter (vertex, x, y, z)."""

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        rows = {int(row[0]): row for row in values[parameter]}
        return {parameter: np.array([*(rows | {index: np.array([index, *point])}).values()])}

    names = tuple(f"vertex {k}" for k in range(len(control.vertices)))
    return Handles(control.vertices, drag, names)


def edge_handles(control: Mesh, ratios: Array) -> Handles:
    """A handle for each edge, between its middle (ratio 0) and its faces' centroids (ratio 1)."""
    t = control.topology
    centroid = np.stack(
        [np.bincount(t.face, x[t.origin]) / t.sizes for x in control.vertices.T], -1
    )
    sharing = np.bincount(t.edge)[:, None]
    inside = np.stack([np.bincount(t.edge, x[t.face]) for x in centroid.T], -1) / sharing
    middle = control.vertices[t.ends].mean(1)
    way = inside - middle

    def turn(values: Mapping[str, Any], index: int, ratio: float) -> Mapping[str, Any]:
        a, b = t.ends[index]
        rows = {tuple(sorted(map(int, row[:2]))): row for row in values["creases"]}
        rows[min(a, b), max(a, b)] = np.array([a, b, np.clip(ratio, LEAST, MOST)])
        return {"creases": np.array([*rows.values()])}

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        along = way[index] @ (point - middle[index]) / max(way[index] @ way[index], 1e-30)
        return turn(values, index, along)

    names = tuple(f"ratio of edge {a}-{b}" for a, b in t.ends)
    at = middle + ratios[:, None] * way
    dial = Dial(ratios, turn)
    return Handles(at, drag, names, color=palette.rgb("E69F00"), radius=3.5, dial=dial)


@remember
def distortion(nets: Array, maps: Array) -> tuple[float, float, float, float]:
    """Largest and mean deviation from right angles (degrees); least and largest area, the median
    being 1."""
    found = sampled_distortions(nets, maps, 4 if len(nets) < MANY else 2)
    angles, areas = np.abs(found[..., 2]), np.exp2(found[..., 0])
    typical = float(np.nanmedian(areas))
    areas = areas / (typical if typical > 0.0 else 1.0)
    numbers = np.nanmax(angles), np.nanmean(angles), np.nanmin(areas), np.nanmax(areas)
    most, mean, low, high = (float(number) for number in numbers)
    return most, mean, low, high


def count_words(spline: SurfaceSpline, merged: bool = False) -> str:
    """How many patches there are, of which kinds."""
    facet = facets_of(merging_of(spline), spline) if merged else spline.facet
    plain = int(np.count_nonzero(facet == 4))
    odd = {n: int(np.count_nonzero(facet == n)) for n in np.unique(facet) if n != 4}
    words = [f"{plain} biquadratic"]
    words += [f"{count} bicubic around {SIDES.get(n, f'{n}-gons')}" for n, count in odd.items()]
    return f"{len(facet)} patches: " + ", ".join(words)


def distortion_words(spline: SurfaceSpline, vertices: Array, texture: str) -> str:
    """The trade between right angles and equal size, in numbers."""
    maps = maps_of(spline, vertices) if texture == "layout" else IDENTITY
    most, mean, low, high = distortion(nets_of(spline, vertices), maps)
    return (
        f"{texture}: angles off by {mean:.1f}° on average, {most:.0f}° at most; "
        f"areas {low:.2f} to {high:.2f} of the median"
    )
