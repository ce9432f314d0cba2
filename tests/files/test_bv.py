"""Reading .bv: every kind, every freedom of the format, every way to be wrong."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

from reparam.errors import FileFormatError
from reparam.files import tokens
from reparam.files.bv import read_bv
from reparam.geometry.body import SQUARE_DOMAIN, TRIANGLE_DOMAIN, Body
from reparam.geometry.evaluate import evaluate, project

BILINEAR = "4 1\n0 0 0\n0 1 0\n1 0 0\n1 1 5\n"
CUBE = """1
8 6
0 0 0  1 0 0  1 1 0  0 1 0
0 0 1  1 0 1  1 1 1  0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


def read(folder: Path, text: str | bytes) -> Body:
    file = folder / "test.bv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_bv(file)


def point_list(count: int) -> str:
    return " ".join(f"{i} {i * i} {-i}" for i in range(count))


def test_tensor_rows_go_with_u(tmp_path: Path) -> None:
    result = read(tmp_path, f"5 1 3\n{point_list(8)}")
    assert result.nets.shape == (1, 4, 4, 4)
    ends = result.nets[0][[0, -1]]
    assert ends[..., 0].tolist() == [[0, 1, 2, 3], [4, 5, 6, 7]]
    assert ends[1, 2].tolist() == [6, 36, -6, 1]
    assert (result.domains == SQUARE_DOMAIN).all()


def test_equal_degrees(tmp_path: Path) -> None:
    result = read(tmp_path, BILINEAR)
    assert result.nets[0, ..., 0].tolist() == [[0, 0], [1, 1]]
    assert result.nets[0, ..., 1].tolist() == [[0, 1], [0, 1]]
    assert result.nets[0, 1, 1].tolist() == [1, 1, 5, 1]


def test_triangle(tmp_path: Path) -> None:
    result = read(tmp_path, f"3 3 {point_list(10)}")
    net = result.nets[0, ..., 0]
    assert net[0].tolist() == [0] * 4
    assert net[:, 0].tolist() == [0, 1, 2, 3]
    assert net[:, 3].tolist() == [0, 4, 7, 9]
    assert (result.domains == TRIANGLE_DOMAIN).all()


def test_cube_is_closed_and_looks_outwards(tmp_path: Path) -> None:
    nets = read(tmp_path, CUBE).nets[..., :3]
    assert nets.shape == (6, 2, 2, 3)
    normals = np.cross(nets[:, 1, 0] - nets[:, 0, 0], nets[:, 0, 1] - nets[:, 0, 0])
    assert ((normals * (nets[:, 0, 0] - 0.5)).sum(-1) > 0.0).all()


def test_concave_face(tmp_path: Path) -> None:
    result = read(tmp_path, "1 6 1  0 0 0 3 0 0 3 1 0 1 1 0 1 3 0 0 3 0  6 0 1 2 3 4 5")
    a, b, c = np.moveaxis(result.nets[:, [0, 1, 1], [0, 0, 1], :3], 1, 0)
    assert len(result.nets) == 4
    assert np.cross(b - a, c - a).sum(0) == pytest.approx([0.0, 0.0, 10.0])


def test_rational_is_premultiplied(tmp_path: Path) -> None:
    """An eighth of the torus R = 2, r = 1: a quarter circle swept along an eighth turn."""
    w, h = 1.0 / sqrt(2.0), np.cos(np.pi / 8.0)
    turn = [(1.0, 0.0, 1.0), (h, np.sin(np.pi / 8.0), h), (sqrt(0.5), sqrt(0.5), 1.0)]
    tube = [(3.0, 0.0, 1.0), (3.0 * w, w, w), (2.0, 1.0, 1.0)]
    rows = [f"{x * r} {y * r} {z * c} {c * s}" for x, y, c in turn for r, z, s in tube]
    result = read(tmp_path, "8\n2 2\n" + "\n".join(rows))
    u, v = np.meshgrid(np.linspace(0, 1, 7), np.linspace(0, 1, 7))
    x, y, z = np.moveaxis(project(evaluate(result.nets[0], u, v)), -1, 0)
    np.testing.assert_allclose((np.hypot(x, y) - 2.0) ** 2 + z**2, 1.0, atol=1e-14)
    np.testing.assert_allclose(np.arctan2(y, x)[:, -1], np.pi / 4, atol=1e-14)


def test_zero_weight_inside_is_allowed(tmp_path: Path) -> None:
    half_circle = "8 0 2  1 0 0 1  0 1 0 0  -1 0 0 1"
    assert read(tmp_path, half_circle).nets.shape == (1, 3, 3, 4)


def test_groups_hold_and_come_back(tmp_path: Path) -> None:
    text = """PGroup 3 wing #4 and whatever 1 2 3\nPP group 12 tail\nP
        Group 0 empty\nGroup 3 wing\n3 0 7 7 7 Group 1 \u00fc_\nP"""
    result = read(tmp_path, text.replace("P", BILINEAR))
    assert result.names == ("", "wing", "tail", "\u00fc_")
    assert result.groups.tolist() == [0, 1, 1, 2, 1, 3]


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace(b"\n", b"\r\n"),
        lambda text: text.replace(b"\n", b"\r"),
        lambda text: b"\xef\xbb\xbf" + text,
        lambda text: b"\n\n" + text.rstrip(),
        lambda text: re.sub(rb"(?<=\d)\s+(?=[\dG])", b"\n\t ", text).replace(b"1\n\t g", b"1 g"),
        lambda text: re.sub(rb"(?<!g)\n", b" ", text),
        lambda text: re.sub(rb"\b(\d) (\d) 0\n", rb"\1.0e0 +\2. -0\n", text),
    ],
    ids=["CRLF", "CR", "BOM", "no end", "one word a line", "one line", "other numbers"],
)
def test_freedoms_of_the_format(tmp_path: Path, change: Callable[[bytes], bytes]) -> None:
    text = f"{BILINEAR}Group 1 g\n{BILINEAR}{CUBE}".encode()
    assert change(text) != text
    expected, found = read(tmp_path, text), read(tmp_path, change(text))
    assert (found.nets == expected.nets).all()
    assert (found.groups == expected.groups).all()
    assert found.names == ("", "g")


def test_lines_are_exact_across_chunks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    good = f"{BILINEAR}\n{CUBE}\nGroup 1 a\n{BILINEAR}"
    for chunk in [1, 2, 7, 30, 1000]:
        monkeypatch.setattr(tokens, "CHUNK", chunk)
        assert len(read(tmp_path, good).nets) == 8
        with pytest.raises(FileFormatError, match=r"bv:26: .* found '1_0'$"):
            read(tmp_path, good + BILINEAR.replace("1 0", "1_0"))


TRIANGLES = "1\n4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
WEIGHTS = "8 1 1\n0 0 0 1\n0 1 0 {}\n1 0 0\n1 1 1 0 1"
BAD = {
    "empty": ("", 1, "expected a patch, found the end of the file"),
    "blank": ("\n \n\n", 1, "expected a patch, found the end of the file"),
    "only groups": ("Group 1 a\nGroup 2 b\n", 2, "expected a patch, found the end of the file"),
    "no faces": ("1\n1 0\n0 0 0\n", 3, "expected a patch, found the end of the file"),
    "prose": ("Dear reader,\n", 1, "expected a number, found 'Dear'"),
    "long word": (f"4 {'x' * 99}", 1, f"found '{'x' * 37}...'"),
    "not a number": (f"{BILINEAR}4 1\n0 0 0\n0 1 O\n", 8, "expected a number, found 'O'"),
    "digits of others": ("4 0\n1 2 \u0663\n", 2, "expected a number, found '\\u0663'"),
    "nan": ("4 1\n0 0 0\n0 nan 0\n", 3, "expected a finite number, found 'nan'"),
    "infinity": ("4 1\n0 0 0\n-inf 0 0\n", 3, "expected a finite number, found '-inf'"),
    "overflow": ("4 0\n0 0 0\n4 0 1e999 0 0\n", 3, "expected a finite number, found '1e999'"),
    "1e38": ("4 0\n0 -1e38 0\n", 2, "expected a number of size up to 1e+18, found '-1e38'"),
    "trim curve": (f"{BILINEAR}\n6 1 2 3", 7, "kind 1, 3, 4, 5 or 8, found kind 6, trim curve"),
    "B-spline": ("7", 1, "found kind 7, B-spline"),
    "PN triangle": ("\n9\n1 1", 2, "found kind 9, triangle with normals"),
    "PN quad": ("10 1 1 1 1", 1, "found kind 10, tensor with normals"),
    "kind 2": ("2", 1, "kind 1, 3, 4, 5 or 8, found '2'"),
    "kind -1": ("-1", 1, "found '-1'"),
    "kind 4.5": (f"{BILINEAR}4.5", 6, "found '4.5'"),
    "one number too many": (f"{BILINEAR} 99 {BILINEAR}", 6, "found '99'"),
    "no degree": ("\n4\n", 2, "expected a degree, found the end of the file"),
    "degree -1": ("4\n-1\n0 0 0", 2, "expected a degree from 0 to 31, found '-1'"),
    "degree 32": ("3\n32\n", 2, "expected a degree from 0 to 31, found '32'"),
    "degree 1000": ("8 2\n1000\n0 0 0", 2, "expected a degree from 0 to 31, found '1000'"),
    "degree 1.5": ("5 1 1.5\n", 1, "expected a degree from 0 to 31, found '1.5'"),
    "degree 1e12": ("3 1e12", 1, "expected a degree from 0 to 31, found '1e12'"),
    "truncated": (f"{BILINEAR}5 1\n1\n0 0 0 1", 7, "12 numbers for 4 points, found 4"),
    "truncated rational": ("8 1 1 0 0 0 1", 1, "expected 16 numbers for 4 points, found 4"),
    "cut by a group": ("4 1\n1 2\nGroup 1 a\n1", 1, "expected 12 numbers for 4 points, found 2"),
    "cut at once": ("4 1\nGroup 1 a\n1", 2, "12 numbers for 4 points, found a group line"),
    "group alone": (f"{BILINEAR}Group\n", 6, "expected Group, a colour number and a name"),
    "group no name": ("group 3\n4 0 0 0 0", 1, "a colour number and a name, found 'group 3'"),
    "group no colour": ("Group red a\n", 1, "a colour number and a name, found 'Group red a'"),
    "group glued on": ("4 0\n0 0 0Group 1 a\n", 2, "expected a number, found '0Group'"),
    "not a group": ("Groups 1 a\n", 1, "expected a number, found 'Groups'"),
    "vertices 10^12": ("1\n1000000000000 1\n0 0 0\n", 2, "1000000000000 points, found 3"),
    "vertices -5": ("1 -5 1\n", 1, "expected a number of vertices of at least 1, found '-5'"),
    "faces 10^12": ("1 1\n1e12\n0 0 0\n", 2, "expected a number of faces from 0 to 524288"),
    "faces -1": ("1 1 -1\n", 1, "expected a number of faces from 0 to"),
    "face missing": (f"{TRIANGLES}3 0 1 2", 7, "a number of corners, found the end of the file"),
    "face cut": (f"{TRIANGLES}3 0 1 2\n4 0\n 1 2", 8, "expected 4 vertex indices, found 3"),
    "face of 2": (f"{TRIANGLES}3 0 1 2\n2 0 1", 8, "corners from 3 to 10000, found '2'"),
    "face of 10^12": (f"{TRIANGLES}1000000000000 0 1", 7, "corners from 3 to 10000, found"),
    "index too large": (f"{TRIANGLES}3 0 1\n4\n3 0 1 2", 8, "indices from 0 to 3, found '4'"),
    "index negative": (f"{TRIANGLES}3 0 1 -1", 7, "vertex indices from 0 to 3, found '-1'"),
    "index 1.5": (f"{TRIANGLES}3 0 1 1.5", 7, "vertex indices from 0 to 3, found '1.5'"),
    "repeated vertex": (f"{TRIANGLES}4 0 1 2\n1\n", 8, "4 different vertices of a face, found '1'"),
    "weight -1": (WEIGHTS.format("\n-1"), 4, "expected a weight of at least 0, found -1"),
    "weight 1e-30": (WEIGHTS.format("1e-30"), 3, "weight of 0 or at least 1e-18, found 1e-30"),
    "weight 0 at a corner": (WEIGHTS.format("0"), 3, "positive weight at the corner of the net"),
    "weight too small": ("8 0 0\n0 1e3 0\n1e-16", 3, "of size up to 1e+18, found 1e+19"),
    "NUL": (f"{BILINEAR}\0", 6, "expected text, found the byte 0x00"),
    "UTF-16": (BILINEAR.encode("utf-16"), 1, "expected text, found the byte 0x00"),
    "picture": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 2, "expected text, found the byte 0x1a"),
    "bytes": (b"4 0\r\n0 \xff\xfe 0", 2, "expected a number, found '\\ufffd\\ufffd'"),
    "too many points": ("4 31 " + "0 " * 3072 + "4 0 0 0 0 " * 9000, None, "control points, found"),
}


@pytest.mark.parametrize(("text", "line", "words"), BAD.values(), ids=BAD.keys())
def test_bad_input(tmp_path: Path, text: str | bytes, line: int | None, words: str) -> None:
    with pytest.raises(FileFormatError) as caught:
        read(tmp_path, text)
    message = str(caught.value)
    place = f"{tmp_path / 'test.bv'}:{line}: " if line else f"{tmp_path / 'test.bv'}: "
    assert message.startswith(f"{place}expected ")
    assert words in message
    assert len(message.splitlines()) == 1


def test_every_truncation_is_one_line_or_a_body(tmp_path: Path) -> None:
    text = f"{BILINEAR}Group 1 a\n8 1 0\n1 2 3 1\n4 5 6 1\n{CUBE}"
    refused = 0
    for end in range(len(text)):
        with suppress(FileFormatError):
            read(tmp_path, text[:end])
            continue
        refused += 1
        with pytest.raises(FileFormatError, match=r"\S+\.bv:\d+: expected .*, found .*$"):
            read(tmp_path, text[:end])
    assert refused > 0.8 * len(text)


def test_random_bytes_do_no_harm(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    letters = np.frombuffer(b"01345678 9.-e\n\n   Group", np.uint8)
    for _ in range(300):
        with pytest.raises(FileFormatError):
            read(tmp_path, random.choice(letters, 200).tobytes())


def test_files_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(FileFormatError, match=r"expected a readable \.bv file, found a directory"):
        read_bv(tmp_path)
    with pytest.raises(FileFormatError, match=r"expected a readable \.bv file, found no file"):
        read_bv(str(tmp_path / "none.bv"))
    with pytest.raises(FileFormatError, match="found a device"):
        read_bv("/dev/zero")

    def refuse(_: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(FileFormatError, match=r"readable \.bv file, found Permission denied"):
        read(tmp_path, BILINEAR)


def test_large_files_are_refused_unread(tmp_path: Path) -> None:
    file = tmp_path / "large.bv"
    with file.open("wb") as stream:
        stream.truncate(1 << 40)
    with pytest.raises(FileFormatError, match="expected at most 268435456 bytes, found 1099511"):
        read_bv(file)


def test_too_many_patches(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reparam.files.bv.MAX_PATCHES", 3)
    assert len(read(tmp_path, BILINEAR * 3).nets) == 3
    with pytest.raises(FileFormatError, match=r"bv:16: expected at most 3 patches, found more"):
        read(tmp_path, BILINEAR * 4)
    with pytest.raises(FileFormatError, match=r"bv:8: expected at most 3 triangles, found more"):
        read(tmp_path, TRIANGLES + "4 0 1 2 3\n4 0 1 2 3")
