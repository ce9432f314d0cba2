"""What time does to the state: what glides, what plays, and lines that are seen for a while."""

from __future__ import annotations

import numpy as np
import pytest
from states import MIXED, opened, run

from reparam.viewer.stage import ANIMATION_SECONDS
from reparam.viewer.state import GLIDE_SECONDS
from reparam.viewer.window import hint


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
