"""What the window adds to the frame: handles, a notice, and the help."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, floor

from ..gpu.labels import SMALLEST, Labels, measure
from ..gpu.painter import UNITS, Painter, Panel
from ..scenes.layers import Handles
from .hand import Grip, Hand, model_units, snap_step
from .keys import keys_groups
from .state import Prompt

INK = (1.0, 1.0, 1.0)
FAINT = (0.70, 0.70, 0.74)
HEADING = (0.60, 0.80, 0.95)
GROUND = (0.10, 0.10, 0.12, 0.88)
HELP_GROUND = (0.10, 0.10, 0.12, 0.95)  # a checkerboard behind small text disturbs
CARET = "|"
PROMPT_HINT = "Enter: set     Esc: leave"
NOTICE = 1.9  # its height in em
LARGER = 1.35  # the handle under the mouse
LEAST = 3.0  # figure units, its radius before that
MOST = 2000  # handles of a layer that are shown at once
GRID = (0.0, 0.45, 0.70, 0.16)
AXIS = (0.0, 0.45, 0.70, 0.45)


def draw_handles(painter: Painter, hand: Hand, size: tuple[int, int], quiet: bool) -> None:
    """All that can be dragged, the quiet ones too if asked; too many only under the mouse."""
    for panel in hand.panels:
        for layer in panel.space.layers:
            if not isinstance(layer, Handles) or not 0 < len(layer.at) <= MOST:
                continue
            if quiet or not layer.quiet:
                _in_panel(painter, panel, layer, size)


def draw_grip(painter: Painter, hand: Hand, grip: Grip, size: tuple[int, int]) -> None:
    """The handle under the mouse, larger, and beside it its name and coordinates."""
    panel, layer = hand.panel(grip.space), hand.layer(grip)
    if panel is None or layer is None:
        return
    radius = LARGER * max(layer.radius, LEAST)
    _in_panel(painter, panel, replace(layer, radius=radius), size, grip.index)
    em = 0.9 * _em(size)
    text = hand.described(grip)
    width, height = measure(text, round(em)) + em, 1.6 * em
    x, y = hand.place(grip)
    gap = radius * min(size) / UNITS + 0.5 * em
    left = min(max(0.0, x + gap), size[0] - width)
    bottom = y + gap if y + gap + height < size[1] else y - gap - height
    painter.labels.box(left, bottom, width, height, size, GROUND)
    at = (left + em / 2, bottom + height / 2)
    painter.labels.text(text, at, size, em, INK, anchor=(0.0, 0.5))


def draw_grid(labels: Labels, panel: Panel, size: tuple[int, int], scale: float) -> None:
    """The lines whose crossings Shift snaps to, in a space of the plane."""
    if panel.space.spatial:
        return
    region, camera = panel.region, panel.camera
    step = snap_step(model_units(panel), scale)
    middle = (region.left + region.width / 2, region.bottom + region.height / 2)
    half = (camera.half_width, camera.half_height)
    unit, thin = model_units(panel), max(1.0, round(scale))
    for axis in (0, 1):
        first = ceil((camera.center[axis] - half[axis]) / step)
        last = floor((camera.center[axis] + half[axis]) / step)
        for k in range(first, last + 1):
            at = round(middle[axis] + (k * step - camera.center[axis]) / unit - thin / 2)
            color = GRID if k else AXIS
            if axis == 0:
                labels.box(at, region.bottom, thin, region.height, size, color)
            else:
                labels.box(region.left, at, region.width, thin, size, color)


def _in_panel(
    painter: Painter, panel: Panel, layer: Handles, size: tuple[int, int], only: int | None = None
) -> None:
    region = panel.region
    box = (region.left, region.bottom, region.width, region.height)
    painter.ctx.viewport = painter.ctx.scissor = box
    painter.strokes.draw_handles(layer, panel.camera, min(size) / UNITS, only)
    painter.ctx.scissor = None
    painter.ctx.viewport = (0, 0, *size)


def draw_notice(labels: Labels, text: str, size: tuple[int, int]) -> None:
    """One line in the upper left corner, where figures have nothing."""
    em = _em(size)
    text = _elided(text, round(em), size[0] - 2 * em)
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


def draw_prompt(labels: Labels, prompt: Prompt, size: tuple[int, int]) -> None:
    """The line that is asked for, with what has been typed so far."""
    em = _em(size)
    typed = (prompt.text, 1.0, HEADING) if prompt.offered else (prompt.text + CARET, 1.0, INK)
    rows = ((prompt.title, 0.85, FAINT), typed, (PROMPT_HINT, 0.75, FAINT))
    width = min(size[0], max(measure(row, round(s * em)) for row, s, _ in rows) + 3 * em)
    width, height = max(width, min(24 * em, size[0])), 5.2 * em
    left, top = (size[0] - width) / 2, size[1] - (NOTICE + 0.5) * em
    labels.box(left, top - height, width, height, size, HELP_GROUND)
    for i, (row, share, color) in enumerate(rows):
        at = (left + 1.5 * em, top - (1.1 + 1.5 * i) * em)
        room = width - 3 * em
        labels.text(row, at, size, share * em, color, anchor=(0.0, 0.5), widest=room)


def draw_progress(labels: Labels, name: str, share: float, size: tuple[int, int]) -> None:
    """How far a file is: a line in the upper left corner, filling up."""
    em = _em(size)
    doing = "drawing" if share == 1.0 else "opening"
    text = f"{doing} {name}: {100.0 * share:.0f} %     Esc: leave"
    text = _elided(text, round(em), size[0] - 2 * em)
    width, height = min(measure(text, round(em)) + 2 * em, size[0]), NOTICE * em
    labels.box(0, size[1] - height, width, height, size, HELP_GROUND)
    labels.box(0, size[1] - height, share * width, 0.22 * em, size, (*HEADING, 1.0))
    at = (em, size[1] - height / 2)
    labels.text(text, at, size, em, INK, anchor=(0.0, 0.5), widest=size[0] - 2 * em)


def draw_help(labels: Labels, size: tuple[int, int]) -> None:
    """The keys grouped by purpose, in two columns, as large as fits beneath the notice's line."""
    room = size[1] - NOTICE * _em(size)
    columns = _columns()
    lines = max(sum(len(rows) + 1.6 for _, rows in column) for column in columns)
    em = min(_em(size), room / (1.4 * lines + 1.4), 0.98 * size[0] / _help_width(1.0))
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
            labels.text(title, (x, y), size, em, HEADING, anchor=(0.0, 0.5))
            y -= 1.4 * em
            for names, does in rows:
                labels.text(names, (x, y), size, em, INK, anchor=(0.0, 0.5))
                place = (x + _names_width(column, em), y)
                labels.text(does, place, size, em, INK, anchor=(0.0, 0.5))
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


def _em(size: tuple[int, int]) -> float:
    return max(13.0, min(size) / 40)
