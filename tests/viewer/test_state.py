"""What keys and mouse do to the state, without a window."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from states import BOTH, MIXED, opened, value

from reparam.geometry.camera import View, frame
from reparam.scenes.cursor import Cursor
from reparam.subject import open_subject
from reparam.viewer.keeping import Keeping
from reparam.viewer.keyboard import bind
from reparam.viewer.keys import KEYS
from reparam.viewer.side import Side
from reparam.viewer.state import CHECKS, LEVELS, State
from reparam.viewer.window import Viewer


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
