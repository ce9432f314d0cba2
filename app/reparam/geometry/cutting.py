r"""Cutting corners and edges off a mesh: the connectivity and the stencils of one step.

Each corner (v, f) of the mesh becomes a vertex of the cut mesh, numbered like its half-edge, and
each face, edge and vertex becomes a face (Doo and Sabin's connectivity):

        o-----------------o
        |\               /|         F(f): the corners of f
        |  o---------- o  |         E(e): the four corners beside an edge
        |  |    F      |  |         V(v): the corners around a vertex
        |  o-----------o  |
        |/  E           \|V
        o-----------------o
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .sparse import Sparse, Stencils

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


def cut(t: Topology) -> Topology:
    """The cut mesh: the faces F in their order, then E for inner edges, V for inner vertices."""
    here = np.arange(len(t.origin))
    inner = here[t.twin > here]
    other = t.twin[inner]
    edges = np.stack([t.following[inner], inner, t.following[other], other], -1)
    around = t.around[~t.on_boundary[t.origin[t.around]]]
    valences = t.valence[(t.valence > 0) & ~t.on_boundary]
    sizes = np.concatenate([t.sizes, np.full(len(inner), 4), valences])
    return Topology(
        len(here),
        np.concatenate([here, edges.ravel(), around]),
        np.concatenate([[0], np.cumsum(sizes)]),
    )


def corner_stencils(t: Topology, ahead: Array, behind: Array) -> Sparse:
    """The corners of the cut mesh from the vertices: (H, V), rows that sum to 1.

    `ahead` (H,) is the fraction a of the way from a corner's vertex v to the middle m of the
    half-edge, `behind` (H,) the fraction b towards the middle n of the one before; with the
    centroid c of the face the corner is

        (1-a)(1-b) v + a(1-b) m + b(1-a) n + a b c.
    """
    here = np.arange(len(t.origin))
    a, b = ahead, behind
    stencils = Stencils()
    stencils.add(here, t.origin, (1 - a) * (1 - b) + (a * (1 - b) + b * (1 - a)) / 2)
    stencils.add(here, t.target, a * (1 - b) / 2)
    stencils.add(here, t.origin[t.preceding], b * (1 - a) / 2)
    size = t.sizes[t.face]
    rows = np.repeat(here, size)
    first = np.repeat(t.starts[t.face], size)
    within = np.arange(len(rows)) - np.repeat(np.cumsum(size) - size, size)
    stencils.add(rows, t.origin[first + within], np.repeat(a * b / size, size))
    return stencils.matrix((len(here), t.vertex_count))


def with_phantoms(t: Topology, ratio: Array) -> tuple[Topology, Sparse, Array]:
    """One ring of phantom quads beyond the boundary, so that the surface ends where the mesh does.

    Returns the larger topology, faces of `t` first; its vertices from those of `t`, reflected; and
    the ratio of each of its half-edges, `ratio` (H,) being those of `t`. A boundary vertex v goes
    to v* = 2 v - mean(inner neighbours); one with a single face to the corner of a quad of its own.
    """
    count = t.vertex_count
    stencils = Stencils()
    stencils.add(np.arange(count), np.arange(count), 1.0)
    if not t.on_boundary.any():
        return t, stencils.matrix((count, count)), ratio
    rim = np.flatnonzero(t.twin < 0)
    leaving = {int(t.origin[h]): int(h) for h in rim}
    arriving = {int(t.target[h]): int(h) for h in rim}
    beyond: dict[int, tuple[int, int]] = {}  # of v: across the edge that leaves it, that arrives
    spoke: dict[tuple[int, int], float] = {}  # ratios of the edges from the boundary outwards
    corners = []
    added = count
    for v, h in leaving.items():
        back = arriving[v]
        after, before = int(t.target[h]), int(t.origin[back])
        inner = _inner_half_edges(t, h)
        if inner:
            stencils.add(added, v, 2.0)
            stencils.add(added, t.target[inner], -1.0 / len(inner))
            beyond[v] = (added, added)
            spoke[v, added] = float(np.mean(ratio[inner]))
            added += 1
            continue
        face = t.origin[t.starts[t.face[h]] : t.starts[t.face[h] + 1]]
        for number, neighbour in ((added, before), (added + 1, after)):
            stencils.add(number, [v, neighbour], [2.0, -1.0])
        if len(face) == 4:
            opposite = t.target[t.following[h]]
            stencils.add(added + 2, [v, after, before, opposite], [4.0, -2.0, -2.0, 1.0])
        else:
            stencils.add(added + 2, [v, after, before], [3.0, -1.0, -1.0])
        beyond[v] = (added, added + 1)
        spoke[v, added], spoke[v, added + 1] = float(ratio[back]), float(ratio[h])
        corners.append((v, added + 1, added + 2, added))
        added += 3
    quads = [
        (
            int(t.target[h]),
            int(t.origin[h]),
            beyond[int(t.origin[h])][0],
            beyond[int(t.target[h])][1],
        )
        for h in rim
    ]
    extra = np.array(quads + corners)
    larger = Topology(
        added,
        np.concatenate([t.origin, extra.ravel()]),
        np.concatenate([t.starts, t.starts[-1] + 4 * np.arange(1, len(extra) + 1)]),
    )
    new = np.arange(len(t.origin), len(larger.origin))
    outwards = [
        spoke.get((a, b), spoke.get((b, a), 0.5))
        for a, b in zip(larger.origin[new].tolist(), larger.target[new].tolist(), strict=True)
    ]
    twin = larger.twin[new]
    real = (twin >= 0) & (twin < len(ratio))
    across = np.where(real, ratio[np.where(real, twin, 0)], outwards)
    return larger, stencils.matrix((added, count)), np.concatenate([ratio, across])


def _inner_half_edges(t: Topology, h: int) -> list[int]:
    """Those that leave the origin of the boundary half-edge h into the mesh."""
    found, corner = [], int(t.ccw[h])
    while corner >= 0:
        found.append(corner)
        corner = int(t.ccw[corner])
    return found
