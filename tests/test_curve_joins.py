"""`reparam joins` with curves: the pieces of a spline, and one curve after another."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from reparam.cli import main

SPLINE = "degree 3\nknots 0 0 0 0 1 2.5 2.5 3 4 4 4 4\n0 0\n1 2\n2 2\n3 0\n4 -1\n5 0\n6 1\n7 3\n"
FIRST = "0,0\n1,1\n2,1\n"
CURVES = {
    "bend": "x,y,w\n2,1,1\n4,1,1\n5,0,2\n",
    "stops": "2,1\n2,1\n5,1\n",
    "back": "2,1\n1,1\n",
    "corner": "2,1\n2,5\n",
    "apart": "3,1\n5,1\n",
    "spatial": "2,1,0\n3,1,0\n4,1,1\n",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "spline.csv").write_text(SPLINE)
    (tmp_path / "first.csv").write_text(FIRST)
    for name, text in CURVES.items():
        (tmp_path / f"{name}.txt").write_text(text)
    return tmp_path


def asked(capsys: pytest.CaptureFixture[str], *words: str | Path) -> str:
    assert main(["joins", *map(str, words)]) == 0
    return capsys.readouterr().out


def test_a_spline_has_as_many_derivatives_as_its_knots_leave(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Cubic: 2 at a knot, 1 at one that stands twice; in the file's own parameters r' = 1."""
    rows = json.loads(asked(capsys, folder / "spline.csv", "--json"))
    assert [row["at"] for row in rows] == [1.0, 2.5, 3.0]
    assert [row["parametric"] for row in rows] == [2, 1, 2]
    assert [row["order"] for row in rows] == [2, 1, 2]
    assert rows[0]["r"] == pytest.approx([1.0, 0.0], abs=1e-12)
    text = asked(capsys, folder / "spline.csv").splitlines()
    assert text[0].endswith("spline.csv: 3 joints, looked at up to order 5")
    assert text[4].split()[:4] == ["2.5", "1", "1", "1"]


def test_a_closed_curve_joins_its_own_start(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "loop.txt").write_text("0 0\n1 0\n1 1\n-1 2\n-1 0\n0 0\n")
    (row,) = json.loads(asked(capsys, folder / "loop.txt", "--json"))
    assert (row["at"], row["point"], row["order"]) == (1.0, [0.0, 0.0, 0.0], 1)


@pytest.mark.parametrize(
    ("name", "order", "turn", "reason"),
    [
        ("bend", 1, 0.0, "order 2 fails"),
        ("stops", 1, 0.0, "order 2 of the image fails"),
        ("back", 0, 180.0, "the tangents are opposed: a cusp"),
        ("corner", 0, 90.0, "the direction turns by 90 degrees"),
        ("apart", -1, 0.0, "the ends are 1 apart"),
        ("spatial", 1, 0.0, "order 2 fails"),
    ],
)
def test_two_curves(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    name: str,
    order: int,
    turn: float,
    reason: str,
) -> None:
    files = folder / "first.csv", folder / f"{name}.txt"
    (row,) = json.loads(asked(capsys, *files, "--json"))
    assert (row["order"], row["turn"]) == (order, pytest.approx(turn, abs=1e-9))
    assert row["reason"].startswith(reason)
    assert reason in asked(capsys, *files)


def test_bad_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["none.csv"], ["fig9", str(folder / "first.csv")]):
        assert main(["joins", *words]) == 3
        assert capsys.readouterr().err == (
            f"reparam: {words[0]}: expected a file of control points, found none\n"
        )
