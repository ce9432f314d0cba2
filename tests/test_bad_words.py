"""Wrong words, files, pictures and disks: one line that says what was expected, and no harm."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from commands import one_line, pixels, render
from reparam.assets import texture_path
from reparam.cli import main
from reparam.errors import UsageError

LONG = "x" * 300
CORNER_AWAY = "[[[-1,1],[0,2],[1,1]],[[-2,0],[0,0],[2,0]],[[-1,-1],[0,-2],[1,-Infinity]]]"
SQUARE = "4 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n"

pytestmark = pytest.mark.usefixtures("own_context")


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
