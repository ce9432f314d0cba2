"""A figure as vectors: curves as Bezier paths, text as outlines, surfaces as embedded pictures.

Spaces in which things hide one another are embedded whole; line_paths.py has the lines of others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .files.outlines import ascent_and_descent, outlines, text_width
from .files.vector import Drawing, Group, Raster, Shape
from .gpu.arrangement import UNITS, Panel, arrange
from .gpu.labels import Style
from .gpu.margins import draw_caption, draw_label, draw_margins
from .line_paths import LinePaths
from .scenes import palette
from .scenes.layers import (
    ControlNet,
    Figure,
    Handles,
    Label,
    Layer,
    Patches,
    Recorded,
    Space,
)
from .subject import Subject

Draw = Callable[[Figure, tuple[int, int]], NDArray[np.uint8]]  # a figure's picture, top row first

FINER = 2  # pixels of an embedded picture to a pixel, each way


def draw_vectors(subject: Subject, size: tuple[int, int], draw: Draw) -> Drawing:
    """The subject's figure as a drawing of that size; `draw` makes the pictures to embed."""
    figure, display = subject.figure(), subject.display
    panels = arrange(figure, size, subject.views, False, display.net, display.perspective)
    unit = min(size) / UNITS
    picture = _Embedded(figure, size, draw)
    groups = []
    for panel in panels:
        region = panel.region
        box = (region.left, region.bottom, region.width, region.height)
        shapes = list(_items(panel, display.net, display.handles, unit, picture))
        groups.append(Group(box, tuple(shapes)))
    words = _Outlines()
    for panel in panels:
        for layer in panel.space.layers:
            if isinstance(layer, Label):
                draw_label(words, layer, panel, size, unit)
    draw_margins(words, panels, size, unit)
    draw_caption(words, figure.caption, size, unit)
    whole = (0.0, 0.0, float(size[0]), float(size[1]))
    return Drawing(*size, palette.GROUND, (*groups, Group(whole, tuple(words.shapes))))


class _Embedded:
    """The picture of all that is not lines, drawn once when a panel needs its part of it."""

    def __init__(self, figure: Figure, size: tuple[int, int], draw: Draw) -> None:
        spaces = tuple(replace(space, layers=_rastered(space)) for space in figure.spaces)
        self._figure = Figure(spaces, ("",) * len(figure.caption))
        self._size, self._draw = size, draw
        self._pixels: NDArray[np.uint8] | None = None

    def part(self, panel: Panel) -> Raster:
        if self._pixels is None:
            width, height = self._size
            self._pixels = self._draw(self._figure, (FINER * width, FINER * height))
        region = panel.region
        top = FINER * (self._size[1] - region.bottom - region.height)
        left = FINER * region.left
        rows = slice(top, top + FINER * region.height)
        columns = slice(left, left + FINER * region.width)
        box = (region.left, region.bottom, region.width, region.height)
        return Raster(np.ascontiguousarray(self._pixels[rows, columns]), box)


def _rastered(space: Space) -> tuple[Layer, ...]:
    if space.spatial:
        return tuple(layer for layer in space.layers if not isinstance(layer, Label))
    return tuple(layer for layer in space.layers if isinstance(layer, Patches | Recorded))


def _items(
    panel: Panel, net: bool, handles: bool, unit: float, picture: _Embedded
) -> Iterator[Shape | Raster]:
    """What a panel shows but for its labels, from the back to the front."""
    space = panel.space
    if _rastered(space):
        yield picture.part(panel)
    if space.spatial:
        return
    for layer in space.layers:
        match layer:
            case ControlNet() if not net:
                continue
            case Handles() if not handles:
                continue
            case Patches() | Recorded() | Label():
                continue
        yield from LinePaths(panel, unit).shapes(layer)


class _Outlines:
    """Sets lines of text as gpu/labels.py does, but as outlines."""

    def __init__(self) -> None:
        self.shapes: list[Shape] = []

    def text(
        self,
        text: str,
        at: tuple[float, float],
        viewport: tuple[int, int],  # noqa: ARG002
        style: Style,
    ) -> None:
        """One line at `at`."""
        italic = style.italic
        room = style.widest / max(text_width(text, style.size, italic), 1e-9)
        size = style.size * min(1.0, room)
        ascent, descent = ascent_and_descent(size, italic)
        left = at[0] - style.anchor[0] * text_width(text, size, italic)
        base = at[1] - style.anchor[1] * (ascent + descent) + descent
        pieces = outlines(text, size, italic, np.array([left, base]))
        if pieces:
            self.shapes.append(Shape(pieces, style.color, words=text))
