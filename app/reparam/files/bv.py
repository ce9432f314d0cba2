"""The .bv files of BezierView (SurfLab): polyhedra and Bezier patches as plain text.

A file is a stream of words separated by blanks: segments `kind data`, and group lines
`Group colour name #depth`, which end with their line.

    1  polyhedron       vertices faces, (x y z) each, then for each face its size and indices
    3  triangle         degree, (d+1)(d+2)/2 points in rows from the base up
    4  tensor product   degree, (d+1)^2 points, u slowest
    5  tensor product   degrees in u and v, (du+1)(dv+1) points
    8  rational         degrees in u and v, (du+1)(dv+1) points (wx wy wz w), premultiplied

Kinds 9 and 10 carry normals of their own, and 6 and 7 are only names: these are refused.
Source: the BezierView distribution and its web page.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..errors import FileFormatError
from ..geometry.body import (
    MAX_PATCHES,
    TRIANGLE_DOMAIN,
    Body,
    Patch,
    Polyhedron,
    body,
    face_patches,
    homogeneous,
    triangle_to_tensor,
)
from ..geometry.net import MAX_ORDER, Array, check_net
from .progress import Progress, silent
from .tokens import Numbers, read_text, runs

POLYHEDRON, RATIONAL = 1, 8
REFUSED = {6: "trim curve", 7: "B-spline", 9: "triangle with normals", 10: "tensor with normals"}
TELL = 500  # patches between words about progress
MAX_CORNERS = 10_000  # of one face: cutting a polygon up may take time like its square


def read_bv(path: str | os.PathLike[str], progress: Progress = silent) -> Body:
    """The patches of a .bv file, in their order; group "" is what precedes the first group line.

    Raises FileFormatError, `file:line: expected ..., found ...`, for everything that is not a
    .bv file, for kinds that are not read, for more than `body` holds, and for control points
    and weights that `check_net` refuses.
    """
    path = Path(path)
    patches: list[Patch] = []
    vertices: list[Array] = []
    faces: list[list[int]] = []
    places: list[tuple[Numbers, int]] = []  # where each face begins
    rational: list[tuple[Array, Numbers, int]] = []
    told = 0
    for group, numbers in runs(path, read_text(path), progress):
        while not numbers.at_end():
            start = numbers.position
            if len(patches) >= told:
                progress(numbers.share())
                told = len(patches) + TELL
            kind = _kind(numbers)
            if kind == POLYHEDRON:
                points, corners = _polyhedron(numbers)
                patches += face_patches(points, corners, group)
                before = sum(map(len, vertices))
                vertices.append(points)
                places += _places(numbers, corners)
                faces += [[before + corner for corner in face] for face in corners]
            else:
                patches += SEGMENTS[kind](numbers, group)
            if len(patches) > MAX_PATCHES:
                raise numbers.error(start, f"at most {MAX_PATCHES} patches", "more")
            if kind == RATIONAL:
                rational.append((patches[-1].net, numbers, numbers.position))
    if not patches:
        raise numbers.error(numbers.position, "a patch")
    try:
        return body(patches, _polyhedron_of(path, vertices, faces, places) if faces else None)
    except ValueError as fault:
        for net, numbers, end in rational:
            _refuse_bad_point(net, numbers, end - net.size)
        raise FileFormatError(f"{path}: {fault}") from None


def _kind(numbers: Numbers) -> int:
    kind = numbers.take(1, "a patch kind")[0]
    if kind not in SEGMENTS and kind != POLYHEDRON:
        found = f"kind {kind:g}, {REFUSED[kind]}" if kind in REFUSED else ""
        raise numbers.error(numbers.position - 1, "a patch of kind 1, 3, 4, 5 or 8", found)
    return int(kind)


def _refuse_bad_point(net: Array, numbers: Numbers, start: int) -> None:
    """Raise FileFormatError with the line of the first weight that spoils its point, if any.

    `check_net` knows the rules; among blameless points it speaks of one point at a time.
    """
    try:
        check_net(net)
    except ValueError:
        for point, index in enumerate(np.ndindex(net.shape[:2])):
            alone = np.tile([0.0, 0.0, 0.0, 1.0], (*net.shape[:2], 1))
            alone[index] = net[index]
            try:
                check_net(alone)
            except ValueError as fault:
                expected, _, found = str(fault).partition("expected ")[2].rpartition(", found ")
                raise numbers.error(start + 4 * point + 3, expected, found) from None


def _polyhedron(numbers: Numbers) -> tuple[Array, list[list[int]]]:
    count = numbers.integer("a number of vertices", 1)
    face_count = numbers.integer("a number of faces", 0, MAX_PATCHES)
    vertices = _points(numbers, count, 3)
    faces: list[list[int]] = []
    triangles = 0
    for _ in range(face_count):
        size = numbers.integer("a number of corners", 3, MAX_CORNERS)
        face = numbers.integers(size, f"{size} vertex indices", 0, count - 1)
        if len(set(face)) < size:
            again = next(i for i, corner in enumerate(face) if corner in face[:i])
            first = numbers.position - size
            raise numbers.error(first + again, f"{size} different vertices of a face")
        triangles += size - 2
        if triangles > MAX_PATCHES:
            raise numbers.error(numbers.position - 1, f"at most {MAX_PATCHES} triangles", "more")
        faces.append(face)
    return vertices, faces


def _places(numbers: Numbers, faces: list[list[int]]) -> list[tuple[Numbers, int]]:
    """Where each of the faces just read begins."""
    lengths = [1 + len(face) for face in faces]
    starts = numbers.position - sum(lengths) + np.cumsum([0, *lengths[:-1]])
    return [(numbers, int(start)) for start in starts] if faces else []


def _polyhedron_of(
    path: Path,
    vertices: list[Array],
    faces: list[list[int]],
    places: list[tuple[Numbers, int]],
) -> Polyhedron:
    def line(face: int) -> int:
        numbers, start = places[face]
        return numbers.line(start)

    return Polyhedron(np.concatenate(vertices), faces, str(path), 0, line)


def _triangle(numbers: Numbers, group: str) -> list[Patch]:
    degree = _degree(numbers)
    points = _points(numbers, (degree + 1) * (degree + 2) // 2, 3)
    return [Patch(triangle_to_tensor(points, degree), TRIANGLE_DOMAIN, group)]


def _square(numbers: Numbers, group: str) -> list[Patch]:
    degree = _degree(numbers)
    return [_tensor_patch(numbers, degree, degree, group)]


def _tensor(numbers: Numbers, group: str) -> list[Patch]:
    return [_tensor_patch(numbers, _degree(numbers), _degree(numbers), group)]


def _tensor_patch(numbers: Numbers, degree_u: int, degree_v: int, group: str) -> Patch:
    m, n = degree_u + 1, degree_v + 1
    return Patch(homogeneous(_points(numbers, m * n, 3).reshape(m, n, 3)), group=group)


def _rational(numbers: Numbers, group: str) -> list[Patch]:
    m, n = _degree(numbers) + 1, _degree(numbers) + 1
    return [Patch(_points(numbers, m * n, 4).reshape(m, n, 4), group=group)]


def _degree(numbers: Numbers) -> int:
    return numbers.integer("a degree", 0, MAX_ORDER - 1)


def _points(numbers: Numbers, count: int, size: int) -> Array:
    """`count` points of `size` numbers: (count, size)."""
    expected = f"{size * count} numbers for {count} points"
    return numbers.take(size * count, expected).reshape(count, size)


SEGMENTS: dict[float, Callable[[Numbers, str], list[Patch]]] = {
    3: _triangle,
    4: _square,
    5: _tensor,
    RATIONAL: _rational,
}
