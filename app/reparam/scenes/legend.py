"""A strip of words above a space: what is seen there, and which colour means what."""

from __future__ import annotations

from collections.abc import Sequence

from ..geometry.net import control_net
from .layers import Array, Color, Label, Layer, Patches, Space, plane

TITLE, WORDS = 15.0, 13.0  # sizes
LETTER = 0.44  # of a size: how wide, on average
HEIGHT, SWATCH, GAP = 22.0, 9.0, 9.0
COLUMN = 456.0  # what a caption of two lines leaves of a square picture


def legend(
    name: str,
    title: str,
    entries: Sequence[tuple[Color, str]] = (),
    rows: int = 1,
    columns: int = 1,
) -> Space:
    """The title, then swatches with their words; lengths are figure units.

    The space that it belongs to comes after it, with `below=True`; such spaces fill a picture in
    `rows` and `columns`.
    """
    layers: list[Layer] = []
    x = 0.0
    if title:
        layers.append(Label(title, (x, HEIGHT / 2, 0.0), anchor=(0.0, 0.5), size=TITLE))
        x += LETTER * TITLE * len(title) + GAP
    for color, words in entries:
        layers.append(Patches(_swatch(x), color=color))
        x += SWATCH + 4.0
        layers.append(Label(words, (x, HEIGHT / 2, 0.0), anchor=(0.0, 0.5), size=WORDS))
        x += LETTER * WORDS * len(words) + GAP
    width = 0.88 * 512.0 / columns  # a little less, so that the height decides on the scale
    share = 1.1 * HEIGHT / (COLUMN / rows - 1.1 * HEIGHT)
    return Space(name, plane(0.0, 0.0, width, HEIGHT), tuple(layers), height=share)


def _swatch(x: float) -> Array:
    low, high = (HEIGHT - SWATCH) / 2, (HEIGHT + SWATCH) / 2
    return control_net([[(x, high), (x + SWATCH, high)], [(x, low), (x + SWATCH, low)]])
