"""Oriented polygonal 2-manifolds, closed or with boundary, as half-edges in numpy arrays.

Half-edge h runs from `origin[h]` to the origin of `following[h]`, with its face on the left; it
stands for the corner at its origin too. `twin[h]` runs the other way, -1 on the boundary.

             o<-------------o
             |   face       ^        ccw[h]: the next corner around the origin,
    preceding|              |        counter-clockwise, twin[preceding[h]]
             v      h       |following
             o------------->o
             <-------------- twin
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

MAX_HALF_EDGES = 1 << 22


class MeshError(ValueError):
    """No oriented 2-manifold: what was expected at a face, edge or vertex, and what was found.

    `numbers` are those of the face, or of the vertices of the edge; `faces` those that disagree.
    """

    def __init__(
        self,
        place: str,
        numbers: Sequence[int],
        expected: str,
        found: str = "",
        faces: Sequence[int] = (),
    ) -> None:
        self.place = place
        self.numbers = tuple(numbers)
        self.expected = expected
        self.found = found or "the faces " + ", ".join(map(str, faces))
        self.faces = tuple(faces)
        super().__init__(self.told())

    def told(self, first: int = 0, found: str = "") -> str:
        """The fault as a line, where the first vertex has that number; `found` in other words."""
        first = 0 if self.place == "face" else first
        names = "-".join(str(number + first) for number in self.numbers)
        return f"{self.place} {names}: expected {self.expected}, found {found or self.found}"


@dataclass(frozen=True, eq=False)
class Topology:
    """Faces without positions: `origin` (H,) face after face, `starts` (F+1,) of the faces in it.

    `topology` checks; this does not.
    """

    vertex_count: int
    origin: Indices
    starts: Indices

    @cached_property
    def sizes(self) -> Indices:
        """How many corners each face has."""
        return np.diff(self.starts)

    @cached_property
    def face(self) -> Indices:
        """The face of each half-edge."""
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    @cached_property
    def following(self) -> Indices:
        """The next half-edge of the same face."""
        after = np.arange(1, len(self.origin) + 1)
        after[self.starts[1:] - 1] = self.starts[:-1]
        return after

    @cached_property
    def preceding(self) -> Indices:
        """The half-edge before in the same face."""
        before = np.empty_like(self.following)
        before[self.following] = np.arange(len(before))
        return before

    @cached_property
    def target(self) -> Indices:
        """The vertex that each half-edge runs to."""
        return self.origin[self.following]

    @cached_property
    def twin(self) -> Indices:
        """The half-edge that runs the other way, -1 where there is none."""
        forth = self.origin * self.vertex_count + self.target
        back = self.target * self.vertex_count + self.origin
        order = np.argsort(forth)
        place = np.minimum(np.searchsorted(forth, back, sorter=order), len(order) - 1)
        found = order[place]
        return np.where(forth[found] == back, found, -1)

    @cached_property
    def ccw(self) -> Indices:
        """The next corner counter-clockwise at the same vertex, -1 at the boundary."""
        return self.twin[self.preceding]

    @cached_property
    def edge(self) -> Indices:
        """The edge of each half-edge: twins have the same number, in the order of the first."""
        here = np.arange(len(self.origin))
        first = np.where(self.twin < 0, here, np.minimum(here, self.twin))
        return np.unique(first, return_inverse=True)[1]

    @cached_property
    def ends(self) -> Indices:
        """The two vertices of each edge, (E, 2)."""
        first = np.unique(self.edge, return_index=True)[1]
        return np.stack([self.origin[first], self.target[first]], -1)

    @cached_property
    def on_boundary(self) -> NDArray[np.bool_]:
        """Whether each vertex lies on the boundary."""
        rim = self.twin < 0
        marks = np.zeros(self.vertex_count, bool)
        marks[self.origin[rim]] = marks[self.target[rim]] = True
        return marks

    @cached_property
    def valence(self) -> Indices:
        """How many faces meet in each vertex."""
        return np.bincount(self.origin, minlength=self.vertex_count)

    @cached_property
    def around(self) -> Indices:
        """All corners, vertex by vertex, counter-clockwise, on the boundary from its outgoing edge.

        Raises MeshError naming a vertex whose faces do not form one fan.
        """
        used, first = np.unique(self.origin, return_index=True)
        start = np.full(self.vertex_count, -1)
        start[used] = first
        rim = np.flatnonzero(self.twin < 0)
        start[self.origin[rim]] = rim
        place = np.full(len(self.origin), -1)
        corner, step = start[used], 0
        while len(corner):  # all vertices at once, as often as the largest valence
            place[corner] = step
            corner = self.ccw[corner]
            corner = corner[corner >= 0]
            corner = corner[place[corner] < 0]
            step += 1
        if (place < 0).any():
            lost = int(np.argmin(place))
            number, alone = int(self.origin[lost]), int(self.face[lost])
            found = f"the face {alone} apart from the others"
            raise MeshError("vertex", [number], "one fan of faces", found, [alone])
        return np.lexsort([place, self.origin])

    def euler_characteristic(self) -> int:
        """Vertices - edges + faces; 2 - 2 genus where there is no boundary."""
        return int(np.count_nonzero(self.valence) - len(self.ends) + len(self.sizes))

    def edge_between(self, a: int, b: int) -> int:
        """The edge with these ends. Raises ValueError where there is none."""
        found = np.flatnonzero((self.ends == (a, b)).all(1) | (self.ends == (b, a)).all(1))
        if not len(found):
            raise ValueError(f"expected an edge of the mesh, found {a}-{b}")
        return int(found[0])

    def faces(self) -> list[list[int]]:
        """The vertices of each face."""
        return [part.tolist() for part in np.split(self.origin, self.starts[1:-1])]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Vertices (V, 3) and their topology."""

    vertices: Array
    topology: Topology


def mesh(vertices: ArrayLike, faces: Sequence[Sequence[int]]) -> Mesh:
    """An oriented 2-manifold, faces counter-clockwise from outside.

    Raises MeshError, one line that names the face, edge or vertex: NaN, an index out of range, a
    face with fewer than three or repeated corners, an edge used thrice, neighbours of opposite
    orientation, faces that meet in a vertex alone; ValueError where there is no face.
    """
    points = np.array(vertices, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"expected vertices of shape (V, 3), found {points.shape}")
    if not np.isfinite(points).all():
        row, axis = np.argwhere(~np.isfinite(points))[0]
        raise MeshError("vertex", [int(row)], "finite numbers", f"{points[row, axis]:g}")
    return Mesh(points, topology(faces, len(points)))


def topology(faces: Sequence[Sequence[int]], vertex_count: int) -> Topology:
    """Faces as half-edges, checked; raises as `mesh` does."""
    if not len(faces):
        raise ValueError("expected at least one face, found none")
    for number, face in enumerate(faces):
        if len(face) < 3 or len(set(face)) < len(face):
            found_here = str(list(face))
            raise MeshError("face", [number], "at least 3 different corners", found_here, [number])
    sizes = np.array([len(face) for face in faces])
    if sizes.sum() > MAX_HALF_EDGES:
        raise ValueError(f"expected at most {MAX_HALF_EDGES} corners, found {sizes.sum()}")
    found = Topology(
        vertex_count,
        np.concatenate([np.asarray(face, dtype=np.intp) for face in faces]),
        np.concatenate([[0], np.cumsum(sizes)]),
    )
    outside = (found.origin < 0) | (found.origin >= vertex_count)
    if outside.any():
        h = int(np.argmax(outside))
        number, expected = int(found.face[h]), f"corners from 0 to {vertex_count - 1}"
        raise MeshError("face", [number], expected, str(found.origin[h]), [number])
    _refuse_crowded_edges(found)
    _ = found.around
    return found


def _refuse_crowded_edges(found: Topology) -> None:
    """MeshError for an edge with three faces, or with two that run the same way along it."""
    low = np.minimum(found.origin, found.target)
    high = np.maximum(found.origin, found.target)
    _, edge, uses = np.unique(
        low * found.vertex_count + high, return_inverse=True, return_counts=True
    )
    _, way, same = np.unique(
        found.origin * found.vertex_count + found.target, return_inverse=True, return_counts=True
    )
    for crowded, group, expected in (
        (uses[edge] > 2, edge, "at most two faces"),
        (same[way] > 1, way, "faces that run along it in opposite directions"),
    ):
        if crowded.any():
            h = int(np.argmax(crowded))
            ends = int(found.origin[h]), int(found.target[h])
            raise MeshError("edge", ends, expected, faces=found.face[group == group[h]].tolist())
