"""How the spaces of a figure are seen, and how a hand changes that."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ..geometry.camera import View


class Views:
    """A view for each space, by name. `changed` is set when the picture must be drawn again."""

    def __init__(self, views: Mapping[str, View]) -> None:
        self.views: dict[str, View] = dict(views)
        self.changed = True

    def view(self, space: str) -> View:
        """How a space is seen."""
        return self.views.get(space, View())

    def pan(self, space: str, dx: float, dy: float) -> None:
        """Move a space's picture by (dx, dy) model units."""
        view = self.view(space)
        self.views[space] = replace(view, pan=(view.pan[0] - dx, view.pan[1] - dy))
        self.changed = True

    def zoom(self, space: str, factor: float, x: float, y: float) -> None:
        """Enlarge by `factor`, keeping the point (x, y) model units from the middle in place."""
        view = self.view(space)
        zoom = min(1e4, max(1e-2, view.zoom * factor))
        shift = 1.0 - view.zoom / zoom
        pan = (view.pan[0] + x * shift, view.pan[1] + y * shift)
        self.views[space] = replace(view, zoom=zoom, pan=pan)
        self.changed = True

    def orbit(self, space: str, azimuth: float, elevation: float) -> None:
        """Turn a spatial space by these degrees."""
        view = self.view(space)
        steep = min(90.0, max(-90.0, view.elevation + elevation))
        turned = (view.azimuth + azimuth) % 360.0
        self.views[space] = replace(view, azimuth=turned, elevation=steep)
        self.changed = True
