r"""Facets that are not quads, in a mesh whose vertices have valence 4: what must hold around them.

 s_k------r_k           A facet of n corners p_k; across its edge k a quad with the outer
  |  g_k   |            corners r_k and s_k. What happens to all facets of one size is one
p_k+1-e_k-p_k           matrix, applied to blocks of points.
   \  c  /
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .net import Array
from .sparse import Sparse, Stencils

Indices = NDArray[np.intp]


def irregular_facets(t: Topology) -> dict[int, Indices]:
    """For each size n: half-edges (facets, n) of the facets with n corners, n != 4.

    Those at the rim, where a quad is missing, are left out: they are phantoms.
    """
    found = {}
    for n in np.unique(t.sizes[t.sizes != 4]).tolist():
        edges = t.starts[:-1][t.sizes == n][:, None] + np.arange(n)
        found[n] = edges[(t.twin[edges] >= 0).all(1)]
    return found


def _moves_outer(n: int) -> bool:
    """Whether the twists of a facet ask something of its quads: for even n, and 4 is regular."""
    return n % 2 == 0 and n >= 6


def _corners(t: Topology, edges: Indices) -> Indices:
    """The vertices (facets, 3, n): p, r and s."""
    across = t.twin[edges]
    r = t.origin[t.following[t.following[across]]]
    return np.stack([t.origin[edges], r, t.origin[t.preceding[across]]], 1)


def compete(t: Topology) -> bool:
    """Whether two facets that must move their outer corners have one in common."""
    outer = [
        _corners(t, h)[:, 1:].ravel() for n, h in irregular_facets(t).items() if _moves_outer(n)
    ]
    moved = np.concatenate([*outer, np.zeros(0, np.intp)])
    return len(np.unique(moved)) < len(moved)


def regular_facets(t: Topology, outer: bool = True) -> Sparse:
    """The map (vertices, vertices) that makes all irregular facets affinely regular, and for even
    n their twists solvable; without `outer` it leaves all but the facets alone."""
    moved = np.zeros(t.vertex_count, bool)
    stencils = Stencils()
    for n, edges in irregular_facets(t).items():
        corners = _corners(t, edges)
        rows = corners if outer and _moves_outer(n) else corners[:, :1]
        moved[rows] = True
        rows = rows.reshape(len(rows), -1, 1)
        stencils.add(rows, corners.reshape(len(rows), 1, -1), regular_block(n)[: rows.shape[1]])
    kept = np.flatnonzero(~moved)
    stencils.add(kept, kept, 1.0)
    return stencils.matrix((t.vertex_count, t.vertex_count))


@lru_cache(maxsize=64)
def regular_block(n: int) -> Array:
    """(3n, 3n) on (p, r, s): p_k to c + 2/n sum_j cos(2 pi (k-j)/n) p_j; for even n > 4 the
    alternating part of (r_k + s_k)/2 is taken away, so that the twists exist."""
    p, r, s = np.eye(3 * n).reshape(3, n, 3 * n)
    k = np.arange(n)
    regular = p.mean(0) + 2.0 / n * np.cos(2.0 * np.pi / n * (k[:, None] - k)) @ p
    sign = (-1.0) ** k[:, None]
    part = (sign * (r + s) / 2.0).mean(0) if _moves_outer(n) else 0.0
    return np.concatenate([regular, r - sign * part, s - sign * part])


@lru_cache(maxsize=64)
def twist_block(n: int) -> Array:
    """(n, 1 + 2n) on (c, e, g): the coefficients f11 = t_k of the patches around a facet.

    t_k + t_(k+1) = R_k = 2/3 (c + 2 e_k) + 2/9 lambda (g_k - e_k), lambda = 2 cos(2 pi/n): a
    cyclic system, divided, in Fourier's basis, by 1 + exp(2 pi i m/n).
    """
    points = np.eye(1 + 2 * n)
    c, e, g = points[0], points[1 : n + 1], points[n + 1 :]
    right = 2.0 / 3.0 * (c + 2.0 * e) + 4.0 / 9.0 * np.cos(2.0 * np.pi / n) * (g - e)
    m = np.arange(n)
    solvable = 2 * m != n  # for even n one component is 0 on the right, and free on the left
    factor = np.where(solvable, 1.0 + np.exp(2j * np.pi * m / n), np.inf)
    return np.asarray(np.fft.ifft(np.fft.fft(right, axis=0) / factor[:, None], axis=0).real)
