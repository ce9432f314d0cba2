"""The mouse: drags of handles change parameters, other drags and the wheel the views."""

from __future__ import annotations

from typing import Any

import glfw

from ..gpu.arrangement import Panel
from ..gpu.region import Region
from .hand import Hand
from .pointer import Pointer
from .state import State

WHEEL = 1.15  # zoom a notch of the wheel
DIVIDER = 6.0  # pixels (of content scale 1) beside the divider that take hold of it
DEGREES_A_WINDOW = 200.0  # of orbit, dragging across the window's shorter side


class Mouse:
    """Listens to a window, and is told what was drawn there."""

    def __init__(self, window: Any, state: State) -> None:
        self._window = window
        self._state = state
        self._panels: list[Panel] = []
        self._units: dict[str, float] = {}  # model units a pixel, by the space, at zoom 1
        self._at: tuple[float, float] = glfw.get_cursor_pos(window)  # as the events tell it
        self._seen_at = (0.0, 0.0)  # where the mouse was when a view followed it last, in pixels
        self._held: tuple[str, bool] | None = None  # a space's name, and whether it is only moved
        self._divides: Region | None = None  # the region whose divider is dragged
        self._cursors: dict[int | None, Any] = {}
        self._shape: int | None = None
        self._unsettled = False  # what the hand has to hear of, once a frame
        self.hand = Hand(state)
        self._pointer = Pointer(state)
        self.inside = bool(glfw.get_window_attrib(window, glfw.HOVERED))
        glfw.set_cursor_pos_callback(window, self._on_move)
        glfw.set_mouse_button_callback(window, self._on_button)
        glfw.set_scroll_callback(window, self._on_scroll)
        glfw.set_cursor_enter_callback(window, self._on_enter)

    def see(self, panels: list[Panel]) -> None:
        """These were drawn with the views as they are."""
        self._panels = panels
        self.hand.see(panels)
        self._units = {
            panel.space.name: 2.0
            * panel.camera.half_height
            / panel.region.height
            * self._state.view(panel.space.name).zoom
            for panel in panels
        }

    def _unit(self, space: str) -> float:
        """Model units a pixel, by the view as it is now, be it drawn already or not."""
        return self._units[space] / self._state.view(space).zoom

    def _pixel(self) -> tuple[float, float]:
        """Where the mouse is, in framebuffer pixels, y up; the window's size may have changed."""
        x, y = self._at
        width, height = glfw.get_window_size(self._window)
        across, up = glfw.get_framebuffer_size(self._window)
        return x * across / max(1, width), up - y * up / max(1, height)

    def _panel_here(self) -> Panel | None:
        x, y = self._pixel()
        return next((panel for panel in self._panels if panel.region.contains(x, y)), None)

    def settle(self) -> None:
        """Once a frame, however many events there were: what the hand does now."""
        if not self._unsettled:
            return
        self._unsettled = False
        if self._divides is not None:
            self._move_divider(self._divides)
        elif self.hand.held:
            shift = (glfw.KEY_LEFT_SHIFT, glfw.KEY_RIGHT_SHIFT)
            snap = any(glfw.get_key(self._window, key) == glfw.PRESS for key in shift)
            self.hand.drag(*self._pixel(), self.scale(), snap)
        elif self._held is not None:
            self._move_view(*self._held)
        else:
            self.hand.point_at(*self._pixel(), self.scale())
            self._pointer.point_at(self._panels, *self._pixel())
        self._show_cursor()

    def _move_divider(self, region: Region) -> None:
        share = (self._pixel()[0] - region.left) / region.width
        self._state.change({"divider": round(min(1.0, max(0.0, share)), 4)})

    def _divider_here(self) -> Region | None:
        """The region whose divider is under the mouse."""
        display = self._state.subject.display
        panel = self._panel_here()
        if not display.compare or panel is None or panel is not self._panels[-1]:
            return None
        line = panel.region.left + display.divider * panel.region.width
        return panel.region if abs(self._pixel()[0] - line) <= DIVIDER * self.scale() else None

    def _show_cursor(self) -> None:
        """A shape that says what pressing the button here takes hold of."""
        shape = None
        if self.hand.over is not None or self.hand.held:
            shape = glfw.HAND_CURSOR
        elif self._divides is not None or self._divider_here() is not None:
            shape = glfw.HRESIZE_CURSOR
        if shape != self._shape:
            self._shape = shape
            if shape is not None and shape not in self._cursors:
                self._cursors[shape] = glfw.create_standard_cursor(shape)
            cursor: Any = self._cursors.get(shape)
            glfw.set_cursor(self._window, cursor)

    def scale(self) -> float:
        """Framebuffer pixels for one at content scale 1."""
        return content_scale(self._window)

    def _on_enter(self, _: Any, entered: int) -> None:
        self.inside = bool(entered)
        self._state.refresh = True

    def _on_button(self, _: Any, button: int, action: int, mods: int) -> None:
        self.settle()  # where the mouse was before
        self.hand.release()
        if self._divides is not None:
            self._divides = None
            self._state.end_gesture()
            self._state.say(f"divider = {self._state.subject.shown('divider')}")
        if button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS:
            self._unsettled = True
            if self.hand.take(*self._pixel(), self.scale()):
                return
            self._divides = self._divider_here()
            if self._divides is not None:
                self._state.begin_gesture()
                return
        panel = self._panel_here() if action == glfw.PRESS else None
        moves = button != glfw.MOUSE_BUTTON_LEFT or bool(mods & glfw.MOD_SHIFT)
        self._held = (panel.space.name, moves) if panel else None
        self._seen_at = self._pixel()

    def _on_move(self, _: Any, x: float, y: float) -> None:
        self._at = (x, y)  # a mouse tells a thousand times a second; it is acted on once a frame
        self._unsettled = True

    def _move_view(self, name: str, moves: bool) -> None:
        """Turn or move a space by the way since it was done last."""
        before, after = self._seen_at, self._pixel()
        self._seen_at = after
        panel = next((panel for panel in self._panels if panel.space.name == name), None)
        dx, dy = after[0] - before[0], after[1] - before[1]
        if panel is None or dx == dy == 0.0:
            return
        if panel.space.spatial and not moves:
            turn = DEGREES_A_WINDOW / min(panel.region.width, panel.region.height)
            self._state.orbit(name, -dx * turn, -dy * turn)
        else:
            unit = self._unit(name)
            self._state.pan(name, dx * unit, dy * unit)

    def _on_scroll(self, _: Any, __: float, notches: float) -> None:
        self.settle()
        panel = self._panel_here()
        if panel is not None:
            region, unit = panel.region, self._unit(panel.space.name)
            x, y = self._pixel()
            right = (x - region.left - region.width / 2) * unit
            up = (y - region.bottom - region.height / 2) * unit
            self._state.zoom(panel.space.name, WHEEL**notches, right, up)


def content_scale(window: Any) -> float:
    """Framebuffer pixels for one at content scale 1."""
    return max(1.0, float(glfw.get_window_content_scale(window)[0]))
