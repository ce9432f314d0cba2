"""Where in a space the pixels of one colour are: what a picture of curves can be asked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reparam.gpu.painter import arrange
from reparam.scenes.layers import Color
from reparam.snapshot import Studio
from reparam.subject import Subject

Array = NDArray[np.float64]


class Seen:
    """The last space of a subject, drawn plain."""

    def __init__(self, studio: Studio, subject: Subject, size: tuple[int, int]) -> None:
        self.picture = studio.draw(subject, size, plain=True).astype(float)
        camera = arrange(subject.figure().plain(), size, {}, True, False)[0].camera
        pixels = camera.pixels(np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]), *size)
        self._origin, self._unit = pixels[0], pixels[1] - pixels[0]
        self.pixel = float(1.0 / self._unit[0])  # its width in model units

    def places(self, color: Color) -> Array:
        """Model points (k, 2) of the pixels that have that colour."""
        off = np.abs(self.picture - 255.0 * np.array(color)).max(-1)
        rows, columns = np.nonzero(off <= 2.0)
        pixels = np.stack([columns + 0.5, len(self.picture) - rows - 0.5], -1)
        return np.asarray((pixels - self._origin) / self._unit)
