"""Shadings that show shape: the scale of the curvatures in a space, and the legend beside it."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np

from ..geometry.curvature import round_scale, sampled_curvatures
from ..scenes import palette
from ..scenes.layers import Array, Color, Patches, Space
from ..scenes.shading import COLUMN, SYMBOLS, Shading, diverging
from .kept import Kept
from .labels import Labels

BAR, STEPS = 110.0, 33  # length of the bar of colours, in figure units, and its pieces
SWATCH, WORDS, LINE = 9.0, 13.0, 17.0
INSET = 10.0  # from the corner of the space


class Shapes:
    """Keeps the curvatures of what is drawn."""

    def __init__(self) -> None:
        self._curvatures: Kept[Array] = Kept(lambda _: None)

    def scale(self, space: Space, shading: Shading) -> float:
        """The curvature that has the full colour, common to all lit patches of the space."""
        lit = [layer.net for layer in space.layers if isinstance(layer, Patches) and layer.lit]
        if shading not in COLUMN or not lit:
            return 1.0
        nets = [net if net.ndim == 4 else net[None] for net in lit]
        values = [
            self._curvatures.get(net, None, partial(sampled_curvatures, part))
            for net, part in zip(lit, nets, strict=True)
        ]
        return round_scale(np.concatenate(values)[:, COLUMN[shading]])

    def sweep(self) -> None:
        """End of a frame."""
        self._curvatures.sweep()


def draw_legend(
    labels: Labels,
    space: Space,
    shading: Shading,
    scale: float,
    corner: tuple[float, float],
    size: tuple[int, int],
    unit: float,
) -> None:
    """What the colours of a space mean, below its upper left `corner` (pixels)."""
    lit = [layer for layer in space.layers if isinstance(layer, Patches) and layer.lit]
    left, top = corner[0] + INSET * unit, corner[1] - INSET * unit
    if not lit:
        return
    if shading in SYMBOLS:
        _draw_bar(labels, SYMBOLS[shading], scale, left, top, size, unit)
    elif shading == "kind":
        kinds = dict.fromkeys(layer.kind for layer in lit if layer.kind.words)
        for number, kind in enumerate(kinds):
            y = top - (number + 0.5) * LINE * unit
            _box(labels, left, y, SWATCH * unit, kind.color, size, SWATCH * unit)
            at = (left + (SWATCH + 5.0) * unit, y)
            labels.text(kind.words, at, size, WORDS * unit, palette.INK, (0.0, 0.5))


def _draw_bar(
    labels: Labels,
    words: str,
    scale: float,
    left: float,
    top: float,
    size: tuple[int, int],
    unit: float,
) -> None:
    labels.text(words, (left, top - LINE / 2 * unit), size, WORDS * unit, palette.INK, (0.0, 0.5))
    y = top - 1.5 * LINE * unit
    edges = np.round(np.linspace(left, left + BAR * unit, STEPS + 1))
    for k, (start, end) in enumerate(pairwise(edges)):
        red, green, blue = diverging(2.0 * k / (STEPS - 1) - 1.0)
        _box(labels, start, y, SWATCH * unit, (red, green, blue), size, end - start)
    for value, at in ((-scale, 0.0), (0.0, 0.5), (scale, 1.0)):
        text = f"{value:g}".replace("-", "−")
        place = (left + at * BAR * unit, y - LINE * unit)
        labels.text(text, place, size, WORDS * unit, palette.INK, (at, 0.5))


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
