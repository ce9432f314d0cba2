"""`reparam joins`: the table, the JSON, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from reparam.cli import main

MIXED = str(Path(__file__).parent / "data" / "mixed.bv")


def test_a_scene_as_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joins", "fig9", "--set", "mesh=tetrahedron"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "fig9: 48 patches, 96 joins, 0 free edges, 0 edges that are points"
    assert "largest gap 0.0e+00 of the size" in lines[1]
    assert lines[2] == (
        "at tolerance 1e-06: 0 of order 0, 48 of order 1, 48 of order 2, 0 of order 3"
    )
    assert len(lines) == 5 + 20 + 1
    assert lines[-1] == "  and 76 more; --all shows them"


def test_a_file_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joins", MIXED, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["patches"] == 16
    assert len(found["free_edges"]) + 2 * len(found["joins"]) + 7 >= 4 * 16
    creases = [row for row in found["joins"] if row["order"] == 0]
    assert len(creases) == 15
    assert {row["beta"] for row in creases} == {None}
    smooth = [row for row in found["joins"] if row["order"] == 3]
    assert len(smooth) == 5
    assert all(len(row["r"]) == 3 and row["beta"][0] > 0.0 for row in smooth)


def test_every_join_if_asked(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joins", "fig9", "--all", "--set", "mesh=tetrahedron"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 5 + 96


def test_a_single_patch_joins_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joins", "fig5"]) == 0
    assert "1 patches, 0 joins, 4 free edges" in capsys.readouterr().out


@pytest.mark.parametrize("tolerance", ["0", "-1", "nan", "2"])
def test_bad_tolerances(tolerance: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joins", "fig5", "--tolerance", tolerance]) == 2
    assert "expected a number between 0 and 1" in capsys.readouterr().err


def test_two_files_together(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A patch of degree 1 beside the halves of its edge, of degree 2 in a file of their own."""
    one, other = tmp_path / "one.bv", tmp_path / "other.bv"
    one.write_text("4 1  0 0 0  0 1 0  1 0 0  1 1 0\n")
    halves = []
    for y in (0.0, 0.5):
        points = [(1 + i / 2, y + j / 4, 0) for i in range(3) for j in range(3)]
        halves.append("4 2  " + "  ".join(f"{x} {y} {z}" for x, y, z in points))
    other.write_text("\n".join(halves))
    assert main(["joins", str(one), str(other), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["patches"] == 3
    assert found["largest_angle"] == 0.0
    rows = {tuple(row["patches"]): row["spans"] for row in found["joins"]}
    assert rows == {
        (1, 0): [[0.0, 1.0], [0.0, 0.5]],
        (2, 0): [[0.0, 1.0], [0.5, 1.0]],
        (1, 2): [[0.0, 1.0], [0.0, 1.0]],
    }
    assert main(["joins", str(one), str(other)]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"{one}, {other}: 3 patches, 3 joins, 7 free edges")
    assert "  3 on 0.5..1" in out
    assert main(["joins", str(one), str(tmp_path / "none.bv")]) == 3
