"""Exported files hold what is seen: read back, closed, of the right size and the right way out."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from reparam.cli import main
from reparam.errors import UsageError
from reparam.exporting import export, parts_of
from reparam.files.bv import read_bv
from reparam.files.obj import read_obj
from reparam.geometry.mesh import mesh
from reparam.geometry.net import lower_degree, raise_degree
from reparam.geometry.patch_joins import joins
from reparam.geometry.tessellate import tessellate, tessellate_trimmed, welded
from reparam.scenes.layers import Patches
from reparam.subject import open_subject

VOLUME = 4.994457582  # of the rounded cube at ratio 1/2
SUBJECT = ["fig9", "--set", "mesh=cube"]


def exported(folder: Path, name: str, *words: str) -> Path:
    path = folder / name
    assert main(["export", *SUBJECT, "-o", str(path), *words]) == 0
    return path


def volume(corners: np.ndarray) -> float:
    """Of a closed body, from its triangles (T, 3, 3)."""
    a, b, c = corners.swapaxes(0, 1).astype(np.float64)
    return float((a * np.cross(b, c)).sum() / 6.0)


def test_bv_holds_the_patches_in_their_own_degrees(tmp_path: Path) -> None:
    path = exported(tmp_path, "cube.bv")
    words = path.read_text().split()
    assert words.count("Group") == 2
    found = read_bv(path)
    assert found.names == ("around_triangles", "regular")
    assert len(found.nets) == 96
    report = joins(found.nets, highest=1)
    assert len(report.patches) == 192
    assert report.angles.max() <= 1e-8
    assert report.gaps.max() <= 1e-15
    lines = path.read_text().splitlines()
    assert (lines.count("2"), lines.count("3")) == (72, 24)


def test_rational_patches_stay_what_they_are(tmp_path: Path) -> None:
    path = tmp_path / "ring.bv"
    assert main(["export", "fig7", "-o", str(path)]) == 0
    nets = np.concatenate([part.nets for part in parts_of(open_subject("fig7").figure())])
    assert (read_bv(path).nets == nets).all()


def test_obj_is_a_closed_mesh_with_normals_and_maps(tmp_path: Path) -> None:
    path = exported(tmp_path, "cube.obj", "--level", "4")
    found = read_obj(path)
    assert found.polyhedron is not None
    closed = mesh(found.polyhedron.vertices, found.polyhedron.faces)
    assert not closed.topology.on_boundary.any()
    assert closed.topology.euler_characteristic() == 2
    assert len(closed.topology.sizes) == 96 * 16
    text = path.read_text()
    assert text.count("\nvn ") == text.count("\nvt ") == 96 * 25
    assert volume(tessellated(16)) == pytest.approx(VOLUME, abs=4e-3)


def tessellated(level: int) -> np.ndarray:
    parts = parts_of(open_subject("fig9").figure())
    meshes = [tessellate(part.nets, level) for part in parts]
    return np.concatenate([m.points[m.triangles()] for m in meshes])


def test_stl(tmp_path: Path) -> None:
    data = exported(tmp_path, "cube.stl", "--level", "8").read_bytes()
    (count,) = struct.unpack("<I", data[80:84])
    assert count == 96 * 64 * 2
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    triangles = np.frombuffer(data, record, offset=84)
    assert len(triangles) == count
    assert volume(triangles["corners"]) == pytest.approx(VOLUME, abs=2e-2)
    middles = triangles["corners"].mean(1)
    assert ((triangles["normal"] * middles).sum(-1) > 0.0).all()


def test_ply(tmp_path: Path) -> None:
    data = exported(tmp_path, "cube.ply", "--level", "3").read_bytes()
    head, body = data.split(b"end_header\n", 1)
    vertices = int(head.split(b"element vertex ")[1].split()[0])
    faces = int(head.split(b"element face ")[1].split()[0])
    assert (vertices, faces) == (96 * 16, 96 * 18)
    table = np.frombuffer(body, "<f4", vertices * 8).reshape(-1, 8)
    assert np.abs(np.linalg.norm(table[:, 3:6], axis=-1) - 1.0).max() < 1e-6
    record = np.dtype([("size", "u1"), ("corners", "<i4", 3)])
    triangles = np.frombuffer(body, record, offset=vertices * 32)
    assert len(triangles) == faces
    assert (triangles["size"] == 3).all()
    assert volume(table[triangles["corners"], :3]) == pytest.approx(VOLUME, abs=0.1)


def test_glb(tmp_path: Path) -> None:
    data = exported(tmp_path, "cube.glb", "--level", "3").read_bytes()
    magic, version, size = struct.unpack("<4sII", data[:12])
    assert (magic, version, size) == (b"glTF", 2, len(data))
    length, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    document = json.loads(data[20 : 20 + length])
    binary = data[20 + length + 8 :]
    assert len(binary) == document["buffers"][0]["byteLength"]

    def values(number: int) -> np.ndarray:
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        dtype = {5125: "<u4", 5126: "<f4"}[accessor["componentType"]]
        count = accessor["count"] * width
        found = np.frombuffer(binary, dtype, count, view["byteOffset"])
        return found.reshape(-1, width)

    total = 0.0
    for primitive in document["meshes"][0]["primitives"]:
        points = values(primitive["attributes"]["POSITION"])
        assert len(values(primitive["attributes"]["TEXCOORD_0"])) == len(points)
        triangles = values(primitive["indices"]).reshape(-1, 3)
        total += volume(points[triangles])
        material = document["materials"][primitive["material"]]
        assert material["pbrMetallicRoughness"]["baseColorTexture"]["index"] in (0, 1)
    assert total == pytest.approx(VOLUME, abs=0.1)
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    picture = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
    with Image.open(io.BytesIO(picture)) as image:
        assert image.format == "PNG"


def test_poles_make_triangles_and_places_are_shared() -> None:
    net = np.array([[[0, 0, 1, 1], [0, 0, 1, 1]], [[1, 0, 0, 1], [0, 1, 0, 1]]], float)
    found = tessellate(net[None], 2)
    assert len(found.triangles()) == 2 * 4 - 2
    assert len(np.unique(found.places)) == 7
    points = np.array([[0.5, 1 / 3, 0], [1, 1, 1], [0.5, 1 / 3 + 1e-16, 0], [0, 0, 0]])
    assert welded(points).tolist() == [0, 1, 0, 2]
    with pytest.raises(ValueError, match=r"expected at most .* vertices, found"):
        tessellate(np.broadcast_to(net, (1000, 2, 2, 4)), 1024)


@pytest.mark.parametrize("degrees", [(2, 2), (1, 3), (3, 5), (4, 4)])
def test_degrees_are_lowered_to_what_they_were(degrees: tuple[int, int]) -> None:
    random = np.random.default_rng(degrees)
    net = random.normal(size=(degrees[0] + 1, degrees[1] + 1, 4))
    for more in ((0, 0), (1, 0), (1, 2)):
        raised = raise_degree(net, degrees[0] + more[0], degrees[1] + more[1])
        lowered = lower_degree(raised)
        assert lowered.shape == net.shape
        assert np.abs(lowered - net).max() <= 1e-12
        assert (lower_degree(raised[::-1])[::-1] == lowered).all()


@pytest.mark.parametrize(
    ("name", "code", "words"),
    [
        ("cube.fbx", 2, "expected a name ending in .bv or .obj or .stl or .ply or .glb, found"),
        ("none/cube.obj", 1, "expected an existing folder"),
    ],
)
def test_bad_names(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, code: int, words: str
) -> None:
    assert main(["export", *SUBJECT, "-o", str(tmp_path / name)]) == code
    assert words in capsys.readouterr().err


def test_levels_are_checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", *SUBJECT, "-o", str(tmp_path / "a.stl"), "--level", "0"]) == 2
    assert "level: expected a whole number from 1 to 1024, found '0'" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["trimmed", "redbook-trim"])
def test_a_trimmed_surface_is_exported_trimmed(name: str, tmp_path: Path) -> None:
    figure = open_subject(name).figure()
    layer = next(x for x in figure.spaces[-1].layers if isinstance(x, Patches))
    parts = parts_of(figure)
    assert layer.trim is not None
    mesh = tessellate_trimmed(parts[0].nets, parts[0].domains, layer.trim, 24)
    whole = tessellate(parts[0].nets, 24)
    a, b, c = np.moveaxis(mesh.points[mesh.triangles()], 1, 0)
    p, q, r = np.moveaxis(whole.points[whole.triangles()], 1, 0)
    areas = [np.linalg.norm(np.cross(y - x, z - x), axis=-1).sum() / 2 for x, y, z in
             ((a, b, c), (p, q, r))]  # fmt: skip
    assert 0.3 < areas[0] / areas[1] < 0.98
    up = (np.cross(b - a, c - a) * mesh.normals[mesh.triangles()].mean(1)).sum(-1)
    assert (up > -1e-12).all()
    path = tmp_path / "trimmed.obj"
    export(open_subject(name).changed("level", 8), path)
    assert path.read_text().count("\nf ") > 100
    with pytest.raises(UsageError, match="no trims"):
        export(open_subject(name), tmp_path / "trimmed.bv")
