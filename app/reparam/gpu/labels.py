"""Text: set by Pillow at the size of the pixels, so sharp at every size (label.*)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import moderngl
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ..files.fonts import font_path
from ..scenes.layers import Color
from .programs import Programs

SMALLEST = 6  # pixels; below, text is not readable and not drawn


@dataclass(frozen=True)
class Style:
    """How a line of text is set: its size and its colour; which point of its box comes to where it
    stands (0..1, y up); and set smaller where it is wider than `widest`. In pixels."""

    size: float
    color: Color
    anchor: tuple[float, float] = (0.5, 0.5)
    italic: bool = False
    widest: float = float("inf")


@dataclass(frozen=True)
class Text:
    """A line of text on the GPU: its coverage, one texel a pixel."""

    texture: moderngl.Texture
    width: int
    height: int


class Labels:
    """Draws text and plain boxes, in pixels from the lower left of the framebuffer."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        self._texts: dict[tuple[str, int, bool], Text] = {}
        self._white = ctx.texture((1, 1), 1, b"\xff")
        self._corners = ctx.buffer(np.array([0, 0, 0, 1, 1, 0, 1, 1], np.float32).tobytes())

    def text(
        self, text: str, at: tuple[float, float], viewport: tuple[int, int], style: Style
    ) -> None:
        """One line at `at`."""
        pixels = round(style.size)
        width = measure(text, pixels, style.italic)
        if width > style.widest:
            pixels = int(style.size * style.widest / width)
        if pixels < SMALLEST or not text:
            return
        line = self._set(text, pixels, style.italic)
        left = round(at[0] - style.anchor[0] * line.width)
        bottom = round(at[1] - style.anchor[1] * line.height)
        box = (left, bottom, line.width, line.height)
        self._draw(line.texture, box, viewport, (*style.color, 1.0))

    def box(
        self,
        left: float,
        bottom: float,
        width: float,
        height: float,
        viewport: tuple[int, int],
        color: tuple[float, float, float, float],
    ) -> None:
        """A plain rectangle, translucent by its fourth colour component."""
        self._draw(self._white, (left, bottom, width, height), viewport, color)

    def _set(self, text: str, pixels: int, italic: bool) -> Text:
        key = (text, pixels, italic)
        if key not in self._texts:
            if len(self._texts) > 256:
                for old in self._texts.values():
                    old.texture.release()
                self._texts.clear()
            image = coverage(text, pixels, italic)
            data = image.transpose(Image.Transpose.FLIP_TOP_BOTTOM).tobytes()
            texture = self._ctx.texture(image.size, 1, data, alignment=1)
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            self._texts[key] = Text(texture, *image.size)
        return self._texts[key]

    def _draw(
        self,
        texture: moderngl.Texture,
        place: tuple[float, float, float, float],
        viewport: tuple[int, int],
        color: tuple[float, float, float, float],
    ) -> None:
        left, bottom, width, height = place
        program = self._programs.get("label.vert", "label.frag")
        texture.use(0)
        box = (left, bottom, left + width, bottom + height)
        program.set(viewport=viewport, box=box, coverage=0, color=color)
        vertices = self._ctx.vertex_array(program.ready(), [(self._corners, "2f", "corner")])
        vertices.render(moderngl.TRIANGLE_STRIP)
        vertices.release()


@lru_cache(maxsize=32)
def font(pixels: int, italic: bool) -> ImageFont.FreeTypeFont:
    """The typeface at a size in pixels."""
    # Raqm would kern differently, and is there only where libfribidi is.
    return ImageFont.truetype(str(font_path(italic)), pixels, layout_engine=ImageFont.Layout.BASIC)


def measure(text: str, pixels: int, italic: bool = False) -> float:
    """The width of a line in pixels."""
    return font(max(1, pixels), italic).getlength(text)


def coverage(text: str, pixels: int, italic: bool) -> Image.Image:
    """A line of text, white on black, in a box from ascender to descender."""
    face = font(pixels, italic)
    ascent, descent = face.getmetrics()
    width = max(1, int(face.getlength(text)) + 3)
    image = Image.new("L", (width, ascent + descent))
    ImageDraw.Draw(image).text((1, 0), text, fill=255, font=face)
    return image
