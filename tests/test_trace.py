"""`reparam trace`: equally spaced points with tangents, as the command line hands them out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reparam.cli import main

QUARTER = "x y w\n2 0 1\n2 2 .7071067811865476\n0 2 1\n"


@pytest.fixture
def file(tmp_path: Path) -> str:
    path = tmp_path / "quarter.csv"
    path.write_text(QUARTER)
    return str(path)


def test_points_at_equal_lengths(
    file: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "points.csv"
    assert main(["trace", file, "--count", "46", "-o", str(out)]) == 0
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err == "length 3.14159265359, 46 points\n"
    values = np.genfromtxt(out, delimiter=",", names=True)
    assert values.dtype.names == ("s", "u", "x", "y", "z", "tx", "ty", "tz")
    angle = np.linspace(0.0, np.pi / 2.0, 46)
    assert np.abs(values["s"] - 2.0 * angle).max() < 1e-14
    assert np.abs(values["x"] - 2.0 * np.cos(angle)).max() < 1e-14
    assert np.abs(values["y"] - 2.0 * np.sin(angle)).max() < 1e-14
    assert np.abs(values["tx"] + np.sin(angle)).max() < 1e-14
    assert np.abs(values["ty"] - np.cos(angle)).max() < 1e-14


def test_a_step_leaves_a_rest(file: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trace", file, "--step", "0.5"]) == 0
    said = capsys.readouterr()
    lines = said.out.splitlines()
    assert [float(line.split(",")[0]) for line in lines[1:]] == [0.5 * k for k in range(7)]
    assert "7 points, 0.141593 left over at the end" in said.err


@pytest.mark.parametrize(
    ("words", "code", "complaint"),
    [
        (["--count", "1"], 2, "--count: expected a whole number from 2"),
        (["--step", "0"], 2, "--step: expected a length from"),
        (["--step", "nan"], 2, "--step: expected a length from"),
        (["--step", "1e-9"], 2, "--step: expected a length from"),
        (
            ["--step", "1", "-o", "points.png"],
            2,
            "--output: expected a name ending in .csv or .txt",
        ),
        (["--step", "1", "-o", "no/such/folder.csv"], 1, "expected an existing folder"),
    ],
)
def test_what_cannot_be(
    file: str, words: list[str], code: int, complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["trace", file, *words]) == code
    assert complaint in capsys.readouterr().err
