"""The words of a picture: labels, caption, and titles above spaces and notes beneath, in the
margins where neither pan nor zoom moves them.

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
from typing import Protocol

import numpy as np

from ..scenes import palette
from ..scenes.layers import Label
from .arrangement import CAPTION_LINE, PADDING, Panel
from .labels import Style, measure
from .region import NOTE_LINE, TITLE_LINE

CAPTION_SIZE = 17.0  # figure units, as all here
TITLE_SIZE = 17.0
NOTE_SIZE = 15.0
GAP = 10.0  # between name and value
DIVIDE = 0.36  # of the region's width: where names end


class Words(Protocol):
    """What sets lines of text: Labels on the GPU, or outlines in a file of vectors."""

    def text(
        self, text: str, at: tuple[float, float], viewport: tuple[int, int], style: Style
    ) -> None:
        """One line at `at`."""
        ...


def draw_label(
    words: Words, label: Label, panel: Panel, size: tuple[int, int], unit: float
) -> None:
    """A label of a space, where its point is seen."""
    region = panel.region
    x, y = panel.camera.pixels(np.array(label.at), region.width, region.height)
    at = (
        float(x) + region.left + label.offset[0] * unit,
        float(y) + region.bottom + label.offset[1] * unit,
    )
    em, widest = label.size * unit, 0.96 * region.width
    words.text(label.text, at, size, Style(em, label.color, label.anchor, label.italic, widest))


def draw_caption(words: Words, lines: Sequence[str], size: tuple[int, int], unit: float) -> None:
    """The lines beneath the whole picture."""
    for i, line in enumerate(reversed(lines)):
        at = (size[0] / 2, (PADDING + (i + 0.5) * CAPTION_LINE) * unit)
        words.text(line, at, size, Style(CAPTION_SIZE * unit, palette.INK, widest=0.96 * size[0]))


def draw_margins(words: Words, panels: Sequence[Panel], size: tuple[int, int], unit: float) -> None:
    """All titles and all notes of a figure; the notes set equally large."""
    for panel in panels:
        region = panel.region
        middle = region.left + region.width / 2
        top = region.bottom + region.height + TITLE_LINE / 2 * unit
        style = Style(TITLE_SIZE * unit, palette.INK, widest=0.96 * region.width)
        words.text(panel.space.title, (middle, top), size, style)
    em = note_size(panels, unit)
    for panel in panels:
        region = panel.region
        divide = region.left + DIVIDE * region.width
        for row, (name, value) in enumerate(panel.space.notes):
            y = region.bottom - (row + 0.5) * NOTE_LINE * unit
            for text, x, anchor in ((name, divide - GAP * unit / 2, 1.0), (value, divide, 0.0)):
                words.text(text, (x, y), size, Style(em, palette.INK, anchor=(anchor, 0.5)))


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
