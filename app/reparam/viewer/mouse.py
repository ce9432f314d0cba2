"""The mouse: drags and the wheel, as changes of the state's views."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import glfw

from ..gpu.painter import Panel
from .state import State

WHEEL = 1.15  # zoom a notch of the wheel
DEGREES_A_WINDOW = 200.0  # of orbit, dragging across the window's shorter side


class Mouse:
    """Listens to a window; `panels` gives the panels as they were drawn last."""

    def __init__(self, window: Any, state: State, panels: Callable[[], list[Panel]]) -> None:
        self._window = window
        self._state = state
        self._panels = panels
        self._at = (0.0, 0.0)
        self._held: tuple[str, bool] | None = None  # a space's name, and whether it is only moved
        glfw.set_cursor_pos_callback(window, self._on_move)
        glfw.set_mouse_button_callback(window, self._on_button)
        glfw.set_scroll_callback(window, self._on_scroll)

    def _pixel(self, x: float, y: float) -> tuple[float, float]:
        """Framebuffer pixels, y up, from window coordinates."""
        width, height = glfw.get_window_size(self._window)
        across, up = glfw.get_framebuffer_size(self._window)
        return x * across / max(1, width), up - y * up / max(1, height)

    def _panel_here(self) -> Panel | None:
        """The panel under the mouse, asked anew: the window may have changed under it."""
        self._at = x, y = self._pixel(*glfw.get_cursor_pos(self._window))
        for panel in self._panels():
            region = panel.region
            inside = 0 <= x - region.left < region.width and 0 <= y - region.bottom < region.height
            if inside:
                return panel
        return None

    def _on_button(self, _: Any, button: int, action: int, mods: int) -> None:
        panel = self._panel_here() if action == glfw.PRESS else None
        moves = button != glfw.MOUSE_BUTTON_LEFT or bool(mods & glfw.MOD_SHIFT)
        self._held = (panel.space.name, moves) if panel else None

    def _on_move(self, _: Any, x: float, y: float) -> None:
        before, self._at = self._at, self._pixel(x, y)
        name, moves = self._held or ("", False)
        panel = next((panel for panel in self._panels() if panel.space.name == name), None)
        if self._held is None or panel is None:
            return
        dx, dy = self._at[0] - before[0], self._at[1] - before[1]
        if panel.space.spatial and not moves:
            turn = DEGREES_A_WINDOW / min(panel.region.width, panel.region.height)
            self._state.orbit(name, -dx * turn, -dy * turn)
        else:
            unit = model_units(panel)
            self._state.pan(name, dx * unit, dy * unit)

    def _on_scroll(self, _: Any, __: float, notches: float) -> None:
        panel = self._panel_here()
        if panel is not None:
            region, unit = panel.region, model_units(panel)
            x = (self._at[0] - region.left - region.width / 2) * unit
            y = (self._at[1] - region.bottom - region.height / 2) * unit
            self._state.zoom(panel.space.name, WHEEL**notches, x, y)


def model_units(panel: Panel) -> float:
    """Model units a pixel."""
    return 2.0 * panel.camera.half_height / panel.region.height
