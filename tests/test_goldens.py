"""Every plate of the gallery, and a file, against the pictures stored in golden/.

They are drawn by llvmpipe, where they must come back the same; other drivers may round
otherwise. `pytest tests/test_goldens.py --update-goldens` stores what is drawn now: look at each
picture before it is committed.
"""

from __future__ import annotations

import base64
import io
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from reparam.gallery import plates
from reparam.snapshot import Studio
from reparam.subject import open_subject

Picture = NDArray[np.uint8]

HERE = Path(__file__).parent
GOLDEN, REPORT = HERE / "golden", HERE / "report"
SUBJECTS = {**dict(plates()), "file-mixed": open_subject(str(HERE / "data" / "mixed.bv"))}
LARGEST_FILE = 1 << 16
PAGE = """<!doctype html><meta charset="utf-8"><title>{name}</title>
<style>img {{ width: 32%; image-rendering: pixelated; border: 1px solid gray }}</style>
<h1>{name}</h1><p>{complaint}</p><p>reference, new, difference (eight times)</p>
{images}
"""


def drawn(studio: Studio, name: str) -> Picture:
    """Small, with the number of samples that llvmpipe has."""
    subject = SUBJECTS[name].changed("samples", 4)
    size = (256, 192) if len(subject.figure().spaces) > 1 else (192, 192)
    return studio.draw(subject, size)


def stored(name: str) -> Picture:
    with Image.open(GOLDEN / f"{name}.png") as image:
        return np.asarray(image.convert("RGB"))


def complaint(reference: Picture, new: Picture, exact: bool) -> str:
    """What is wrong with the new picture; nothing if it will do."""
    if reference.shape != new.shape:
        return f"expected shape {reference.shape}, found {new.shape}"
    difference = np.abs(reference.astype(int) - new)
    if exact:
        count = np.count_nonzero(difference.max(-1) > 1)
        return f"pixels off by more than 1: {count}, at most by {difference.max()}" * bool(count)
    share = np.mean(difference.max(-1) > 16)
    rms = np.sqrt(np.mean(difference**2.0))
    bad = bool(share > 1e-3 or rms > 2.0)
    return f"{share:.2%} of the pixels are off by more than 16, RMS {rms:.2f}" * bad


def write_report(name: str, reference: Picture, new: Picture, text: str) -> Path:
    """One page for each plate, so that tests that run at once do not meet."""
    pictures = [reference, new]
    if reference.shape == new.shape:
        difference = 8 * np.abs(reference.astype(int) - new)
        pictures.append(np.minimum(difference, 255).astype(np.uint8))
    images = []
    for picture in pictures:
        stream = io.BytesIO()
        Image.fromarray(picture).save(stream, "PNG")
        code = base64.b64encode(stream.getvalue()).decode()
        images.append(f'<img src="data:image/png;base64,{code}">')
    REPORT.mkdir(exist_ok=True)
    page = REPORT / f"{name}.html"
    page.write_text(PAGE.format(name=name, complaint=text, images="\n".join(images)), "utf-8")
    return page


@pytest.mark.parametrize("name", SUBJECTS)
def test_golden(studio: Studio, request: pytest.FixtureRequest, name: str) -> None:
    capabilities = studio.painter.capabilities
    if capabilities.samples < 4:
        pytest.skip(f"{capabilities.renderer} has not 4 samples a pixel")
    llvmpipe = "llvmpipe" in capabilities.renderer
    new = drawn(studio, name)
    if request.config.getoption("--update-goldens"):
        assert llvmpipe, "the goldens are llvmpipe's"
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(new).save(GOLDEN / f"{name}.png", optimize=True)
    assert (GOLDEN / f"{name}.png").is_file(), "no golden yet: --update-goldens, and look at it"
    reference = stored(name)
    wrong = complaint(reference, new, exact=llvmpipe)
    if wrong:
        page = write_report(name, reference, new, wrong)
        pytest.fail(f"{wrong}; see {page}")
    (REPORT / f"{name}.html").unlink(missing_ok=True)


def test_each_golden_has_its_plate() -> None:
    files = {path.name for path in GOLDEN.iterdir()}
    assert files == {f"{name}.png" for name in SUBJECTS}
    assert all((GOLDEN / name).stat().st_size < LARGEST_FILE for name in files)


def test_a_difference_is_seen_and_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reference = stored("fig5-texture-r")
    assert complaint(reference, reference, exact=True) == ""
    one_off = reference.copy()
    one_off[90, 80] ^= 1
    assert complaint(reference, one_off, exact=True) == ""
    one_off[90, 80] ^= 2
    assert "more than 1: 1, at most by 3" in complaint(reference, one_off, True)
    assert complaint(reference, one_off, exact=False) == ""
    moved = np.roll(reference, 1, 1)
    assert "RMS" in complaint(reference, moved, exact=False)
    assert "shape" in complaint(reference, reference[1:], exact=False)
    monkeypatch.setitem(globals(), "REPORT", tmp_path / "report")
    page = write_report("moved", reference, moved, "moved")
    assert page.read_text("utf-8").count("<img") == 3
