"""The window: glfw's events in, the painter's frame out."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import glfw
import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError, ReparamError, UsageError
from ..files.output import check_output, save_picture
from ..frame import draw_subject
from ..gpu.context import create_for_window
from ..gpu.diagnosis import explain
from ..gpu.painter import Painter, Panel
from ..gpu.targets import Target
from ..saving import command, save
from ..subject import Subject
from .keys import KEYS
from .mouse import Mouse
from .overlay import draw_grid, draw_grip, draw_handles, draw_help, draw_notice, draw_prompt
from .screen import screen_missing
from .state import State

FRAME_SECONDS = 1 / 60

# What a scene, or a shader just edited, may raise: shown, and the window stays.
UNDRAWABLE = (ReparamError, ValueError, OSError, AssertionError, moderngl.Error)

# Names of the table that are not GLFW's own.
NAMED = {"Esc": "ESCAPE", "PageDown": "PAGE_DOWN", "PageUp": "PAGE_UP"}
TYPED = {"+": ("+", "="), "-": ("-", "_")}  # `+` needs no Shift
KEYPAD = {glfw.KEY_KP_ADD: "+", glfw.KEY_KP_SUBTRACT: "-", glfw.KEY_KP_ENTER: "ENTER"}
KEYPAD |= {glfw.KEY_KP_1 + i: str(1 + i) for i in range(9)}


def show(subject: Subject, size: tuple[int, int], evaluator: str | None) -> int:
    """Open the window and stay until it is closed. Raises GraphicsError where there is none."""
    missing = screen_missing()
    if missing is not None:
        name = "FILE" if subject.data else subject.scene.name
        raise GraphicsError(f"{missing}; without one: reparam render {name} -o OUT.png")
    window = open_window(size, f"reparam: {subject.title}")
    try:
        Viewer(window, subject, evaluator).run()
    finally:
        glfw.terminate()
    return 0


def open_window(size: tuple[int, int], title: str, visible: bool = True) -> Any:
    """A window with OpenGL 4.1 core, or 3.3 where there is no more. Raises GraphicsError."""
    glfw.ERROR_REPORTING = "ignore"  # asked for by get_error instead
    if not glfw.init():
        raise GraphicsError(explain(str(glfw.get_error()[1] or "glfw.init failed")))
    for major, minor in ((4, 1), (3, 3)):
        glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, major)
        glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, minor)
        glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
        glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
        glfw.window_hint(glfw.VISIBLE, visible)
        window = glfw.create_window(*size, title, None, None)
        if window:
            glfw.make_context_current(window)
            glfw.swap_interval(1)
            return window
    reason = str(glfw.get_error()[1] or "glfw.create_window failed")
    glfw.terminate()
    raise GraphicsError(explain(reason))


class Viewer:
    """One window. Keys call methods of this class or of its state, as the table of keys says."""

    def __init__(self, window: Any, subject: Subject, evaluator: str | None) -> None:
        self._window = window
        self._ctx = create_for_window()
        self._painter = Painter(self._ctx)
        capabilities = self._painter.capabilities
        evaluators = ("vertex", "tessellation") if capabilities.tessellation else ("vertex",)
        self.state = State(subject, evaluators, capabilities.evaluator(evaluator))
        self._target: Target | None = None
        self._samples = 0  # asked for when the target was made
        self._mouse = Mouse(window, self.state)
        self._windowed: tuple[int, int, int, int] | None = None
        self._began = time.perf_counter()
        self._actions = self._bind_keys()
        self._typed_by_key = False  # the letter that opened a prompt does not go into it
        glfw.set_key_callback(window, self._on_key)
        glfw.set_char_callback(window, self._on_char)
        glfw.set_framebuffer_size_callback(window, self._on_damage)
        glfw.set_window_refresh_callback(window, self._on_damage)
        self.state.say(hint(subject), 6.0)

    def run(self) -> None:
        """Until the window is closed: wait, and draw only what changed."""
        while not glfw.window_should_close(self._window):
            self._tick()
            self._mouse.settle()
            began = time.perf_counter()
            if drew := self._draw_changes():
                time.sleep(max(0.0, began + FRAME_SECONDS - time.perf_counter()))
            if self.state.moving:
                glfw.wait_events_timeout(1e-3 if drew else FRAME_SECONDS)
            elif self.state.notice:
                glfw.wait_events_timeout(max(1e-3, self.state.seconds_of_notice()))
            else:
                glfw.wait_events()

    def _tick(self) -> None:
        self.state.advance(time.perf_counter() - self._began)

    # Drawing --------------------------------------------------------------------------------

    def _draw_changes(self) -> bool:
        """What is to be drawn again, if anything; whether it was."""
        if self.state.changed:
            return self._draw()
        if self.state.refresh and self._target is not None:
            self._present(self._target)
            return True
        return False

    def _draw(self) -> bool:
        """Draw a frame; whether it could be done. Nothing while iconified."""
        size = glfw.get_framebuffer_size(self._window)
        if min(size) < 1:
            return False
        self.state.changed = False
        glfw.set_window_title(self._window, f"reparam: {self.state.subject.title}")
        try:
            target = self._draw_frame(size)
        except UNDRAWABLE as error:
            self.state.say(str(error), 8.0)
            if self._target is None or self._target.size != size:
                return False
            target = self._target
        self._present(target)
        return True

    def _draw_frame(self, size: tuple[int, int]) -> Target:
        subject = self.state.subject
        self._mouse.hand.steady()
        self._renew_target(size, subject.display.samples)
        assert self._target is not None
        self._mouse.see(self._paint(self._target))
        return self._target

    def _paint(self, target: Target) -> list[Panel]:
        subject, evaluator = self.state.snapshot(), self.state.evaluator
        return draw_subject(self._painter, subject, target, evaluator=evaluator)

    def _renew_target(self, size: tuple[int, int], samples: int) -> None:
        """A target of that size and with that many samples, the present one if it is so."""
        if self._target is not None and (self._target.size, self._samples) == (size, samples):
            return
        if self._target is not None:
            self._target.release()
            self._target = None
        self._target = Target(self._ctx, size, samples, self._painter.capabilities)
        self._samples = samples

    def _present(self, target: Target) -> None:
        """The frame onto the screen, and over it what only the window has."""
        self.state.refresh = False
        target.show()
        self._draw_hand(target.size)
        if self.state.help:
            draw_help(self._painter.labels, target.size)
        if (prompt := self.state.prompt) is not None:
            draw_prompt(self._painter.labels, prompt, target.size)
        if self.state.notice:
            draw_notice(self._painter.labels, self.state.notice, target.size)
        glfw.swap_buffers(self._window)

    def _draw_hand(self, size: tuple[int, int]) -> None:
        """The handles, while somebody is there to drag them."""
        hand, display = self._mouse.hand, self.state.subject.display
        if self._mouse.inside or hand.held or display.net:
            draw_handles(self._painter, hand, size, display.net)
        if (grip := hand.chosen if hand.held else hand.over) is not None:
            panel = hand.panel(grip.space)
            if hand.snapping and panel is not None:
                draw_grid(self._painter.labels, panel, size, self._mouse.scale())
            draw_grip(self._painter, hand, grip, size)

    # Keys -----------------------------------------------------------------------------------

    def _bind_keys(self) -> dict[str, tuple[Any, tuple[int, ...]]]:
        """Method and arguments by the key's name."""
        bound = {}
        for key in KEYS:
            method = getattr(self, key.action, None) or getattr(self.state, key.action)
            for i, name in enumerate(key.names):
                for typed in TYPED.get(name, (name,)):
                    bound[typed.upper()] = (method, key.arguments[i : i + 1])
        return bound

    def _on_key(self, _: Any, key: int, scancode: int, action: int, mods: int) -> None:
        if action == glfw.RELEASE or mods & glfw.MOD_ALT:
            return
        name, nothing = key_name(key, scancode), (None, ())
        held = "CTRL+" if mods & (glfw.MOD_CONTROL | glfw.MOD_SUPER) else ""
        self._typed_by_key = False
        if self.state.prompt is not None:
            self._tick()
            self._type(held + name)
            return
        plain = self._actions.get(held + name, nothing)  # Shift changes nothing but what it names
        shifted = f"{held}SHIFT+{name}" if mods & glfw.MOD_SHIFT else ""
        method, arguments = self._actions.get(shifted, plain)
        if method is None or (action == glfw.REPEAT and not arguments):
            return  # a key held down repeats only what goes on: levels and pages
        self._tick()  # the clock stood still while the window waited for this key
        method(*arguments)
        self._typed_by_key = self.state.prompt is not None

    def _type(self, name: str) -> None:
        """A key while a line of text is asked for."""
        if name == "CTRL+V":
            text: Any = glfw.get_clipboard_string(self._window) or b""
            letters = text.decode("utf-8", "replace")
            self.state.type_text("".join(c for c in letters if c.isprintable()))
        self.state.type_key(name)

    def _on_char(self, _: Any, code: int) -> None:
        if not self._typed_by_key:
            self.state.type_text(chr(code))
        self._typed_by_key = False

    def type_value(self) -> None:
        """Ask for the coordinates of a point, or for a parameter."""
        self._mouse.hand.ask()

    # Files ----------------------------------------------------------------------------------

    def screenshot(self, times: int = 1) -> None:
        """The frame, without what the window adds, into the next free file of the folder."""
        self._mouse.settle()
        if self.state.changed:
            self._draw()  # what a key or the mouse did just now belongs to it
        if self._target is None:
            return
        try:
            path = check_output(self._free_path(".png"))
            save_picture(self._target.pixels() if times == 1 else self._enlarged(times), path)
            self.state.say(f"saved {path}")
        except ReparamError as error:
            self.state.say(str(error), 8.0)

    def ask_screenshot(self) -> None:
        """Ask how many times the window's size a screenshot shall have, and make it."""

        def accept(text: str) -> None:
            if not text.isdecimal() or int(text) < 1:
                raise UsageError(f"expected a whole number from 1, found {text!r}")
            self.screenshot(int(text))

        width, height = glfw.get_framebuffer_size(self._window)
        self.state.ask(f"screenshot, how many times {width} x {height}?", accept, "2")

    def _enlarged(self, times: int) -> NDArray[np.uint8]:
        """The same picture with `times` as many pixels to each side. Raises GraphicsError."""
        assert self._target is not None
        width, height = (times * side for side in self._target.size)
        samples = self.state.subject.display.samples
        target = Target(self._ctx, (width, height), samples, self._painter.capabilities)
        try:
            self._paint(target)
            return target.pixels()
        finally:
            target.release()

    def save_scene(self) -> None:
        """Everything that the picture is made from, as a file that `reparam view` opens again."""
        try:
            path = self._free_path(".json")
            save(self.state.snapshot(), path)
            self.state.say(f"saved {path}")
        except ReparamError as error:
            self.state.say(str(error), 8.0)

    def copy_command(self) -> None:
        """The command line that draws this picture without a window, into the clipboard."""
        size = glfw.get_framebuffer_size(self._window)
        usual = self._painter.capabilities.evaluator(None)
        evaluator = self.state.evaluator if self.state.evaluator != usual else None
        text = command(self.state.snapshot(), size, evaluator, f"{self._stem()}.png")
        glfw.set_clipboard_string(self._window, text)
        self.state.say(f"copied: {text}", 6.0)

    def _stem(self) -> str:
        subject = self.state.subject
        return f"reparam-{Path(subject.source).stem if subject.source else subject.scene.name}"

    def _free_path(self, ending: str) -> Path:
        """The next free file of the current folder."""
        number = 1
        while (path := Path.cwd() / f"{self._stem()}-{number:03}{ending}").exists():
            number += 1
        return path

    # The window -----------------------------------------------------------------------------

    def reload_shaders(self) -> None:
        """Read the shaders anew; broken ones leave the last good ones at work."""
        try:
            self._painter.reload_shaders()
            self.state.say("shaders reloaded")
        except UNDRAWABLE as error:
            self.state.say(str(error), 15.0)

    def toggle_full_screen(self) -> None:
        """Full screen and back."""
        if self._windowed is None:
            monitor = glfw.get_primary_monitor()
            if not monitor:
                self.state.say("no monitor to fill")
                return
            x, y = glfw.get_window_pos(self._window)
            self._windowed = (x, y, *glfw.get_window_size(self._window))
            mode = glfw.get_video_mode(monitor)
            glfw.set_window_monitor(
                self._window, monitor, 0, 0, mode.size.width, mode.size.height, mode.refresh_rate
            )
        else:
            windowed: Any = None
            glfw.set_window_monitor(self._window, windowed, *self._windowed, glfw.DONT_CARE)
            self._windowed = None
        self.state.changed = True

    def quit(self) -> None:
        """Close the window."""
        glfw.set_window_should_close(self._window, True)

    def _on_damage(self, *_: Any) -> None:
        self.state.changed = True


def hint(subject: Subject) -> str:
    """What to press first: only what this subject has."""
    hints = [("texture", "T: the other texture map"), ("morph", "M: morph")]
    return "   ".join([*(text for name, text in hints if name in subject.values), "H: all keys"])


def key_name(key: int, scancode: int) -> str:
    """The key as the table names it: letters by the user's own keyboard layout."""
    if key in KEYPAD:
        return KEYPAD[key]
    printable = glfw.get_key_name(key, scancode)
    if printable:
        return str(printable).upper()
    for name in (name for row in KEYS for name in row.names):
        constant = getattr(glfw, "KEY_" + NAMED.get(name, name).upper(), None)
        if constant is not None and constant == key:
            return name.upper()
    return ""
