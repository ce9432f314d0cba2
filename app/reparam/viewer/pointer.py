"""The linked cursor under the mouse: which (u,v) a pixel of any linked space shows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.inverse import Picker
from ..gpu.arrangement import Panel
from ..scenes.cursor import Cursor, patches_of, picker
from ..scenes.layers import Array
from .state import State


class Pointer:
    """Moves the state's cursor to what the mouse points at."""

    def __init__(self, state: State) -> None:
        self._state = state
        self._picker: tuple[Array, Array, Picker] | None = None  # of a map, seen from an eye

    def point_at(self, panels: Sequence[Panel], x: float, y: float) -> None:
        """The mouse is here, in framebuffer pixels, y up."""
        panel = next((panel for panel in panels if panel.region.contains(x, y)), None)
        if panel is not None and panel.space.map is not None:
            self._state.point(self._cursor(panel, x, y))

    def _cursor(self, panel: Panel, x: float, y: float) -> Cursor:
        region = panel.region
        pixel = np.array([x - region.left, y - region.bottom])
        at = panel.camera.in_view(pixel, region.width, region.height)
        patch, u, v = self._picker_of(panel).pick(at)
        nets, before = patches_of(panel.space), self._state.cursor
        if nets is not None and len(nets) == 1 and before is not None:
            patch = before.patch  # one square is the domain of every patch
        return Cursor(u, v, patch)

    def _picker_of(self, panel: Panel) -> Picker:
        """Boxes of many patches are made once for each map and place of the eye."""
        net, matrix, kept = panel.space.map, panel.camera.plane_from_model(), self._picker
        assert net is not None
        if kept is None or kept[0] is not net or not np.array_equal(kept[1], matrix):
            kept = self._picker = (net, matrix, picker(panel.space, matrix))
        return kept[2]
