"""The panel without a window: every widget is found, clicked, and changes what its key changes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from imgui_bundle import imgui

from reparam.scenes.claims import Claim
from reparam.scenes.registry import load_scene
from reparam.snapshot import Studio
from reparam.subject import DISPLAY, open_subject
from reparam.viewer import panel_parts
from reparam.viewer.panel import begin, compose
from reparam.viewer.panel_parts import Parts
from reparam.viewer.panel_style import WIDTH, set_style
from reparam.viewer.state import State
from reparam.viewer.verdicts import Verdicts

SIZE = (780, 900)
WIDGETS = ("checkbox", "radio_button", "slider_int", "slider_float", "input_text_with_hint",
           "button", "begin_combo", "begin_tab_item", "selectable")  # fmt: skip
MIXED = Path(__file__).parents[1] / "data" / "mixed.bv"


class Sheet:
    """The panel's frames in a context of their own, and where each widget was laid out."""

    def __init__(
        self,
        monkeypatch: pytest.MonkeyPatch,
        scene: str,
        measure: Any = None,
        size: tuple[int, int] = SIZE,
    ) -> None:
        self.size = size
        self.opened: list[str] = []
        self.state = State(open_subject(scene), ("vertex",), "vertex")
        self.verdicts = Verdicts(lambda: measure)
        self.parts = Parts(self.state, self.verdicts, self.opened.append, begin())
        self.places: dict[str, tuple[float, float]] = {}
        set_style(1.0)
        for name in WIDGETS:
            monkeypatch.setattr(panel_parts.imgui, name, self.noting(getattr(imgui, name)))
        self.frames()

    def noting(self, widget: Callable[..., Any]) -> Callable[..., Any]:
        def noted(label: str, *arguments: Any, **named: Any) -> Any:
            result = widget(label, *arguments, **named)
            low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
            self.places[label] = ((low.x + high.x) / 2, (low.y + high.y) / 2)
            return result

        return noted

    def frames(self, count: int = 3) -> None:
        for _ in range(count):
            io = imgui.get_io()
            io.display_size = imgui.ImVec2(*self.size)
            io.delta_time = 1 / 60
            self.places.clear()
            compose(self.parts, self.size, WIDTH)

    def press(self, label: str, share: float | None = None) -> None:
        """The mouse button down and up on a widget; at a share of its width from the left."""
        x, y = self.places[label]
        if share is not None:
            x += (share - 0.5) * 200.0
        io = imgui.get_io()
        io.add_mouse_pos_event(x, y)
        self.frames()
        for down in (True, False):
            io.add_mouse_button_event(0, down)
            self.frames()

    def type(self, label: str, text: str) -> None:
        """Text instead of what the field holds, then Enter."""
        self.press(label)
        io = imgui.get_io()
        for key in (imgui.Key.mod_ctrl, imgui.Key.a):
            io.add_key_event(key, True)
        self.frames()
        for key in (imgui.Key.a, imgui.Key.mod_ctrl):
            io.add_key_event(key, False)
        io.add_input_characters_utf8(text)
        self.frames()
        for down in (True, False):
            io.add_key_event(imgui.Key.enter, down)
            self.frames()

    def value(self, name: str) -> Any:
        return self.state.subject.value(name)


@pytest.fixture
def sheet(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Sheet]]:
    before = imgui.get_current_context()

    def make(scene: str = "fig5", measure: Any = None) -> Sheet:
        return Sheet(monkeypatch, scene, measure)

    yield make
    imgui.destroy_context(imgui.get_current_context())
    if before is not None:
        imgui.set_current_context(before)


def test_every_parameter_has_a_widget(sheet: Callable[..., Sheet]) -> None:
    for scene in ("fig5", "fig4", str(MIXED)):
        here = sheet(scene)
        for name, parameter in here.state.subject.parameters().items():
            buttons = [f"{choice}##{name}" for choice in parameter.choices]
            assert f"##{name}" in here.places or set(buttons) <= set(here.places), name


def test_a_checkbox_and_its_key_change_the_same_parameter(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    for name, key in (("net", here.state.toggle_net), ("wireframe", here.state.toggle_wireframe)):
        here.press(f"##{name}")
        assert here.value(name) is True
        assert here.state.notice == f"{name} = on"
        key()
        assert here.value(name) is False
        here.frames()
        here.press(f"##{name}")
        assert here.value(name) is True
    here.press("r##texture")
    assert here.value("texture") == "r"
    here.state.next_texture()
    assert here.value("texture") == "identity"


def test_many_choices_hang_out_as_a_list(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    assert "light##shading" not in here.places
    here.press("##shading")
    here.press("zebra")
    assert here.value("shading") == "zebra"


def test_a_slider_goes_where_it_is_pressed_as_one_step_to_undo(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    here.press("##morph", 0.25)
    assert here.value("morph") == pytest.approx(0.25, abs=0.05)
    x, y = here.places["##morph"]
    io = imgui.get_io()
    io.add_mouse_button_event(0, True)
    here.frames()
    for way in (20.0, 40.0, 60.0):
        io.add_mouse_pos_event(x + way, y)
        here.frames()
    io.add_mouse_button_event(0, False)
    here.frames()
    assert here.value("morph") == pytest.approx(0.8, abs=0.05)
    here.state.undo()
    assert here.value("morph") == pytest.approx(0.25, abs=0.05)
    here.state.undo()
    assert here.value("morph") == 1.0


def test_a_whole_number_goes_by_powers_and_the_level_waits(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    here.press("##checks", 0.75)
    assert 32 < here.value("checks") < 128
    assert isinstance(here.value("checks"), int)
    x, y = here.places["##level"]
    io = imgui.get_io()
    io.add_mouse_pos_event(x + 80.0, y)
    here.frames()
    io.add_mouse_button_event(0, True)
    here.frames()
    assert here.value("level") == 32
    io.add_mouse_button_event(0, False)
    here.frames()
    assert here.value("level") > 200


def test_text_counts_at_enter_and_wrong_text_is_told(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    here.type("##cursor", "0.25,0.5")
    assert here.value("cursor") == "0.25,0.5"
    here.type("##cursor", "here")
    assert here.value("cursor") == "0.25,0.5"
    assert here.state.notice.startswith("cursor: expected u,v from 0 to 1")
    square = "[[[-1,1],[0,1],[1,1]],[[-1,0],[0,0],[1,0]],[[-1,-1],[0,-1],[1,-1]]]"
    here.type("##points", square)
    assert np.array_equal(here.value("points")[0], [[-1, 1], [0, 1], [1, 1]])
    assert imgui.get_io().want_text_input is False


def test_escape_leaves_the_text_as_it_was_and_no_bad_picture_is_set(
    sheet: Callable[..., Sheet],
) -> None:
    here = sheet()
    here.press("##image")
    io = imgui.get_io()
    io.add_input_characters_utf8("nt4")
    here.frames()
    for down in (True, False):
        io.add_key_event(imgui.Key.escape, down)
        here.frames()
    assert (here.value("image"), here.state.notice) == ("", "")
    here.type("##image", "nt4")
    assert here.value("image") == ""
    assert here.state.notice == "nt4: expected a picture, found no such file"
    here.type("##image", "corners")
    assert here.value("image") == "corners"


def test_the_keyboard_is_wanted_while_text_is_typed(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    assert imgui.get_io().want_text_input is False
    here.press("##image")
    assert imgui.get_io().want_text_input is True
    assert imgui.get_io().want_capture_mouse is True


def test_scenes_are_searched_and_chosen(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    here.press("Open")
    assert {"fig4", "fig5", "fig6"} <= set(here.places)
    here.type("##search", "three spaces")
    assert "fig6" in here.places
    assert "fig4" not in here.places
    here.press("fig6")
    assert here.state.subject.scene.name == "fig6"


def test_a_file_is_opened_by_its_path(sheet: Callable[..., Sheet]) -> None:
    here = sheet()
    here.press("Open")
    here.type("##path", f" {MIXED} ")
    here.type("##path", "  ")
    assert here.opened == [str(MIXED)]


def test_claims_are_measured_when_asked(sheet: Callable[..., Sheet], studio: Studio) -> None:
    here = sheet("fig6", studio)
    here.press("Claims")
    assert not here.verdicts.running
    here.press("measure what this scene claims")
    assert here.verdicts.running
    while here.verdicts.running:
        here.verdicts.step()
        here.frames(1)
    scene = load_scene("fig6")
    found = here.verdicts.found
    assert [verdict.statement for verdict in found] == [each.statement for each in scene.claimed()]
    assert all(verdict.ok for verdict in found)
    assert [verdict.measured for verdict in found][-1] == 1.0  # of the GPU


def test_a_claim_that_cannot_be_measured_is_told_and_ends_it() -> None:
    def impossible(_: object) -> float:
        raise ValueError("no such thing")

    scene = load_scene("fig4")
    verdicts = Verdicts(lambda: None)  # type: ignore[arg-type,return-value]
    verdicts.begin(scene)
    claims = [Claim("(1)", "one", 1.0, 1.0, 0.0), Claim("(2)", "two", 1.0, impossible, 0.0)]
    verdicts._claims = iter(claims)
    for _ in range(3):
        verdicts.step()
    assert [verdict.ok for verdict in verdicts.found] == [True]
    assert verdicts.trouble == "no such thing"
    assert not verdicts.running


def test_display_parameters_are_all_of_the_kinds_that_have_widgets() -> None:
    assert {p.type for p in DISPLAY.values()} <= {bool, int, float, str}
