"""Texture maps of a surface spline from a layout of its mesh, through the spline's own stencils.

Each face of the mesh gets a chart: after the first cut its corners are laid flat with their true
lengths, and what surrounds it is folded down around them.

          D----C              h runs from A to B; the strip A D C B cut along the edge is turned
          |    |              about it into the plane of the face. Around a corner A the others of
       A--A----B--B           its facet follow from their two neighbours as in a regular polygon.
       |  |face|  |
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .net import Array
from .normal import safe_normalize
from .sparse import Sparse
from .surface_spline import SurfaceSpline

Indices = NDArray[np.intp]
Entry = tuple[Indices, Indices, Array]  # faces, vertices of the cut mesh, (s, t) there


@dataclass(frozen=True, eq=False)
class Layout:
    """How the coefficients of texture nets follow from places in charts, for one spline.

    `first` are the entries of the charts that count, one for each face and vertex it reaches;
    `stencils` (points, entries) make of them the points of the maps, which `index` (P, m, m) picks.
    """

    spline: SurfaceSpline
    first: Indices
    stencils: Sparse
    index: Indices

    def places(self, vertices: Array) -> Array:
        """(s, t) of each entry, lengths of the cut mesh: the part that is not linear."""
        _, _, places = _entries(self.spline, vertices)
        return places[self.first]

    def points(self, places: Array) -> Array:
        """The points of the maps, (K, 4), points (s, t, 0, 1)."""
        return _flat(self.stencils @ places)

    def points_after(self, points: Array, places: Array, moved: Indices) -> Array:
        """The points again, bit for bit `points(places)`, after these places alone have moved."""
        rows = self.stencils.rows_with(moved)
        points = points.copy()
        points[rows, :2] = self.stencils.take(rows) @ places
        return points


def layout(spline: SurfaceSpline) -> Layout:
    """The layout's linear part, the same wherever the vertices are."""
    h = len(spline.whole.origin)
    faces, vertex, _ = _entries(spline, np.zeros((spline.stages[0].shape[1], 3)))
    keys, first = np.unique(faces * h + vertex, return_index=True)
    rest, points = spline.from_first_cut, spline.stencils.shape[0]
    # Each patch in its own face's chart: a point is laid flat once for every face that has it.
    own, index = np.unique(spline.face[:, None, None] * points + spline.index, return_inverse=True)
    entry, counts = rest.entries(own % points)
    wanted = np.repeat(own // points, counts) * h + rest.columns[entry]
    found = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    assert (keys[found] == wanted).all(), "a stencil reaches beyond its face's chart"
    rows = np.repeat(np.arange(len(own)), counts)
    stencils = Sparse(rows, found, rest.values[entry], (len(own), len(keys)))
    return Layout(spline, first, stencils, index.reshape(spline.index.shape))


def layout_nets(spline: SurfaceSpline, vertices: Array) -> Array:
    """Texture nets (P, m, m, 4), points (s, t, 0, 1): lengths of the cut mesh, face by face.

    Over all patches their area is as large as under the identity, where each has 2 x 2.
    """
    of = layout(spline)
    nets = of.points(of.places(vertices))[of.index]
    nets[..., :2] *= identity_scale(nets)
    return nets


def identity_scale(nets: Array) -> float:
    """By what texture nets (P, m, m, 4) are to be scaled to have the identity's area, 4 a patch."""
    a, b, c, d = (nets[:, i, j, :2] for i, j in ((0, 0), (-1, 0), (-1, -1), (0, -1)))
    across, along = c - a, d - b  # the diagonals
    area = abs(float((across[:, 0] * along[:, 1] - across[:, 1] * along[:, 0]).sum())) / 2.0
    return float((4.0 * len(nets) / area) ** 0.5) if area > 0.0 else 1.0


def _flat(places: Array) -> Array:
    points = np.zeros((len(places), 4))
    points[:, :2], points[:, 3] = places, 1.0
    return points


def _entries(spline: SurfaceSpline, vertices: Array) -> Entry:
    """All entries of all charts; which there are depends on the topology alone."""
    charts = _Charts(spline.whole, spline.cut_vertices(vertices))
    return charts.entries(int(spline.face.max()) + 1)


class _Charts:
    """All charts at once: entry after entry, the first of a face's vertex counts."""

    def __init__(self, t: Topology, cut_vertices: Array) -> None:
        self.t = t
        self.space = cut_vertices  # (H, 3): vertex h of the cut mesh is corner h
        self.count = len(t.origin)

    def entries(self, faces: int) -> Entry:
        """Faces, vertices of the cut mesh and (s, t) there, for the first `faces` faces."""
        t = self.t
        h = np.flatnonzero(t.face < faces)
        face = t.face[h]
        flat = np.zeros((self.count, 2))
        flat[h] = self._flattened(h)
        entries: list[Entry] = [(face, h, flat[h])]
        across = t.twin[h]
        a, b = flat[h], flat[t.following[h]]
        clockwise, other = t.following[across], across  # D at the origin of h, C at its end
        d = self._hinged(h, t.following[h], clockwise, a, b, -1.0)
        c = self._hinged(h, t.following[h], other, a, b, -1.0)
        entries += [(face, clockwise, d), (face, other, c)]
        # At the origin of h: D beside h clockwise, and C of the half-edge before counter-clockwise.
        beside = np.zeros((self.count, 2))
        beside[h] = c
        entries += self._around(h, face, a, beside[t.preceding[h]], d)
        faces_of, vertex, places = (np.concatenate(part) for part in zip(*entries, strict=True))
        return faces_of, vertex, places

    def _flattened(self, h: Indices) -> Array:
        """Corners in the Newell plane of their face, about its centroid, lengths kept."""
        t, p = self.t, self.space
        size = np.maximum(np.bincount(t.face[h]), 1)[:, None]

        def total(values: Array) -> Array:
            return np.stack([np.bincount(t.face[h], x) for x in values.T], -1)

        local = p[h] - (total(p[h]) / size)[t.face[h]]
        after = p[t.following[h]] - (total(p[h]) / size)[t.face[h]]
        normal = total(np.cross(local, after))
        normal = safe_normalize(normal)  # zero for a face without area, whose chart is a line
        first = t.starts[: len(size)]
        right = p[t.following[first]] - p[first]
        right -= (right * normal).sum(-1, keepdims=True) * normal
        right = safe_normalize(right)
        up = np.cross(normal, right)
        of = t.face[h]
        return np.stack([(local * right[of]).sum(-1), (local * up[of]).sum(-1)], -1)

    def _hinged(
        self, a: Indices, b: Indices, point: Indices, flat_a: Array, flat_b: Array, side: float
    ) -> Array:
        """A point beside the edge a-b turned about it into the plane; side +1 is its left."""
        edge, reach = self.space[b] - self.space[a], self.space[point] - self.space[a]
        square = np.maximum((edge * edge).sum(-1, keepdims=True), 1e-300)
        along = (reach * edge).sum(-1, keepdims=True) / square
        away = np.linalg.norm(reach - along * edge, axis=-1, keepdims=True) / square**0.5
        flat = flat_b - flat_a
        left = np.stack([-flat[:, 1], flat[:, 0]], -1)
        return np.asarray(flat_a + along * flat + side * away * left)

    def _around(
        self, h: Indices, face: Indices, here: Array, ahead: Array, behind: Array
    ) -> list[Entry]:
        """The other corners around each vertex, and beside irregular facets what lies beyond."""
        t = self.t
        n = t.valence[t.origin[h]]
        turn = 2.0 * np.pi / n[:, None]
        middle = (ahead + behind) / 2.0
        with np.errstate(divide="ignore", invalid="ignore"):
            cosine = (here - middle) / (1.0 - np.cos(turn))
            sine = np.where(n[:, None] > 2, (ahead - behind) / (2.0 * np.sin(turn)), 0.0)
        corner, flat = t.ccw[h], ahead
        entries: list[Entry] = []
        beyond: list[Entry] = []
        for step in range(2, int(n.max(initial=0))):
            before, flat_before = corner, flat
            corner = np.where(step < n, t.ccw[corner], corner)
            around = here - cosine + np.cos(turn * step) * cosine + np.sin(turn * step) * sine
            flat = np.where((step < n - 1)[:, None], around, behind)
            entries.append(_part(step < n - 1, face, corner, flat))
            # The strip cut along the half-edge of this corner, beyond the facet's edge to it.
            outer = (step < n) & (n != 4)
            for point in (t.following[corner], t.twin[corner]):
                place = self._hinged(corner, before, point, flat, flat_before, 1.0)
                beyond.append(_part(outer, face, point, place))
        return entries + beyond


def _part(mask: NDArray[np.bool_], face: Indices, vertex: Indices, place: Array) -> Entry:
    return face[mask], vertex[mask], place[mask]
