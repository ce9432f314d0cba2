"""What the window adds to the frame: a notice, and the help."""

from __future__ import annotations

from ..gpu.labels import SMALLEST, Labels, measure
from .keys import keys_rows

INK = (1.0, 1.0, 1.0)
GROUND = (0.10, 0.10, 0.12, 0.88)
HELP_GROUND = (0.10, 0.10, 0.12, 0.95)  # a checkerboard behind small text disturbs
NOTICE = 1.9  # its height in em


def draw_notice(labels: Labels, text: str, size: tuple[int, int]) -> None:
    """One line in the upper left corner, where figures have nothing."""
    em = _em(size)
    width = min(measure(text, round(em)) + 2 * em, size[0])
    labels.box(0, size[1] - NOTICE * em, width, NOTICE * em, size, GROUND)
    labels.text(
        text,
        (em, size[1] - NOTICE / 2 * em),
        size,
        em,
        INK,
        anchor=(0.0, 0.5),
        widest=size[0] - 2 * em,
    )


def draw_help(labels: Labels, size: tuple[int, int]) -> None:
    """The table of keys in the middle, as large as fits beside the notice's line."""
    rows = keys_rows()
    room = size[1] - NOTICE * _em(size)
    em = min(_em(size), room / (1.4 * len(rows) + 1.6), 0.98 * size[0] / _help_width(1.0))
    if em < SMALLEST:
        return
    width, height = _help_width(em), (1.4 * len(rows) + 1.6) * em
    left = (size[0] - width) / 2
    top = min(room, (size[1] + height) / 2)
    labels.box(left, top - height, width, height, size, HELP_GROUND)
    column = left + 1.5 * em + _first_column(em)
    for i, (names, does) in enumerate(rows):
        y = top - (1.5 + 1.4 * i) * em
        labels.text(names, (left + 1.5 * em, y), size, em, INK, anchor=(0.0, 0.5))
        labels.text(does, (column, y), size, em, INK, anchor=(0.0, 0.5))


def _first_column(em: float) -> float:
    return _widest([names for names, _ in keys_rows()]) * em + 1.5 * em


def _help_width(em: float) -> float:
    return _first_column(em) + _widest([does for _, does in keys_rows()]) * em + 3 * em


def _widest(texts: list[str]) -> float:
    """In em; a little more than measured, for what rounding to whole pixels adds."""
    return max(measure(text, 100) for text in texts) / 100 * 1.04


def _em(size: tuple[int, int]) -> float:
    return max(13.0, min(size) / 40)
