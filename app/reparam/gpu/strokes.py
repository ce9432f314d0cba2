"""Thick lines, dots and arrow heads, as wide as asked at any size.

What each layer is made of: lines, whose points are evaluated or uploaded and kept until they
change; a pen draws them (gpu/pen.py).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..scenes.layers import (
    Color,
    ControlNet,
    Curves,
    Dots,
    Handles,
    IsoLines,
    Parametric,
    Polylines,
    Stroked,
    Traced,
)
from .curve_parts import CurveParts
from .evaluation import Evaluation, patch_count
from .kept import Kept
from .pen import DEPTH_BIAS, FLATNESS, Lines, Pen, Screen, clip_bytes
from .polylines import (
    arrow_parameters,
    curve_links,
    curve_parameters,
    joined,
    line_parameters,
    net_legs,
)
from .programs import Programs

Array = NDArray[np.float64]

HANDLE_RINGS = ((1.5, (0.13, 0.13, 0.13)), (0.8, (1.0, 1.0, 1.0)))  # seen on any ground
ARROW_SIZE = 4.5  # figure units from the middle of the head to its tip


class Strokes:
    """Draws the layers that are made of lines and dots into the current framebuffer."""

    def __init__(self, ctx: moderngl.Context, programs: Programs, evaluation: Evaluation) -> None:
        self._ctx = ctx
        self._programs = programs
        self._evaluation = evaluation
        self._lines: Kept[Lines] = Kept(lambda lines: lines.release())
        self._parts = CurveParts()
        self._pen = Pen(ctx, programs)
        self._square = ctx.buffer(np.array([-1, -1, -1, 1, 1, -1, 1, 1], np.float32).tobytes())

    def sweep(self) -> None:
        """End of a frame."""
        self._lines.sweep()
        self._parts.sweep()
        self._pen.sweep()

    def forget(self) -> None:
        """Drop what older shaders evaluated."""
        self._lines.clear()
        self._pen.forget()

    def draw(
        self, layer: Stroked | ControlNet, camera: Camera, unit: float, tolerance: float = 0.0
    ) -> None:
        """A layer into the current viewport; a figure unit is `unit` pixels, and the segments of
        curves are off by at most `tolerance` pixels; 0: by less than is seen."""
        screen = Screen(camera, self._ctx.viewport, unit, tolerance or FLATNESS)
        match layer:
            case IsoLines():
                self._draw_iso_lines(layer, screen)
            case Curves():
                self._draw_curves(layer, screen)
            case Polylines():
                self._draw_polylines(layer, screen)
            case Dots():
                self._draw_dots(layer.at, screen, layer.color, layer.radius)
            case Parametric():
                self._draw_parametric(layer, screen)
            case Traced():
                self._draw_traced(layer, screen)
            case ControlNet():
                self._draw_control_net(layer, screen)

    def draw_lines(
        self,
        key: tuple[Array, Hashable],
        make: Callable[[], tuple[moderngl.Buffer, Array]],
        look: tuple[Camera, float, Color, float],
    ) -> None:
        """Lines that someone else makes: points (k, 4) in a buffer that passes to us, and their
        links; kept by an array and a key. `look`: camera, unit, colour, width."""
        camera, unit, color, width = look

        def lines() -> Lines:
            return Lines.linked(self._ctx, *make())

        self._stroke(*key, lines, Screen(camera, self._ctx.viewport, unit), color, width)

    def draw_handles(
        self, layer: Handles, camera: Camera, unit: float, only: int | None = None
    ) -> None:
        """A ringed disc for each point, or for point `only` alone, into the current viewport."""
        screen = Screen(camera, self._ctx.viewport, unit)
        at = layer.at if only is None else layer.at[only : only + 1]
        for ring, color in (*HANDLE_RINGS, (0.0, layer.color)):
            self._draw_dots(at, screen, color, layer.radius + ring)

    # Layers ---------------------------------------------------------------------------------

    def _draw_iso_lines(self, layer: IsoLines, screen: Screen) -> None:
        """The curves, evaluated on the GPU by the evaluator that draws the patches."""
        segments = self._parts.of_patches(layer, *screen.fineness())

        def evaluate() -> Lines:
            parameters, links = line_parameters(layer.u, layer.v, layer.span, segments)
            return self._evaluate(layer.net, parameters, np.tile(links, patch_count(layer.net)))

        key = (layer.u, layer.v, layer.span, segments)
        self._stroke(layer.net, key, evaluate, screen, layer.color, layer.width)
        if layer.arrow:
            ends = arrow_parameters(layer.u, layer.v, layer.span)
            tips = self._evaluation.read(layer.net, ends).reshape(-1, 2, 4)
            self._draw_arrows(tips[:, 1], tips[:, 0], screen, layer.color)

    def _draw_curves(self, layer: Curves, screen: Screen) -> None:
        for segments, net in self._parts.of_curves(layer, *screen.fineness()):
            self._draw_part(layer, net, segments, screen)
        if layer.arrow:
            ends = arrow_parameters((), (0.0,), layer.span)
            nets = layer.net.reshape(-1, layer.net.shape[-2], 1, 4)
            tips = self._evaluation.read(nets, ends).reshape(-1, 2, 4)
            self._draw_arrows(tips[:, 1], tips[:, 0], screen, layer.color)

    def _draw_part(self, layer: Curves, net: Array, segments: int, screen: Screen) -> None:
        nets = net.reshape(-1, net.shape[-2], 1, 4)

        def evaluate() -> Lines:
            links = (
                curve_links(nets[:, :, 0], segments + 1)
                if layer.span == (0.0, 1.0)
                else joined(np.zeros((len(nets), segments + 1, 3)))[1]
            )
            return self._evaluate(nets, curve_parameters(layer.span, segments), links)

        self._stroke(net, (layer.span, segments), evaluate, screen, layer.color, layer.width)

    def _draw_polylines(self, layer: Polylines, screen: Screen) -> None:
        def upload() -> Lines:
            return self._upload(*joined(layer.points, layer.closed))

        self._stroke(layer.points, layer.closed, upload, screen, layer.color, layer.width)
        if layer.arrow:
            ends = layer.points.reshape(-1, *layer.points.shape[-2:])[:, -2:].astype(np.float32)
            tips = np.concatenate([ends, np.ones((len(ends), 2, 1), np.float32)], -1)
            self._draw_arrows(tips[:, 1], tips[:, 0], screen, layer.color)

    def _draw_dots(self, at: Array, screen: Screen, color: Color, radius: float) -> None:
        """A dot is a line without length."""

        def upload() -> Lines:
            return self._upload(*joined(np.repeat(at.reshape(-1, 1, 3), 2, 1)))

        self._stroke(at, "dots", upload, screen, color, 2.0 * radius)

    def _draw_parametric(self, layer: Parametric, screen: Screen) -> None:
        def points(times: int) -> Callable[[], Lines]:
            def make() -> Lines:
                captured = self._evaluation.formulas(
                    layer.x, layer.y, layer.w, np.repeat(layer.at, times)
                )
                return self._linked(captured, len(layer.at), times)

            return make

        key = (layer.x, layer.y, layer.w)
        if layer.width:
            self._stroke(layer.at, key, points(1), screen, layer.color, layer.width)
        if layer.radius:
            width = 2.0 * layer.radius
            self._stroke(layer.at, (key, "dots"), points(2), screen, layer.color, width)

    def _draw_traced(self, layer: Traced, screen: Screen) -> None:
        def make() -> Lines:
            captured = self._evaluation.trace(layer.net, layer.table, np.repeat(layer.at, 2))
            return self._linked(captured, len(layer.at), 2)

        key = (layer.net.tobytes(), layer.table.tobytes())
        self._stroke(layer.at, key, make, screen, layer.color, 2.0 * layer.radius)

    def _linked(self, points: moderngl.Buffer, count: int, times: int) -> Lines:
        """Evaluated points as one line, or, each given twice, as dots."""
        links = np.tile([0.0, 1.0], count) if times == 2 else np.minimum(np.arange(count), 1.0)
        return Lines.linked(self._ctx, points, links)

    def _draw_control_net(self, layer: ControlNet, screen: Screen) -> None:
        """Lines along the legs, dots at the control points."""

        def upload() -> Lines:
            return self._upload(*net_legs(layer.net))

        def upload_dots() -> Lines:
            points = layer.net.reshape(-1, 4)
            dots = np.repeat(points[points[:, 3] > 0.0], 2, 0)
            return self._upload(dots, np.tile([0.0, 1.0], len(dots) // 2))

        self._stroke(layer.net, "legs", upload, screen, layer.color, layer.width)
        self._stroke(layer.net, "points", upload_dots, screen, layer.color, 2.0 * layer.dot)

    # Lines ----------------------------------------------------------------------------------

    def _evaluate(self, nets: Array, parameters: Array, links: Array) -> Lines:
        points = self._evaluation.run(nets, parameters, range(patch_count(nets)))
        return Lines.linked(self._ctx, points, links)

    def _upload(self, points: Array, links: Array) -> Lines:
        buffer = self._ctx.buffer(points.astype(np.float32).tobytes())
        return Lines.linked(self._ctx, buffer, links)

    def _stroke(
        self,
        array: Array,
        key: Hashable,
        make: Callable[[], Lines],
        screen: Screen,
        color: Color,
        width: float,
    ) -> None:
        """The lines that `make` makes of the array, as wide as `width` figure units."""
        lines = self._lines.get(array, key, make)
        self._pen.draw((array, key), lines, screen, (*color, 1.0), width * screen.unit / 2.0)

    def _draw_arrows(
        self,
        at: NDArray[np.float32],
        tail: NDArray[np.float32],
        screen: Screen,
        color: Color,
    ) -> None:
        program = self._programs.get("marker.vert", "marker.frag")
        _, _, width, height = screen.region
        program.set(
            clip_from_model=clip_bytes(screen.camera),
            viewport=(width, height),
            depth_bias=DEPTH_BIAS,
            color=(*color, 1.0),
            size=ARROW_SIZE * screen.unit,
        )
        marks = self._ctx.buffer(np.concatenate([at, tail], -1).tobytes())
        vertices = self._ctx.vertex_array(
            program.ready(),
            [(self._square, "2f", "corner"), (marks, "4f 4f /i", "at", "tail")],
        )
        vertices.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(at))
        vertices.release()
        marks.release()
