"""Where in a space the pixels of one colour are: what a picture of curves can be asked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reparam.gpu.arrangement import UNITS, arrange
from reparam.scenes.layers import Color
from reparam.snapshot import Studio
from reparam.subject import Subject

Array = NDArray[np.float64]


class Seen:
    """The last space of a subject drawn plain, or one of its spaces, by name, drawn in full."""

    def __init__(
        self, studio: Studio, subject: Subject, size: tuple[int, int], space: str = ""
    ) -> None:
        plain = not space
        self.picture = studio.draw(subject, size, plain=plain).astype(float)
        figure = subject.figure().plain() if plain else subject.figure()
        panels = arrange(figure, size, {}, plain, False)
        panel = next(p for p in panels if plain or p.space.name == space)
        region = panel.region
        corners = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
        pixels = panel.camera.pixels(corners, region.width, region.height)
        self._origin = pixels[0] + [region.left, region.bottom]
        self._unit = pixels[1] - pixels[0]
        self.pixel = float(1.0 / self._unit[0])  # its width in model units
        self.unit = min(size) / UNITS * self.pixel  # a figure unit in model units

    def places(self, color: Color) -> Array:
        """Model points (k, 2) of the pixels that have that colour."""
        rows, columns = np.nonzero(self._has(color))
        pixels = np.stack([columns + 0.5, len(self.picture) - rows - 0.5], -1)
        return np.asarray((pixels - self._origin) / self._unit)

    def shows(self, at: Array, color: Color) -> NDArray[np.bool_]:
        """Whether the pixels at model points (k, 2) have that colour."""
        pixels = np.asarray(at)[:, :2] * self._unit + self._origin
        columns, up = np.floor(pixels).astype(int).T
        return np.asarray(self._has(color)[len(self.picture) - 1 - up, columns])

    def _has(self, color: Color) -> NDArray[np.bool_]:
        return np.asarray(np.abs(self.picture - 255.0 * np.array(color)).max(-1) <= 2.0)
