"""What the window writes over the frame: a notice, the help, a line that is asked for."""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.labels import SMALLEST, Style, measure
from ..gpu.painter import Painter
from .keys import keys_groups
from .prompt import Prompt

INK = (1.0, 1.0, 1.0)
FAINT = (0.70, 0.70, 0.74)
HEADING = (0.60, 0.80, 0.95)
GROUND = (0.10, 0.10, 0.12, 0.88)
HELP_GROUND = (0.10, 0.10, 0.12, 0.95)  # a checkerboard behind small text disturbs
CARET = "|"
PROMPT_HINT = "Enter: set     Esc: leave"
NOTICE = 1.9  # its height in em


@dataclass(frozen=True)
class Sheet:
    """The window's framebuffer: its painter, its size, and its pixels for one at scale 1."""

    painter: Painter
    size: tuple[int, int]
    scale: float

    @property
    def em(self) -> float:
        """The size of letters in pixels: readable, and larger in a large window."""
        return max(13.0 * self.scale, min(self.size) / 40)


def draw_notice(sheet: Sheet, text: str) -> None:
    """One line in the upper left corner, where figures have nothing."""
    labels, size, em = sheet.painter.labels, sheet.size, sheet.em
    text = _elided(text, round(em), size[0] - 2 * em)
    width = min(measure(text, round(em)) + 2 * em, size[0])
    labels.box(0, size[1] - NOTICE * em, width, NOTICE * em, size, GROUND)
    labels.text(
        text,
        (em, size[1] - NOTICE / 2 * em),
        size,
        Style(em, INK, anchor=(0.0, 0.5), widest=size[0] - 2 * em),
    )


def draw_prompt(sheet: Sheet, prompt: Prompt) -> None:
    """The line that is asked for, with what has been typed so far."""
    labels, size, em = sheet.painter.labels, sheet.size, sheet.em
    typed = (prompt.text, 1.0, HEADING) if prompt.offered else (prompt.text + CARET, 1.0, INK)
    rows = ((prompt.title, 0.85, FAINT), typed, (PROMPT_HINT, 0.75, FAINT))
    width = min(size[0], max(measure(row, round(s * em)) for row, s, _ in rows) + 3 * em)
    width, height = max(width, min(24 * em, size[0])), 5.2 * em
    left, top = (size[0] - width) / 2, size[1] - (NOTICE + 0.5) * em
    labels.box(left, top - height, width, height, size, HELP_GROUND)
    for i, (row, share, color) in enumerate(rows):
        at = (left + 1.5 * em, top - (1.1 + 1.5 * i) * em)
        room = width - 3 * em
        labels.text(row, at, size, Style(share * em, color, anchor=(0.0, 0.5), widest=room))


def draw_progress(sheet: Sheet, name: str, share: float) -> None:
    """How far a file is: a line in the upper left corner, filling up."""
    labels, size, em = sheet.painter.labels, sheet.size, sheet.em
    doing = "drawing" if share == 1.0 else "opening"
    text = f"{doing} {name}: {100.0 * share:.0f} %     Esc: leave"
    text = _elided(text, round(em), size[0] - 2 * em)
    width, height = min(measure(text, round(em)) + 2 * em, size[0]), NOTICE * em
    labels.box(0, size[1] - height, width, height, size, HELP_GROUND)
    labels.box(0, size[1] - height, share * width, 0.22 * em, size, (*HEADING, 1.0))
    at = (em, size[1] - height / 2)
    labels.text(text, at, size, Style(em, INK, anchor=(0.0, 0.5), widest=size[0] - 2 * em))


def draw_help(sheet: Sheet) -> None:
    """The keys grouped by purpose, in two columns, as large as fits beneath the notice's line."""
    labels, size = sheet.painter.labels, sheet.size
    room = size[1] - NOTICE * sheet.em
    columns = _columns()
    lines = max(sum(len(rows) + 1.6 for _, rows in column) for column in columns)
    em = min(sheet.em, room / (1.4 * lines + 1.4), 0.98 * size[0] / _help_width(1.0))
    if em < SMALLEST:
        return
    width, height = _help_width(em), (1.4 * lines + 1.0) * em
    left = (size[0] - width) / 2
    top = min(room, (size[1] + height) / 2)
    labels.box(left, top - height, width, height, size, HELP_GROUND)
    x = left + 1.5 * em
    for column in columns:
        y = top - 1.4 * em
        for title, rows in column:
            labels.text(title, (x, y), size, Style(em, HEADING, anchor=(0.0, 0.5)))
            y -= 1.4 * em
            for names, does in rows:
                labels.text(names, (x, y), size, Style(em, INK, anchor=(0.0, 0.5)))
                place = (x + _names_width(column, em), y)
                labels.text(does, place, size, Style(em, INK, anchor=(0.0, 0.5)))
                y -= 1.4 * em
            y -= 0.84 * em
        x += _column_width(column, em) + 2.5 * em


Column = list[tuple[str, list[tuple[str, str]]]]


def _columns() -> tuple[Column, Column]:
    """The groups in two columns of nearly one height."""
    groups = keys_groups()
    heights = [len(rows) + 1.6 for _, rows in groups]
    split = min(range(1, len(groups)), key=lambda k: max(sum(heights[:k]), sum(heights[k:])))
    return groups[:split], groups[split:]


def _names_width(column: Column, em: float) -> float:
    return (_widest([names for _, rows in column for names, _ in rows]) + 1.2) * em


def _column_width(column: Column, em: float) -> float:
    does = _widest([does for _, rows in column for _, does in rows])
    return _names_width(column, em) + does * em


def _help_width(em: float) -> float:
    return sum(_column_width(column, em) for column in _columns()) + 5.5 * em


def _elided(text: str, pixels: int, widest: float) -> str:
    """The line, its end left out where it does not fit at half the size."""
    if measure(text, max(1, pixels // 2)) <= widest:
        return text
    count = int(len(text) * widest / measure(text, max(1, pixels // 2)))
    return text[: max(1, count - 2)] + "…"


def _widest(texts: list[str]) -> float:
    """In em; a little more than measured, for what rounding to whole pixels adds."""
    return max(measure(text, 100) for text in texts) / 100 * 1.04
