"""Titles above spaces and notes beneath, in the margins where neither pan nor zoom moves them.

+-------- title --------+
|                       |
|   the space's region  |
|                       |
+-----------------------+
       name  value         names end where values begin, at one place in every space
       name  value
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..scenes import palette
from .labels import Labels, measure
from .region import NOTE_LINE, TITLE_LINE

if TYPE_CHECKING:
    from .painter import Panel

TITLE_SIZE = 17.0  # figure units, as all here
NOTE_SIZE = 15.0
GAP = 10.0  # between name and value
DIVIDE = 0.36  # of the region's width: where names end


def draw_margins(
    labels: Labels, panels: Sequence[Panel], size: tuple[int, int], unit: float
) -> None:
    """All titles and all notes of a figure; the notes set equally large."""
    for panel in panels:
        region = panel.region
        middle = region.left + region.width / 2
        top = region.bottom + region.height + TITLE_LINE / 2 * unit
        labels.text(
            panel.space.title, (middle, top), size, TITLE_SIZE * unit, palette.INK,
            widest=0.96 * region.width,
        )  # fmt: skip
    em = note_size(panels, unit)
    for panel in panels:
        region = panel.region
        divide = region.left + DIVIDE * region.width
        for row, (name, value) in enumerate(panel.space.notes):
            y = region.bottom - (row + 0.5) * NOTE_LINE * unit
            for text, x, anchor in ((name, divide - GAP * unit / 2, 1.0), (value, divide, 0.0)):
                labels.text(text, (x, y), size, em, palette.INK, anchor=(anchor, 0.5))


def note_size(panels: Sequence[Panel], unit: float) -> float:
    """The size that suits all notes, in pixels."""
    em = NOTE_SIZE * unit
    for panel in panels:
        width = panel.region.width
        for name, value in panel.space.notes:
            rooms = ((name, DIVIDE * width - GAP * unit), (value, (1 - DIVIDE) * width))
            for text, room in rooms:
                em = min(em, 0.98 * max(room, 0.0) / max(measure(text, 100) / 100, 1e-9))
    return em
