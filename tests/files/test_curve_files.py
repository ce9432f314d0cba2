"""Curves from tables of control points, and what is said of those that are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reparam.errors import FileFormatError
from reparam.files.curve import read_curve
from reparam.geometry.nurbs import clamped_knots, evaluate_curve
from reparam.geometry.paths import Path as CurvePath

POINTS = [[0, 0, 0], [1, 2, 0], [2, -1, 1], [3, 0, 0], [4, 4, 4], [5, 1, 0]]
TABLE = "\n".join(" ".join(map(str, row)) for row in POINTS)


def read(folder: Path, text: str | bytes) -> CurvePath:
    file = folder / "curve.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_curve(file)


def test_one_bezier_curve(tmp_path: Path) -> None:
    path = read(tmp_path, "\ufeff# made by hand\r\n0, 0\r\n\r\n1;2 # the top\r\n2\t0\r\n")
    assert path.nets.shape == (1, 3, 4)
    assert path.points([0.5]).tolist() == [[1.0, 1.0, 0.0]]
    assert path.parameters([0.25]).tolist() == [0.25]


def test_a_header_and_weights(tmp_path: Path) -> None:
    path = read(tmp_path, "weight, y, x\n1, 0, 1\n.7071067811865476, 1, 1\n1, 1, 0\n")
    at = path.points(np.linspace(0.0, 1.0, 9))
    assert np.abs(np.linalg.norm(at, axis=-1) - 1.0).max() < 1e-15
    assert abs(path.arc.length - np.pi / 2.0) < 1e-14


@pytest.mark.parametrize("knots", [None, [0, 0, 0, 0, 0.3, 2, 3, 3, 3, 3]])
def test_splines(tmp_path: Path, knots: list[float] | None) -> None:
    line = "knots " + " ".join(map(str, knots)) if knots else ""
    path = read(tmp_path, f"degree 3\n{line}\n{TABLE}")
    own = np.array(knots, float) if knots else clamped_knots(6, 4)
    u = np.linspace(0.0, len(path.nets), 31)[:-1]
    expected = evaluate_curve(own, np.array(POINTS, float), 4, path.parameters(u))
    assert np.abs(path.points(u) - expected).max() < 1e-14
    again = read(tmp_path, f"{line or 'degree 3'}\n{TABLE}")  # the knots alone tell the degree
    assert np.array_equal(again.nets, path.nets)


def test_tangents_go_where_the_path_goes(tmp_path: Path) -> None:
    cusp = read(tmp_path, "0 0\n1 1\n0 1\n1 0")
    tangents = cusp.tangents([0.0, 0.5, 1.0])
    assert np.abs(np.linalg.norm(tangents, axis=-1) - 1.0).max() < 1e-12
    assert np.abs(tangents[1] - [0.0, -1.0, 0.0]).max() < 1e-6
    rest = read(tmp_path, "0 0\n0 0\n1 1\n1 1")
    assert np.abs(rest.tangents([0.0, 1.0]) - np.sqrt(0.5) * np.array([1, 1, 0])).max() < 1e-6


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "expected two control points or more, found 0"),
        ("0 0\n", "expected two control points or more, found 1"),
        ("0 0\n1 one\n", ":2: expected a number, found 'one'"),
        ("0 0\n1 nan\n", ":2: expected a number, found 'nan'"),
        ("0 0\n1 2 3\n", ":2: expected 2 numbers, found 3"),
        ("0\n1\n", ":1: expected 2, 3 or 4 numbers, found 1"),
        ("x q\n0 0\n1 1\n", ":1: expected degree, knots, or columns"),
        ("x x\n0 0\n1 1\n", ":1: expected degree, knots, or columns"),
        ("degree 0\n0 0\n1 1\n", ":1: expected degree 1 to 31, found 'degree 0'"),
        ("degree three\n", ":1: expected degree 1 to 31"),
        ("degree " + "9" * 5000, ":1: expected degree 1 to 31"),
        ("degree 3\n0 0\n1 1\n", "expected"),
        ("degree 1\nknots 0 1 0 1\n0 0\n1 1\n", "knots: expected"),
        ("knots 0 1\n0 0\n1 1\n", "expected"),
        ("1 1\n1 1\n", "expected a curve of some length, found a point"),
        ("x y w\n0 0 1\n1 1 0\n2 2 1", "expected positive weights, found 0"),
        ("x y w\n0 0 1\n1 1 -2\n2 2 1", "expected positive weights, found -2"),
        ("0 0\n" * 40, "expected at most 32 points of one Bézier curve, found 40"),
        ("0 1e30\n1 1", "expected a coordinate"),
        (b"\xff\xfe\x00", "expected text, found other bytes"),
    ],
)
def test_what_is_no_curve(tmp_path: Path, text: str | bytes, complaint: str) -> None:
    with pytest.raises(FileFormatError) as refused:
        read(tmp_path, text)
    assert str(refused.value).startswith(str(tmp_path / "curve.csv"))
    assert complaint in str(refused.value)
    assert "\n" not in str(refused.value)


def test_no_file(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.csv"):
        with pytest.raises(FileFormatError, match="expected a file of control points, found none"):
            read_curve(path)
