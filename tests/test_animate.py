"""`reparam animate`: as many frames as asked, each the picture of its values."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from reparam.animate import courses
from reparam.cli import main
from reparam.errors import UsageError
from reparam.snapshot import Studio
from reparam.subject import open_subject

SIZE = (96, 64)


def frames_of(path: Path) -> list[np.ndarray]:
    found = []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            found.append(np.asarray(image.convert("RGB")).astype(int))
    return found


@pytest.mark.parametrize(("ending", "off"), [("gif", 40), ("webp", 0), ("png", 0)])
def test_each_frame_is_the_picture_of_its_values(
    studio: Studio, tmp_path: Path, capsys: pytest.CaptureFixture[str], ending: str, off: int
) -> None:
    out = tmp_path / f"walk.{ending}"
    words = ["--vary", "time=0:1", "--frames", "4", "--size", "96x64", "--rate", "10"]
    assert main(["animate", "fig1", "-o", str(out), *words]) == 0
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.endswith("4/4\n")
    assert [path.name for path in tmp_path.iterdir()] == [out.name]
    with Image.open(out) as image:
        assert image.info["loop"] == 0
    frames = frames_of(out)
    assert len(frames) == 4
    for k, frame in enumerate(frames):  # a clock: the last frame is a step before the first
        exact = studio.draw(open_subject("fig1").changed("time", k / 4), SIZE)
        assert np.abs(frame - exact).max() <= off


def test_courses() -> None:
    subject = open_subject("fig5")
    values = [(s.value("morph"), s.value("checks"), s.value("texture")) for s in courses(
        subject, ["morph=0:1", "checks=2:4", "texture=r,identity"], 5)]  # fmt: skip
    morphs, checks, textures = zip(*values, strict=True)
    assert morphs == (0.0, 0.25, 0.5, 0.75, 1.0)
    assert checks == (2, 2, 3, 4, 4)
    assert textures == ("r", "r", "r", "identity", "identity")
    back = [s.value("morph") for s in courses(subject, ["morph=0:1"], 3, there_and_back=True)]
    assert back == [0.0, 0.5, 1.0, 0.5]


def test_arrays_go_too() -> None:
    points = "[[0,0],[1,1]]:[[0,2],[1,1]]"
    found = [s.value("points") for s in courses(open_subject("trace"), [f"points={points}"], 3)]
    assert found[1].tolist() == [[0.0, 1.0], [1.0, 1.0]]


@pytest.mark.parametrize(
    ("varied", "complaint"),
    [
        ([], "--vary: expected NAME=FROM:TO or NAME=A,B,C, found none"),
        (["time"], "--vary: expected NAME=FROM:TO or NAME=A,B,C, found 'time'"),
        (["tim=0:1"], "did you mean time?"),
        (["time=1"], "--vary: time: expected FROM:TO, found '1'"),
        (["time=0:2"], "time: expected a number from 0 to 1, found '2'"),
        (["time=a:1"], "time: expected a number from 0 to 1, found 'a'"),
        (["curve=S,T"], "curve: expected diagonal or parabola or S, found 'T'"),
        (["change=square,2u"], "change: expected 2u to be 1 at u = 1, found 2"),
    ],
)
def test_what_cannot_vary(varied: list[str], complaint: str) -> None:
    with pytest.raises(UsageError) as refused:
        courses(open_subject("fig1"), varied, 6)
    assert complaint in str(refused.value)


@pytest.mark.parametrize(
    "words",
    [
        ["-o", "out.mp4"],
        ["-o", "out.gif", "--frames", "1"],
        ["-o", "out.gif", "--frames", "100000"],
        ["-o", "out.gif", "--rate", "0"],
        ["-o", "out.gif", "--size", "16384x16384"],
    ],
)
def test_wrong_words(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["animate", "fig1", "--vary", "time=0:1", *words]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_an_interrupted_animation_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Image.Image, "save", interrupted)
    words = ["--vary", "time=0:1", "--frames", "2", "--size", "32x32"]
    assert main(["animate", "fig1", "-o", str(tmp_path / "walk.png"), *words]) == 130
    assert list(tmp_path.iterdir()) == []
