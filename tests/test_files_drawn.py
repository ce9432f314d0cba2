"""Surfaces from files, every kind, drawn by both evaluators and compared with float64."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.files.bv import read_bv
from reparam.geometry.evaluate import evaluate, project
from reparam.snapshot import Studio
from reparam.subject import open_subject

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SIZE = 200
LEVEL = 10
MIXED = Path(__file__).parent / "data" / "mixed.bv"  # in space, all kinds
H = sqrt(0.5)
ANNULUS = (
    f"8 1 2  3 0 0 1  {3 * H} {3 * H} 0 {H}  0 3 0 1  1 0 0 1  {H} {H} 0 {H}  0 1 0 1",
    2.0 * np.pi,
)
FILES = {  # in the plane z = 0, with the area
    "polygon": ("1 6 1  0 0 0  3 0 0  3 1 0  1 1 0  1 3 0  0 3 0  6 0 1 2 3 4 5", 5.0),
    "polyhedron": ("1 5 2  0 0 0  2 0 0  3 1 0  2 2 0  0 2 0  4 0 1 3 4  3 1 2 3", 5.0),
    "triangle": ("3 2  0 0 0  1 -.75 0  2 0 0  .25 1 0  2 1.5 0  .5 2 0", 3.25),
    "equal": ("4 2  0 2 0 1 2.5 0 2 2 0  -.5 1 0 1 .8 0 2.5 1 0  0 0 0 1 .5 0 2.5 -.5 0", 16 / 3),
    "tensor": ("5 1 3  0 1 0  1 2 0  2 1.5 0  3 1 0  0 0 0  1 -1 0  2 .5 0  3 0 0", 4.5),
    "rational": ANNULUS,
}

pytestmark = pytest.mark.usefixtures("evaluator")


def write(folder: Path, text: str) -> Path:
    path = folder / "surface.bv"
    path.write_text(text)
    return path


def draw(studio: Studio, path: Path, *settings: str) -> NDArray[np.uint8]:
    subject = open_subject(str(path)).assigned(["samples=1", "filter=nearest", *settings])
    return studio.draw(subject, (SIZE, SIZE), plain=True)


def covered(picture: NDArray[np.uint8]) -> Mask:
    return ~(picture == (0, 0, 255)).all(-1)


def grid(path: Path, steps: int) -> Array:
    """(patches, steps + 1, steps + 1, 3): points of the surface."""
    t = np.linspace(0.0, 1.0, steps + 1)
    return project(evaluate(read_bv(path).nets, *np.meshgrid(t, t, indexing="ij")))


def frame(seen: Array) -> tuple[Array, float]:
    """The middle of what is seen (..., 2), and the size of a pixel."""
    flat = seen.reshape(-1, 2)
    low, high = flat.min(0), flat.max(0)
    return (low + high) / 2.0, float(1.08 * (high - low).max() / SIZE)


def assert_covers(found: Mask, path: Path, right: Array, up: Array) -> None:
    """The triangles' pixels and no others, but where an edge passes a centre very closely."""
    middle, pixel = frame(grid(path, 256) @ np.stack([right, up], -1))
    p = (grid(path, LEVEL) @ np.stack([right, up], -1) - middle) / pixel * [1, -1] + SIZE / 2
    a, b, c, d = p[:, :-1, :-1], p[:, 1:, :-1], p[:, 1:, 1:], p[:, :-1, 1:]
    cells = np.stack([np.stack([a, b, c], -2), np.stack([a, c, d], -2)]).reshape(-1, 3, 2)
    distance = np.full((SIZE, SIZE), -1.0)  # in pixels, from the nearest edge, inside positive
    for corners in cells:
        edges = np.roll(corners, -1, 0) - corners
        turn = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        if abs(turn) < 1e-12:
            continue
        low, high = np.floor(corners.min(0)).astype(int), np.ceil(corners.max(0)).astype(int)
        window = np.s_[low[1] : high[1], low[0] : high[0]]
        row, column = np.mgrid[window] + 0.5
        inside = np.full(row.shape, np.inf)
        for e, q in zip(edges, corners, strict=True):
            across = e[0] * (row - q[1]) - e[1] * (column - q[0])
            inside = np.minimum(inside, np.copysign(1.0, turn) * across / np.hypot(*e))
        distance[window] = np.maximum(distance[window], inside)
    assert found.sum() > 0.1 * SIZE**2
    assert not (found & (distance < -0.03)).any()
    assert found[distance > 0.03].all()


@pytest.mark.parametrize("name", FILES)
def test_in_the_plane_it_is_seen_from_above(studio: Studio, tmp_path: Path, name: str) -> None:
    text, area = FILES[name]
    path = write(tmp_path, text)
    found = covered(draw(studio, path, f"level={LEVEL}"))
    assert_covers(found, path, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    _, pixel = frame(grid(path, 256)[..., :2])
    assert found.sum() * pixel**2 == pytest.approx(area, rel=1e-2)


def test_in_space_it_is_seen_from_the_left_and_above(studio: Studio) -> None:
    found = covered(draw(studio, MIXED, f"level={LEVEL}"))
    right = np.array([0.5, -sqrt(0.75), 0.0])
    eye = np.array([-0.75, -sqrt(3.0) / 4.0, 0.5])
    assert_covers(found, MIXED, right, np.cross(eye, right))


@pytest.mark.parametrize("level", [2, 7, 32])
@pytest.mark.parametrize(
    "text",
    [
        ANNULUS[0],
        "8 1 1  -1.5 1.25 0 1  5.5 6 0 4  -.5 -.75 0 .5  3 -2 0 2",
        "5 1 3  -1 1 0  0 2 0  1 1.5 0  2 1 0  -1 0 0  0 -1 0  1 .5 0  2 0 0",
    ],
    ids=["annulus", "rational", "tensor"],
)
def test_by_its_own_map_the_squares_stay_square(
    studio: Studio, tmp_path: Path, text: str, level: int
) -> None:
    path = write(tmp_path, text)
    picture = draw(studio, path, "texture=r", f"level={level}")
    middle, pixel = frame(grid(path, 256)[..., :2])
    t = (np.arange(SIZE) + 0.5 - SIZE / 2) * pixel
    cells = np.stack(np.meshgrid(middle[0] + t, middle[1] - t)) * 4.0 + 4.0
    seen = covered(picture) & (np.abs(cells - np.round(cells)) > 4e-3).all(0)
    bright = np.floor(cells).sum(0) % 2 == 1
    assert seen.sum() > 0.1 * SIZE**2
    assert (bright == (picture[..., 0] > 127))[seen].all()


def test_each_patch_by_the_identity(studio: Studio, tmp_path: Path) -> None:
    """(s,t) = (2v-1, 1-2u) in the middles of the 8 x 8 cells of a rational patch."""
    path = write(tmp_path, ANNULUS[0])
    picture = draw(studio, path)
    middle, pixel = frame(grid(path, 256)[..., :2])
    points = grid(path, 16)[0, 1::2, 1::2, :2]
    column, row = np.moveaxis(
        np.floor((points - middle) / pixel * [1, -1] + SIZE / 2).astype(int), -1, 0
    )
    i, j = np.indices((8, 8))
    assert ((picture[row, column, 0] > 127) == ((j + 7 - i) % 2 == 1)).all()


def test_faces_look_both_ways(studio: Studio, tmp_path: Path) -> None:
    """Turned over, a surface in space is covered and lit the same."""
    face = "1 4 1  0 0 0  2 0 0  2 1 1  0 1 1  4 {}"
    up = draw(studio, write(tmp_path, face.format("0 1 2 3")), "checks=1")
    down = draw(studio, write(tmp_path, face.format("3 2 1 0")), "checks=1")
    assert (up == down).all()
