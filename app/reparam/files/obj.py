"""Polygon meshes in Wavefront's .obj: vertices and faces are read, all else is passed over.

    v x y z            a vertex
    f a b c ...        a face, counter-clockwise from outside; a, or a/texture/normal; numbers
                       count from 1, negative ones backwards from the last vertex so far

A backslash at its end continues a line, # begins a comment.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from math import isfinite
from pathlib import Path

import numpy as np

from ..errors import FileFormatError
from ..geometry.body import MAX_PATCHES, Body, Polyhedron, body, face_patches
from ..geometry.net import LARGEST
from .tokens import read_text

MAX_CORNERS = 10_000  # of one face


def read_obj(path: str | os.PathLike[str]) -> Body:
    """The faces as flat patches, with the polyhedron that they form.

    Raises FileFormatError, `file:line: expected ..., found ...`, for a vertex that is not three
    numbers, a face with fewer than three or repeated corners or one that is not there, for more
    faces than a body holds, and for a file without a face.
    """
    path = Path(path)
    vertices: list[tuple[float, float, float]] = []
    faces: list[list[int]] = []
    lines: list[int] = []
    line = 0
    for line, words in _lines(read_text(path, ".obj")):
        if words[0] == "v":
            vertices.append(_vertex(path, line, words[1:]))
        elif words[0] == "f":
            faces.append(_face(path, line, words[1:], len(vertices)))
            lines.append(line)
            if len(faces) > MAX_PATCHES:
                raise FileFormatError(f"{path}:{line}: expected at most {MAX_PATCHES} faces")
    if not faces:
        raise FileFormatError(f"{path}:{max(line, 1)}: expected a face, found none")
    points = np.array(vertices)
    try:
        polyhedron = Polyhedron(points, faces, str(path), 1, lines.__getitem__)
        return body(face_patches(points, faces), polyhedron)
    except ValueError as fault:
        raise FileFormatError(f"{path}: {fault}") from None


def _lines(data: bytes) -> Iterator[tuple[int, list[str]]]:
    """Number and words of each line that has any, continued lines joined."""
    start, kept = 1, ""
    for number, raw in enumerate(data.decode("utf-8", "replace").split("\n"), start=1):
        text = kept + raw.split("#", 1)[0].rstrip()
        if text.endswith("\\"):
            kept = text[:-1] + " "
            continue
        if words := text.split():
            yield start if kept else number, words
        start, kept = number + 1, ""


def _vertex(path: Path, line: int, words: list[str]) -> tuple[float, float, float]:
    try:
        if len(words) < 3:
            raise ValueError
        x, y, z = (float(word) for word in words[:3])
    except ValueError:
        found = repr(" ".join(words)[:40])
        raise FileFormatError(f"{path}:{line}: expected v and 3 numbers, found {found}") from None
    for value in (x, y, z):
        if not isfinite(value) or abs(value) > LARGEST:
            expected = f"expected numbers of size up to {LARGEST:g}"
            raise FileFormatError(f"{path}:{line}: {expected}, found {value:g}")
    return x, y, z


def _face(path: Path, line: int, words: list[str], count: int) -> list[int]:
    if not 3 <= len(words) <= MAX_CORNERS:
        expected = f"expected f and 3 to {MAX_CORNERS} corners"
        raise FileFormatError(f"{path}:{line}: {expected}, found {len(words)}")
    corners = []
    for word in words:
        text = word.split("/", 1)[0]
        try:
            number = int(text)
        except ValueError:
            number = 0
        index = number - 1 if number > 0 else count + number
        if number == 0 or not 0 <= index < count:
            expected = f"expected the number of one of the {count} vertices above"
            raise FileFormatError(f"{path}:{line}: {expected}, found {word[:40]!r}")
        corners.append(index)
    if len(set(corners)) < len(corners):
        found = " ".join(words)[:40]
        raise FileFormatError(f"{path}:{line}: expected different corners, found {found!r}")
    return corners
