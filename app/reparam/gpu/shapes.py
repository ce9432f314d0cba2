"""Shadings: the scale of their values in a space, and the legend beside it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..geometry.curvature import round_scale, sampled_curvatures
from ..scenes import palette
from ..scenes.layers import Array, Color, Patches, Space
from ..scenes.shading import (
    COLUMN,
    DISTORTION,
    HALF_A_PIXEL,
    OF_SUBJECT,
    RIM,
    SYMBOLS,
    Scale,
    Shading,
    attached_by,
    bar_colors,
    ticks,
)
from .arrangement import Panel
from .kept import Kept
from .labels import Labels, Style, measure
from .region import TITLE_LINE

BAR, STEPS = 110.0, 33  # length of the bar of colours, in figure units, and its pieces
SWATCH, WORDS, LINE = 9.0, 13.0, 17.0
INSET = 10.0  # from the corner of the space
AIR = 5.0  # of a title's line, above its letters
VEIL = 4.0  # how far it reaches beyond words and bar
FACTORS = (1.1, 1.2, 1.5, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0, 1024.0)  # at which colours are full
SAMPLES = 1 << 14  # of a layer, at most, that tell which values occur


class Shapes:
    """Keeps the curvatures and distortions of what is drawn."""

    def __init__(self) -> None:
        self._values: Kept[tuple[Array, Array]] = Kept(lambda _: None)  # and what it was made of

    def scale(self, space: Space, shading: Shading, tolerance: float, unit: float) -> Scale:
        """What is white and what has the full colour, common to all patches of the space, drawn to
        a tolerance (0: none) where a figure unit is `unit` pixels."""
        layers = shaded(space, shading)
        if shading == "error":
            return Scale(full=tolerance or HALF_A_PIXEL)
        if shading == "level":
            return Scale(full=RIM * unit)
        if shading in COLUMN and layers:
            values = np.concatenate([self._curvatures(layer.net) for layer in layers])
            return Scale(0.0, round_scale(values[:, COLUMN[shading]]))
        if shading in DISTORTION and layers:
            values = np.concatenate([self._distortions(layer) for layer in layers])
            return distortion_scale(shading, values[:, DISTORTION[shading]])
        return Scale()

    def _curvatures(self, net: Array) -> Array:
        nets = net if net.ndim == 4 else net[None]
        return self._values.get(net, None, lambda: (net, sampled_curvatures(nets)))[1]

    def _distortions(self, layer: Patches) -> Array:
        maps = attached_by(layer)
        nets = layer.net if layer.net.ndim == 4 else layer.net[None]
        samples = int(np.clip((SAMPLES / len(nets)) ** 0.5, 2, 16))

        def made() -> tuple[Array, Array]:
            from ..geometry.distortion import sampled_distortions  # a plain start goes without

            return maps, sampled_distortions(nets, maps, samples).reshape(-1, 3)

        return self._values.get(layer.net, id(maps), made)[1]

    def sweep(self) -> None:
        """End of a frame."""
        self._values.sweep()


def shaded(space: Space, shading: Shading) -> list[Patches]:
    """The layers that a shading is for: those that are lit, or all of a subject."""
    layers = [layer for layer in space.layers if isinstance(layer, Patches)]
    return [layer for layer in layers if layer.lit or shading in OF_SUBJECT]


def distortion_scale(shading: Shading, values: Array) -> Scale:
    """The median area is white, and no stretch, and the right angle; 19 of 20 values have not yet
    the full colour."""
    values = values[np.isfinite(values)]
    if not len(values):
        return Scale()
    if shading == "angle":
        return Scale(0.0, min(round_scale(values), 90.0))
    middle = float(np.median(values)) if shading == "area" else 0.0
    most = float(np.quantile(np.abs(values - middle), 0.95))
    logs = np.log2(FACTORS)
    return Scale(
        middle, float(logs[np.searchsorted(logs[:-1], most - 1e-9)]) if most > 1e-6 else 1.0
    )


def draw_legend(
    labels: Labels,
    panel: Panel,
    shading: Shading,
    scale: Scale,
    size: tuple[int, int],
    unit: float,
) -> None:
    """What the colours of a space mean: in its upper left corner, or above its title if there is
    room for that."""
    layers = shaded(panel.space, shading)
    left, top = panel.region.left + INSET * unit, panel.region.top - INSET * unit
    above = panel.region.top + (TITLE_LINE - AIR + 3.0 * LINE) * unit
    if panel.space.title and panel.part.top >= above:
        top = above
    if not layers:
        return
    if shading in SYMBOLS:
        words = SYMBOLS[shading]
        marks = [*ticks(shading, scale)]
        colors = bar_colors(shading, np.linspace(marks[0][0], marks[-1][0], STEPS))
        _draw_bar(labels, words, marks, colors, left, top, size, unit)
    elif shading == "kind":
        kinds = dict.fromkeys(layer.kind for layer in layers if layer.kind.words)
        for number, kind in enumerate(kinds):
            y = top - (number + 0.5) * LINE * unit
            _box(labels, left, y, SWATCH * unit, kind.color, size, SWATCH * unit)
            at = (left + (SWATCH + 5.0) * unit, y)
            labels.text(kind.words, at, size, Style(WORDS * unit, palette.INK, (0.0, 0.5)))


def _draw_bar(
    labels: Labels,
    words: str,
    marks: list[tuple[float, str]],
    colors: Array,
    left: float,
    top: float,
    size: tuple[int, int],
    unit: float,
) -> None:
    """The colours (k, 3) from the first mark's value to the last one's."""
    width = max(BAR * unit, measure(words, round(WORDS * unit))) + 2 * VEIL * unit
    veil = (left - VEIL * unit, top - 3 * LINE * unit, width, 3 * LINE * unit)
    labels.box(*veil, size, (1.0, 1.0, 1.0, 0.75))  # words stay legible over a surface
    style = Style(WORDS * unit, palette.INK, (0.0, 0.5))
    labels.text(words, (left, top - LINE / 2 * unit), size, style)
    y = top - 1.5 * LINE * unit
    first, last = marks[0][0], marks[-1][0]
    edges = np.round(np.linspace(left, left + BAR * unit, len(colors) + 1))
    for (red, green, blue), (start, end) in zip(colors, pairwise(edges), strict=True):
        _box(labels, start, y, SWATCH * unit, (red, green, blue), size, end - start)
    for value, text in marks:
        at = (value - first) / (last - first)
        place = (left + at * BAR * unit, y - LINE * unit)
        labels.text(text, place, size, Style(WORDS * unit, palette.INK, (at, 0.5)))


def _box(
    labels: Labels,
    left: float,
    middle: float,
    height: float,
    color: Color,
    size: tuple[int, int],
    width: float,
) -> None:
    labels.box(left, middle - height / 2, width, height, size, (*color, 1.0))
