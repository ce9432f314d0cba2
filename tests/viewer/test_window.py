"""A real window: every key, densities, files dropped, and what a drag costs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from driver import (
    SECONDS,
    SIZE,
    Screen,
    Window,
    assert_no_complaint,
    same_picture,
    virtual_screen,
)

from reparam.gpu.arrangement import arrange
from reparam.scenes.registry import scene_names
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject
from reparam.viewer.keys import KEYS
from reparam.viewer.panel import WIDEST
from reparam.viewer.state import FIELD_OF_VIEW

HERE = Path(__file__).parent


@pytest.fixture
def older(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESA_GL_VERSION_OVERRIDE", "3.3")
    monkeypatch.setenv("MESA_GLSL_VERSION_OVERRIDE", "330")


@pytest.mark.usefixtures("older")
def test_a_window_with_opengl_3_3(studio: Studio, window: Window) -> None:
    """Before 4.0 the window's own buffer is no name for glDrawBuffers."""
    subject = open_subject("fig5")
    assert same_picture(window.screenshot(), studio.draw(subject, SIZE))
    window.press("t", "texture = r")
    assert same_picture(window.screenshot(), studio.draw(subject.changed("texture", "r"), SIZE))
    assert_no_complaint(window)


def test_files_dropped_a_size_of_nothing_and_the_cost_of_a_drag(
    screen: Screen, tmp_path: Path
) -> None:
    """Asked of the inside of a window: see inside.py."""
    app = str(HERE.parents[1] / "app")
    done = subprocess.run(
        [sys.executable, str(HERE / "inside.py")],
        cwd=tmp_path,
        env={**os.environ, "DISPLAY": screen.name, "PYTHONPATH": app},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    report: dict[str, Any] = json.loads(done.stdout.rsplit("REPORT ", 1)[1])
    assert report["shrunk"] == [False, False, True]
    assert report["drag"]["above"] <= 4.5 * report["drag"]["frame"], report["drag"]
    notices = [
        ("bad.bv:2: expected a number, found 'zero'", "fig5"),
        ("bad.json:2: expected a scene (", "fig5"),
        ("bad.png: expected a picture, found", "fig5"),
        ("notes.txt:1: expected a number, found 'hello'", "fig5"),
        ("none.bv: expected a readable .bv file, found no file", "fig5"),
        ("image = ", "fig5"),
        ("surface: good.bv", "surface"),
        ("fig4: The square and its image under r", "fig4"),
        ("The square and its image under r: has no place for a picture", "fig4"),
    ]
    for (name, found), (notice, scene) in zip(report["dropped"].items(), notices, strict=True):
        assert notice in found[0], name
        assert found[1:] == [scene, "GL_NO_ERROR"], name


def middle(studio_size: tuple[int, int]) -> tuple[float, float]:
    """Where the middle control point of r is in a window of that size, y down."""
    panel = arrange(open_subject("fig5").figure(), studio_size, {}, False, False)[0]
    x, y = panel.camera.pixels(np.zeros(3), panel.region.width, panel.region.height)
    return float(x) + panel.region.left, studio_size[1] - float(y) - panel.region.bottom


def test_a_screen_of_twice_the_density(tmp_path: Path) -> None:
    """What a hand reaches and reads there is twice as many pixels."""
    x, y = middle(SIZE)
    heights = {}
    for dots in (96, 192):
        with virtual_screen(dots) as screen:
            folder = tmp_path / str(dots)
            folder.mkdir()
            opened = Window(screen, folder)
            try:
                opened.press("n", "net = on")
                opened.press("n", "net = off")
                shown = screen.seen()[: SIZE[1], : SIZE[0]].astype(int)
                dark = (shown[:, 2] < 60).all(-1)  # the ground of the notice, beside its text
                heights[dots] = int(np.argmin(dark))
                start = (x + 12.0, y)  # too far from the point at 96 dots an inch
                if dots == 192:
                    opened.drag(start, (20.0, 0.0), "c11 = (")
                else:
                    before = opened.screenshot()
                    opened.drag(start, (20.0, 0.0))
                    opened.press("r", "view reset")
                    assert same_picture(opened.screenshot(), before)
                assert opened.close() == 0
            finally:
                opened.process.kill()
    assert heights[96] > 15
    assert heights[192] == pytest.approx(2 * heights[96], abs=3)


@pytest.mark.slow
def test_every_key_of_the_table(window: Window, screen: Screen, studio: Studio) -> None:
    """What it says, what it shows, and that the picture is the one without a window."""
    subject = open_subject("fig5")
    tried = set()

    def press(action: str, key: str, notice: str, **values: object) -> None:
        nonlocal subject
        tried.add(action)
        window.press(key, notice)
        for name, value in values.items():
            subject = subject.changed(name, value)
        assert same_picture(window.screenshot(), studio.draw(subject, SIZE)), action

    def follow(action: str, key: str, notice: str, there: Subject) -> None:
        nonlocal subject
        subject = there
        press(action, key, notice)

    press("next_texture", "t", "texture = r", texture="r")
    press("next_checks", "c", "checks = 16", checks=16)
    press("toggle_linked", "d", "linked = on", linked=True)
    press("toggle_linked", "d", "linked = off", linked=False)
    shading = subject.parameters()["shading"].following(subject.value("shading"))
    press("next_shading", "l", f"shading = {shading}", shading=shading)
    press("undo", "ctrl+z", "undone: shading", shading=open_subject("fig5").value("shading"))
    press("toggle_net", "n", "net = on", net=True)
    press("toggle_wireframe", "w", "wireframe = on", wireframe=True)
    press("toggle_perspective", "o", "perspective = 40", perspective=FIELD_OF_VIEW)
    press("toggle_perspective", "o", "perspective = 0", perspective=0.0)
    press("toggle_tolerance", "a", "tolerance = 0.5", tolerance=0.5)
    press("toggle_tolerance", "a", "tolerance = 0", tolerance=0.0)
    press("next_change", "p", "has no change")
    press("change_level", "plus", "level = 48", level=48)
    press("change_level", "minus", "level = 32", level=32)
    press("change_level", "minus", "level = 24", level=24)
    press("undo", "ctrl+z", "undone: level = 32", level=32)
    press("redo", "ctrl+y", "redone: level = 24", level=24)
    press("undo", "ctrl+z", "undone: level = 32", level=32)
    press("toggle_comparison", "x", "compare = texture", compare="texture=identity|r")
    press("toggle_comparison", "x", "compare = none", compare="")
    window.press("ctrl+z", "undone: compare")
    window.press("ctrl+z", "undone: compare")
    window.press("w", "wireframe = off")
    subject = subject.changed("wireframe", False)
    window.press("c", "checks = 32")
    press("compare_last_change", "shift+x", "compare = checks", compare="checks=16|32", checks=32)
    press("toggle_comparison", "x", "compare = none", compare="")
    evaluator = studio.evaluator
    studio.evaluator = "tessellation"
    press("next_evaluator", "e", "evaluator = tessellation")
    studio.evaluator = evaluator
    press("next_evaluator", "e", "evaluator = vertex")
    tried.add("glide")
    window.press("m", "morph to 0")
    time.sleep(1.5)
    subject = subject.changed("morph", 0.0)
    assert same_picture(window.screenshot(), studio.draw(subject, SIZE))
    tried.add("play")
    window.press("space", "animating morph")
    time.sleep(0.5)
    window.press("space", "morph = ")
    assert not same_picture(window.screenshot(), studio.draw(subject, SIZE))
    window.point((SIZE[0] / 3, SIZE[1] / 3))
    window.xdotool("click", "4")
    press("reset", "r", "view reset", morph=subject_morph(window))
    follow("reset", "r", "parameters reset", open_subject("fig5"))
    tried.add("blend")
    window.press("b", "blend to 1")
    time.sleep(4.0)
    faded = subject.changed("compare", "texture=identity|r").changed("divider", 1.0)
    faded = faded.changed("blend", 1.0)
    assert same_picture(window.screenshot(), studio.draw(faded, SIZE))
    window.press("r", "parameters reset")
    names = scene_names()
    for number in range(1, 10):
        name = f"fig{number}"
        window.press(str(number), f"{name}: " if name in names else f"no figure {number} here")
    tried.add("show_figure")
    window.press("4", "fig4: ")
    follow("turn_page", "Next", ": ", open_subject(names[(names.index("fig4") + 1) % len(names)]))
    follow("turn_page", "Prior", "fig4: ", open_subject("fig4"))
    tried |= check_what_only_the_window_shows(window, screen)
    assert tried >= {key.action for key in KEYS} - {"quit"}
    assert_no_complaint(window)
    assert window.close() == 0


def subject_morph(window: Window) -> float:
    """The morph that the picture has, by the command line it gives."""
    window.press("ctrl+c", "copied: ")
    text = window.log.read_text().rsplit("copied: ", 1)[1].splitlines()[0]
    return float(text.split("morph=")[1].split()[0])


def check_what_only_the_window_shows(window: Window, screen: Screen) -> set[str]:
    """Help, a line that is asked for, full screen; none of them is in a screenshot."""
    before, picture = screen.seen(), window.screenshot()
    for key in ("h", "F1"):
        window.xdotool_key(key)
        until = time.monotonic() + SECONDS
        changed = key == "h"
        while np.mean(screen.seen()[100:140, 100:200]) < 120 != changed:
            assert time.monotonic() < until
    window.type_line("Return", "level = 7", "level = 7")
    window.press("ctrl+z", "undone: level")
    window.type_line("shift+s", "1", "saved ")
    window.press("ctrl+s", "saved ")
    window.press("ctrl+c", "copied: ")
    window.press("F5", "shaders reloaded")
    assert same_picture(window.screenshot(), picture)
    window.xdotool_key("Tab")
    beside = SIZE[0] - round(WIDEST * SIZE[0])
    assert window.screenshot().shape == (SIZE[1], beside, 3)
    window.xdotool_key("Tab")
    window.xdotool_key("F11")
    time.sleep(1.0)
    assert window.screenshot().shape == (600, 800, 3)
    window.xdotool_key("F11")
    time.sleep(1.0)
    assert same_picture(window.screenshot(), picture)
    assert before.shape == (600, 800, 3)
    return {"toggle_help", "type_value", "ask_screenshot", "screenshot", "save_scene",
            "copy_command", "reload_shaders", "toggle_full_screen", "toggle_panel"}  # fmt: skip
