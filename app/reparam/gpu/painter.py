"""Draws a figure into a target: the one frame that window and snapshot share."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import moderngl

from ..errors import GraphicsError
from ..geometry.camera import View
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
    Polylines,
    Recorded,
)
from ..scenes.shading import OF_SUBJECT, Scale, Shading
from .arrangement import UNITS, Panel, arrange
from .context import Capabilities, capabilities
from .evaluation import Evaluation
from .plans import Tolerance
from .programs import Programs
from .shapes import Shapes, draw_legend
from .surfaces import Fine, Surfaces
from .targets import Target

if TYPE_CHECKING:
    from .comparison import Comparison
    from .labels import Labels
    from .recordings import Recordings
    from .strokes import Strokes

LIFT = 5e-4  # of normalised depth, between strokes that lie on one another


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
        more: bool = False,
    ) -> list[Panel]:
        """The figure, or with `plain` its subject's patches alone on a saturated ground; `more`
        figures follow in the same frame.

        Raises GraphicsError if OpenGL reports an error, or has not the evaluator asked for.
        """
        chosen = self.capabilities.evaluator(evaluator)
        figure = figure.plain() if plain else figure
        panels = arrange(figure, target.size, views or {}, plain, display.net, display.perspective)
        framebuffer = target.framebuffer
        framebuffer.use()
        self._reset_state()
        ground = palette.PLAIN_GROUND if plain else palette.GROUND
        self.ctx.viewport = (0, 0, *target.size)
        framebuffer.clear(*ground, 1.0, depth=1.0)
        self.ctx.blend_func = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)
        unit = min(target.size) / UNITS
        for panel in panels:
            shading = display.shading
            if shading in OF_SUBJECT and panel.space is not figure.subject:
                shading = "light"
            self._draw_space(panel, target, display, shading, chosen, unit, plain)
        if not plain:
            self._draw_words(figure, panels, target.size, unit)
        if not more:
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
        shading: Shading,
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
        scale = self.shapes.scale(panel.space, shading, display.tolerance, unit)
        for layer in panel.space.layers:
            self._draw_layer(layer, panel, display, shading, evaluator, unit, scale)
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
        if shading != "light" and not plain:
            draw_legend(self.labels, panel, shading, scale, target.size, unit)

    def _draw_layer(
        self,
        layer: Layer,
        panel: Panel,
        display: Display,
        shading: Shading,
        evaluator: str,
        unit: float,
        scale: Scale,
    ) -> None:
        camera = panel.camera
        match layer:
            case Patches():
                viewport = (panel.region.width, panel.region.height)
                off = display.tolerance
                beside = tuple(each for each in panel.space.layers if isinstance(each, Patches))
                fine: Fine = Tolerance(off, viewport, beside) if off else display.level
                several = sum(each.trim is not None for each in beside) > 1
                self.surfaces.draw(
                    layer, camera, evaluator, fine, shading, scale,
                    by_sample=panel.space.spatial or several,
                )  # fmt: skip
                if display.wireframe:
                    nearer = camera.nearer(1e-3)
                    self.surfaces.draw_wireframe(layer, nearer, evaluator, fine, palette.INK)
            case ControlNet() if not display.net:
                pass
            case Label() | Handles():
                pass
            case IsoLines() | Dots() | Polylines():
                self.strokes.draw(layer, camera.nearer(LIFT * layer.lift), unit, display.tolerance)
            case Recorded():
                self.recordings.draw_layer(layer, camera, unit)
            case _:
                self.strokes.draw(layer, camera, unit, display.tolerance)

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
