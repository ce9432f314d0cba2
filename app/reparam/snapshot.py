"""The headless host: a subject in, a picture out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .frame import Apart
from .gpu.context import create_headless
from .gpu.painter import Painter
from .subject import Subject


class Studio(Apart):
    """A headless context that draws; `picture` makes it a claim's Measure.

    Raises GraphicsError with the line that mends it where OpenGL does not start.
    """

    def __init__(self, evaluator: str | None = None) -> None:
        self.ctx = create_headless()
        super().__init__(Painter(self.ctx), self.ctx.extra, evaluator)

    def draw(
        self, subject: Subject, size: tuple[int, int], *, plain: bool = False
    ) -> NDArray[np.uint8]:
        """The subject as (height, width, 3), top row first."""
        self.ctx.__enter__()  # type: ignore[no-untyped-call]  # current, should there be another
        return super().draw(subject, size, plain=plain)
