"""The panel at the window's right edge: Dear ImGui's frame, fed with the window's events.

What stands in it is in panel_parts.py. It is laid out anew only after an event, and then a few
times, since some things (a list that opens, a scroll bar) take Dear ImGui a frame more.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import glfw
from imgui_bundle import imgui

from ..gpu.painter import Painter
from ..gpu.widgets import Widgets
from .panel_parts import Parts
from .panel_style import WIDTH, load_fonts, set_style
from .state import State
from .verdicts import Verdicts

FRAMES = 3  # after an event
WIDEST = 0.6  # of the window
KEYS = {
    "LEFT": "left_arrow", "RIGHT": "right_arrow", "UP": "up_arrow", "DOWN": "down_arrow",
    "HOME": "home", "END": "end", "DELETE": "delete", "BACKSPACE": "backspace",
    "ENTER": "enter", "KP_ENTER": "keypad_enter", "ESCAPE": "escape", "TAB": "tab",
    "SPACE": "space", **{letter.upper(): letter for letter in "acvxyz"},
}  # fmt: skip
LEAVING = ("ESCAPE", "ENTER", "KP_ENTER")  # a field of text
MODIFIERS = (
    (glfw.MOD_CONTROL, imgui.Key.mod_ctrl),
    (glfw.MOD_SHIFT, imgui.Key.mod_shift),
    (glfw.MOD_ALT, imgui.Key.mod_alt),
    (glfw.MOD_SUPER, imgui.Key.mod_super),
)


class Panel:
    """Shown or hidden; takes the events that belong to it and hands on the others."""

    def __init__(
        self,
        window: Any,
        painter: Painter,
        state: State,
        verdicts: Verdicts,
        open: Callable[[str], None],
    ) -> None:
        self._window = window
        self._parts = Parts(state, verdicts, open, begin())
        self._share_clipboard()
        self._widgets = Widgets(painter.ctx, painter.programs)
        self._style_scale = 0.0
        self._state = state
        self._verdicts = verdicts
        self._frames = FRAMES
        self._last = glfw.get_time()
        self._left = False  # a key has just left a field
        self._pressed = False  # the button went down in here
        self._behind = False  # a click is not laid out yet
        self.shown = False
        self._take_events()

    def toggle(self) -> None:
        """Show or hide."""
        self.shown = not self.shown
        self.touch()

    def touch(self) -> None:
        """Something happened that it may show."""
        self._frames = FRAMES
        self._state.refresh = True

    @property
    def busy(self) -> bool:
        """Whether it wants another frame without an event."""
        return self.shown and (self._frames > 0 or self._verdicts.running)

    def width(self) -> int:
        """How many of the framebuffer's pixels it takes, from the right edge."""
        if not self.shown:
            return 0
        window, _ = glfw.get_window_size(self._window)
        pixels, _ = glfw.get_framebuffer_size(self._window)
        return round(self._units() * pixels / max(1, window))

    def _units(self) -> float:
        """The same in the window's units."""
        window, _ = glfw.get_window_size(self._window)
        return float(min(round(WIDTH * self._scale()), round(WIDEST * window)))

    def _scale(self) -> float:
        """The window's units for one at content scale 1."""
        window, _ = glfw.get_window_size(self._window)
        pixels, _ = glfw.get_framebuffer_size(self._window)
        return float(glfw.get_window_content_scale(self._window)[0]) * window / max(1, pixels)

    # Drawing --------------------------------------------------------------------------------

    def draw(self) -> None:
        """Lay out and draw, into the current framebuffer."""
        if not self.shown:
            return
        self._verdicts.step()
        self._frames = max(0, self._frames - 1)
        self._widgets.draw(self._lay_out())

    def _lay_out(self) -> imgui.ImDrawData:
        """What Dear ImGui makes of the events since the last time."""
        io, size = imgui.get_io(), glfw.get_window_size(self._window)
        pixels, now = glfw.get_framebuffer_size(self._window), glfw.get_time()
        io.display_size = imgui.ImVec2(*size)
        ratio = (pixels[0] / max(1, size[0]), pixels[1] / max(1, size[1]))
        io.display_framebuffer_scale = imgui.ImVec2(*ratio)
        io.delta_time = max(1e-4, now - self._last)
        self._last = now
        scale = self._scale()
        if scale != self._style_scale:
            set_style(scale)
            self._style_scale = scale
        laid_out = compose(self._parts, size, self._units())
        self._left = self._left and io.want_text_input
        return laid_out

    # Events ---------------------------------------------------------------------------------

    def _keyed(self, window: Any, key: int, scancode: int, action: int, mods: int) -> None:
        if not self._keeps_key(key, scancode, action, mods):
            self._on_key(window, key, scancode, action, mods)

    def _keeps_key(self, key: int, scancode: int, action: int, mods: int) -> bool:
        """A key went down or up; whether a field has it now."""
        if not self.shown:
            return False
        self._catch_up()
        io = imgui.get_io()
        for flag, modifier in MODIFIERS:
            io.add_key_event(modifier, bool(mods & flag))
        name, down = _key_name(key, scancode), action != glfw.RELEASE
        typing = self._typing()
        if name in KEYS and (typing or not down):
            io.add_key_event(imgui.Key[KEYS[name]], down)
        if typing:
            self._left = down and name in LEAVING
            self.touch()
        return typing

    def _typing(self) -> bool:
        """Whether a field has the keyboard; a key that leaves it may be known here alone yet."""
        return self.shown and bool(imgui.get_io().want_text_input) and not self._left

    def _catch_up(self) -> None:
        """Before a key: where frames are slow, the click into its field is not laid out yet."""
        for _ in range(FRAMES if self._behind else 0):
            self._lay_out()
        self._behind = False

    def _typed(self, window: Any, code: int) -> None:
        if self._typing():
            imgui.get_io().add_input_character(code)
            self.touch()
        else:
            self._on_char(window, code)

    def _take_events(self) -> None:
        """Stand before those who listen to the window by now."""
        window = self._window
        self._on_key = _after(glfw.set_key_callback, window, self._keyed)
        self._on_char = _after(glfw.set_char_callback, window, self._typed)
        self._on_move = _after(glfw.set_cursor_pos_callback, window, self._moved)
        self._on_button = _after(glfw.set_mouse_button_callback, window, self._clicked)
        self._on_scroll = _after(glfw.set_scroll_callback, window, self._scrolled)

    def _here(self) -> bool:
        """Whether the mouse is in the panel, or over a list that hangs out of it."""
        if not self.shown:
            return False
        x, _ = glfw.get_cursor_pos(self._window)
        window, _ = glfw.get_window_size(self._window)
        return bool(imgui.get_io().want_capture_mouse) or x >= window - self._units()

    def _moved(self, window: Any, x: float, y: float) -> None:
        was_here = self.shown and imgui.get_io().want_capture_mouse
        if self.shown:
            imgui.get_io().add_mouse_pos_event(x, y)
        if was_here or self._pressed or self._here():
            self.touch()
        if not self._pressed:
            self._on_move(window, x, y)

    def _clicked(self, window: Any, button: int, action: int, mods: int) -> None:
        pressed = action == glfw.PRESS
        if self.shown and button < 5:
            imgui.get_io().add_mouse_button_event(button, pressed)
            self.touch()
            self._behind = True
        if pressed:
            self._pressed, self._left = self._here(), False
        if not self._pressed:
            self._on_button(window, button, action, mods)
        elif not pressed:
            self._pressed = False

    def _scrolled(self, window: Any, x: float, y: float) -> None:
        if self._here():
            imgui.get_io().add_mouse_wheel_event(x, y)
            self.touch()
        else:
            self._on_scroll(window, x, y)

    def _share_clipboard(self) -> None:
        platform = imgui.get_platform_io()

        def read(_: Any) -> str:
            text: Any = glfw.get_clipboard_string(self._window) or b""
            return str(text.decode("utf-8", "replace"))

        def write(_: Any, text: str) -> None:
            glfw.set_clipboard_string(self._window, text)

        platform.platform_get_clipboard_text_fn = read
        platform.platform_set_clipboard_text_fn = write


def begin() -> imgui.ImFont:
    """A context of Dear ImGui that writes no files; the headings' face."""
    imgui.set_current_context(imgui.create_context())  # a first one would stay the current one
    io = imgui.get_io()
    io.set_ini_filename("")
    io.set_log_filename("")
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures.value
    io.config_input_text_cursor_blink = False  # an idle window stays idle
    return load_fonts()


def compose(parts: Parts, size: tuple[int, int], width: float) -> imgui.ImDrawData:
    """One frame of the panel at the right edge of a window of that size, in its units."""
    imgui.new_frame()
    imgui.set_next_window_pos(imgui.ImVec2(size[0] - width, 0))
    imgui.set_next_window_size(imgui.ImVec2(width, size[1]))
    flags = imgui.WindowFlags_
    fixed = flags.no_decoration.value | flags.no_move.value | flags.no_saved_settings.value
    imgui.begin("panel", flags=fixed)
    parts.lay_out()
    imgui.end()
    imgui.render()
    return imgui.get_draw_data()


def _after(
    setter: Callable[..., Any], window: Any, callback: Callable[..., None]
) -> Callable[..., None]:
    """Set a callback; the one that was there before, to hand on to."""
    before = setter(window, callback)
    return before if before is not None else lambda *_: None


def _key_name(key: int, scancode: int) -> str:
    """As GLFW's constants are called; letters by the user's own keyboard."""
    letter = glfw.get_key_name(key, scancode)
    if letter and key not in (glfw.KEY_KP_ENTER, glfw.KEY_SPACE):
        return str(letter).upper()
    names = (name for name in KEYS if len(name) > 1)
    return next((name for name in names if getattr(glfw, f"KEY_{name}") == key), "")
