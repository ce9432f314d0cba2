"""The frame that both hosts draw: a subject into a target."""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from .compare import agree, blends_by_value, sides
from .gpu.arrangement import UNITS, Panel
from .gpu.comparison import Split
from .gpu.painter import Painter
from .gpu.targets import Target
from .scenes.layers import Figure
from .subject import Subject, open_subject


def draw_subject(
    painter: Painter,
    subject: Subject,
    target: Target,
    *,
    evaluator: str | None = None,
    plain: bool = False,
) -> list[Panel]:
    """Draw the subject as it is seen, with `plain` its patches alone; where its spaces stand.

    Raises what `Subject.figure` and `Painter.draw` raise.
    """
    if subject.display.compare:
        return _draw_compared(painter, subject, target, evaluator, plain)
    return painter.draw(
        subject.figure(),
        target,
        subject.display,
        evaluator=evaluator,
        views=subject.views,
        plain=plain,
    )


class Apart:
    """Draws subjects into targets of their own; `picture` makes it a claim's Measure.

    `rest` is the framebuffer that is bound afterwards.
    """

    def __init__(
        self, painter: Painter, rest: moderngl.Framebuffer, evaluator: str | None = None
    ) -> None:
        self.painter = painter
        self.evaluator = evaluator
        self._rest = rest

    def draw(
        self, subject: Subject, size: tuple[int, int], *, plain: bool = False
    ) -> NDArray[np.uint8]:
        """The subject as (height, width, 3), top row first."""
        painter = self.painter
        target = Target(painter.ctx, size, subject.display.samples, painter.capabilities)
        try:
            draw_subject(painter, subject, target, evaluator=self.evaluator, plain=plain)
            return target.pixels()
        finally:
            self._rest.use()
            target.release()

    def draw_figure(
        self, figure: Figure, subject: Subject, size: tuple[int, int]
    ) -> NDArray[np.uint8]:
        """Another figure, displayed and seen as the subject's own would be."""
        painter = self.painter
        target = Target(painter.ctx, size, subject.display.samples, painter.capabilities)
        try:
            painter.draw(
                figure, target, subject.display, evaluator=self.evaluator, views=subject.views
            )
            return target.pixels()
        finally:
            self._rest.use()
            target.release()

    def picture(self, scene: str, size: tuple[int, int], **values: Any) -> NDArray[np.uint8]:
        """A scene drawn plain; `values` are its parameters and the display's."""
        subject = open_subject(scene)
        for name, value in values.items():
            subject = subject.changed(name, value)
        return self.draw(subject, size, plain=True)


def _draw_compared(
    painter: Painter, subject: Subject, target: Target, evaluator: str | None, plain: bool
) -> list[Panel]:
    """Both values of the compared parameter, first the right one; the left one's panels."""
    left, right, name = sides(subject)
    nets = (left.display.net, right.display.net)
    figures = agree(left.figure(), right.figure(), nets)
    panels = []
    for side, figure in ((right, figures[1]), (left, figures[0])):
        panels = painter.draw(
            figure, target, side.display,
            evaluator=evaluator, views=subject.views, plain=plain, more=side is right,
        )  # fmt: skip
        if side is right:
            painter.comparison.keep(target)
    display = subject.display
    fading = 0.0 if blends_by_value(left, right, name) else display.blend
    tags = (_tag(left, right, name, fading), f"{name} = {right.shown(name)}")
    split = Split(panels[-1].region, display.divider, fading, *tags)
    unit = 0.0 if plain else min(target.size) / UNITS
    painter.comparison.lay_over(painter, target, split, unit)
    return panels


def _tag(left: Subject, right: Subject, name: str, fading: float) -> str:
    """What stands left of the divider: the left value, or how far it has become the right one."""
    if fading == 0.0:
        return f"{name} = {left.shown(name)}"
    return f"{name} = {left.shown(name)} → {right.shown(name)}, {100.0 * fading:.0f} %"
