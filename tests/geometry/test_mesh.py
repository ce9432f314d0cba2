"""Half-edge meshes: built-in ones are what they are called, bad ones are refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.mesh import Mesh, mesh
from reparam.geometry.meshes import MESHES

CUBE = MESHES["cube"]()
COUNTS = {  # vertices, edges, faces, Euler characteristic
    "cube": (8, 12, 6, 2),
    "tetrahedron": (4, 6, 4, 2),
    "octahedron": (6, 12, 8, 2),
    "icosahedron": (12, 30, 20, 2),
    "dodecahedron": (20, 30, 12, 2),
    "prism9": (18, 27, 11, 2),
    "three_handles": (64, 136, 68, -4),
    "torus": (48, 96, 48, 0),
    "hexagon_torus": (32, 84, 52, 0),
    "open_cube": (8, 12, 5, 1),
    "hill": (20, 31, 12, 1),
}


def volume(found: Mesh) -> float:
    """Enclosed volume, each face a fan about its centroid."""
    total = 0.0
    for face in found.topology.faces():
        corners = found.vertices[face]
        normal = np.cross(corners, np.roll(corners, -1, 0)).sum(0)
        total += float(corners.mean(0) @ normal) / 6.0
    return total


@pytest.mark.parametrize("name", COUNTS)
def test_counts(name: str) -> None:
    found = MESHES[name]()
    t = found.topology
    counts = len(found.vertices), len(t.ends), len(t.sizes), t.euler_characteristic()
    assert counts == COUNTS[name]


@pytest.mark.parametrize("name", MESHES)
def test_faces_run_counter_clockwise_seen_from_outside(name: str) -> None:
    found = MESHES[name]()
    if not found.topology.on_boundary.any():
        assert volume(found) > 1.0


def test_solids_are_regular() -> None:
    for name in ("cube", "tetrahedron", "octahedron", "icosahedron", "dodecahedron"):
        found = MESHES[name]()
        lengths = np.linalg.norm(np.diff(found.vertices[found.topology.ends], axis=1), axis=-1)
        assert np.ptp(lengths) < 1e-12, name
        assert len(np.unique(found.topology.valence)) == 1, name


@pytest.mark.parametrize("name", MESHES)
def test_half_edges_agree(name: str) -> None:
    t = MESHES[name]().topology
    here, inner = np.arange(len(t.origin)), t.twin >= 0
    assert (t.preceding[t.following] == here).all()
    assert (t.twin[t.twin[inner]] == here[inner]).all()
    assert (t.origin[t.twin[inner]] == t.target[inner]).all()
    assert (np.sort(t.around) == here).all()
    fans = np.split(t.around, np.cumsum(t.valence)[:-1])
    for fan in fans:
        assert (t.ccw[fan[:-1]] == fan[1:]).all()
        assert t.ccw[fan[-1]] in (-1, fan[0])


@pytest.mark.parametrize(
    ("faces", "words"),
    [
        ([], "at least one face, found none"),
        ([(0, 1)], r"face 0: expected at least 3 different corners, found \[0, 1\]"),
        ([(0, 1, 2), (1, 0, 3, 0)], r"face 1: expected at least 3 different corners"),
        ([(0, 1, 2), (0, 2, 9)], "face 1: expected corners from 0 to 4, found 9"),
        ([(0, 1, 2), (0, 2, -1)], "face 1: expected corners from 0 to 4, found -1"),
        (
            [(0, 1, 2), (1, 0, 3), (0, 1, 4)],
            "edge 0-1: expected at most two faces, found the faces 0, 1, 2",
        ),
        (
            [(0, 1, 2), (0, 1, 3)],
            "edge 0-1: expected faces that run along it in opposite directions, .* faces 0, 1",
        ),
        ([(0, 1, 2), (0, 3, 4)], "vertex 0: expected one fan of faces, found the face . apart"),
    ],
)
def test_bad_faces_are_named(faces: list[tuple[int, ...]], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        mesh(np.eye(5)[:, :3], faces)


def test_two_bodies_that_touch_in_a_vertex_are_refused() -> None:
    two = np.concatenate([CUBE.vertices, CUBE.vertices + 2.0])
    faces = [*CUBE.topology.faces(), *(np.add(CUBE.topology.faces(), 8)).tolist()]
    top = int(np.argmax(CUBE.vertices.sum(1)))
    low = 8 + int(np.argmin(CUBE.vertices.sum(1)))
    merged = [[top if corner == low else corner for corner in face] for face in faces]
    with pytest.raises(ValueError, match=f"vertex {top}: expected one fan"):
        mesh(two, merged)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_bad_vertices_are_named(value: float) -> None:
    vertices = CUBE.vertices.copy()
    vertices[5, 1] = value
    with pytest.raises(ValueError, match=f"vertex 5: expected finite numbers, found {value}"):
        mesh(vertices, CUBE.topology.faces())
    with pytest.raises(ValueError, match=r"vertices of shape \(V, 3\), found \(8, 2\)"):
        mesh(CUBE.vertices[:, :2], CUBE.topology.faces())
