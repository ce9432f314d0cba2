"""The headless host: a subject in, a picture out."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .frame import draw_subject
from .gpu.context import create_headless
from .gpu.painter import Painter
from .gpu.targets import Target
from .subject import Subject, open_subject


class Studio:
    """A headless context that draws; `picture` makes it a claim's Measure.

    Raises GraphicsError with the line that mends it where OpenGL does not start.
    """

    def __init__(self, evaluator: str | None = None) -> None:
        self.ctx = create_headless()
        self.painter = Painter(self.ctx)
        self.evaluator = evaluator

    def draw(
        self, subject: Subject, size: tuple[int, int], *, plain: bool = False
    ) -> NDArray[np.uint8]:
        """The subject as (height, width, 3), top row first."""
        self.ctx.__enter__()  # type: ignore[no-untyped-call]  # current, should there be another
        target = Target(self.ctx, size, subject.display.samples, self.painter.capabilities)
        try:
            draw_subject(self.painter, subject, target, evaluator=self.evaluator, plain=plain)
            return target.pixels()
        finally:
            self.ctx.extra.use()
            target.release()

    def picture(self, scene: str, size: tuple[int, int], **values: Any) -> NDArray[np.uint8]:
        """A scene drawn plain; `values` are its parameters and the display's."""
        subject = open_subject(scene)
        for name, value in values.items():
            subject = subject.changed(name, value)
        return self.draw(subject, size, plain=True)
