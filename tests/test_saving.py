"""Saved scenes, and the command line that draws a picture again: the same subject comes back."""

from __future__ import annotations

import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest

from reparam.cli import main, parser
from reparam.errors import FileFormatError, ReparamError, UsageError
from reparam.geometry.camera import View
from reparam.saving import command, parse_view, save, view_text, with_views
from reparam.subject import Subject, open_subject

MIXED = Path(__file__).parent / "data" / "mixed.bv"
POINTS = [
    [[-1, 1], [0, 2.1], [1, 1]],
    [[-2, 0], [0.1, 1 / 3], [2, 0]],
    [[-1, -1], [0, -2], [1, -1]],
]
VIEW = View(zoom=1.0 / 3.0, pan=(0.1, -2e-17))
TURNED = View(2.0, (0.0, 0.25), 1e-3, -89.5)


def fig5() -> Subject:
    subject = open_subject("fig5")
    for name, value in {
        "texture": "r",
        "points": POINTS,
        "morph": 0.1 + 0.2,
        "image": 'it\'s $HOME; "quoted".png',
        "net": True,
        "level": 7,
    }.items():
        subject = subject.changed(name, value)
    return with_views(subject, {"physical": VIEW})


def surface(path: Path) -> Subject:
    subject = open_subject(str(path)).changed("moved", [[0, 0, 0, 1, 2, 0.1]])
    return with_views(subject, {"physical": TURNED})


def assert_same(a: Subject, b: Subject) -> None:
    """Bit for bit."""
    assert a.scene is b.scene
    assert (a.display, dict(a.views), a.title) == (b.display, dict(b.views), b.title)
    assert a.values.keys() == b.values.keys()
    for name, value in a.values.items():
        assert np.asarray(value).tobytes() == np.asarray(b.value(name)).tobytes(), name


def test_a_saved_scene_comes_back(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    save(fig5(), path)
    assert_same(open_subject(str(path)), fig5())
    lines = path.read_text().splitlines()
    assert '    "texture": "r",' in lines
    assert '    "net": true' in lines
    assert not any("checks" in line for line in lines)  # it has its default
    with pytest.raises(ReparamError, match="could not be written: File exists"):
        save(fig5(), path)


def test_a_saved_surface_finds_its_file_from_its_own_folder(tmp_path: Path) -> None:
    (tmp_path / "models").mkdir()
    model = tmp_path / "models" / "mixed.bv"
    shutil.copy(MIXED, model)
    path = tmp_path / "scene.json"
    save(surface(model), path)
    assert '"file": "models/mixed.bv"' in path.read_text()
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    shutil.move(path, moved)
    shutil.move(tmp_path / "models", moved)
    again = open_subject(str(moved / "scene.json"))
    assert_same(again, surface(moved / "models" / "mixed.bv"))
    assert np.array_equal(again.data["body"].nets, open_subject(str(MIXED)).data["body"].nets)


def test_defaults_need_no_sections(tmp_path: Path) -> None:
    save(open_subject("fig4"), tmp_path / "plain.json")
    text = (tmp_path / "plain.json").read_text()
    assert text == '{\n  "reparam": 1,\n  "scene": "fig4"\n}\n'


def from_words(words: list[str]) -> Subject:
    from reparam.commands.options import chosen_subject

    return chosen_subject(parser().parse_args(words))


@pytest.mark.parametrize("kind", ["scene", "surface"])
def test_the_command_line_gives_the_same_subject(
    kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    subject = fig5() if kind == "scene" else surface(MIXED)
    if kind == "scene":  # a picture that is not there is put back
        subject = subject.changed("image", "checkerboard")
    text = command(subject, (321, 123), "vertex", "out.png")
    words = shlex.split(text)
    assert words[:2] == ["reparam", "render"]
    assert_same(from_words(words[1:]), subject)
    options = parser().parse_args(words[1:])
    assert (options.size, options.evaluator, str(options.output)) == (
        "321x123",
        "vertex",
        "out.png",
    )
    assert capsys.readouterr().err == ""
    assert shlex.split(command(fig5(), (1, 1), None, "o.png")).count("it's") == 0  # one word


def test_a_view_as_text() -> None:
    for view in (VIEW, TURNED, View(), View(azimuth=0.0), View(pivot=(0.1, 2.0, -3.0, 7.5))):
        assert parse_view(view_text("physical", view)) == ("physical", view)
    assert view_text("domain", View(2.0, (0.5, 0.0))) == "domain=2,0.5,0"
    for text in ("physical", "physical=", "physical=1,2", "=1,0,0", "a=1,0,0,5", "a=0,0,0",
                 "a=nan,0,0", "a=1,inf,0", "a=1,0,0,0,91", "a=1,x,0"):  # fmt: skip
        with pytest.raises(UsageError, match="--view: expected SPACE=ZOOM,X,Y"):
            parse_view(text)


GOOD = '{\n "reparam": 1,\n "scene": "fig5"'
BAD = {
    "nothing": ("", ":1: expected value, found the end of the line"),
    "no JSON": ("{\n 'a': 1}", ":2: expected property name enclosed in double quotes, found"),
    "cut": (GOOD, ":3: expected ',' delimiter, found the end of the line"),
    "no object": ("[1]", ':1: expected "reparam": 1, found no object'),
    "another format": ('{\n\n"reparam": 2}', ':3: expected "reparam": 1, found 2'),
    "deep": ("[" * 100_000, "too deep a nest"),
    "no scene": ('{"reparam": 1}', ":1: expected the name of a scene or of a file, found neither"),
    "both": (GOOD + ', "file": "x"}', ":3: expected the name of a scene or of a file, found both"),
    "unknown scene": (GOOD.replace("fig5", "fgi5") + "}", ":3: expected a scene ("),
    "unknown word": (GOOD + ',\n "size": 3}', ":4: expected one of reparam, scene, file"),
    "no section": (GOOD + ',\n "views": 3}', ":4: expected an object with names and values"),
    "unknown parameter": (
        GOOD + ',\n "parameters": {\n  "checks": 8,\n  "chekcs": 4}}',
        ":6: expected one of texture, checks",
    ),
    "of the display": (GOOD + ',\n "parameters": {"net": true}}', ":4: expected one of texture"),
    "wrong type": (
        GOOD + ',\n "parameters": {"checks": "8"}}',
        ":4: checks: expected a whole number from 1 to 256, found '8'",
    ),
    "truth for a number": (GOOD + ',\n "parameters": {"checks": true}}', "found True"),
    "out of range": (GOOD + ',\n "parameters": {"morph": 2}}', "a number from 0 to 1, found 2"),
    "wrong shape": (GOOD + ',\n "parameters": {"points": [[1, 2]]}}', ":4: points: expected 3 x 3"),
    "unknown space": (GOOD + ',\n "views":\n {"domian": {}}}', ":5: view: expected one of"),
    "bad view": (GOOD + ',\n "views": {"physical": {"zoom": 0}}}', ":4: expected zoom, pan [x, y]"),
    "odd view": (GOOD + ',\n "views": {"physical": {"roll": 0}}}', ":4: expected zoom, pan [x, y]"),
    "bad pivot": (GOOD + ',\n "views": {"body": {"pivot": [0, 0, 0, -1]}}}', ":4: expected zoom"),
    "bad pan": (GOOD + ',\n "views": {"physical": {"pan": [0]}}}', ":4: expected zoom, pan [x, y]"),
}  # fmt: skip


@pytest.mark.parametrize(("text", "complaint"), BAD.values(), ids=BAD)
def test_bad_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, complaint: str
) -> None:
    path = tmp_path / "bad.json"
    path.write_text(text)
    assert main(["render", str(path), "-o", str(tmp_path / "out.png")]) == 3
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"reparam: {path}:")
    assert complaint in line


def test_files_that_are_none(tmp_path: Path) -> None:
    (tmp_path / "folder.json").mkdir()
    (tmp_path / "latin.json").write_bytes(b'{"reparam": "\xe9"}')
    (tmp_path / "gone.json").write_text('{"reparam": 1, "file": "gone.bv"}')
    for name, found in {
        "none.json": "found no file",
        "folder.json": "found a directory",
        "latin.json": "expected UTF-8 text, found the byte 0xe9",
        "gone.json": "gone.bv: expected a readable .bv file, found no file",
    }.items():
        with pytest.raises(FileFormatError, match=found):
            open_subject(str(tmp_path / name))
