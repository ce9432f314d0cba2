"""What keys, mouse and time do to the state, without a window."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reparam.geometry.camera import View, frame
from reparam.scenes.cursor import Cursor
from reparam.scenes.registry import scene_names
from reparam.subject import open_subject
from reparam.viewer.keeping import Keeping
from reparam.viewer.keyboard import bind
from reparam.viewer.keys import KEYS
from reparam.viewer.side import Side
from reparam.viewer.stage import ANIMATION_SECONDS
from reparam.viewer.state import CHECKS, GLIDE_SECONDS, LEVELS, State
from reparam.viewer.window import Viewer, hint

MIXED = Path(__file__).parents[1] / "data" / "mixed.bv"
BOTH = ("vertex", "tessellation")


def opened(name: str = "fig5", *assignments: str) -> State:
    state = State(open_subject(name).assigned(assignments), BOTH, "vertex")
    state.advance(0.0)
    return state


def value(state: State, name: str) -> object:
    return state.subject.value(name)


def presses(state: State, press: Callable[[], None], name: str, times: int) -> list[object]:
    """The values of a parameter after each press."""
    values = []
    for _ in range(times):
        state.changed = False
        press()
        assert state.changed
        values.append(value(state, name))
    return values


def test_every_action_of_the_table_is_there() -> None:
    state = opened()
    bound = bind((Viewer, Keeping, Side, state))
    assert {name.upper() for key in KEYS for name in key.names} <= bound.keys()
    assert all(callable(method) for method, _ in bound.values())


def test_texture_checks_net_and_wireframe_come_round() -> None:
    state = opened()
    assert presses(state, state.next_texture, "texture", 2) == ["r", "identity"]
    assert presses(state, state.next_checks, "checks", 5) == [16, 32, 2, 4, 8]
    assert presses(state, state.toggle_net, "net", 2) == [True, False]
    assert presses(state, state.toggle_wireframe, "wireframe", 2) == [True, False]
    assert state.notice == "wireframe = off"


def test_checks_between_the_steps_go_up() -> None:
    for checks, following in ((5, 8), (64, CHECKS[0])):
        state = opened("fig5", f"checks={checks}")
        assert presses(state, state.next_checks, "checks", 1) == [following]


def test_level_goes_through_its_steps_and_stops_at_both_ends() -> None:
    state = opened()
    up = presses(state, lambda: state.change_level(1), "level", 9)
    assert up == [48, 64, 96, 128, 192, 256, 256, 256, 256]
    down = presses(state, lambda: state.change_level(-1), "level", 17)
    assert down == [*reversed(LEVELS[:-1]), 1, 1]
    assert presses(state, lambda: state.change_level(1), "level", 1) == [2]


@pytest.mark.parametrize(("level", "finer", "coarser"), [(1024, 1024, 256), (40, 48, 32)])
def test_a_level_beside_the_steps(level: int, finer: int, coarser: int) -> None:
    for direction, expected in ((1, finer), (-1, coarser)):
        state = opened("fig5", f"level={level}")
        state.change_level(direction)
        assert value(state, "level") == expected


def test_evaluator() -> None:
    state = opened()
    for expected in ("tessellation", "vertex"):
        state.next_evaluator()
        assert state.evaluator == expected
        assert state.notice == f"evaluator = {expected}"
    alone = State(open_subject("fig5"), ("vertex",), "vertex")
    alone.next_evaluator()
    assert alone.evaluator == "vertex"
    assert "the only one here" in alone.notice


def test_linked_is_for_what_has_patches_and_is_not_linked_by_itself() -> None:
    state = opened()
    assert presses(state, state.toggle_linked, "linked", 2) == [True, False]
    state.show_figure(6)
    state.toggle_linked()
    assert value(state, "linked") is False
    assert "there already" in state.notice


def test_the_cursor_is_no_step_to_undo() -> None:
    state = opened("fig6")
    state.changed = False
    state.point(Cursor(0.25, 0.75))
    assert state.changed
    state.changed = False
    state.point(Cursor(0.25, 0.75))
    assert not state.changed
    state.undo()
    assert state.notice == "nothing to undo"
    assert state.subject == open_subject("fig6")


def test_help() -> None:
    state = opened()
    for shown in (True, False):
        state.changed = state.refresh = False
        state.toggle_help()
        assert (state.help, state.changed, state.refresh) == (shown, False, True)


def run(state: State, start: float, seconds: float) -> list[float]:
    """The morph at 60 steps a second; it never leaves its range."""
    values = []
    for now in np.arange(start, start + seconds, 1 / 60):
        state.advance(float(now))
        values.append(float(state.subject.value("morph")))
    assert min(values) >= 0.0
    assert max(values) <= 1.0
    return values


@pytest.mark.parametrize("start", ["1", "0", "0.3", "0.7"])
def test_glide_ends_exactly_at_an_end(start: str) -> None:
    state = opened("fig5", f"morph={start}")
    end = 0.0 if float(start) >= 0.5 else 1.0
    state.glide()
    values = run(state, 0.0, GLIDE_SECONDS + 0.1)
    assert values[0] == pytest.approx(float(start), abs=1e-12)
    assert values[-1] == end
    assert not state.moving
    steps = np.diff(values)
    assert (steps <= 1e-12).all() if end == 0.0 else (steps >= -1e-12).all()
    assert np.abs(steps).max() < 0.05


def test_glide_there_and_back() -> None:
    state = opened()
    for begin, end in ((0.0, 0.0), (5.0, 1.0), (9.0, 0.0)):
        state.advance(begin)
        state.glide()
        assert run(state, begin, 1.0)[-1] == end


def test_play_goes_to_and_fro_and_stops_where_it_is() -> None:
    state = opened()
    state.play()
    assert state.moving
    values = run(state, 0.0, 2 * ANIMATION_SECONDS)
    assert values[0] == pytest.approx(1.0, abs=1e-12)
    assert values[len(values) // 2] == pytest.approx(0.0, abs=1e-3)
    assert values[-1] == pytest.approx(1.0, abs=1e-3)
    assert np.abs(np.diff(values)).max() < 0.02
    here = run(state, 2 * ANIMATION_SECONDS, 1.0)[-1]
    state.play()
    assert not state.moving
    assert state.notice == f"morph = {here:.2f}"
    assert run(state, 20.0, 1.0) == [here] * 60
    state.play()
    assert run(state, 21.0, 0.1)[-1] == pytest.approx(here, abs=0.1)


def test_space_stops_a_glide_too() -> None:
    state = opened()
    state.glide()
    here = run(state, 0.0, 0.3)[-1]
    assert 0.0 < here < 1.0
    state.play()
    assert run(state, 1.0, 0.3)[-1] == here


def test_what_a_file_has_not_is_said() -> None:
    state = opened(str(MIXED))
    for press in (state.glide, state.play):
        state.notice = ""
        press()
        assert "mixed.bv" in state.notice
        assert not state.moving
    assert hint(state.subject) == "T: the other texture map     drag a point     H: all keys"
    assert "M: morph" in hint(opened().subject)


def test_figures_and_pages_come_round() -> None:
    state = opened()
    for number in range(1, 10):
        before = state.subject.scene.name
        state.show_figure(number)
        there = f"fig{number}" in scene_names()
        assert state.subject.scene.name == (f"fig{number}" if there else before)
        assert there or state.notice == f"there is no figure {number} here"
    for direction in (1, -1):
        state = opened(scene_names()[0])
        seen = []
        for _ in scene_names():
            seen.append(state.subject.scene.name)
            state.turn_page(direction)
        assert sorted(seen) == scene_names()
        assert state.subject.scene.name == scene_names()[0]


def test_an_opened_file_is_a_page() -> None:
    state = opened(str(MIXED))
    body = state.subject.data["body"]
    state.turn_page(1)
    assert state.subject.scene.name == scene_names()[0]
    state.turn_page(-1)
    assert state.subject.data["body"] is body
    assert state.subject.title == "mixed.bv"


def test_scenes_remember_their_values_and_views() -> None:
    state = opened("fig5", "texture=r", "morph=0.4")
    state.pan("physical", 0.1, 0.2)
    views = dict(state.views)
    state.toggle_net()
    state.show_figure(4)
    assert state.views == {}
    assert value(state, "net") is True  # how things are displayed goes along
    assert value(state, "morph") == 1.0
    state.show_figure(5)
    assert (value(state, "texture"), value(state, "morph")) == ("r", 0.4)
    assert state.views == views


def test_a_new_page_stops_what_moves() -> None:
    state = opened()
    state.play()
    state.show_figure(4)
    assert not state.moving


def test_reset_takes_the_view_then_the_parameters() -> None:
    state = opened()
    state.next_texture()
    state.change_level(1)
    state.zoom("physical", 2.0, 0.0, 0.0)
    state.reset()
    assert state.notice == "view reset"
    assert (state.views, value(state, "texture")) == ({}, "r")
    state.reset()
    assert state.notice == "parameters reset"
    assert (value(state, "texture"), value(state, "level")) == ("identity", 32)
    assert state.subject == open_subject("fig5")


def test_reset_keeps_the_file() -> None:
    state = opened(str(MIXED))
    body = state.subject.data["body"]
    state.next_texture()
    state.reset()
    assert state.subject.data["body"] is body
    assert (state.subject.title, value(state, "texture")) == ("mixed.bv", "identity")


def test_random_keys_leave_no_value_out_of_range() -> None:
    state, random = opened(), np.random.default_rng(3)
    rows = [row for row in KEYS if hasattr(State, row.action)]
    for step in range(250):
        row = rows[random.integers(len(rows))]
        argument = row.arguments[random.integers(len(row.names))] if row.arguments else None
        getattr(state, row.action)(*(() if argument is None else (argument,)))
        state.advance(step * 0.1)
        for name, parameter in state.subject.parameters().items():
            assert np.array_equal(parameter.check(value(state, name)), value(state, name))
        assert state.evaluator in BOTH
        assert state.subject.figure().spaces


POINTS = np.array([[-1.65, -1.5, 0.0], [1.5, 1.65, 0.0]])


def at(state: State, point: tuple[float, float], size: tuple[int, int]) -> np.ndarray:
    camera = frame(POINTS, *size, state.view("physical"), False)
    return camera.pixels(np.array([*point, 0.0]), *size)


def test_zoom_keeps_the_point_under_the_mouse() -> None:
    state, size, point = opened(), (320, 240), (0.7, -0.4)
    state.pan("physical", -0.3, 0.2)
    before = at(state, point, size)
    for factor in (1.15, 3.0, 0.2, 1e9, 1e-9):
        camera = frame(POINTS, *size, state.view("physical"), False)
        unit = 2.0 * camera.half_height / size[1]
        x, y = (before - np.array(size) / 2) * unit
        state.zoom("physical", factor, x, y)
        assert at(state, point, size) == pytest.approx(before, abs=1e-6)
        assert 1e-2 <= state.view("physical").zoom <= 1e4


def test_pan_moves_by_what_the_mouse_moved() -> None:
    state, size = opened(), (320, 240)
    before = at(state, (0.0, 0.0), size)
    unit = 2.0 * frame(POINTS, *size, View(), False).half_height / size[1]
    state.pan("physical", 30 * unit, -20 * unit)
    assert at(state, (0.0, 0.0), size) - before == pytest.approx([30.0, -20.0])


def test_orbit_stops_at_the_poles() -> None:
    state = opened(str(MIXED))
    state.orbit("physical", 350.0, 500.0)
    assert state.view("physical").elevation == 90.0
    state.orbit("physical", 0.0, -500.0)
    assert state.view("physical").elevation == -90.0
    assert state.view("physical").azimuth == pytest.approx(290.0)


def test_a_notice_disappears_in_time(capsys: pytest.CaptureFixture[str]) -> None:
    state = opened()
    state.advance(10.0)
    state.say("here", 2.0)
    state.advance(60.0)  # as long as drawing may take
    assert state.notice == "here"
    state.advance(10.0)
    state.presented(10.0)
    state.presented(10.5)  # it began when it was seen first
    assert capsys.readouterr().out == "here\n"
    state.advance(11.0)
    assert (state.notice, state.seconds_of_notice()) == ("here", pytest.approx(1.0))
    state.changed = state.refresh = False
    state.advance(12.0)
    assert (state.notice, state.refresh, state.seconds_of_notice()) == ("", True, 0.0)
    assert not state.changed


def test_time_alone_changes_nothing() -> None:
    state = opened()
    state.changed = False
    for now in (1.0, 2.0, 1e6):
        state.advance(now)
        assert not state.changed
        assert not state.moving


def test_comparing_and_blending() -> None:
    state = opened("fig5", "texture=r")
    state.toggle_comparison()
    assert value(state, "compare") == "texture=identity|r"
    assert (value(state, "divider"), value(state, "texture")) == (0.5, "r")
    state.toggle_comparison()
    assert value(state, "compare") == ""
    state.blend()
    assert (value(state, "compare"), value(state, "divider")) == ("texture=identity|r", 1.0)
    for now in np.linspace(0.0, 4.0, 100):
        state.advance(float(now))
    assert (value(state, "blend"), state.moving) == (1.0, False)
    state.blend()
    for now in np.linspace(4.0, 8.0, 100):
        state.advance(float(now))
    assert value(state, "blend") == 0.0
    state.next_texture()  # the compared parameter itself: it shall be seen
    assert value(state, "compare") == ""
    state.toggle_comparison()
    state.show_figure(4)
    assert value(state, "compare") == ""


def test_comparing_with_before_the_last_change() -> None:
    state = opened()
    state.compare_last_change()
    assert "nothing to compare" in state.notice
    state.next_checks()
    state.toggle_net()
    state.compare_last_change()  # the control net is no parameter of the scene
    assert "nothing to compare" in state.notice
    state.undo()
    state.compare_last_change()
    assert value(state, "compare") == "checks=8|16"


def test_each_change_of_parameters_is_undone_and_made_again() -> None:
    state = opened("fig5", "morph=0.25")
    seen = [state.subject]
    for press in (state.next_texture, state.next_checks, state.toggle_net, state.glide):
        press()
        if state.moving:
            run(state, 0.0, 1.0)
        seen.append(state.subject)
    state.play()
    run(state, 1.0, 0.5)  # frames of an animation are no steps
    state.play()
    for subject in reversed(seen[:-1]):
        state.undo()
        assert state.subject is subject
    state.undo()
    assert state.notice == "nothing to undo"
    for before, subject in pairwise(seen[:4]):
        assert state.subject is before
        state.redo()
        assert state.subject is subject
    state.redo()
    assert state.subject.value("morph") == seen[-1].value("morph")
    state.redo()
    assert state.notice == "nothing to redo"
    state.undo()
    state.next_texture()
    state.redo()
    assert state.notice == "nothing to redo"


def test_undo_returns_to_the_scene_of_the_change() -> None:
    state = opened()
    state.next_texture()
    state.show_figure(4)
    state.undo()
    assert (state.subject.scene.name, value(state, "texture")) == ("fig5", "identity")
    state.show_figure(4)
    assert state.subject.scene.name == "fig4"
