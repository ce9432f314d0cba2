"""Surface splines with blend ratios: smooth patches from any oriented polygonal mesh (Fig. 8, 9).

Corners and edges of the mesh are cut off twice; then each vertex has four neighbours, and its nine
Bezier coefficients are read off: the vertex, the middles of its edges, the centroids of its faces.

      b20---b21---b22      b11 = x             v ^     where a face is not a quad the four
       |     |     |       b21 = (x + y0)/2      |     patches... around its corner are of
      b10---b11---b12      b22 = centroid        +> u  degree 3 x 3, with one coefficient
       |     |     |                                   changed: the twist f11
      b00---b01---b02

The ratio of an edge, in (0,1), says how wide a strip is cut off along it: 1/2 everywhere is the
uniform biquadratic spline, towards 0 the edge becomes a crease. All patches meet with one tangent
plane (G1). Everything is linear in the vertices: coefficients = stencils @ vertices.

In the spirit of J. Peters' surface splines (1995) and of the note's Fig. 9; the rest is our own
derivation. Along the edge of two patches f, g out of the centre c of an n-gon, with the quadratic
curve gamma of coefficients (c, e_k, g_k),

      f_u(0,t) + g_v(t,0) = lambda (1-t)^2 gamma'(t),      lambda = 2 cos(2 pi/n),

which is (14) with r's first derivatives (lambda (1-t)^2, -1). It holds coefficient by coefficient:
the first since the facet is affinely regular, the second by the twists, the last two since
biquadratic splines are C1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .cutting import corner_stencils, cut, with_phantoms
from .facets import compete, irregular_facets, regular_facets, twist_block
from .mesh import Topology
from .net import Array
from .sparse import Sparse, Stencils, chain

Indices = NDArray[np.intp]

BALANCE = 4.0  # how much smaller than an edge that leaves it an irregular facet may be
MOST_CUTS = 4


def edge_ratios(t: Topology, ratio: float, creases: ArrayLike = ()) -> Array:
    """One ratio for each edge (E,): `ratio`, but in creases rows (v, w, ratio of the edge v-w).

    Raises ValueError for a ratio outside (0,1) and for an edge that the mesh has not.
    """
    ratios = np.full(len(t.ends), float(ratio))
    for a, b, own in np.asarray(creases, dtype=np.float64).reshape(-1, 3):
        ratios[t.edge_between(int(a), int(b))] = own
    return _checked(t, ratios)


def _checked(t: Topology, ratios: Array) -> Array:
    bad = ~((ratios > 0.0) & (ratios < 1.0))  # NaN is bad too
    if bad.any():
        edge = int(np.argmax(bad))
        a, b = t.ends[edge]
        raise ValueError(f"edge {a}-{b}: expected a ratio between 0 and 1, found {ratios[edge]:g}")
    return ratios


@dataclass(frozen=True, eq=False)
class SurfaceSpline:
    """The linear map from a mesh's vertices to control nets, for one topology and its ratios.

    `stages` lead from the vertices to the points of biquadratic nets, which `quadratic` (P, 3, 3)
    picks: what neighbours share is one point, so patches meet bit for bit. Where facets are
    irregular `raised` leads on to the points of bicubic nets, picked by `index` (P, m, m). `facet`
    (P,) is the size of the irregular facet that a patch touches, 4 where it touches none; `face`
    (P,) the face of the mesh that it belongs to; `ratios` (E,) are the edges'. `whole` is the mesh
    with its phantoms, `cuts` are the meshes after each cut; `fractions` are the last cut's, ahead
    and behind each corner, and `corner` (P,) says which corner each patch came from.
    """

    stages: tuple[Sparse, ...]
    quadratic: Indices
    raised: Sparse | None
    index: Indices
    facet: Indices
    face: Indices
    ratios: Array
    whole: Topology
    cuts: tuple[Topology, ...]
    fractions: tuple[Array, Array]
    corner: Indices

    @cached_property
    def stencils(self) -> Sparse:
        """All stages as one map: (points of the nets of one degree, vertices)."""
        return chain(self.stages if self.raised is None else (*self.stages, self.raised))

    @cached_property
    def from_first_cut(self) -> Sparse:
        """The same map from the vertices of the first cut, but without what even facets ask of
        their quads: that reaches round the facet, and only tangent planes need it."""
        facets = regular_facets(self.cuts[-1], outer=False)
        stages = [*self.stages[2:-2], facets, self.stages[-1]]
        return chain(stages if self.raised is None else [*stages, self.raised])

    def points(self, vertices: Array) -> Array:
        """The points of the nets, (K, 4), over vertices (V, 3)."""
        return _with_weights(self.stencils @ vertices)

    def points_after(self, points: Array, vertices: Array, moved: Indices) -> Array:
        """The points again, bit for bit `points(vertices)`, after these vertices alone have moved:
        only what depends on them is computed."""
        rows = self.stencils.rows_with(moved)
        points = points.copy()
        points[rows, :3] = self.stencils.take(rows) @ vertices
        return points

    def nets(self, vertices: Array) -> Array:
        """The control nets (P, m, m, 4) over vertices (V, 3): one degree, 2 or 3, for all."""
        return self.points(vertices)[self.index]

    def own_nets(self, vertices: Array) -> list[Array]:
        """The nets in their own degrees: (3, 3, 4), or (4, 4, 4) at irregular facets."""
        low = _with_weights(reduce(_applied, self.stages, vertices))
        high, irregular = self.nets(vertices), self.facet != 4
        pairs = zip(low[self.quadratic], high, irregular, strict=True)
        return [cubic if bent else quadratic for quadratic, cubic, bent in pairs]

    def cut_vertices(self, vertices: Array, count: int = 1) -> Array:
        """The vertices of the mesh after `count` cuts; after all of them, with regular facets."""
        last = count + 1 + (count == len(self.cuts))
        return reduce(_applied, self.stages[:last], vertices)


def _applied(points: Array, stage: Sparse) -> Array:
    return stage @ points


def _with_weights(points: Array) -> Array:
    return np.concatenate([points, np.ones((len(points), 1))], -1)


def surface_spline(t: Topology, ratios: ArrayLike = 0.5) -> SurfaceSpline:
    """The spline over a topology; `ratios` for each edge (E,), or one for all.

    Raises ValueError for a ratio outside (0,1), naming the edge.
    """
    own = _checked(t, np.broadcast_to(np.asarray(ratios, dtype=np.float64), len(t.ends)))
    whole, phantoms, ratio = with_phantoms(t, own[t.edge])
    # The fraction along one edge is the ratio of the other: an edge's ratio is the width of the
    # strip that is cut along it.
    ahead, behind = ratio[whole.preceding], ratio
    stages, cuts = [phantoms, corner_stencils(whole, ahead, behind)], [cut(whole)]
    fractions = _balanced(whole, cuts[0], ahead, behind)
    face = np.where(whole.face < len(t.sizes), whole.face, -1)  # -1: of a phantom
    while True:
        assert len(cuts) < MOST_CUTS, "a cut in halves separates the facets"
        stages.append(corner_stencils(cuts[-1], *fractions))
        face = face[cuts[-1].origin]
        cuts.append(cut(cuts[-1]))
        if not compete(cuts[-1]):
            break
        halves = np.full(len(cuts[-1].origin), 0.5)
        fractions = (halves, halves)
    last = cuts[-1]
    ring = _rings(last, np.flatnonzero(face >= 0))
    facet = last.sizes[last.face[ring[:, 2]]]
    low, quadratic = _quadratic_points(last, ring)
    if (facet != 4).any():
        raised, index = _used(*_cubic_points(last, ring, facet))
    else:
        low, quadratic = _used(low, quadratic)
        raised, index = None, quadratic
    stages += [regular_facets(last), low]
    corner = last.origin[ring[:, 0]]
    return SurfaceSpline(
        tuple(stages), quadratic, raised, index, facet, face[corner], own, whole, tuple(cuts),
        fractions, corner,
    )  # fmt: skip


def _balanced(t: Topology, first: Topology, ahead: Array, behind: Array) -> tuple[Array, Array]:
    """Fractions of the second cut: 1/2, but smaller where an irregular facet is much smaller than
    the edge that leaves it, for there the twist would fold the patch."""
    fraction = (ahead + behind) / 2.0
    of_vertex = np.bincount(t.origin, fraction, t.vertex_count) / np.maximum(t.valence, 1)
    of_face = 1.0 - np.bincount(t.face, fraction, len(t.sizes)) / t.sizes
    sigma, tau = of_vertex[t.origin], of_face[t.face]  # of each vertex (v, f) of the first cut
    leaving_v = np.where(t.valence[t.origin] == 4, 0.5, np.minimum(0.5, BALANCE / 2 * sigma / tau))
    leaving_f = np.where(t.sizes[t.face] == 4, 0.5, np.minimum(0.5, BALANCE / 2 * tau / sigma))

    def towards(other: Indices) -> Array:
        within_f = t.face[first.origin] == t.face[other]
        return np.where(within_f, leaving_v[first.origin], leaving_f[first.origin])

    return towards(first.target), towards(first.origin[first.preceding])


# Reading off: patch after patch the corners around a vertex x, in the faces F_0 .. F_3, between
# its neighbours y_i and y_i+1; the half-edge of corner i runs from x to y_i.


def _rings(t: Topology, vertices: Indices) -> Indices:
    """The corners (P, 4) around these 4-valent vertices; an irregular facet comes as F_2."""
    chosen = np.zeros(t.vertex_count, bool)
    chosen[vertices] = True
    ring = t.around[chosen[t.origin[t.around]]].reshape(-1, 4)
    irregular = t.sizes[t.face[ring]] != 4
    turn = np.where(irregular.any(1), np.argmax(irregular, 1) - 2, 0)
    return np.take_along_axis(ring, (np.arange(4) + turn[:, None]) % 4, 1)


def _quadratic_points(t: Topology, ring: Indices) -> tuple[Sparse, Indices]:
    """From the vertices: centroids of the faces, middles of the edges, the vertices themselves."""
    faces, edges, x = len(t.sizes), len(t.ends), np.arange(t.vertex_count)
    stencils = Stencils()
    stencils.add(t.face, t.origin, 1.0 / t.sizes[t.face])
    stencils.add(faces + np.arange(edges)[:, None], t.ends, 0.5)
    stencils.add(faces + edges + x, x, 1.0)
    matrix = stencils.matrix((faces + edges + t.vertex_count, t.vertex_count))
    c0, c1, c2, c3 = t.face[ring].T
    m0, m1, m2, m3 = faces + t.edge[ring].T
    middle = faces + edges + t.origin[ring[:, 0]]
    return matrix, _grid([[c2, m2, c1], [m3, middle, m1], [c3, m0, c0]])


def _cubic_points(t: Topology, ring: Indices, facet: Indices) -> tuple[Sparse, Indices]:
    """From the quadratic points, raised in both directions: centroids, two points beside each
    edge's middle, four inside each patch, of which f11 is a twist at an irregular facet."""
    faces, edges, halves = len(t.sizes), len(t.ends), len(t.origin)
    stencils = Stencils()
    stencils.add(np.arange(faces), np.arange(faces), 1.0)
    towards = faces + np.arange(halves)  # from an edge's middle towards the half-edge's face
    stencils.add(towards, t.face, 1.0 / 3.0)
    stencils.add(towards, faces + t.edge, 2.0 / 3.0)
    inside = faces + halves + np.arange(4 * len(ring)).reshape(-1, 4)
    plain = np.ones(ring.shape, bool)
    plain[:, 2] = facet == 4
    middles = faces + t.edge[ring]
    x = np.broadcast_to(faces + edges + t.origin[ring[:, :1]], ring.shape)
    for points, factor in (
        (t.face[ring], 1.0 / 9.0),
        (middles, 2.0 / 9.0),
        (np.roll(middles, -1, 1), 2.0 / 9.0),
        (x, 4.0 / 9.0),
    ):
        stencils.add(inside[plain], points[plain], factor)
    twist = np.full(t.vertex_count, -1)
    twist[t.origin[ring[:, 0]]] = inside[:, 2]
    for n, h in irregular_facets(t).items():
        rows = twist[t.origin[h]]
        block = np.concatenate([t.face[h[:, :1]], faces + t.edge[h], t.face[t.twin[h]]], 1)
        which, corner = np.nonzero(rows >= 0)  # not those of phantoms
        stencils.add(rows[which, corner, None], block[which], twist_block(n)[corner])
    matrix = stencils.matrix((faces + halves + inside.size, faces + edges + t.vertex_count))
    c0, c1, c2, c3 = t.face[ring].T
    (a0, a1, a2, a3), (b0, b1, b2, b3) = faces + ring.T, faces + t.twin[ring].T
    i0, i1, i2, i3 = inside.T
    return matrix, _grid([[c2, a2, b2, c1], [b3, i2, i1, a1], [a3, i3, i0, b1], [c3, b0, a0, c0]])


def _grid(rows: list[list[Indices]]) -> Indices:
    """(P, m, m) from rows of (P,)."""
    return np.moveaxis(np.array(rows), -1, 0)


def _used(matrix: Sparse, index: Indices) -> tuple[Sparse, Indices]:
    """Without the rows that no net picks: points of phantoms."""
    rows, place = np.unique(index, return_inverse=True)
    return matrix.take(rows), place.reshape(index.shape)
