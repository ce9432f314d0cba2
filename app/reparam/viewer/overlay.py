"""What the window adds to the frame: a notice, and the help."""

from __future__ import annotations

from ..gpu.labels import Labels, measure
from .keys import keys_rows

INK = (1.0, 1.0, 1.0)
GROUND = (0.10, 0.10, 0.12, 0.88)


def draw_notice(labels: Labels, text: str, size: tuple[int, int]) -> None:
    """One line in the upper left corner, where figures have nothing."""
    em = _em(size)
    width = min(measure(text, round(em)) + 2 * em, size[0])
    labels.box(0, size[1] - 1.9 * em, width, 1.9 * em, size, GROUND)
    labels.text(
        text, (em, size[1] - 0.95 * em), size, em, INK, anchor=(0.0, 0.5), widest=size[0] - 2 * em
    )


def draw_help(labels: Labels, size: tuple[int, int]) -> None:
    """The table of keys in the middle, as large as fits."""
    rows = keys_rows()
    em = min(_em(size), size[1] / (1.45 * len(rows) + 3))
    first = max(measure(names, round(em)) for names, _ in rows) + 1.5 * em
    second = max(measure(does, round(em)) for _, does in rows)
    width, height = first + second + 3 * em, (1.4 * len(rows) + 1.6) * em
    left, top = (size[0] - width) / 2, (size[1] + height) / 2
    labels.box(left, top - height, width, height, size, GROUND)
    for i, (names, does) in enumerate(rows):
        y = top - (1.5 + 1.4 * i) * em
        labels.text(names, (left + 1.5 * em, y), size, em, INK, anchor=(0.0, 0.5))
        labels.text(does, (left + 1.5 * em + first, y), size, em, INK, anchor=(0.0, 0.5))


def _em(size: tuple[int, int]) -> float:
    return max(13.0, min(size) / 40)
