"""Figure 1 takes any change of variables, and refuses what is none in one line."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.geometry.change import NAMES
from reparam.scenes.layers import Curves, Dots, Figure
from reparam.subject import open_subject
from reparam.viewer.state import State


def images(figure: Figure) -> list[np.ndarray]:
    spaces = [space for space in figure.spaces if space.name.startswith("physical")]
    return [next(layer.at for layer in space.layers if isinstance(layer, Dots)) for space in spaces]


@pytest.mark.parametrize("change", [*NAMES, "u**3"])
@pytest.mark.parametrize("curve", ["diagonal", "parabola", "S"])
def test_dots_on_the_same_image(change: str, curve: str) -> None:
    subject = open_subject("fig1").changed("change", change).changed("curve", curve)
    figure = subject.figure()
    before, after = images(figure)
    assert len(before) == len(after) == 11
    assert np.abs(before[[0, -1]] - after[[0, -1]]).max() < 1e-12
    nets = [layer.net for s in figure.spaces for layer in s.layers if isinstance(layer, Curves)]
    assert np.array_equal(nets[0], nets[1])


def test_what_is_no_change() -> None:
    with pytest.raises(UsageError, match=r"^change: expected 2u to be 1 at u = 1, found 2$"):
        open_subject("fig1").assigned(["change=2u"]).figure()


def test_p_cycles_and_the_ant_walks_evenly(capsys: pytest.CaptureFixture[str]) -> None:
    state = State(open_subject("fig1").assigned(["change=u**3", "time=0"]), ("vertex",), "vertex")
    seen = []
    for _ in range(len(NAMES) + 1):
        state.next_change()
        seen.append(state.subject.value("change"))
    assert seen == [*NAMES, NAMES[0]]
    state.play()
    times = []
    for second in range(7):
        state.advance(float(second))
        times.append(state.subject.value("time"))
    steps = np.diff(np.unwrap(np.array(times) * 2 * np.pi)) / (2 * np.pi)
    assert np.abs(steps - 1 / 3).max() < 1e-12
    assert "change = identity" in capsys.readouterr().out


def test_a_formula_typed_in_the_window(capsys: pytest.CaptureFixture[str]) -> None:
    state = State(open_subject("fig1"), ("vertex",), "vertex")
    state.ask_for_parameter()
    state.type_text("change = 2u")
    state.type_key("ENTER")
    assert state.subject.value("change") == "square"
    assert state.notice == "change: expected 2u to be 1 at u = 1, found 2"
    state.type_key("ESC")
    state.ask_for_parameter()
    state.type_text("change = sin(pi u / 2)")
    state.type_key("ENTER")
    assert state.subject.value("change") == "sin(pi u / 2)"
    assert "expected 2u" in capsys.readouterr().out
