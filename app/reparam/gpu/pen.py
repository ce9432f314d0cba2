"""Draws polylines as wide as asked, whatever they are made of.

Points in the model go their way in three steps, each kept for as long as it stays true: points on
the pixels (flatten.vert), for each view; which segments are drawn together (group.vert) and what
lies around them (reach.vert), for each view and width. Then they are drawn (stroke.*).
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from .kept import Kept
from .nets import NET_WIDTH
from .polylines import segments
from .programs import Program, Programs

Array = NDArray[np.float64]

DEPTH_BIAS = 2e-3  # lines that lie on a surface come before it
TEXEL = 16  # bytes of a point

# Pixels between a curve and its segments where no tolerance is asked for, however many curves: no
# pixel is more than 5 grey levels off. (By a 20th of a pixel it is 13, by half a pixel 49: corners
# show. A 20th would take half as many segments, half a pixel a sixth.)
FLATNESS = 1.0 / 80.0
VIEWS = 1  # frames that what is true of a view is kept unused


@dataclass(frozen=True)
class Screen:
    """A camera, the viewport (left, bottom, width, height), the pixels of a figure unit, and those
    that a curve's segments may be off."""

    camera: Camera
    region: tuple[int, int, int, int]
    unit: float
    tolerance: float = FLATNESS

    def key(self) -> Hashable:
        """What the points on the pixels depend on."""
        return self.camera.clip_from_model().tobytes(), self.region

    def fineness(self) -> tuple[Camera, float, float]:
        """The camera, pixels of a unit of its view plane, and the tolerance."""
        return self.camera, self.region[2] / (2.0 * self.camera.half_width), self.tolerance


@dataclass(frozen=True)
class Lines:
    """Polylines on the GPU: points (count, 4), and of each point's segment its line."""

    points: moderngl.Buffer
    segments: moderngl.Buffer
    count: int

    @classmethod
    def linked(cls, ctx: moderngl.Context, points: moderngl.Buffer, links: Array) -> Lines:
        """Points (count, 4) in a buffer, which passes to us, with their links as
        gpu/polylines.py has them."""
        return cls(points, ctx.buffer(segments(links).tobytes()), len(links))

    def release(self) -> None:
        """Give the memory back."""
        self.points.release()
        self.segments.release()


@dataclass(frozen=True)
class Grouped:
    """Which segments are drawn together (lib/groups.glsl), and what lies around them."""

    groups: moderngl.Texture
    reach: moderngl.Buffer

    def release(self) -> None:
        """Give the memory back."""
        self.groups.release()
        self.reach.release()


class Pen:
    """Draws lines into the current viewport."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        self._flat: Kept[moderngl.Texture] = Kept(lambda texture: texture.release(), VIEWS)
        self._grouped: Kept[Grouped] = Kept(lambda grouped: grouped.release(), VIEWS)
        self._rectangle = ctx.buffer(np.array([0, 0, 0, 1, 1, 0, 1, 1], np.float32).tobytes())

    def sweep(self) -> None:
        """End of a frame."""
        self._flat.sweep()
        self._grouped.sweep()

    def forget(self) -> None:
        """Drop what older shaders made."""
        self._flat.clear()
        self._grouped.clear()

    def draw(
        self,
        what: tuple[Array, Hashable],
        lines: Lines,
        screen: Screen,
        color: tuple[float, float, float, float],
        half_width: float,
    ) -> None:
        """Lines, made of an array and a key, in the screen's viewport; `half_width` in pixels."""
        array, key = what
        view = (key, screen.key())
        self._flat.get(array, view, lambda: self._flatten(lines, screen)).use(0)
        wide = (view, half_width)
        grouped = self._grouped.get(array, wide, lambda: self._group(lines, half_width))
        grouped.groups.use(1)
        program = self._programs.get("stroke.vert", "stroke.frag")
        program.set(
            polyline=0,
            groups=1,
            region=screen.region,
            half_width=half_width,
            depth_bias=DEPTH_BIAS,
            color=color,
        )
        vertices = self._ctx.vertex_array(
            program.ready(),
            [
                (self._rectangle, "2f", "corner"),
                (lines.segments, "3i i /i", "line", "segment"),
                (grouped.reach, "4f /i", "reach"),
            ],
        )
        vertices.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=lines.count)
        vertices.release()

    def _flatten(self, lines: Lines, screen: Screen) -> moderngl.Texture:
        """The points on the pixels."""
        program = self._programs.get("flatten.vert", varyings=("place",))
        program.set(clip_from_model=clip_bytes(screen.camera), region=screen.region)
        return self._as_texture(self._capture(program, (lines.points, "4f", "point"), lines, 1))

    def _group(self, lines: Lines, half_width: float) -> Grouped:
        """The flattened lines are bound; the groups are, from then on."""
        line = (lines.segments, "3i i", "line", "segment")
        program = self._programs.get("group.vert", varyings=("circle", "extent"))
        program.set(polyline=0, half_width=half_width)
        groups = self._as_texture(self._capture(program, line, lines, 2))
        groups.use(1)
        program = self._programs.get("reach.vert", varyings=("reach",))
        program.set(polyline=0, groups=1, half_width=half_width)
        return Grouped(groups, self._capture(program, line, lines, 1))

    def _capture(
        self, program: Program, content: tuple[Any, ...], lines: Lines, texels: int
    ) -> moderngl.Buffer:
        """What a program makes of each point: (count, texels, 4), and room for whole rows."""
        width = min(lines.count * texels, NET_WIDTH)
        rows = -(-lines.count * texels // width)
        captured = self._ctx.buffer(reserve=rows * width * TEXEL)
        vertices = self._ctx.vertex_array(program.ready(), [content])
        vertices.transform(captured, moderngl.POINTS, lines.count)
        vertices.release()
        return captured

    def _as_texture(self, captured: moderngl.Buffer) -> moderngl.Texture:
        """The same in rows of up to NET_WIDTH texels; the buffer is given back."""
        texels = captured.size // TEXEL
        width = min(texels, NET_WIDTH)
        texture = self._ctx.texture((width, texels // width), 4, dtype="f4")
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        texture.write(captured)
        captured.release()
        return texture


def clip_bytes(camera: Camera) -> bytes:
    """The matrix as OpenGL takes it."""
    return camera.clip_from_model().T.astype(np.float32).tobytes()
