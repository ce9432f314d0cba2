"""Text as outlines: the same letters everywhere, whether the reader has the font or not."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont
from numpy.typing import NDArray

from .fonts import font_path
from .vector import Piece

Array = NDArray[np.float64]


@lru_cache(maxsize=2)
def _opened(italic: bool) -> TTFont:
    return TTFont(str(font_path(italic)))


def outlines(text: str, size: float, italic: bool, origin: Array) -> tuple[Piece, ...]:
    """The pieces of a line of text whose baseline begins at `origin` (2,), `size` to the em."""
    face = _opened(italic)
    glyphs, names, widths = face.getGlyphSet(), face.getBestCmap(), face["hmtx"]
    scale = size / face["head"].unitsPerEm
    pieces: list[Piece] = []
    at = np.array(origin, dtype=np.float64)  # where the next letter stands
    for letter in text:
        name = names.get(ord(letter), ".notdef")
        pen = DecomposingRecordingPen(glyphs)
        glyphs[name].draw(pen)
        pieces += _pieces(pen.value, scale, at.copy())
        at[0] += widths[name][0] * scale
    return tuple(pieces)


def text_width(text: str, size: float, italic: bool) -> float:
    """The sum of the letters' advances."""
    face = _opened(italic)
    names, widths = face.getBestCmap(), face["hmtx"]
    units = sum(widths[names.get(ord(letter), ".notdef")][0] for letter in text)
    return float(units * size / face["head"].unitsPerEm)


def ascent_and_descent(size: float, italic: bool) -> tuple[float, float]:
    """How far the line's box reaches above and below its baseline."""
    face = _opened(italic)
    scale = size / face["head"].unitsPerEm
    return face["hhea"].ascent * scale, -face["hhea"].descent * scale


def _pieces(value: list[tuple[str, Any]], scale: float, origin: Array) -> list[Piece]:
    found: list[Piece] = []
    start, segments = origin, list[Array]()
    for command, points in value:
        placed = [origin + scale * np.array(point, dtype=np.float64) for point in points if point]
        if command == "moveTo":
            start, segments = placed[0], []
        elif command == "lineTo" or command == "curveTo":
            segments.append(np.stack(placed))
        elif command == "qCurveTo":
            segments += _quadratics(placed)
        elif segments:
            found.append(Piece(start, tuple(segments), closed=True))
    return found


def _quadratics(points: list[Array]) -> list[Array]:
    """TrueType's run of control points: between two of them there is one of the curve."""
    controls, end = points[:-1], points[-1]
    ends = [(a + b) / 2.0 for a, b in pairwise(controls)]
    return [np.stack(pair) for pair in zip(controls, [*ends, end], strict=True)]
