"""Draws a figure into a target: the one frame that window and snapshot share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError
from ..geometry.camera import Camera, View, frame
from ..geometry.evaluate import project
from ..scenes import palette
from ..scenes.display import Display
from ..scenes.layers import (
    ControlNet,
    Dots,
    Figure,
    Handles,
    IsoLines,
    Label,
    Layer,
    Patches,
    Recorded,
    Space,
)
from .adaptive import Tolerance
from .context import Capabilities, capabilities
from .evaluation import Evaluation
from .programs import Programs
from .region import Region
from .shapes import Shapes, draw_legend
from .surfaces import Fine, Surfaces
from .targets import Target

if TYPE_CHECKING:
    from .comparison import Comparison
    from .labels import Labels
    from .recordings import Recordings
    from .strokes import Strokes

Array = NDArray[np.float64]

UNITS = 512.0  # figure units along the shorter side of a picture
CAPTION_SIZE = 17.0
CAPTION_LINE = 23.0
PADDING = 10.0
LIFT = 5e-4  # of normalised depth, between strokes that lie on one another


@dataclass(frozen=True)
class Panel:
    """A space with where it stands and how it is seen."""

    space: Space
    region: Region
    camera: Camera


def arrange(
    figure: Figure, size: tuple[int, int], views: Mapping[str, View], plain: bool, net: bool
) -> list[Panel]:
    """The spaces where `regions` puts them, less their margins, above the caption.

    With `net` the control nets must be seen too.
    """
    width, height = size
    unit = min(size) / UNITS
    foot = 0 if plain else round((len(figure.caption) * CAPTION_LINE + PADDING) * unit)
    foot = min(foot, height - 1)
    panels = []
    whole = regions(figure.spaces, width, height - foot, foot)
    for space, region in zip(figure.spaces, whole, strict=True):
        alike = zip(figure.spaces, whole, strict=True)
        narrowest = min(each.width for other, each in alike if other.width == space.width)
        region = region.inside(figure.spaces, unit, narrowest)
        points = extent(space, net)
        view = views.get(space.name, View())
        camera = frame(points, region.width, region.height, view, space.spatial)
        panels.append(Panel(space, region, camera))
    return panels


def regions(spaces: Sequence[Space], width: int, height: int, foot: int) -> list[Region]:
    """Columns side by side (rows one above another in an upright picture), `foot` from below.

    A space that stands `below` belongs to the column of the one before it. Columns are as wide,
    and spaces in a column as high, as they ask for in proportion; together they fill the whole.
    """
    columns: list[list[Space]] = []
    for space in spaces:
        if space.below and columns:
            columns[-1].append(space)
        else:
            columns.append([space])
    found = []
    across = width >= height
    wide = _cuts([column[0].width for column in columns], width if across else height)
    for column, (start, end) in zip(columns, wide, strict=True):
        high = _cuts([space.height for space in column], height if across else end - start)
        for low, up in high:  # both count from the top
            if across:
                region = Region(start, foot + height - up, end - start, up - low)
            else:
                region = Region(0, foot + height - start - up, width, up - low)
            found.append(region)
    return found


def _cuts(shares: Sequence[float], length: int) -> list[tuple[int, int]]:
    """A length cut in proportion: start and end of each part, at least 1 long."""
    ends = np.cumsum([0.0, *shares]) / sum(shares) * length
    whole = [round(end) for end in ends]
    return [(a, max(a + 1, b)) for a, b in pairwise(whole)]


def extent(space: Space, net: bool) -> Array:
    """Points (k, 3) that the space's viewport must show."""
    points = space.bounds
    if len(points) == 2:
        points = np.stack(np.meshgrid(*points.T, indexing="ij"), -1).reshape(-1, 3)
    nets = [layer.net for layer in space.layers if isinstance(layer, ControlNet) and net]
    controls = [control[control[..., 3] > 0.0] for control in nets]
    return np.concatenate([points, *(project(control) for control in controls)])


class Painter:
    """All that a context holds to draw figures."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self.capabilities: Capabilities = capabilities(ctx)
        self.programs = Programs(ctx)
        self.evaluation = Evaluation(ctx, self.programs)
        self.surfaces = Surfaces(ctx, self.programs, self.evaluation, self.capabilities)
        self.shapes = Shapes()

    @cached_property
    def strokes(self) -> Strokes:
        """Lines and marks; a plain picture starts without them."""
        from .strokes import Strokes

        return Strokes(self.ctx, self.programs, self.evaluation)

    @cached_property
    def comparison(self) -> Comparison:
        """Two pictures in one; few ask for it."""
        from .comparison import Comparison

        return Comparison(self.ctx)

    @cached_property
    def nowhere(self) -> moderngl.Framebuffer:
        """A framebuffer to be bound while evaluating: without any, surfaceless EGL evaluates
        nothing and says nothing."""
        return self.ctx.framebuffer([self.ctx.renderbuffer((1, 1))])

    @cached_property
    def recordings(self) -> Recordings:
        """What evaluator calls recorded."""
        from .recordings import Recordings

        return Recordings(self)

    @cached_property
    def labels(self) -> Labels:
        """Text; a plain picture starts without it."""
        from .labels import Labels

        return Labels(self.ctx, self.programs)

    def draw(
        self,
        figure: Figure,
        target: Target,
        display: Display,
        *,
        evaluator: str | None = None,
        views: Mapping[str, View] | None = None,
        plain: bool = False,
    ) -> list[Panel]:
        """The figure, or with `plain` its subject's patches alone on a saturated ground.

        Raises GraphicsError if OpenGL reports an error, or has not the evaluator asked for.
        """
        chosen = self.capabilities.evaluator(evaluator)
        figure = figure.plain() if plain else figure
        panels = arrange(figure, target.size, views or {}, plain, display.net)
        framebuffer = target.framebuffer
        framebuffer.use()
        self._reset_state()
        ground = palette.PLAIN_GROUND if plain else palette.GROUND
        self.ctx.viewport = (0, 0, *target.size)
        framebuffer.clear(*ground, 1.0, depth=1.0)
        self.ctx.blend_func = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)
        unit = min(target.size) / UNITS
        for panel in panels:
            self._draw_space(panel, target, display, chosen, unit, plain)
        if not plain:
            self._draw_words(figure, panels, target.size, unit)
        self._end_frame()
        target.resolve()
        return panels

    def clear_screen(self, size: tuple[int, int]) -> None:
        """An empty picture in the window's own framebuffer, which is bound from then on."""
        screen = self.ctx.detect_framebuffer(0)
        screen.use()
        self._reset_state()
        self.ctx.viewport = (0, 0, *size)
        screen.clear(*palette.GROUND, 1.0)
        self.ctx.blend_func = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)

    def _reset_state(self) -> None:
        """What an earlier frame may have left, had it failed."""
        self.ctx.enable_only(moderngl.BLEND)
        self.ctx.scissor = None

    def _draw_space(
        self,
        panel: Panel,
        target: Target,
        display: Display,
        evaluator: str,
        unit: float,
        plain: bool,
    ) -> None:
        region = panel.region
        box = (region.left, region.bottom, region.width, region.height)
        self.ctx.viewport = box
        self.ctx.scissor = box
        if panel.space.spatial:
            self.ctx.enable(moderngl.DEPTH_TEST)
        scale = self.shapes.scale(panel.space, display.shading)
        for layer in panel.space.layers:
            self._draw_layer(layer, panel, display, evaluator, unit, scale)
        self.ctx.disable(moderngl.DEPTH_TEST)
        for layer in panel.space.layers:
            if isinstance(layer, Handles) and display.handles:
                self.strokes.draw_handles(layer, panel.camera, unit)
        self.ctx.scissor = None
        self.ctx.viewport = (0, 0, *target.size)
        for layer in panel.space.layers:
            if isinstance(layer, Label):
                from .margins import draw_label

                draw_label(self.labels, layer, panel, target.size, unit)
        if display.shading != "light" and not plain:
            corner = (region.left, region.bottom + region.height)
            draw_legend(self.labels, panel.space, display.shading, scale, corner, target.size, unit)

    def _draw_layer(
        self,
        layer: Layer,
        panel: Panel,
        display: Display,
        evaluator: str,
        unit: float,
        scale: float,
    ) -> None:
        camera = panel.camera
        match layer:
            case Patches():
                viewport = (panel.region.width, panel.region.height)
                off = display.tolerance
                fine: Fine = Tolerance(off, viewport) if off else display.level
                self.surfaces.draw(
                    layer, camera, evaluator, fine, display.shading, scale,
                    spatial=panel.space.spatial,
                )  # fmt: skip
                if display.wireframe:
                    nearer = camera.nearer(1e-3)
                    self.surfaces.draw_wireframe(layer, nearer, evaluator, fine, palette.INK)
            case ControlNet() if not display.net:
                pass
            case Label() | Handles():
                pass
            case IsoLines() | Dots():
                self.strokes.draw(layer, camera.nearer(LIFT * layer.lift), unit)
            case Recorded():
                self.recordings.draw_layer(layer, camera, unit)
            case _:
                self.strokes.draw(layer, camera, unit)

    def _draw_words(
        self, figure: Figure, panels: list[Panel], size: tuple[int, int], unit: float
    ) -> None:
        """Titles and notes of the spaces, and the caption."""
        if any(space.title or space.notes for space in figure.spaces):
            from .margins import draw_margins

            draw_margins(self.labels, panels, size, unit)
        if figure.caption:
            from .margins import draw_caption

            draw_caption(self.labels, figure.caption, size, unit)

    def _end_frame(self) -> None:
        self.evaluation.sweep()
        self.surfaces.sweep()
        self.shapes.sweep()
        if "strokes" in self.__dict__:
            self.strokes.sweep()
        error = self.ctx.error
        if error != "GL_NO_ERROR":
            raise GraphicsError(f"OpenGL: expected no error after drawing, found {error}")

    def reload_shaders(self) -> None:
        """Read all shaders anew; if one fails, keep the last good ones and raise GraphicsError."""
        self.programs.reload()
        self.surfaces.forget()
        self.strokes.forget()
