"""The command line: what it prints, what it writes, its exit codes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from commands import pixels, render
from reparam.cli import main
from reparam.gallery import plates
from reparam.scenes.claims import Claim
from reparam.scenes.registry import load_scene, scene_names

pytestmark = pytest.mark.usefixtures("own_context")


def test_list(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list"]) == 0
    text = capsys.readouterr().out
    assert all(f"{name}: {load_scene(name).title}" in text for name in scene_names())
    assert "FILE: " in text
    assert "any scene:" in text


def test_list_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [row["scene"] for row in rows] == [*scene_names(), "surface"]
    for row in rows:
        assert row.keys() == {"scene", "title", "figure", "parameters"}
        for parameter in row["parameters"]:
            keys = {"name", "type", "choices", "presets", "range", "shape", "default", "help"}
            assert parameter.keys() == keys
            assert parameter["help"]
            assert parameter["type"] in ("choice", "bool", "int", "float", "str", "points")
            assert (parameter["type"] == "points") == (parameter["shape"] is not None)
            assert (parameter["type"] == "choice") == (parameter["choices"] is not None)
            if parameter["choices"]:
                assert parameter["default"] in parameter["choices"]
            if parameter["range"]:
                assert parameter["range"][0] <= parameter["default"] <= parameter["range"][1]


def test_render_writes_a_png_of_the_size(out: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pictures = []
    for options in ([], ["--plain"], ["--set", "texture=r"], ["--set", "net=1"]):
        assert render(out, "fig5", "--size", "123x77", *options) == 0
        assert capsys.readouterr() == ("", "")
        assert pixels(out).shape == (77, 123, 3)
        pictures.append(pixels(out).tobytes())
    assert len(set(pictures)) == len(pictures)
    assert [path.name for path in out.parent.iterdir()] == ["out.png"]


def test_without_a_command_and_a_screen_the_figures_are_written(
    out: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("reparam.viewer.screen.screen_missing", lambda: "no screen")
    some = list(plates())[::24]  # the goldens draw all
    monkeypatch.setattr("reparam.gallery.plates", lambda: iter(some))
    assert main([]) == 0
    folder = out.parent / "figures"
    assert str(folder) in capsys.readouterr().out
    stems = {path.stem for path in folder.glob("*.png")}
    assert stems == {name for name, _ in some}


@pytest.mark.parametrize("name", scene_names())
def test_check(capsys: pytest.CaptureFixture[str], name: str) -> None:
    assert main(["check", name]) == 0
    text = capsys.readouterr().out
    assert "FAIL" not in text
    assert f"ok   {name}" in text or load_scene(name).figure is None


def test_all_scenes_are_checked_unless_some_are_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    claim = Claim("(1)", "one", 1.0, 1.0, 0.0)
    for name in scene_names():
        monkeypatch.setattr(load_scene(name), "_claims", lambda: iter([claim]))
    assert main(["check"]) == 0
    assert capsys.readouterr().out.count("ok  ") == len(scene_names())


def test_check_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "fig5", "--json"]) == 0
    verdicts = json.loads(capsys.readouterr().out)
    assert len(verdicts) > 3
    keys = {"scene", "equation", "statement", "expected", "measured", "tolerance", "ok"}
    assert all(verdict.keys() == keys and verdict["ok"] is True for verdict in verdicts)
    assert {verdict["scene"] for verdict in verdicts} == {"fig5"}


@pytest.mark.parametrize("measured", [1.1, float("nan"), [1.0, 1.0], lambda _: 0.9])
def test_a_claim_that_fails(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], measured: Any
) -> None:
    good, bad = Claim("(1)", "one", 1.0, 1.0, 0.0), Claim("(2)", "not one", 1.0, measured, 1e-3)
    monkeypatch.setattr(load_scene("fig4"), "_claims", lambda: iter([good, bad]))
    assert main(["check", "fig4"]) == 1
    text = capsys.readouterr().out
    assert "ok   fig4   (1)" in text
    assert "FAIL fig4   (2)" in text


def test_doctor(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["draws"] is True
    assert {"reparam", "python", "moderngl", "renderer", "chosen evaluator"} <= report.keys()
    assert main(["doctor"]) == 0
    assert report["renderer"] in capsys.readouterr().out


def test_two_studios_in_one_process() -> None:
    """In a process of its own: OpenGL forgives no call to the wrong context."""
    code = """from reparam.snapshot import Studio
one = Studio()
first = [one.picture("fig5", (64, 64), checks=n) for n in (2, 8)]
two = Studio()
for studio in (one, two, one, two):
    assert (studio.picture("fig5", (64, 64), checks=8) == first[1]).all()
    assert (studio.picture("fig5", (64, 64), checks=2) == first[0]).all()"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(("subject", "code"), [("fig5", 0), ("fgi5", 2), ("none.bv", 3)])
def test_as_a_process(out: Path, subject: str, code: int) -> None:
    words = [sys.executable, "-m", "reparam", "render", subject, "-o", str(out)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (code, "")
    assert len(done.stderr.splitlines()) == (0 if code == 0 else 1)
    assert out.exists() == (code == 0)
