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
