"""The window: glfw's events in, the painter's frame out."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import glfw
import moderngl

from ..errors import GraphicsError, ReparamError
from ..frame import draw_subject
from ..gpu.arrangement import Panel
from ..gpu.context import create_for_window
from ..gpu.diagnosis import explain
from ..gpu.painter import Painter
from ..gpu.targets import Target
from ..scenes import palette
from ..scenes.layers import Handles
from ..subject import Subject
from .grips import draw_grid, draw_grip, draw_handles
from .keeping import Keeping
from .keyboard import Keyboard
from .loading import Loading, Opener
from .mouse import Mouse, content_scale
from .overlay import Sheet, draw_help, draw_notice, draw_progress, draw_prompt
from .screen import screen_missing
from .side import Side
from .state import State

FRAME_SECONDS = 1 / 60
PROGRESS_SECONDS = 0.05
QUICK = 0.2  # seconds in which most things are open
HINT_SECONDS = 8.0
ERROR_SECONDS = 10.0

# What a scene, or a shader just edited, may raise: shown, and the window stays.
UNDRAWABLE = (ReparamError, ValueError, OSError, AssertionError, moderngl.Error)


def show(name: str, open: Opener, size: tuple[int, int], evaluator: str | None) -> int:
    """Open the window and stay until it is closed; what `name` means is opened meanwhile.

    Raises GraphicsError where there is no window, and what `open` raises.
    """
    loading = Loading(Path(name).name, open)
    if loading.done(QUICK):
        loading.result()  # what is wrong is said without a window
    missing = screen_missing()
    if missing is not None:
        loading.result()
        raise GraphicsError(f"{missing}; without one: reparam render {name} -o OUT.png")
    window = open_window(size, f"reparam: {name}")
    try:
        painter = Painter(create_for_window())
        if wait_for(loading, window, painter):
            Viewer(window, painter, loading.result(), evaluator).run()
    finally:
        loading.give_up()
        glfw.terminate()
    return 0


def wait_for(loading: Loading, window: Any, painter: Painter) -> bool:
    """Show how far a file is until it is open; whether it is, or the window was closed."""
    done = loading.done()
    while not done:
        done = loading.done()  # once more then: a large surface takes its time to be drawn, too
        if glfw.window_should_close(window) or glfw.get_key(window, glfw.KEY_ESCAPE):
            return False
        size = glfw.get_framebuffer_size(window)
        if min(size) > 0:
            painter.clear_screen(size)
            sheet = Sheet(painter, size, content_scale(window))
            draw_progress(sheet, loading.name, 1.0 if done else loading.share)
            glfw.swap_buffers(window)
        glfw.wait_events_timeout(0.0 if done else PROGRESS_SECONDS)
    return True


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

    def __init__(
        self, window: Any, painter: Painter, subject: Subject, evaluator: str | None
    ) -> None:
        self._window = window
        self._ctx = painter.ctx
        self._painter = painter
        capabilities = painter.capabilities
        evaluators = ("vertex", "tessellation") if capabilities.tessellation else ("vertex",)
        self.state = State(subject, evaluators, capabilities.evaluator(evaluator))
        self._target: Target | None = None
        self._samples = 0  # asked for when the target was made
        self._windowed: tuple[int, int, int, int] | None = None
        self._began = time.perf_counter()
        self._mouse = Mouse(window, self.state)
        self.keeping = Keeping(window, painter, self.state, self._drawn, self._paint)
        self.side = Side(window, painter, self.state, lambda path: self._on_drop(window, [path]))
        actors = (self, self.keeping, self.side, self.state)
        self._keyboard = Keyboard(window, self.state, actors, self._guard)
        on_drop: Any = self._on_drop
        glfw.set_drop_callback(window, on_drop)
        glfw.set_framebuffer_size_callback(window, self._on_damage)
        glfw.set_window_refresh_callback(window, self._on_damage)
        self.state.say(hint(subject), HINT_SECONDS)

    def run(self) -> None:
        """Until the window is closed: wait, and draw only what changed."""
        while not glfw.window_should_close(self._window):
            self._tick()
            self._guard(self.keeping.follow_loading)
            self._guard(self._mouse.settle)
            self.state.refresh |= self.side.busy
            began = time.perf_counter()
            if drew := self._draw_changes():
                time.sleep(max(0.0, began + FRAME_SECONDS - time.perf_counter()))
            if self.state.moving or self.side.busy:
                glfw.wait_events_timeout(1e-3 if drew else FRAME_SECONDS)
            elif self.keeping.loading is not None:
                glfw.wait_events_timeout(PROGRESS_SECONDS)
            elif self.state.notice:
                glfw.wait_events_timeout(max(1e-3, self.state.seconds_of_notice()))
            else:
                glfw.wait_events()

    def _tick(self) -> None:
        self.state.advance(time.perf_counter() - self._began)

    def _guard(self, method: Callable[..., None], *arguments: Any) -> None:
        """Call a method; what it raises is one line in the window, and the scene stays."""
        self._tick()  # the clock stood still while the window waited for an event
        try:
            method(*arguments)
        except UNDRAWABLE as error:
            self.state.say(str(error), ERROR_SECONDS)

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
        size = self.side.picture_size()
        if min(size) < 1:
            return False
        self.state.changed = False
        glfw.set_window_title(self._window, f"reparam: {self.state.subject.title}")
        try:
            target = self._draw_frame(size)
        except UNDRAWABLE as error:
            self.state.say(str(error), ERROR_SECONDS)
            if self._target is None or self._target.size != size:
                return False
            target = self._target
        self._present(target)
        return True

    def _drawn(self) -> Target | None:
        """The frame as it is to be now; None while there can be none."""
        self._mouse.settle()
        if self.state.changed:
            self._draw()
        return self._target

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
        self._target.framebuffer.clear(*palette.GROUND, 1.0)  # should the scene not be drawable
        self._target.resolve()
        self._samples = samples

    def _present(self, target: Target) -> None:
        """The frame onto the screen, and over it what only the window has."""
        self.state.refresh = False
        target.show()
        sheet = Sheet(self._painter, target.size, self._mouse.scale())
        self._draw_hand(sheet)
        if self.state.help:
            draw_help(sheet)
        if (prompt := self.state.prompt) is not None:
            draw_prompt(sheet, prompt)
        if self.state.notice:
            draw_notice(sheet, self.state.notice)
        if (loading := self.keeping.loading) is not None:
            draw_progress(sheet, loading.name, loading.share)
        self.side.draw()
        glfw.swap_buffers(self._window)
        self.state.presented(time.perf_counter() - self._began)

    def _draw_hand(self, sheet: Sheet) -> None:
        """The handles, while somebody is there to drag them."""
        hand, display = self._mouse.hand, self.state.subject.display
        if self._mouse.inside or hand.held or display.net:
            draw_handles(sheet, hand, display.net)
        asked = hand.held or self.state.prompt is not None
        if (grip := (hand.chosen if asked else None) or hand.over) is not None:
            panel = hand.panel(grip.space)
            if hand.snapping and panel is not None:
                draw_grid(sheet, panel)
            draw_grip(sheet, hand, grip)

    def type_value(self) -> None:
        """Ask for the coordinates of a point, or for a parameter."""
        self._mouse.hand.ask()

    # The window -----------------------------------------------------------------------------

    def reload_shaders(self) -> None:
        """Read the shaders anew; broken ones leave the last good ones at work, and are raised."""
        self._painter.reload_shaders()
        self.state.changed = True
        self.state.say("shaders reloaded")

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
        """Close the window; while a file is being opened, only give that up."""
        if not self.keeping.give_up_loading():
            glfw.set_window_should_close(self._window, True)

    def _on_drop(self, _: Any, paths: list[str]) -> None:
        self._guard(self.keeping.drop, paths)

    def _on_damage(self, *_: Any) -> None:
        self.state.changed = True


def hint(subject: Subject) -> str:
    """What to do first: only what this subject has."""
    hints = [("texture", "T: the other texture map"), ("morph", "M: morph")]
    found = [text for name, text in hints if name in subject.values]
    layers = [layer for space in subject.figure().spaces for layer in space.layers]
    if any(isinstance(layer, Handles) and len(layer.at) for layer in layers):
        found.append("drag a point")
    return "     ".join([*found, "H: all keys"])
