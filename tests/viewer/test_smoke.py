"""A real window under Xvfb: keys and drags change the picture as they should, Escape closes it."""

from __future__ import annotations

import shlex
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from driver import SECONDS, SIZE, Screen, Window, same_picture, virtual_screen
from PIL import Image
from test_panel import Sheet

from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.inverse import invert
from reparam.gpu.arrangement import arrange
from reparam.snapshot import Studio
from reparam.subject import open_subject
from reparam.viewer.panel_style import WIDTH


@pytest.fixture(scope="module")
def display() -> Iterator[Screen]:
    with virtual_screen() as name:
        yield name


@pytest.fixture(scope="module")
def shared(display: Screen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """One window for the tests that leave no more behind than R puts back; Escape closes it."""
    opened = Window(display, tmp_path_factory.mktemp("window"))
    try:
        yield opened
        assert opened.close() == 0
    finally:
        opened.process.kill()
        opened.process.wait()


@pytest.fixture
def window(shared: Window) -> Window:
    shared.press("r", " reset")
    if "parameters reset" not in shared.log.read_text().splitlines()[-1]:
        shared.press("r", "parameters reset")
    return shared


def test_keys_change_the_picture_as_the_command_line_does(window: Window, studio: Studio) -> None:
    subject = open_subject("fig5")
    assert same_picture(window.screenshot(), studio.draw(subject, SIZE))
    for key, name, value in (
        ("t", "texture", "r"),
        ("c", "checks", 16),
        ("n", "net", True),
        ("w", "wireframe", True),
        ("minus", "level", 24),
    ):
        shown = "on" if value is True else value
        window.press(key, f"{name} = {shown}")
        subject = subject.changed(name, value)
        assert same_picture(window.screenshot(), studio.draw(subject, SIZE)), name
    window.press("F5", "shaders reloaded")
    window.press("4", "fig4: ")
    window.press("5", "fig5: ")


def test_a_dragged_point_moves_alone_and_undo_brings_the_picture_back(
    window: Window, studio: Studio
) -> None:
    subject = open_subject("fig5").changed("texture", "r")
    window.press("t", "texture = r")
    before = window.screenshot()
    assert same_picture(before, studio.draw(subject, SIZE))
    panel = arrange(subject.figure(), SIZE, {}, False, False)[0]
    region = panel.region
    x, y = panel.camera.pixels(np.zeros(3), region.width, region.height)
    window.drag((x, SIZE[1] - y - region.bottom), (24.0, -16.0), "c11 = (")
    place = window.log.read_text().rsplit("c11 = (", 1)[1].split(")")[0].split(", ")
    points = np.array(subject.value("points"))
    points[1, 1] = [float(c) for c in place]
    pixel = panel.camera.pixels(np.array([*points[1, 1], 0.0]), region.width, region.height)
    assert np.abs(pixel - (x, y) - (24.0, 16.0)).max() <= 1.0
    moved = studio.draw(subject.changed("points", points), SIZE)
    assert same_picture(window.screenshot(), moved)
    assert not same_picture(moved, before)
    window.press("ctrl+z", "undone: points")
    assert same_picture(window.screenshot(), before)
    window.press("ctrl+shift+z", "redone: points")
    assert same_picture(window.screenshot(), moved)


def test_what_is_kept_draws_the_same_picture_without_a_window(
    window: Window, studio: Studio
) -> None:
    window.press("t", "texture = r")
    window.press("n", "net = on")
    window.press("w", "wireframe = on")
    window.type_line("Return", "checks = 5", "checks = 5")
    window.point((SIZE[0] * 0.4, SIZE[1] * 0.4))
    window.xdotool("click", "4")  # the wheel
    picture = window.screenshot()
    window.press("ctrl+s", "saved ")
    saved = window.log.read_text().rsplit("saved ", 1)[1].splitlines()[0]
    assert same_picture(studio.draw(open_subject(saved), SIZE), picture)
    window.press("ctrl+c", "copied: ")
    words = shlex.split(window.log.read_text().rsplit("copied: ", 1)[1].splitlines()[0])
    assert "--view" in words
    command = [sys.executable, "-m", *words]
    subprocess.run(command, cwd=window.folder, env=window.environment, check=True)
    rendered = np.asarray(Image.open(window.folder / words[words.index("-o") + 1]))
    assert same_picture(rendered, picture)
    window.type_line("shift+s", "", "saved ")  # twice the size is offered
    large = window.last_picture()
    assert same_picture(large, studio.draw(open_subject(saved), (2 * SIZE[0], 2 * SIZE[1])))
    window.type_line("Return", "checks = 0", "expected a whole number from 1 to 256")
    window.xdotool_key("Escape")  # leaves the line, not the window
    assert same_picture(window.screenshot(), picture)


def test_the_divider_is_dragged(window: Window, studio: Studio) -> None:
    subject = open_subject("fig5").changed("compare", "texture=identity|r")
    window.press("x", "compare = texture=identity|r")
    assert same_picture(window.screenshot(), studio.draw(subject, SIZE))
    window.drag((SIZE[0] / 2 + 2, SIZE[1] * 0.7), (-82.0, 10.0), "divider = 0.25")
    moved = subject.changed("divider", 0.25)
    assert same_picture(window.screenshot(), studio.draw(moved, SIZE))
    window.press("ctrl+z", "undone: divider")
    window.press("b", "blend to 1")
    until = time.monotonic() + SECONDS
    faded = studio.draw(subject.changed("blend", 1.0), SIZE)
    while not same_picture(window.screenshot(), faded):
        assert time.monotonic() < until


def test_the_mouse_marks_one_point_in_three_spaces(tmp_path: Path, studio: Studio) -> None:
    size = (780, 360)
    subject = open_subject("fig6")
    panels = {p.space.name: p for p in arrange(subject.figure(), size, {}, False, False)}
    with virtual_screen() as own:
        window = Window(own, tmp_path, "fig6", "--size", f"{size[0]}x{size[1]}")
        for name, at in (("physical", (0.3, 0.7)), ("domain", (0.6, 0.25)), ("texture", (0, 1))):
            region, camera, net = panels[name].region, panels[name].camera, panels[name].space.map
            assert net is not None
            x, y = camera.pixels(project(evaluate(net, *at)), region.width, region.height)
            mouse = (round(x + region.left), round(size[1] - y - region.bottom))
            window.point(mouse)
            pixel = np.array([mouse[0] - region.left, size[1] - mouse[1] - region.bottom])
            u, v = invert(net, camera.in_view(pixel, region.width, region.height))
            assert (u, v) == pytest.approx(at, abs=0.05)
            expected = studio.draw(subject.changed("cursor", f"{u},{v}"), size)
            assert same_picture(window.screenshot(), expected), name
        window.press("d", "its domain is there already")
        window.press("5", "fig5: ")
        window.press("d", "linked = on")
        assert window.close() == 0


def test_the_panel_and_a_key_change_the_same_parameter(
    tmp_path: Path, studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    size = (780, 580)
    places = Sheet(monkeypatch, "fig5", size=size).places  # laid out here as it is there
    beside = (size[0] - int(WIDTH), size[1])
    subject = open_subject("fig5")
    with virtual_screen() as own:
        window = Window(own, tmp_path, "--size", f"{size[0]}x{size[1]}")
        window.point((100, 100))
        window.xdotool_key("Tab")
        assert same_picture(window.screenshot(), studio.draw(subject, beside))
        window.click(places["##net"], "net = on")
        on = subject.changed("net", True)
        assert same_picture(window.screenshot(), studio.draw(on, beside))
        window.press("n", "net = off")
        window.click(places["##net"], "net = on")
        window.click(places["r##texture"], "texture = r")
        window.press("t", "texture = identity")
        window.press("ctrl+z", "undone: texture = r")
        window.point(places["##image"])
        window.xdotool("click", "1", "type", "--delay", "1", "nt4")  # no keys of the window's
        window.xdotool_key("Escape")
        window.xdotool_key("Tab")
        final = on.changed("texture", "r")
        assert same_picture(window.screenshot(), studio.draw(final, size))
        assert window.close() == 0


def test_without_its_package_the_panel_says_how_to_get_it(tmp_path: Path) -> None:
    missing = "raise ModuleNotFoundError('no imgui_bundle here', name='imgui_bundle')"
    (tmp_path / "imgui_bundle.py").write_text(missing)  # the window's folder comes first
    with virtual_screen() as own:
        window = Window(own, tmp_path)
        window.press("Tab", "pip install imgui-bundle")
        window.press("t", "texture = r")
        assert window.close() == 0
