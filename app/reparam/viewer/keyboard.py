"""The keyboard: the table's keys to methods, and letters to the line that is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import glfw

from .keys import KEYS
from .state import State

# Names of the table that are not GLFW's own.
NAMED = {"Esc": "ESCAPE", "PageDown": "PAGE_DOWN", "PageUp": "PAGE_UP"}
TYPED = {"+": ("+", "="), "-": ("-", "_")}  # `+` needs no Shift
KEYPAD = {glfw.KEY_KP_ADD: "+", glfw.KEY_KP_SUBTRACT: "-", glfw.KEY_KP_ENTER: "ENTER"}
KEYPAD |= {glfw.KEY_KP_1 + i: str(1 + i) for i in range(9)}

Action = Callable[..., None]


class Keyboard:
    """Listens to a window. `guard(method, *arguments)` calls a method and shows what it raises."""

    def __init__(
        self, window: Any, state: State, actors: Sequence[object], guard: Callable[..., None]
    ) -> None:
        self._window = window
        self._state = state
        self._guard = guard
        self._actions = bind(actors)
        self._opened_by_key = False  # the letter that opened a prompt does not go into it
        glfw.set_key_callback(window, self._on_key)
        glfw.set_char_callback(window, self._on_char)

    def _on_key(self, _: Any, key: int, scancode: int, action: int, mods: int) -> None:
        if action == glfw.RELEASE or mods & glfw.MOD_ALT:
            return
        self._opened_by_key = False
        name = key_name(key, scancode)
        held = "CTRL+" if mods & (glfw.MOD_CONTROL | glfw.MOD_SUPER) else ""
        if self._state.prompt is not None:
            self._guard(self._type, held + name)
            return
        plain = self._actions.get(held + name)  # Shift changes nothing but what it names
        shifted = f"{held}SHIFT+{name}" if mods & glfw.MOD_SHIFT else ""
        method, arguments = self._actions.get(shifted, plain) or (None, ())
        if method is None or (action == glfw.REPEAT and not arguments):
            return  # a key held down repeats only what goes on: levels and pages
        self._guard(method, *arguments)
        self._opened_by_key = self._state.prompt is not None

    def _type(self, name: str) -> None:
        """A key while a line of text is asked for."""
        if name == "CTRL+V":
            text: Any = glfw.get_clipboard_string(self._window) or b""
            letters = text.decode("utf-8", "replace")
            self._state.type_text("".join(c for c in letters if c.isprintable()))
        self._state.type_key(name)

    def _on_char(self, _: Any, code: int) -> None:
        if not self._opened_by_key:
            self._state.type_text(chr(code))
        self._opened_by_key = False


def bind(actors: Sequence[object]) -> dict[str, tuple[Action, tuple[int, ...]]]:
    """Method, of the first actor that has it, and arguments by the key's name."""
    bound = {}
    for key in KEYS:
        actor = next(actor for actor in actors if hasattr(actor, key.action))
        for i, name in enumerate(key.names):
            for typed in TYPED.get(name, (name,)):
                bound[typed.upper()] = (getattr(actor, key.action), key.arguments[i : i + 1])
    return bound


def key_name(key: int, scancode: int) -> str:
    """The key as the table names it: letters by the user's own keyboard layout."""
    if key in KEYPAD:
        return KEYPAD[key]
    if key == glfw.KEY_BACKSPACE:
        return "BACKSPACE"
    printable = glfw.get_key_name(key, scancode)
    if printable:
        return str(printable).upper()
    for name in (name for row in KEYS for name in row.names):
        constant = getattr(glfw, "KEY_" + NAMED.get(name, name).upper(), None)
        if constant is not None and constant == key:
            return name.upper()
    return ""
