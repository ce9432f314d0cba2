"""Writing what is seen for other programs: patches as .bv, triangles as .obj, .stl, .ply and .glb.

.bv    the patches themselves, 17 digits: nothing is lost
.obj   quads with normals and (s,t); vertices that lie at one place are one
.ply   the same with triangles, binary
.stl   triangles alone, binary
.glb   glTF 2.0: triangles, normals, (s,t), colour and the picture that is attached
"""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReparamError
from ..geometry.net import Array, lower_degree
from ..geometry.tessellate import Triangles, tessellate, tessellate_trimmed, welded
from ..geometry.trimming import TrimRegion
from .picture import find_picture, png_bytes, read_picture

Color = tuple[float, float, float]
TRIMMED = ".obj, .stl, .ply or .glb"


@dataclass(frozen=True)
class Attached:
    """A picture and where it lies: (s, t) * scale + offset, the whole picture being [0,1]^2."""

    source: str
    scale: float
    offset: float
    mirrored: bool


@dataclass(frozen=True, eq=False)
class Part:
    """Patches (P, m, n, 4) of one colour, with their texture nets and picture if they have one."""

    name: str
    nets: Array
    color: Color
    maps: Array | None = None
    picture: Attached | None = None
    trim: TrimRegion | None = None
    domains: Array | None = None  # (P, 4) in the trim region's domain


def write_model(parts: Sequence[Part], path: Path, level: int) -> None:
    """Write by the ending of the path; what stood there stays until the new file is whole.

    Raises ReparamError where that cannot be, ValueError for an ending that is not known or more
    vertices than `tessellate` makes.
    """
    data = WRITERS[ending(path)](parts, level)
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_bytes(data)
        os.replace(part, path)
    except OSError as error:
        with suppress(OSError):
            part.unlink()
        raise ReparamError(f"{path}: could not be written: {error.strerror or error}") from error


def ending(path: Path) -> str:
    """The ending, in small letters. Raises ValueError for one that is not written."""
    found = path.suffix.lower()
    if found not in WRITERS:
        raise ValueError(f"expected a name ending in {', '.join(WRITERS)}, found {str(path)!r}")
    return found


# Patches ------------------------------------------------------------------------------------


def bv_bytes(parts: Sequence[Part], level: int) -> bytes:  # noqa: ARG001
    """Each patch in its own lowest degree; a group for each part."""
    if any(part.trim is not None for part in parts):
        raise ValueError(f"expected {TRIMMED} for a trimmed surface, found .bv, which has no trims")
    lines = []
    for number, part in enumerate(parts):
        lines.append(f"Group {number} {part.name.replace(' ', '_')}")
        for net in part.nets:
            lines += _bv_patch(lower_degree(net))
    return ("\n".join(lines) + "\n").encode()


def _bv_patch(net: Array) -> list[str]:
    m, n = net.shape[0] - 1, net.shape[1] - 1
    rational = bool((net[..., 3] != 1.0).any())
    header = f"8\n{m} {n}" if rational else f"4\n{m}" if m == n else f"5\n{m} {n}"
    points = net.reshape(-1, 4)[:, : 4 if rational else 3]
    return [header, *(" ".join(f"{x:.17g}" for x in point) for point in points.tolist())]


# Triangles ----------------------------------------------------------------------------------


def _tessellated(parts: Sequence[Part], level: int) -> list[Triangles]:
    return [_triangles(part, level) for part in parts]


def _triangles(part: Part, level: int) -> Triangles:
    if part.trim is None or part.domains is None:
        return tessellate(part.nets, level, part.maps)
    return tessellate_trimmed(part.nets, part.domains, part.trim, level, part.maps)


def obj_bytes(parts: Sequence[Part], level: int) -> bytes:
    """Quads; where a side has no length, triangles."""
    meshes = _tessellated(parts, level)
    places = welded(np.concatenate([mesh.points for mesh in meshes]))
    _, first = np.unique(places, return_index=True)
    points = np.concatenate([mesh.points for mesh in meshes])[first]
    lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in points.tolist()]
    start = 0
    for part, mesh in zip(parts, meshes, strict=True):
        here = places[start : start + len(mesh.points)] + 1
        lines.append(f"o {part.name.replace(' ', '_')}")
        lines += [f"vn {x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh.normals.tolist()]
        if mesh.maps is not None:
            lines += [f"vt {s:.9g} {t:.9g}" for s, t in mesh.maps.tolist()]
        for quad in mesh.quads.tolist():
            corners = list(dict.fromkeys(int(here[k]) for k in quad))
            if len(corners) >= 3:
                lines.append("f " + " ".join(_obj_corners(quad, here, start, mesh)))
        start += len(mesh.points)
    return ("\n".join(lines) + "\n").encode()


def _obj_corners(
    quad: list[int], places: NDArray[np.intp], start: int, mesh: Triangles
) -> list[str]:
    """place/map/normal of the corners, one for each place."""
    words: dict[int, str] = {}
    for k in quad:
        map_number = "" if mesh.maps is None else str(k + 1)
        words.setdefault(int(places[k]), f"{places[k]}/{map_number}/{start + k + 1}")
    return list(words.values())


def stl_bytes(parts: Sequence[Part], level: int) -> bytes:
    """Binary: a head of 80 bytes, the count, then normal and corners of each triangle."""
    corners = [mesh.points[mesh.triangles()] for mesh in _tessellated(parts, level)]
    triangles = np.concatenate(corners)
    record = np.zeros(
        len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("", "<u2")]
    )
    a, b, c = triangles.swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    record["normal"] = normal / np.where(length > 0.0, length, 1.0)
    record["corners"] = triangles
    return b"reparam".ljust(80) + struct.pack("<I", len(triangles)) + record.tobytes()


def ply_bytes(parts: Sequence[Part], level: int) -> bytes:
    """Binary, little-endian; (s, t) is 0 where nothing is attached."""
    meshes = _tessellated(parts, level)
    vertices, faces, start = [], [], 0
    for mesh in meshes:
        maps = np.zeros((len(mesh.points), 2)) if mesh.maps is None else mesh.maps
        vertices.append(np.concatenate([mesh.points, mesh.normals, maps], -1))
        faces.append(mesh.triangles() + start)
        start += len(mesh.points)
    triangles = np.concatenate(faces)
    record = np.zeros(len(triangles), [("size", "u1"), ("corners", "<i4", 3)])
    record["size"], record["corners"] = 3, triangles
    properties = "".join(
        f"property float {name}\n" for name in ["x", "y", "z", "nx", "ny", "nz", "s", "t"]
    )
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {start}\n{properties}"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return head.encode() + np.concatenate(vertices).astype("<f4").tobytes() + record.tobytes()


# glTF ---------------------------------------------------------------------------------------

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
FLOAT, UNSIGNED_INT = 5126, 5125
REPEAT, MIRRORED_REPEAT = 10497, 33648
UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # z up here, y up in glTF: a quarter turn about x
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}


class _Glb:
    """A glTF document and its one binary chunk, growing together."""

    def __init__(self) -> None:
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "reparam"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "rotation": UPRIGHT}],
            "meshes": [{"primitives": []}],
        }
        self.binary = b""

    def add(self, list_name: str, item: dict[str, Any]) -> int:
        """The item's index in a list of the document."""
        items = self.document.setdefault(list_name, [])
        items.append(item)
        return len(items) - 1

    def view(self, data: bytes, **properties: int) -> int:
        """A buffer view of these bytes, aligned."""
        offset = len(self.binary)
        self.binary += data + b"\0" * (-len(data) % 4)
        view = {"buffer": 0, "byteOffset": offset, "byteLength": len(data), **properties}
        return self.add("bufferViews", view)

    def accessor(self, values: NDArray[Any], target: int) -> int:
        """An accessor of float32 or uint32 values."""
        kind = UNSIGNED_INT if target == ELEMENT_ARRAY_BUFFER else FLOAT
        item = {
            "bufferView": self.view(values.tobytes(), target=target),
            "componentType": kind,
            "count": len(values),
            "type": TYPES[values.shape[1] if values.ndim == 2 else 1],
        }
        if values.ndim == 2:
            item |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        return self.add("accessors", item)

    def bytes(self) -> bytes:
        """The file."""
        self.document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(self.binary)
        head = b"glTF" + struct.pack("<II", 2, size)
        chunks = (b"JSON", text), (b"BIN\0", self.binary)
        return head + b"".join(struct.pack("<I", len(data)) + name + data for name, data in chunks)


def glb_bytes(parts: Sequence[Part], level: int) -> bytes:
    """A primitive and a material for each part."""
    glb = _Glb()
    for part, mesh in zip(parts, _tessellated(parts, level), strict=True):
        attributes = {
            "POSITION": glb.accessor(mesh.points.astype("<f4"), ARRAY_BUFFER),
            "NORMAL": glb.accessor(mesh.normals.astype("<f4"), ARRAY_BUFFER),
        }
        if mesh.maps is not None and part.picture is not None:
            at = mesh.maps * part.picture.scale + part.picture.offset
            at[:, 1] = 1.0 - at[:, 1]  # glTF counts pictures from the top
            attributes["TEXCOORD_0"] = glb.accessor(at.astype("<f4"), ARRAY_BUFFER)
        indices = mesh.triangles().astype("<u4").ravel()
        primitive = {
            "attributes": attributes,
            "indices": glb.accessor(indices, ELEMENT_ARRAY_BUFFER),
            "material": _material(glb, part),
        }
        glb.document["meshes"][0]["primitives"].append(primitive)
    return glb.bytes()


def _material(glb: _Glb, part: Part) -> int:
    linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04045 else c / 12.92 for c in part.color]
    surface: dict[str, Any] = {
        "baseColorFactor": [*linear, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.6,
    }  # fmt: skip
    if part.picture is not None:
        data = png_bytes(read_picture(find_picture(part.picture.source)))
        image = glb.add("images", {"bufferView": glb.view(data), "mimeType": "image/png"})
        wrap = MIRRORED_REPEAT if part.picture.mirrored else REPEAT
        sampler = glb.add("samplers", {"wrapS": wrap, "wrapT": wrap})
        texture = glb.add("textures", {"source": image, "sampler": sampler})
        surface["baseColorTexture"] = {"index": texture}
    material = {"name": part.name, "pbrMetallicRoughness": surface, "doubleSided": True}
    return glb.add("materials", material)


WRITERS: dict[str, Callable[[Sequence[Part], int], bytes]] = {
    ".bv": bv_bytes,
    ".obj": obj_bytes,
    ".stl": stl_bytes,
    ".ply": ply_bytes,
    ".glb": glb_bytes,
}
