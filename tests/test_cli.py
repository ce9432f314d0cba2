"""The command line: what it prints, what it writes, its exit codes, and bad input."""

from __future__ import annotations

import json
import struct
import subprocess
import sys
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from reparam.assets import texture_path
from reparam.cli import main
from reparam.errors import UsageError
from reparam.gallery import plates
from reparam.scenes.claims import Claim
from reparam.scenes.registry import load_scene, scene_names
from reparam.snapshot import Studio

LONG = "x" * 300
CORNER_AWAY = "[[[-1,1],[0,2],[1,1]],[[-2,0],[0,0],[2,0]],[[-1,-1],[0,-2],[1,-Infinity]]]"
SQUARE = "4 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n"


@pytest.fixture(autouse=True)
def own_context(studio: Studio) -> Iterator[None]:
    """A command opens a context of its own; afterwards the tests' one is current again."""
    yield
    studio.ctx.__enter__()


@pytest.fixture
def out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where a picture may be written; the working directory is beside it."""
    monkeypatch.chdir(tmp_path)
    return tmp_path / "out.png"


def render(out: Path, *words: str) -> int:
    return main(["render", *words, "-o", str(out)])


def pixels(path: Path) -> np.ndarray[Any, Any]:
    with Image.open(path) as image:
        return np.asarray(image)


def one_line(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on stderr; nothing on stdout."""
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("reparam: ")
    assert printed.err.endswith("\n")
    assert len(printed.err.splitlines()) == 1
    return printed.err


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


BAD_WORDS = {
    "unknown scene": (["fgi5"], 2, "expected a scene (", "did you mean fig5?"),
    "long scene": ([LONG], 2, "expected a scene", ""),
    "surface needs a file": (["surface"], 2, "expected a scene", ""),
    "unknown parameter": (["fig5", "--set", "textur=r"], 2, "'textur'", "did you mean texture?"),
    "no value": (["fig5", "--set", "checks"], 2, "expected NAME=VALUE", "'checks'"),
    "no JSON": (["fig5", "--set", "points=[[1,2"], 2, "3 x 3 x 2 numbers", "found '[[1,2'"),
    "wrong shape": (["fig5", "--set", "points=[[[0,1]]]"], 2, "points: ", "found 1 x 1 x 2"),
    "not a number": (["fig4", "--set", f"points={CORNER_AWAY}"], 2, "points: ", "inf at [2][2][1]"),
    "bad choice": (["fig5", "--set", "texture=q"], 2, "expected identity or r, found 'q'", ""),
    "bad number": (["fig5", "--set", "checks=1.5"], 2, "a whole number from 1 to 256", "'1.5'"),
    "out of range": (["fig5", "--set", "level=0"], 2, "level: expected", "found '0'"),
    "NaN": (["fig5", "--set", "morph=nan"], 2, "a number from 0 to 1, found 'nan'", ""),
    "infinity": (["fig5", "--set", "morph=-inf"], 2, "a number from 0 to 1, found '-inf'", ""),
    **{
        f"size {size}": (["fig5", f"--size={size}"], 2, "expected WIDTHxHEIGHT", f"{size!r}")
        for size in ("0x0", "-1", "99999x1", "1x16385", "nonsense", "10", "1e2x3", "5x5x5", "")
    },
    "no such folder": (["fig5", "-o", "none/out.png"], 1, "an existing folder", "none"),
    "no PNG": (["fig5", "-o", "out.jpg"], 2, "ending in .png or .svg or .pdf, found 'out.jpg'", ""),
    "output is a folder": (["fig5", "-o", "folder.png"], 1, "a file that may be written", ""),
    "long output": (["fig5", "-o", f"{LONG}.png"], 1, "xxx.png: ", ""),
    "missing file": (["none.bv"], 3, "none.bv: expected a readable .bv file, found no file", ""),
    "a folder": (["folder.png"], 3, "folder.png: expected a readable .bv file", "a directory"),
    "truncated file": (["cut.bv"], 3, "cut.bv:1: expected 12 numbers for 4 points, found 11", ""),
    "binary file": (["binary.bv"], 3, "binary.bv:2: expected text, found the byte 0x", ""),
}  # fmt: skip


@pytest.mark.parametrize(("words", "code", "first", "second"), BAD_WORDS.values(), ids=BAD_WORDS)
def test_bad_words(
    out: Path, capsys: pytest.CaptureFixture[str], words: list[str], code: int, first: str,
    second: str,
) -> None:  # fmt: skip
    (out.parent / "folder.png").mkdir()
    (out.parent / "cut.bv").write_text(SQUARE[:-3])
    (out.parent / "binary.bv").write_bytes(b"\x89PNG\r\n\x1a\n\0\0")
    out.write_bytes(b"precious")
    assert main(["render", "-o", str(out), *words]) == code
    message = one_line(capsys)
    assert first in message
    assert second in message
    assert out.read_bytes() == b"precious"


def png_header(width: int, height: int) -> bytes:
    """As much of a PNG as says how large it is."""
    header = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    check = struct.pack(">I", zlib.crc32(header))
    return b"\x89PNG\r\n\x1a\n\0\0\0\x0d" + header + check + b"\0\0\0\x01IDAT"


BAD_PICTURES = {
    "text": b"hello",
    "cut": texture_path("checkerboard").read_bytes()[:300],
    "20000 x 1": png_header(20000, 1),
    "16000 x 10000": png_header(16000, 10000),
    "bomb": png_header(20000, 20000),
}


PLAIN = ("fig5", "--plain", "--size", "64x64")


@pytest.fixture(scope="module")
def checkered(tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    path = tmp_path_factory.mktemp("checkered") / "out.png"
    assert render(path, *PLAIN) == 0
    return pixels(path)


@pytest.mark.parametrize("name", ["none", "folder", LONG, *BAD_PICTURES])
def test_bad_picture(
    out: Path, capsys: pytest.CaptureFixture[str], checkered: np.ndarray, name: str
) -> None:
    (out.parent / "folder.png").mkdir()
    if name in BAD_PICTURES:
        (out.parent / f"{name}.png").write_bytes(BAD_PICTURES[name])
    assert render(out, *PLAIN, "--set", f"image={name}.png") == 0
    message = one_line(capsys)
    assert message.startswith(f"reparam: {name}.png: expected a picture")
    assert message.endswith("; the checkerboard stands in\n")
    assert " x " not in name or f"found {name};" in message
    assert (pixels(out) == checkered).all()


@pytest.mark.parametrize("exif", [b"", b"Exif\0\0II*\0\x08\0\0\0\xff\xff"], ids=["large", "EXIF"])
def test_a_picture_in_order_gives_no_warning(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, exif: bytes
) -> None:
    """Larger than Pillow likes, but not than we allow; or with a useless tag."""
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 5000)
    Image.new("RGB", (80, 80), "red").save(out.parent / "photo.jpg", exif=exif)
    assert render(out, "fig5", "--size", "64x64", "--set", "image=photo.jpg") == 0
    assert capsys.readouterr() == ("", "")
    assert pixels(out)[32, 32] == pytest.approx([254, 0, 0], abs=3)


def test_a_decoder_that_fails(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Pillow's readers raise what they like: that of AVIF RuntimeError."""

    def decode(path: Path) -> Image.Image:
        if path.suffix == ".avif":
            raise RuntimeError("Failed to decode frame 0")
        return read(path)

    read = Image.open
    monkeypatch.setattr(Image, "open", decode)
    assert render(out, "fig5", "--size", "64x64", "--set", "image=photo.avif") == 0
    assert one_line(capsys).endswith("; the checkerboard stands in\n")


def test_a_disk_that_is_full(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def save(_: Image.Image, path: Path, *__: object) -> None:
        path.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", save)
    out.write_bytes(b"precious")
    assert render(out, "fig5", "--size", "64x64") == 1
    assert "out.png: could not be written: No space left" in one_line(capsys)
    assert [path.read_bytes() for path in out.parent.iterdir()] == [b"precious"]


def test_debug_shows_the_traceback(out: Path) -> None:
    with pytest.raises(UsageError, match="found 'fgi5'"):
        main(["--debug", "render", "fgi5", "-o", str(out)])


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
