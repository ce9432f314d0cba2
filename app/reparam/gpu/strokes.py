"""Thick lines, dots and arrow heads, as wide as asked at any size (stroke.*, marker.*)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..scenes.layers import Color, ControlNet, Handles, IsoLines
from .evaluation import Evaluation, patch_count
from .kept import Kept
from .programs import Program, Programs

Array = NDArray[np.float64]

CURVE_SEGMENTS = 64
DEPTH_BIAS = 2e-3  # lines that lie on a surface come before it
HANDLE_RINGS = ((1.5, (0.13, 0.13, 0.13)), (0.8, (1.0, 1.0, 1.0)))  # seen on any ground
ARROW_SIZE = 4.5  # figure units from the middle of the head to its tip


@dataclass(frozen=True)
class Polylines:
    """Points of polylines, one after another, on the GPU.

    `points` holds (count, 4) float32; `pens` is 1 where a segment comes from the point before.
    The first and the last point are padding, so that every segment has two neighbours.
    """

    points: moderngl.Buffer
    pens: moderngl.Buffer
    count: int


class Strokes:
    """Draws IsoLines, ControlNet and Handles layers into the current framebuffer."""

    def __init__(self, ctx: moderngl.Context, programs: Programs, evaluation: Evaluation) -> None:
        self._ctx = ctx
        self._programs = programs
        self._evaluation = evaluation
        self._lines: Kept[Polylines] = Kept(_release)
        self._segment = ctx.buffer(np.array([0, -1, 0, 1, 1, -1, 1, 1], np.float32).tobytes())
        self._square = ctx.buffer(np.array([-1, -1, -1, 1, 1, -1, 1, 1], np.float32).tobytes())

    def sweep(self) -> None:
        """End of a frame."""
        self._lines.sweep()

    def forget(self) -> None:
        """Drop what older shaders evaluated."""
        self._lines.clear()

    def draw_iso_lines(
        self, layer: IsoLines, camera: Camera, viewport: tuple[int, int], unit: float
    ) -> None:
        """The curves, evaluated on the GPU by the evaluator that draws the patches."""
        key = (layer.u, layer.v, layer.span)
        lines = self._lines.get(layer.net, key, lambda: self._evaluate(layer))
        self._stroke(lines, camera, viewport, layer.color, layer.width * unit / 2.0)
        if layer.arrow:
            ends = arrow_parameters(layer.u, layer.v, layer.span)
            tips = self._evaluation.read(layer.net, ends).reshape(-1, 2, 4)
            self._mark(
                tips[:, 1], tips[:, 0], camera, viewport, layer.color, ARROW_SIZE * unit, ARROW=1
            )

    def draw_control_net(
        self, layer: ControlNet, camera: Camera, viewport: tuple[int, int], unit: float
    ) -> None:
        """Dots at the control points, lines along the legs."""
        lines = self._lines.get(layer.net, "net", lambda: self._upload(*net_legs(layer.net)))
        self._stroke(lines, camera, viewport, layer.color, layer.width * unit / 2.0)
        points = layer.net.reshape(-1, 4)
        dots = points[points[:, 3] > 0.0].astype(np.float32)
        self._mark(dots, dots, camera, viewport, layer.color, layer.dot * unit)

    def draw_handles(
        self,
        layer: Handles,
        camera: Camera,
        viewport: tuple[int, int],
        unit: float,
        only: int | None = None,
    ) -> None:
        """A ringed disc for each point, or for point `only` alone."""
        at = layer.at if only is None else layer.at[only : only + 1]
        points = np.concatenate([at, np.ones((len(at), 1))], -1).astype(np.float32)
        for ring, color in (*HANDLE_RINGS, (0.0, layer.color)):
            size = (layer.radius + ring) * unit
            self._mark(points, points, camera, viewport, color, size)

    def _evaluate(self, layer: IsoLines) -> Polylines:
        parameters, pens = line_parameters(layer.u, layer.v, layer.span)
        patches = patch_count(layer.net)
        points = self._evaluation.run(layer.net, parameters, range(patches))
        pen_buffer = self._ctx.buffer(np.tile(pens, patches).astype(np.float32).tobytes())
        return Polylines(points, pen_buffer, len(pens) * patches)

    def _upload(self, points: Array, pens: Array) -> Polylines:
        return Polylines(
            self._ctx.buffer(points.astype(np.float32).tobytes()),
            self._ctx.buffer(pens.astype(np.float32).tobytes()),
            len(pens),
        )

    def _stroke(
        self,
        lines: Polylines,
        camera: Camera,
        viewport: tuple[int, int],
        color: Color,
        half_width: float,
    ) -> None:
        program = self._programs.get("stroke.vert", "stroke.frag")
        self._set_common(program, camera, viewport, color)
        program.set(half_width=half_width)
        gl = program.ready()
        vertices = self._ctx.vertex_array(gl, [(self._segment, "2f", "corner")])
        for i, name in enumerate(("before", "start", "end", "after")):
            _bind_instanced(vertices, gl, name, lines.points, "4f", 16 * i, 16)
        for i, name in enumerate(("joins_before", "drawn", "joins_after"), start=1):
            _bind_instanced(vertices, gl, name, lines.pens, "1f", 4 * i, 4)
        vertices.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=lines.count - 3)
        vertices.release()

    def _mark(
        self,
        at: NDArray[np.float32],
        tail: NDArray[np.float32],
        camera: Camera,
        viewport: tuple[int, int],
        color: Color,
        size: float,
        **defines: int,
    ) -> None:
        program = self._programs.get("marker.vert", "marker.frag", defines=defines)
        self._set_common(program, camera, viewport, color)
        program.set(size=size)
        marks = self._ctx.buffer(np.concatenate([at, tail], -1).tobytes())
        vertices = self._ctx.vertex_array(
            program.ready(),
            [(self._square, "2f", "corner"), (marks, "4f 4f /i", "at", "tail")],
        )
        vertices.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(at))
        vertices.release()
        marks.release()

    def _set_common(
        self, program: Program, camera: Camera, viewport: tuple[int, int], color: Color
    ) -> None:
        program.set(
            clip_from_model=camera.clip_from_model().T.astype(np.float32).tobytes(),
            viewport=viewport,
            depth_bias=DEPTH_BIAS,
            color=(*color, 1.0),
        )


def _bind_instanced(
    vertices: moderngl.VertexArray,
    program: moderngl.Program,
    name: str,
    buffer: moderngl.Buffer,
    format: str,
    offset: int,
    stride: int,
) -> None:
    """One attribute an instance, at its own offset: neighbours read the same buffer."""
    location = program[name].location  # type: ignore[union-attr]
    vertices.bind(location, "f", buffer, format, offset=offset, stride=stride, divisor=1)


def _release(lines: Polylines) -> None:
    lines.points.release()
    lines.pens.release()


Values = tuple[float, ...]


@lru_cache(maxsize=256)
def line_parameters(u: Values, v: Values, span: tuple[float, float]) -> tuple[Array, Array]:
    """(u, 1-u, v, 1-v) along the curves u = const and v = const of one patch, and their pens.

    The same object for the same curves: it is uploaded once.
    """
    t = np.linspace(*span, CURVE_SEGMENTS + 1)
    parameters = _with_complements(_padded(_along(u, v, t)))
    return parameters, _pens([len(t)] * (len(u) + len(v)))


@lru_cache(maxsize=256)
def arrow_parameters(u: Values, v: Values, span: tuple[float, float]) -> Array:
    """Parameters of the last two points of each curve."""
    return _with_complements(_along(u, v, np.array([span[1] - 1e-3, span[1]])))


def _along(u: Values, v: Values, t: Array) -> Array:
    """(u, v) of the points t of each curve, one curve after another."""
    curves = [np.stack([np.full_like(t, value), t], -1) for value in u]
    curves += [np.stack([t, np.full_like(t, value)], -1) for value in v]
    return np.concatenate(curves)


def net_legs(net: Array) -> tuple[Array, Array]:
    """The rows and columns of control nets as polylines; points without weight are left out."""
    patches = net.reshape(-1, *net.shape[-3:])
    rows = [row for patch in patches for row in patch]
    columns = [column for patch in patches for column in patch.swapaxes(0, 1)]
    lines = [line[line[:, 3] > 0.0] for line in rows + columns]
    return _padded(np.concatenate(lines)), _pens([len(line) for line in lines])


def _padded(points: Array) -> Array:
    return np.concatenate([points[:1], points, points[-1:]])


def _pens(lengths: list[int]) -> Array:
    pens = np.ones(sum(lengths) + 2)
    starts = np.cumsum([0, *lengths])[:-1]
    pens[starts + 1] = 0.0
    pens[[0, -1]] = 0.0
    return pens


def _with_complements(uv: Array) -> Array:
    u, v = uv.T
    return np.stack([u, 1.0 - u, v, 1.0 - v], -1)
