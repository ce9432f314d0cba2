"""Built-in meshes: solids, bodies with handles, open pieces."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from itertools import combinations

import numpy as np

from .mesh import Mesh, mesh

GOLDEN = (1.0 + 5.0**0.5) / 2.0
Cell = tuple[int, int, int]


def cube() -> Mesh:
    """[-1, 1]^3: 8 vertices of valence 3, 6 squares."""
    return _centred(voxels([(0, 0, 0)]), 2.0)


def tetrahedron() -> Mesh:
    """Four corners of the cube."""
    return mesh(
        [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)],
        [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)],
    )


def octahedron() -> Mesh:
    """The square bipyramid: its vertices lie on the axes."""
    return bipyramid(4)


def icosahedron() -> Mesh:
    """12 vertices of valence 5, 20 triangles: corners of three golden rectangles, 2 apart."""
    rectangle = [(0.0, a, b * GOLDEN) for a in (-1.0, 1.0) for b in (-1.0, 1.0)]
    points = np.array([np.roll(corner, axis) for axis in range(3) for corner in rectangle])
    near = np.linalg.norm(points[:, None] - points, axis=-1) < 2.1
    faces = [
        (i, j, k) for i, j, k in combinations(range(12), 3) if near[i, j] & near[j, k] & near[k, i]
    ]
    outside = [np.linalg.det(points[list(face)]) > 0.0 for face in faces]
    return mesh(points, [f if out else f[::-1] for f, out in zip(faces, outside, strict=True)])


def dodecahedron() -> Mesh:
    """The dual of the icosahedron: 20 vertices of valence 3, 12 pentagons."""
    return dual(icosahedron())


def dual(primal: Mesh) -> Mesh:
    """Centroids of the faces as vertices, a face for each vertex of a closed mesh."""
    t = primal.topology
    centroids = np.stack(
        [np.bincount(t.face, c[t.origin]) / t.sizes for c in primal.vertices.T], -1
    )
    faces = np.split(t.face[t.around], np.cumsum(t.valence)[:-1])
    return mesh(centroids, [face.tolist() for face in faces])


def prism(n: int) -> Mesh:
    """Two regular n-gons of radius 1, one above the other, and n squares between them."""
    low, high = range(n), range(n, 2 * n)
    sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    points = np.concatenate([_circle(n, height) for height in (-0.5, 0.5)])
    return mesh(points, [tuple(reversed(low)), tuple(high), *sides])


def bipyramid(n: int) -> Mesh:
    """A regular n-gon of radius 1 and two poles of valence n."""
    upper = [(n, k, (k + 1) % n) for k in range(n)]
    lower = [(n + 1, (k + 1) % n, k) for k in range(n)]
    return mesh([*_circle(n, 0.0), (0, 0, 1), (0, 0, -1)], upper + lower)


def three_handles() -> Mesh:
    """A slab of 7 x 3 cells without three of them: genus 3, all faces squares (Fig. 8)."""
    cells = [(i, j, 0) for i in range(7) for j in range(3) if j != 1 or i not in (1, 3, 5)]
    return _centred(voxels(cells), 1.0)


def torus(around: int = 8, across: int = 6, big: float = 2.0, small: float = 0.8) -> Mesh:
    """A grid of quads that closes both ways: every vertex has valence 4."""
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    psi, phi = 2.0 * np.pi * i / around, 2.0 * np.pi * j / across
    distance = big + small * np.cos(phi)
    points = np.stack([distance * np.cos(psi), distance * np.sin(psi), small * np.sin(phi)], -1)
    number = np.arange(around * across).reshape(around, across)
    right, up = np.roll(number, -1, 0), np.roll(number, -1, 1)
    quads = np.stack([number, right, np.roll(right, -1, 1), up], -1)
    return mesh(points.reshape(-1, 3), quads.reshape(-1, 4).tolist())


def hexagon_torus() -> Mesh:
    """Hexagons beside vertices of valence 5 and 6: even facets that compete for their neighbours.

    A triangulated torus of 6 x 6 vertices, each third vertex both ways taken out.
    """
    n = 6
    full = torus(n, n, 3.0, 1.2).vertices
    ring = [(1, 0), (1, 1), (0, 1), (-1, 0), (-1, -1), (0, -1)]
    faces = []
    for i in range(n):
        for j in range(n):
            if i % 3 == 0 and j % 3 == 0:
                faces.append([_wrap(i + a, j + b, n) for a, b in ring])
            for shape in ([(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]):
                cell = [(i + a, j + b) for a, b in shape]
                if not any(a % 3 == 0 and b % 3 == 0 for a, b in cell):
                    faces.append([_wrap(a, b, n) for a, b in cell])
    kept = sorted({corner for face in faces for corner in face})
    number = {corner: k for k, corner in enumerate(kept)}
    return mesh(full[kept], [[number[corner] for corner in face] for face in faces])


def t_mesh() -> Mesh:
    """A plate of small and large quads: where they meet, vertices lie in the middle of an edge
    (T-joints), so that the large faces are pentagons and hexagons."""
    top = [
        [(0, 0), (1, 0), (1, 1), (0, 1)],
        [(0, 1), (1, 1), (1, 2), (0, 2)],
        [(1, 0), (3, 0), (3, 1), (3, 2), (1, 2), (1, 1)],
        [(3, 0), (4, 0), (4, 1), (3, 1)],
        [(3, 1), (4, 1), (4, 2), (3, 2)],
    ]
    bottom = [
        [(0, 0), (0, 1), (0, 2), (1, 2), (1, 0)],
        [(1, 0), (1, 2), (3, 2), (3, 1), (3, 0)],
        [(3, 0), (3, 1), (4, 1), (4, 0)],
        [(3, 1), (3, 2), (4, 2), (4, 1)],
    ]
    rim = [(0, 0), (1, 0), (3, 0), (4, 0), (4, 1), (4, 2), (3, 2), (1, 2), (0, 2), (0, 1)]
    outlines = [[(x, y, 1) for x, y in face] for face in top]
    outlines += [[(x, y, 0) for x, y in face] for face in bottom]
    for (x0, y0), (x1, y1) in zip(rim, [*rim[1:], rim[0]], strict=True):
        outlines.append([(x0, y0, 0), (x1, y1, 0), (x1, y1, 1), (x0, y0, 1)])
    number: dict[Cell, int] = {}
    faces = [[number.setdefault(corner, len(number)) for corner in face] for face in outlines]
    return _centred(mesh(list(number), faces), 1.0)


def open_cube() -> Mesh:
    """The cube without its lid."""
    closed = cube()
    faces = closed.topology.faces()
    heights = [closed.vertices[face][:, 2].min() for face in faces]
    return mesh(closed.vertices, [f for f, z in zip(faces, heights, strict=True) if z < 1.0])


def hill() -> Mesh:
    """An open piece, all quads."""
    x, y = np.meshgrid(np.arange(5.0), np.arange(4.0), indexing="ij")
    points = np.stack([x - 2.0, y - 1.5, 0.5 * np.sin(1.3 * x) * np.cos(1.1 * y)], -1)
    number = np.arange(20).reshape(5, 4)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1)
    return mesh(points.reshape(-1, 3), quads.reshape(-1, 4).tolist())


def parasol() -> Mesh:
    """An open piece: six triangles around a vertex, then a ring of quads, corners without rule."""
    k = np.arange(6)
    heights = 0.1 * k % 0.3, 0.05 * k - 0.2
    inner, outer = (_circle(6, 0.0) * [r, r, 1.0] for r in (1.0, 2.2))
    inner[:, 2], outer[:, 2] = heights
    triangles = [(0, 1 + a, 1 + (a + 1) % 6) for a in range(6)]
    quads = [(1 + a, 7 + a, 7 + (a + 1) % 6, 1 + (a + 1) % 6) for a in range(6)]
    return mesh(np.concatenate([[(0.0, 0.0, 0.6)], inner, outer]), [*triangles, *quads])


def voxels(cells: Iterable[Cell]) -> Mesh:
    """The boundary quads of a union of unit cells."""
    solid = set(cells)
    number: dict[Cell, int] = {}
    faces = []
    for cell in sorted(solid):
        for axis in range(3):
            for side in (0, 1):
                beside = [c + (2 * side - 1) * (k == axis) for k, c in enumerate(cell)]
                if tuple(beside) in solid:
                    continue
                turns = (
                    [(0, 0), (1, 0), (1, 1), (0, 1)] if side else [(0, 0), (0, 1), (1, 1), (1, 0)]
                )
                corners = [_corner(cell, axis, side, a, b) for a, b in turns]
                faces.append([number.setdefault(corner, len(number)) for corner in corners])
    return mesh(list(number), faces)


def _corner(cell: Cell, axis: int, side: int, a: int, b: int) -> Cell:
    offset = {axis: side, (axis + 1) % 3: a, (axis + 2) % 3: b}
    return (cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2])


def _wrap(i: int, j: int, n: int) -> int:
    return i % n * n + j % n


def _circle(n: int, height: float) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    angle = 2.0 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle), np.full(n, height)], -1)


def _centred(found: Mesh, scale: float) -> Mesh:
    middle = (found.vertices.min(0) + found.vertices.max(0)) / 2.0
    return Mesh((found.vertices - middle) * scale, found.topology)


MESHES: dict[str, Callable[[], Mesh]] = {
    "cube": cube,
    "tetrahedron": tetrahedron,
    "octahedron": octahedron,
    "icosahedron": icosahedron,
    "dodecahedron": dodecahedron,
    "prism6": partial(prism, 6),
    "prism7": partial(prism, 7),
    "prism8": partial(prism, 8),
    "prism9": partial(prism, 9),
    "three_handles": three_handles,
    "torus": torus,
    "hexagon_torus": hexagon_torus,
    "t_mesh": t_mesh,
    "open_cube": open_cube,
    "hill": hill,
    "parasol": parasol,
}
