"""Reading .obj: what is a mesh, what is refused and at which line; meshes as surface splines."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from reparam.cli import main
from reparam.errors import FileFormatError, UsageError
from reparam.files.bv import read_bv
from reparam.files.obj import read_obj
from reparam.geometry.patch_joins import joins
from reparam.scenes.layers import Label, Polylines
from reparam.subject import Subject, open_subject

CUBE = """# a cube \\
v -1 -1 -1
v 1 -1 -1 1.0
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vn 0 0 1
g sides
usemtl stone
f 4/1/1 3/1/1 2/1/1 1/1/1
f 5//1 6//1 7//1 \\
  8//1
f 1 2 6 5
f 2 3 7 6
f -6 -5 -1 -2
f 4 1 5 8
"""
BV_CUBE = """1 8 6
-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1
4 3 2 1 0  4 4 5 6 7  4 0 1 5 4  4 1 2 6 5  4 2 3 7 6  4 3 0 4 7
"""


def written(folder: Path, text: str, name: str = "mesh.obj") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def nets_of(subject: Subject) -> np.ndarray:
    layers = [layer for layer in subject.figure().spaces[-1].layers if hasattr(layer, "lit")]
    return np.concatenate([layer.net for layer in layers])


def test_a_cube(tmp_path: Path) -> None:
    found = read_obj(written(tmp_path, CUBE))
    assert found.polyhedron is not None
    assert found.polyhedron.vertices.tolist()[1] == [1.0, -1.0, -1.0]
    assert found.polyhedron.faces[4] == [2, 3, 7, 6]
    assert found.nets.shape == (6, 2, 2, 4)
    assert len(joins(found.nets).patches) == 12


@pytest.mark.parametrize("name", ["mesh.obj", "mesh.bv"])
def test_files_are_control_meshes(tmp_path: Path, name: str) -> None:
    subject = open_subject(str(written(tmp_path, CUBE if name.endswith("obj") else BV_CUBE, name)))
    assert subject.value("smooth") == ("layout" if name.endswith("obj") else "off")
    smooth = subject.assigned(["smooth=on", "ratio=0.3", "creases=[[0,1,0.05]]"])
    report = joins(nets_of(smooth), highest=1)
    assert len(report.patches) == 192
    assert report.angles.max() <= 1e-8
    assert len(nets_of(smooth.assigned(["smooth=off"]))) == 6
    moved = smooth.assigned(["vertices=[[6,2,2,2]]"])
    assert np.abs(nets_of(moved) - nets_of(smooth)).max() > 0.1


def test_smoothing_what_has_no_good_polyhedron(tmp_path: Path) -> None:
    patch = open_subject(str(written(tmp_path, "4 1 0 0 0 0 1 0 1 0 0 1 1 0", "patch.bv")))
    with pytest.raises(UsageError, match="smooth: expected a file with a polyhedron"):
        patch.assigned(["smooth=on"]).figure()


FIVE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\n"
BAD_MESHES = {
    "crowded.obj": (
        FIVE + "f 1 2 3\nf 2 1 4\nf 1 2 5\n",
        8,
        "edge 1-2: expected at most two faces, found the faces of lines 6, 7, 8",
    ),
    "turned.obj": (
        FIVE + "\nf 1 2 3\nf 1 2 4\n",
        8,
        "edge 1-2: expected faces that run along it in opposite directions, found the faces of "
        "lines 7, 8",
    ),
    "fans.obj": (
        FIVE + "f 1 2 3\nf 1 4 5\n",
        6,
        "vertex 1: expected one fan of faces, found that face apart from the others",
    ),
    "crowded.bv": (
        "1 5 3\n0 0 0 1 0 0\n0 1 0 0 0 1\n0 -1 0\n3 0 1 2\n3 1 0 3 3 0 1\n4\n",
        6,
        "edge 0-1: expected at most two faces, found the faces of lines 5, 6",
    ),
}


@pytest.mark.parametrize("name", BAD_MESHES)
def test_a_mesh_that_is_no_surface(
    tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text, line, words = BAD_MESHES[name]
    path = written(tmp_path, text, name)
    assert len(nets_of(open_subject(str(path)).assigned(["smooth=off"]))) >= 2
    for arguments in ([str(path), "--set", "smooth=on"], ["fig9", "--set", f"mesh={path}"]):
        assert main(["joins", *arguments]) == FileFormatError.exit_code
        assert capsys.readouterr().err == f"reparam: {path}:{line}: {words}\n"


def test_fig9_of_a_file(tmp_path: Path) -> None:
    path = written(tmp_path, CUBE)
    subject = open_subject("fig9").assigned([f"mesh={path}", "step=all", "creases=[[0,1,0.1]]"])
    built_in = open_subject("fig9").assigned(["step=all", "creases=[[0,1,0.1]]"])
    assert len(subject.figure().spaces) == len(built_in.figure().spaces) == 8
    assert subject.figure().caption[0] == built_in.figure().caption[0]
    path.write_text(CUBE + "f 1 2 3\n")
    os.utime(path, (1, 1))
    with pytest.raises(FileFormatError, match="at most two faces"):
        subject.changed("step", "mesh").figure()  # it is read again
    with pytest.raises(UsageError, match=r"mesh: expected cube, .* or a file .*, found 'cub'"):
        open_subject("fig9").assigned(["mesh=cub"]).figure()
    with pytest.raises(FileFormatError, match="found no file"):
        open_subject("fig9").assigned(["mesh=none.obj"]).figure()


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "expected a face, found none"),
        ("v 0 0 0\n\n# no more", 1, "expected a face, found none"),
        ("v 0 0\n", 1, "expected v and 3 numbers, found '0 0'"),
        ("v 0 0 x\n", 1, "expected v and 3 numbers"),
        ("v 0 nan 0\n", 1, "expected numbers of size up to 1e.18, found nan"),
        ("v 0 0 1e30\n", 1, "found 1e.30"),
        ("v 0 0 0\nf 1 1\n", 2, "expected f and 3 to 10000 corners, found 2"),
        ("v 0 0 0\nv 1 0 0\nf 1 2 3\n", 3, "one of the 2 vertices above, found '3'"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", 4, "found '0'"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", 4, "found '-4'"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 a/b\n", 4, "found 'a/b'"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n2\n", 4, "expected different corners"),
    ],
)
def test_bad_files(tmp_path: Path, text: str, line: int, words: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(FileFormatError, match=f"mesh.obj:{line}: .*{words}"):
        read_obj(path)


def test_what_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"expected a readable \.obj file, found no file"):
        read_obj(tmp_path / "none.obj")


def test_polyhedra_of_one_bv_file_are_one(tmp_path: Path) -> None:
    tetrahedron = "1 4 4 2 0 0 3 0 0 2 1 0 2 0 1  3 0 2 1 3 0 1 3 3 0 3 2 3 1 2 3\n"
    found = read_bv(written(tmp_path, BV_CUBE + tetrahedron, "two.bv"))
    assert found.polyhedron is not None
    assert len(found.polyhedron.vertices) == 12
    assert found.polyhedron.faces[6] == [8, 10, 9]
    assert len(found.nets) == 10


def test_edges_in_the_colours_of_their_joins(tmp_path: Path) -> None:
    subject = open_subject(str(written(tmp_path, CUBE))).assigned(["joins=1"])
    expected = {"off": ["kink 12"], "on": ["G1 96", "G2 96"]}
    for smooth, words in expected.items():
        figure = subject.changed("smooth", smooth).figure()
        strip, body = figure.spaces
        assert [layer.text for layer in strip.layers if isinstance(layer, Label)] == words
        lines = [layer for layer in body.layers if isinstance(layer, Polylines)]
        assert sum(len(layer.points) for layer in lines[-len(words) :]) == int(words[0][-2:]) * len(
            words
        )
