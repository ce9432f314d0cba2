"""`reparam bench`: ratios of neighbouring runs, a table, JSON; no times are judged here."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from reparam import bench
from reparam.bench import Pairs, Row, Skipped, interleave, line, names
from reparam.cli import main

FAKE = '''"""A fake."""
from reparam.bench import Pairs, Skipped

ACCOUNT = "Why it is slow."

def rows(pairs):
    yield Pairs([0.002] * pairs, [0.001] * pairs).row("fake/slow", goal=1.5, size="1x1")
    yield Pairs([0.002] * pairs, [0.004] * pairs).row("fake/better", inverse=True, goal=1.5)
    yield Skipped("fake/absent", "nobody is there")
'''


@pytest.fixture
def fake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "fake_benchmark.py").write_text(FAKE)
    (tmp_path / "helper.py").write_text("x = 1")
    monkeypatch.setattr(bench, "folder", lambda: tmp_path)
    monkeypatch.delitem(sys.modules, "fake_benchmark", raising=False)


def test_the_benchmarks_are_found() -> None:
    assert {
        "cold_start",
        "edit",
        "edited",
        "start_up",
        "one_frame",
        "eval_mesh",
        "scale",
        "static_mesh",
    } <= set(names())
    assert "frames" not in names()


def test_runs_alternate() -> None:
    runs: list[str] = []
    times = interleave(lambda: runs.append("ours"), lambda: runs.append("other"), 4, warm_up=2)
    assert runs == ["ours", "other"] * 6
    assert (len(times.ours), len(times.other)) == (4, 4)


def test_the_ratio_is_of_neighbours() -> None:
    """The machine slows down by ten: the ratio of medians would say 1.1 and 11."""
    times = Pairs([1.0, 10.0, 10.0], [2.0, 20.0, 5.0])
    assert times.row("r").ratio == 0.5
    assert times.row("r", inverse=True).ratio == 2.0
    assert times.row("r").settings == {"pairs": 3}


@pytest.mark.parametrize(
    ("ratio", "at_least", "reached"), [(1.2, False, True), (1.4, False, False), (1.4, True, True)]
)
def test_goals(ratio: float, at_least: bool, reached: bool) -> None:
    row = Row("r", ratio, 1.0, 1.0, goal=1.3, at_least=at_least)
    assert row.reached() is reached
    assert ("MISSED" in line(row)) is not reached
    assert Row("r", ratio, 1.0, 1.0).reached() is None


@pytest.mark.usefixtures("fake")
def test_table_and_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--pairs", "3"]) == 0
    slow, better, absent = capsys.readouterr().out.splitlines()
    assert "2.000" in slow
    assert slow.endswith("goal <= 1.5  MISSED")
    assert better.endswith("goal >= 1.5")
    assert absent.endswith("skipped: nobody is there")
    assert main(["bench", "fake_benchmark", "--pairs", "3", "--json"]) == 0
    out, progress = capsys.readouterr()
    assert len(progress.splitlines()) == 3
    rows = json.loads(out)
    assert rows[0]["settings"] == {"pairs": 3, "size": "1x1"}
    assert [row.get("reached") for row in rows] == [False, True, None]
    assert rows[2] == {"name": "fake/absent", "skipped": "nobody is there"}


@pytest.mark.parametrize("words", [["nope"], ["--pairs", "0"]])
def test_wrong_words(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", *words]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_row_that_is_skipped_says_why() -> None:
    assert line(Skipped("a/b", "no such library")).split() == [
        "a/b",
        "skipped:",
        "no",
        "such",
        "library",
    ]


@pytest.mark.usefixtures("fake")
def test_a_document_of_tables(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Run benchmarks are put in, tables of others stay, and their machine is named."""
    document = tmp_path / "BENCHMARKS.md"
    document.write_text("# Old\n\n## another\n\nkept\n\n## fake_benchmark\n\nold\n", "utf-8")
    assert main(["bench", "--pairs", "2", "--into", str(document)]) == 0
    capsys.readouterr()
    text = document.read_text("utf-8")
    assert text.startswith("# Benchmarks\n")
    assert text.index("## another\n\nkept") < text.index("## fake_benchmark")
    assert "old" not in text.partition("## fake_benchmark")[2]
    assert "| `fake/slow` | 2 | ≤ 1.5 **missed** | 2 | 1 | pairs 2, size 1x1 |" in text
    assert "| `fake/better` | 2 | ≥ 1.5 | 2 | 4 | pairs 2 |" in text
    assert "* fake/absent was skipped: nobody is there" in text
    assert "A fake.\n" in text
    assert "Why it is slow." in text
    assert "cores" in text
    assert "Python 3." in text
    assert main(["bench", "--pairs", "2", "--into", str(tmp_path)]) == 1
    assert len(capsys.readouterr().err.splitlines()) == 1
