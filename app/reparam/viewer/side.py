"""The place of the panel at the window's right edge: empty until it is first asked for.

The panel needs one more package; all else works without it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import glfw

from ..frame import Apart
from ..gpu.painter import Painter
from .state import State
from .verdicts import Verdicts

if TYPE_CHECKING:
    from .panel import Panel

MISSING = "the panel needs one more package: pip install imgui-bundle"


class Side:
    """Makes the panel when it is first shown. `open` opens the file of a path."""

    def __init__(
        self, window: Any, painter: Painter, state: State, open: Callable[[str], None]
    ) -> None:
        self._window = window
        self._painter = painter
        self._state = state
        self._open = open
        self._panel: Panel | None = None

    def toggle_panel(self) -> None:
        """Show the panel or hide it, or say what is missing."""
        if self._panel is None:
            try:
                from .panel import Panel
            except ModuleNotFoundError as missing:
                if not (missing.name or "").startswith("imgui_bundle"):
                    raise
                self._state.say(MISSING, 8.0)
                return
            verdicts = Verdicts(self._measure)
            self._panel = Panel(self._window, self._painter, self._state, verdicts, self._open)
        self._panel.toggle()
        self._state.changed = True

    def _measure(self) -> Apart:
        screen = self._painter.ctx.detect_framebuffer(0)
        return Apart(self._painter, screen, self._state.evaluator)

    @property
    def busy(self) -> bool:
        """Whether the panel wants another frame without an event."""
        return self._panel is not None and self._panel.busy

    def picture_size(self) -> tuple[int, int]:
        """What the panel leaves of the framebuffer, in pixels."""
        width, height = glfw.get_framebuffer_size(self._window)
        return width - (self._panel.width() if self._panel else 0), height

    def draw(self) -> None:
        """The panel, if it is shown, into the current framebuffer."""
        if self._panel is not None:
            self._panel.draw()
