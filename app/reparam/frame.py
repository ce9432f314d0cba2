"""The frame that both hosts draw: a subject into a target."""

from __future__ import annotations

from .gpu.painter import Painter, Panel
from .gpu.targets import Target
from .subject import Subject


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
    return painter.draw(
        subject.figure(),
        target,
        subject.display,
        evaluator=evaluator,
        views=subject.views,
        plain=plain,
    )
