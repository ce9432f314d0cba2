"""Texture maps of a surface spline from a layout of its mesh, through the spline's own stencils.

Each face of the mesh gets a chart: after the first cut its corners are laid flat with their true
lengths, and what surrounds it is folded down around them.

          D----C              h runs from A to B; the strip A D C B cut along the edge is turned
          |    |              about it into the plane of the face. Around a corner A the others of
       A--A----B--B           its facet follow from their two neighbours as in a regular polygon.
       |  |face|  |
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .net import Array
from .normal import safe_normalize
from .surface_spline import SurfaceSpline

Indices = NDArray[np.intp]
Entry = tuple[Indices, Indices, Array]  # faces, vertices of the cut mesh, (s, t) there


def layout_nets(spline: SurfaceSpline, vertices: Array) -> Array:
    """Texture nets (P, m, m, 4), points (s, t, 0, 1): lengths of the cut mesh, face by face.

    Over all patches their area is as large as under the identity, where each has 2 x 2.
    """
    charts = _Charts(spline.whole, spline.cut_vertices(vertices))
    keys, places = charts.table(int(spline.face.max()) + 1)
    nets = _apply(spline, keys, places)
    flat = np.zeros((*nets.shape[:-1], 4))
    flat[..., :2], flat[..., 3] = nets, 1.0
    corners = flat[:, [0, -1, -1, 0], [0, 0, -1, -1], :2]
    after = np.roll(corners, -1, 1)
    area = np.abs((corners[..., 0] * after[..., 1] - corners[..., 1] * after[..., 0]).sum() / 2)
    flat[..., :2] *= (4.0 * len(nets) / area) ** 0.5 if area > 0.0 else 1.0
    return flat


def _apply(spline: SurfaceSpline, keys: Indices, places: Array) -> Array:
    """The stencils at every coefficient of every patch, each patch in its own face's chart."""
    rest, points = spline.from_first_cut, spline.index.reshape(-1)
    entry, counts = rest.entries(points)
    rows = np.repeat(np.arange(len(points)), counts)
    face = spline.face[rows // spline.index[0].size]
    wanted = face * rest.shape[1] + rest.columns[entry]
    found = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    assert (keys[found] == wanted).all(), "a stencil reaches beyond its face's chart"
    columns = [np.bincount(rows, rest.values[entry] * c[found], len(points)) for c in places.T]
    return np.stack(columns, -1).reshape(*spline.index.shape, 2).astype(np.float64)


class _Charts:
    """All charts at once: entry after entry, the first of a place counts."""

    def __init__(self, t: Topology, cut_vertices: Array) -> None:
        self.t = t
        self.space = cut_vertices  # (H, 3): vertex h of the cut mesh is corner h
        self.count = len(t.origin)

    def table(self, faces: int) -> tuple[Indices, Array]:
        """Sorted keys face * H + vertex, and (s, t) at each, for the first `faces` faces."""
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
        faces_of, vertex = (np.concatenate([e[k] for e in entries]) for k in (0, 1))
        keys, first = np.unique(faces_of * self.count + vertex, return_index=True)
        return keys, np.concatenate([e[2] for e in entries])[first]

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
