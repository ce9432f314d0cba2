"""A line of text asked for in the window: coordinates of a point, or a parameter."""

from __future__ import annotations

import pytest
from test_hand import MIDDLE, Table

from reparam.subject import open_subject
from reparam.viewer.state import State


def typed(state: State, text: str) -> None:
    for letter in text:
        state.type_text(letter)
    state.type_key("ENTER")


def test_coordinates_are_set_as_they_are_typed() -> None:
    table = Table()
    table.hand.point_at(*table.pixel(MIDDLE), 1.0)
    table.hand.ask()
    prompt = table.state.prompt
    assert prompt is not None
    assert (prompt.title, prompt.text) == ("c11 =  x, y", "0, 0")
    typed(table.state, "0.1, -1e-3")
    assert table.state.prompt is None
    assert table.points()[1, 1].tolist() == [0.1, -1e-3]
    assert table.state.notice == "c11 = (0.1, -0.001)"
    table.state.undo()
    assert table.points()[1, 1].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("text", ["", "1", "1, 2, 3", "1, x", "nan, 0", "0, 1e300"])
def test_bad_coordinates_stay_to_be_mended(text: str) -> None:
    table = Table()
    table.hand.point_at(*table.pixel(MIDDLE), 1.0)
    table.hand.ask()
    table.state.type_key("BACKSPACE")  # takes all of what was only proposed
    before = table.state.subject
    typed(table.state, text)
    assert table.state.notice == f"expected 2 numbers, found {text!r}"
    assert table.state.prompt is not None
    assert table.state.prompt.text == text
    assert table.state.subject is before
    table.state.type_key("ESC")
    assert table.state.prompt is None


def test_without_a_point_a_parameter_is_asked_for() -> None:
    table = Table()
    for text, notice in (
        ("checks = 5", "checks = 5"),
        ("net=1", "net = on"),
        ("texture=q", "texture: expected identity or r, found 'q'"),
        ("textur=r", "--set: expected one of"),
        ("level", "--set: expected NAME=VALUE, found 'level'"),
    ):
        table.hand.ask()
        typed(table.state, text)
        assert table.state.notice.startswith(notice)
        table.state.type_key("ESC")
    assert (table.state.subject.value("checks"), table.state.subject.value("net")) == (5, True)


def test_where_a_point_is_asked_for_a_parameter_will_do() -> None:
    table = Table()
    table.hand.point_at(*table.pixel(MIDDLE), 1.0)
    table.hand.ask()
    typed(table.state, "checks = 6")
    assert (table.state.subject.value("checks"), table.state.prompt) == (6, None)


def test_keys_edit_the_line() -> None:
    state = State(open_subject("fig5"), ("vertex",), "vertex")
    heard: list[str] = []
    state.type_text("x")  # nothing is asked for
    state.type_key("ENTER")
    state.ask("what?", heard.append, "7")
    state.type_text("a")  # begins anew
    state.type_text("bc")
    state.type_key("BACKSPACE")
    state.type_key("F5")
    state.type_key("ENTER")
    state.ask("what?", heard.append, "7")
    state.type_key("ENTER")
    assert heard == ["ab", "7"]
