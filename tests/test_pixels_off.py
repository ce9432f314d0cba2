"""`reparam accuracy`: each fragment against float64, as a table and as JSON."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from reparam.accuracy import Accuracy
from reparam.cli import main


def rows(capsys: pytest.CaptureFixture[str], *words: str) -> list[dict[str, float]]:
    main(["accuracy", *words, "--json", "--size", "256x256"])
    found: list[dict[str, float]] = json.loads(capsys.readouterr().out)
    return found


def test_a_tolerance_is_kept_with_fewer_triangles(capsys: pytest.CaptureFixture[str]) -> None:
    for row in rows(capsys, "fig5", "--tolerance"):  # half a pixel, if no number is given
        assert row["ok"]
        assert row["tolerance"] == 0.5
        assert row["most"] <= 0.5
        assert row["triangles"] < 2048
        assert row["fragments"] == pytest.approx(20 / 3 / (3 * 1.08) ** 2 * 256**2, rel=0.01)


def test_coarse_levels_are_seen(capsys: pytest.CaptureFixture[str]) -> None:
    """Two steps of x = V (3 - U^2) / 2 are off by up to 1/4 of a unit in x and in y."""
    (row,) = rows(capsys, "fig5", "--set", "level=2", "--evaluator", "vertex")
    quarter = 0.25 * 256 / (3 * 1.08)
    assert quarter * 0.8 < row["most"] <= quarter * 2**0.5
    (finer,) = rows(capsys, "fig5", "--set", "level=4", "--evaluator", "vertex")
    assert row["mean"] / finer["mean"] == pytest.approx(4.0, rel=0.05)


def test_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["accuracy", "fig4", "--evaluator", "vertex"]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("ok   layer 1 vertex")
    assert line.endswith("one level")


def test_a_broken_promise_fails() -> None:
    kept = Accuracy(1, "vertex", 1, 2, 3, 0.1, 0.5, 0.9, silhouette=0.5, tolerance=0.5)
    assert kept.ok
    for name in ("most", "picture", "silhouette"):
        broken = replace(kept, **{name: 0.51})
        assert not broken.ok
        assert broken.line().startswith("FAIL")


def test_coarse_outlines_and_pictures_are_seen(capsys: pytest.CaptureFixture[str]) -> None:
    """Two steps of the side (V, (3 - V^2) / 2) cut off 1/8 of a unit, by a chord of slope 1/2. What
    is attached by r lies right however few steps there are, what is by the identity does not."""
    (row,) = rows(capsys, "fig5", "--set", "level=2", "--evaluator", "vertex")
    unit = 256 / (3 * 1.08)
    assert row["silhouette"] == pytest.approx(unit / 8 / 1.25**0.5, abs=1 / 16)
    assert row["picture"] == pytest.approx(row["most"], rel=1e-6)
    (own,) = rows(capsys, "fig5", "--set", "level=2", "--set", "texture=r", "--evaluator", "vertex")
    assert own["most"] == row["most"]
    assert own["picture"] is None or own["picture"] < 0.01


def test_outlines_of_bodies_fall_with_the_square_of_the_steps(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ("fig7", "--evaluator", "vertex", "--set", "perspective=40", "--set")
    coarse, fine = (rows(capsys, *words, f"level={level}") for level in (3, 6))
    ratios = [a["silhouette"] / b["silhouette"] for a, b in zip(coarse, fine, strict=True)]
    assert len(ratios) == 4
    assert 3.0 < np.mean(ratios) < 5.0


def test_nothing_to_measure_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["accuracy", "staircase"]) == 0
    assert capsys.readouterr().out == "staircase fills no patches or meshes: nothing to measure\n"


def test_recorded_meshes_are_measured(capsys: pytest.CaptureFixture[str]) -> None:
    """Four times the steps are off by a sixteenth, as far as a pixel's rounding lets one see."""
    coarse, fine = (rows(capsys, "redbook-bezmesh", "--set", f"grid={n}")[0] for n in (3, 12))
    assert (fine["triangles"], fine["recorded"], fine["tolerance"]) == (288, True, 0.0)
    assert 10.0 < coarse["mean"] / fine["mean"] < 20.0
    told = Accuracy(1, "vertex", 1, 2, 3, 0.1, 0.5, 0.9, silhouette=0.5, recorded=True)
    assert told.line().endswith("as recorded")
