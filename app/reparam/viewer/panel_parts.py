"""What stands in the panel: made from the scene's parameters, claims and words alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from imgui_bundle import imgui

from ..errors import ReparamError
from ..scenes.parameters import Parameter
from ..scenes.registry import load_scene
from ..subject import DISPLAY
from .panel_style import BAD, FAINT, GOOD, HEADING
from .state import State
from .verdicts import Verdicts

NAMES = 0.30  # of the width: the column of parameters' names
SCENES = 0.40  # and of scenes'
LONG_RANGE = 64.0  # ratio of its ends: a whole number's slider goes by powers
HELD = ("level", "samples")  # costly: set only when the slider is let go


class Parts:
    """The panel's content, for the subject that the state has now."""

    def __init__(
        self,
        state: State,
        verdicts: Verdicts,
        open: Callable[[str], None],
        heading: imgui.ImFont,
    ) -> None:
        self._state = state
        self._verdicts = verdicts
        self._open_file = open
        self._heading = heading
        self._search = ""
        self._path = ""
        self._held: dict[str, float] = {}  # values that are being chosen, likewise
        self._typed: dict[str, str] = {}  # texts that are being typed, by the parameter's name

    def lay_out(self) -> None:
        """All of it, into the window that Dear ImGui is at."""
        subject = self._state.subject
        imgui.push_font(self._heading, HEADING)
        imgui.text_wrapped(subject.title)
        imgui.pop_font()
        if imgui.begin_tab_bar("tabs"):
            for title, part in (
                ("Scene", self._scene),
                ("Claims", self._claims),
                ("Open", self._open),
            ):
                opened, _ = imgui.begin_tab_item(title)
                if opened:
                    imgui.begin_child(title, imgui.ImVec2(0, 0), window_flags=0)
                    part()
                    imgui.end_child()
                    imgui.end_tab_item()
            imgui.end_tab_bar()

    # Parameters -----------------------------------------------------------------------------

    def _scene(self) -> None:
        subject = self._state.subject
        self._parameters("scene", subject.scene.parameters)
        _title("how it is drawn")
        self._parameters("display", DISPLAY)
        _title("what it shows")  # last: as its lines come and go no widget moves
        for line in self._caption():
            _colored(line, FAINT)

    def _caption(self) -> tuple[str, ...]:
        try:
            return self._state.snapshot().figure().caption
        except (ReparamError, ValueError):
            return ()

    def _parameters(self, name: str, parameters: Mapping[str, Parameter]) -> None:
        if not parameters or not imgui.begin_table(name, 2):
            return
        _columns(NAMES)
        for parameter in parameters.values():
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.align_text_to_frame_padding()
            imgui.text(parameter.name)
            _hint(parameter.help)
            imgui.table_next_column()
            imgui.set_next_item_width(-1.0)
            self._widget(parameter, self._state.subject.value(parameter.name))
            _hint(parameter.help)
        imgui.end_table()

    def _widget(self, parameter: Parameter, value: Any) -> None:
        name, mark = parameter.name, f"##{parameter.name}"
        if parameter.type is bool:
            changed, on = imgui.checkbox(mark, value)
            self._put(name, changed, on)
        elif parameter.choices:
            self._choice(parameter, value)
        elif parameter.range and parameter.type in (int, float):
            self._slider(parameter, value)
        elif parameter.type is int:
            self._put(name, *imgui.input_int(mark, value))
        elif parameter.type is float:
            self._put(name, *imgui.input_float(mark, value, format="%.6g"))
        else:
            self._text(parameter, value)

    def _choice(self, parameter: Parameter, value: str) -> None:
        if _buttons_width(parameter.choices) <= imgui.get_content_region_avail().x:
            for i, choice in enumerate(parameter.choices):
                if i:
                    imgui.same_line()
                if imgui.radio_button(f"{choice}##{parameter.name}", choice == value):
                    self._put(parameter.name, choice != value, choice)
        elif imgui.begin_combo(f"##{parameter.name}", value):
            for choice in parameter.choices:
                chosen, _ = imgui.selectable(choice, choice == value)
                self._put(parameter.name, chosen, choice)
            imgui.end_combo()

    def _slider(self, parameter: Parameter, value: float) -> None:
        interval, mark = parameter.range, f"##{parameter.name}"
        assert interval is not None
        value = self._held.get(parameter.name, value)
        new: float
        if parameter.type is int:
            powers = interval.low > 0 and interval.high / interval.low >= LONG_RANGE
            flags = imgui.SliderFlags_.logarithmic.value if powers else 0
            low, high = int(interval.low), int(interval.high)
            changed, new = imgui.slider_int(mark, int(value), low, high, flags=flags)
        else:
            changed, new = imgui.slider_float(mark, value, interval.low, interval.high, "%.4g")
            new = float(f"{new:.4g}")  # as it is shown, and not in float32
        if imgui.is_item_activated():
            self._state.begin_gesture()
        new = parameter.type(min(max(new, interval.low), interval.high))
        if parameter.name in HELD and imgui.is_item_active():
            self._held[parameter.name] = new
        else:
            self._put(parameter.name, changed, new)
        if imgui.is_item_deactivated():
            if parameter.name in self._held:
                self._put(parameter.name, True, self._held.pop(parameter.name))
            self._state.end_gesture()

    def _text(self, parameter: Parameter, value: Any) -> None:
        """A line of text counts when Enter is pressed or the field is left."""
        text = self._typed.get(parameter.name, parameter.text(value))
        _, text = imgui.input_text_with_hint(f"##{parameter.name}", parameter.help, text)
        if imgui.is_item_active():
            self._typed[parameter.name] = text
        elif parameter.name in self._typed:
            del self._typed[parameter.name]
            if text != parameter.text(value):  # Escape has put the old one back
                self._state.assign(parameter.name, text)

    def _put(self, name: str, changed: bool, value: Any) -> None:
        if changed:
            self._state.choose(name, value)

    # Claims ---------------------------------------------------------------------------------

    def _claims(self) -> None:
        verdicts, scene = self._verdicts, self._state.subject.scene
        imgui.begin_disabled(verdicts.running)
        if imgui.button("measure what this scene claims"):
            verdicts.begin(scene)
        imgui.end_disabled()
        if verdicts.scene is not scene:
            return
        if verdicts.trouble:
            _colored(verdicts.trouble, BAD)
        for verdict in verdicts.found:
            imgui.spacing()
            _colored("holds" if verdict.ok else "FAILS", GOOD if verdict.ok else BAD)
            imgui.same_line()
            _colored(verdict.equation, FAINT)
            imgui.text_wrapped(verdict.statement)
            for word, quantity in (("expected", verdict.expected), ("measured", verdict.measured)):
                _colored(f"{word}  {_number(quantity)}", FAINT)
            imgui.separator()
        if verdicts.running:
            imgui.text_disabled("measuring ...")
        elif not verdicts.found and not verdicts.trouble:
            imgui.text_disabled("it claims nothing")

    # Scenes and files -----------------------------------------------------------------------

    def _open(self) -> None:
        imgui.set_next_item_width(-1.0)
        _, self._search = imgui.input_text_with_hint("##search", "search scenes", self._search)
        if imgui.begin_table("scenes", 2):
            imgui.table_setup_column("name", imgui.TableColumnFlags_.width_stretch.value, SCENES)
            imgui.table_setup_column(
                "what", imgui.TableColumnFlags_.width_stretch.value, 1 - SCENES
            )
            words = self._search.lower().split()
            for name in self._state.pages():
                title = self._title_of(name)
                if all(word in f"{name} {title}".lower() for word in words):
                    self._page(name, title)
            imgui.end_table()
        _title("open a file")
        imgui.set_next_item_width(-1.0)
        entered, self._path = imgui.input_text_with_hint(
            "##path", "path of a surface, a saved scene, a picture", self._path,
            flags=imgui.InputTextFlags_.enter_returns_true.value,
        )  # fmt: skip
        if entered and self._path.strip():
            self._open_file(str(Path(self._path.strip()).expanduser()))
        imgui.text_disabled("or drop one onto the window")

    def _page(self, name: str, title: str) -> None:
        imgui.table_next_row()
        imgui.table_next_column()
        here = name == self._state.subject.scene.name
        whole = imgui.SelectableFlags_.span_all_columns.value
        chosen, _ = imgui.selectable(name, here, whole)
        _hint(title)
        imgui.table_next_column()
        imgui.text_disabled(title)
        if chosen:
            self._state.visit(name)

    def _title_of(self, name: str) -> str:
        subject = self._state.subject
        return subject.title if name == subject.scene.name else load_scene(name).title


def _buttons_width(choices: tuple[str, ...]) -> float:
    """Of radio buttons in a row."""
    style, button = imgui.get_style(), imgui.get_frame_height()
    gaps = style.item_inner_spacing.x * len(choices) + style.item_spacing.x * (len(choices) - 1)
    words = sum(imgui.calc_text_size(choice).x for choice in choices)
    return float(words + button * len(choices) + gaps)


def _columns(share: float) -> None:
    """Two columns of a table, the first one with that share of the width."""
    for name, part in (("left", share), ("right", 1.0 - share)):
        imgui.table_setup_column(name, imgui.TableColumnFlags_.width_stretch.value, part)


def _title(text: str) -> None:
    imgui.spacing()
    imgui.separator_text(text)


def _hint(text: str) -> None:
    if text and imgui.is_item_hovered():
        imgui.set_tooltip(text)


def _colored(text: str, color: tuple[float, float, float]) -> None:
    imgui.push_style_color(imgui.Col_.text.value, imgui.ImVec4(*color, 1.0))
    imgui.text_wrapped(text)
    imgui.pop_style_color()


def _number(quantity: Any) -> str:
    values = quantity if isinstance(quantity, (list, tuple)) else [quantity]
    return ",  ".join(f"{value:.10g}" for value in values)
