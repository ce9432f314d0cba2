"""Two pictures in one: side by side with a divider, or one fading into the other (compare.frag)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import moderngl
import numpy as np

from ..scenes import palette
from .labels import SMALLEST, Style, measure
from .targets import Target

if TYPE_CHECKING:
    from .painter import Painter
    from .region import Region

LINE = 1.2  # figure units, of the divider
TAG = 15.0
TAG_GROUND = (1.0, 1.0, 1.0, 0.85)


@dataclass(frozen=True)
class Split:
    """A region with two pictures: where the divider stands, 0..1 of its width, how far the left
    one has faded, and both names."""

    region: Region
    divider: float
    blend: float
    left: str
    right: str

    @property
    def line(self) -> int:
        """The divider in pixels from the left of the target."""
        return self.region.left + round(self.divider * self.region.width)


class Comparison:
    """Keeps the right picture while the left one is drawn, and lays it over."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._corners = ctx.buffer(np.array([0, 0, 0, 1, 1, 0, 1, 1], np.float32).tobytes())
        self._texture: moderngl.Texture | None = None
        self._framebuffer: moderngl.Framebuffer | None = None

    def keep(self, target: Target) -> None:
        """Keep what was drawn into the target."""
        if self._texture is None or self._texture.size != target.size:
            self.release()
            self._texture = self._ctx.texture(target.size, 4)
            self._texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            self._framebuffer = self._ctx.framebuffer([self._texture])
        assert self._framebuffer is not None
        self._ctx.copy_framebuffer(self._framebuffer, target.framebuffer)

    def lay_over(self, painter: Painter, target: Target, split: Split, unit: float) -> None:
        """The kept picture over the one drawn last into the target, with divider and names."""
        assert self._texture is not None
        region, line = split.region, split.line
        box = (
            region.left,
            region.bottom,
            region.left + region.width,
            region.bottom + region.height,
        )
        target.framebuffer.use()
        self._ctx.viewport = (0, 0, *target.size)
        self._texture.use(0)
        program = painter.programs.get("label.vert", "compare.frag")
        program.set(viewport=target.size, box=tuple(map(float, box)))
        program.set(picture=0, divider=float(line), blend=split.blend)
        vertices = self._ctx.vertex_array(program.ready(), [(self._corners, "2f", "corner")])
        vertices.render(moderngl.TRIANGLE_STRIP)
        vertices.release()
        if unit > 0.0 and box[0] < line < box[2]:
            thick = max(1.0, round(LINE * unit))
            stroke = (line - thick / 2, float(region.bottom), thick, float(region.height))
            painter.labels.box(*stroke, target.size, (*palette.INK, 1.0))
        _draw_tag(painter, split, target.size, unit, before=True)
        _draw_tag(painter, split, target.size, unit, before=False)
        target.resolve()

    def release(self) -> None:
        """Give the memory back."""
        if self._framebuffer is not None and self._texture is not None:
            self._framebuffer.release()
            self._texture.release()
        self._framebuffer = self._texture = None


def _draw_tag(
    painter: Painter, split: Split, size: tuple[int, int], unit: float, *, before: bool
) -> None:
    """The name of one side, at the top beside the divider."""
    text = split.left if before else split.right
    region, line = split.region, split.line
    gap, pixels = 0.7 * TAG * unit, TAG * unit
    room = (line - region.left if before else region.left + region.width - line) - 2.0 * gap
    width = min(measure(text, round(pixels)), room)
    if width < SMALLEST:
        return
    left = line - gap - width if before else line + gap
    bottom, high = region.bottom + region.height - 1.9 * pixels, 1.5 * pixels
    painter.labels.box(left - gap / 2, bottom, width + gap, high, size, TAG_GROUND)
    at = (left, bottom + high / 2)
    painter.labels.text(text, at, size, Style(pixels, palette.INK, anchor=(0.0, 0.5), widest=room))
