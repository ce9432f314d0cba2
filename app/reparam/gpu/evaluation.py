"""The vertex evaluator: nets at lists of parameters, into buffers (evaluate.vert, strip.vert)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.formula import Formula
from .kept import Kept
from .nets import NET_UNIT, net_texture, rewrite
from .programs import SPECIALISED_DEGREE, Program, Programs, degree_defines

Array = NDArray[np.float64]

SHORTEST_STRIP = 3
STRIPS_FROM = 1 << 14  # vertices: below, compiling another program costs more
LONGEST_STRIP = {False: 16, True: 9}  # 64 floats of a vertex can be captured everywhere

FLOATS = {False: 4, True: 7}  # a captured vertex: point, and with normals its normal


def orders(net: Array) -> tuple[int, int]:
    """Degrees in u and v of a net (..., m, n, 4)."""
    return net.shape[-3] - 1, net.shape[-2] - 1


def patch_count(net: Array) -> int:
    """1 for a net (m, n, 4), else the length of its first axis."""
    return net.shape[0] if net.ndim == 4 else 1


@dataclass(frozen=True)
class Parameters:
    """A list of (u, 1-u, v, 1-v) on the GPU."""

    buffer: moderngl.Buffer
    count: int


class Evaluation:
    """Evaluates nets by transform feedback. Owns the nets' textures and the parameter lists."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        slots = int(ctx.info["GL_MAX_VERTEX_OUTPUT_COMPONENTS"]) // 4 - 1
        self._longest = {n: min(most, slots // (1 + n)) for n, most in LONGEST_STRIP.items()}
        self._textures: Kept[moderngl.Texture] = Kept(lambda texture: texture.release())
        self._columns: Kept[Array] = Kept(lambda _: None, frames=64)
        self._parameters: Kept[Parameters] = Kept(lambda p: p.buffer.release(), frames=64)

    def texture(self, net: Array) -> moderngl.Texture:
        """The net on the GPU; uploaded once for each array, and after an edit what it changed."""
        return self._textures.get(
            net,
            None,
            lambda: net_texture(self._ctx, net),
            lambda texture, changed: rewrite(texture, net, changed),
        )

    def run(
        self,
        net: Array,
        parameters: Array,
        patches: Sequence[int] | range,
        *,
        normals: bool = False,
        into: tuple[moderngl.Buffer, int] | None = None,
    ) -> moderngl.Buffer:
        """Points, and normals if asked, of consecutive patches at the parameters (k, 4).

        The buffer holds float32 (patches, k, 4), or (patches, k, 7) with normals; a net of one
        patch answers for all of them. `into` is a buffer to write to instead of a new one, and how
        many patches come before these in it.
        """
        if patch_count(net) == 1 and len(patches) > 1:
            captured = self.run(net, parameters, range(1), normals=normals)
            return self._repeated(captured, len(patches))
        program = self._programs.get(
            "evaluate.vert",
            defines=degree_defines(**{"": orders(net)}) | ({"NORMALS": 1} if normals else {}),
            varyings=("point", "normal") if normals else ("point",),
        )
        self.texture(net).use(NET_UNIT)
        program.set(
            net=NET_UNIT,
            degree=orders(net),
            first_patch=0 if patch_count(net) == 1 else patches[0],
        )
        where = self._upload(parameters)
        vertices = self._ctx.vertex_array(
            program.ready(),
            [(where.buffer, "4f", "parameters")] if "parameters" in program.gl else [],
        )
        size = where.count * FLOATS[normals] * 4
        captured, before = into or (self._ctx.buffer(reserve=len(patches) * size), 0)
        vertices.transform(
            captured,
            moderngl.POINTS,
            where.count,
            instances=len(patches),
            buffer_offset=before * size,
        )
        vertices.release()
        return captured

    def run_grid(
        self,
        net: Array,
        parameters: Array,
        shape: tuple[int, int],
        patches: range,
        *,
        normals: bool = False,
    ) -> moderngl.Buffer:
        """The same at the points of a grid of that shape, u slowest. Much work is done strip by
        strip (strip.vert), if a row can be cut into strips: see `strip_row`."""
        if patch_count(net) == 1 and len(patches) > 1:
            captured = self.run_grid(net, parameters, shape, range(1), normals=normals)
            return self._repeated(captured, len(patches))
        length = longest_divisor(shape[1], self._longest[normals])
        little = len(parameters) * len(patches) < STRIPS_FROM or length < SHORTEST_STRIP
        if little or max(orders(net)) > SPECIALISED_DEGREE:
            return self.run(net, parameters, patches, normals=normals)
        program = self._programs.get(
            "strip.vert",
            defines=degree_defines(**{"": orders(net)}) | strip_defines(length, normals),
            varyings=strip_varyings(length, normals),
        )
        self.texture(net).use(NET_UNIT)
        columns = self._columns.get(parameters, shape, lambda: strip_columns(parameters, shape))
        self.texture(columns).use(NET_UNIT - 1)
        first = 0 if patch_count(net) == 1 else patches[0]
        program.set(net=NET_UNIT, columns=NET_UNIT - 1, first_patch=first)
        starts = self._parameters.get(
            parameters,
            (shape, length, len(patches)),
            lambda: self._uploaded(strip_starts(parameters, shape, length, len(patches))),
        )
        size = len(patches) * len(parameters) * FLOATS[normals] * 4
        captured = self._ctx.buffer(reserve=size)
        vertices = self._ctx.vertex_array(program.ready(), [(starts.buffer, "4f", "start")])
        vertices.transform(captured, moderngl.POINTS, starts.count)
        vertices.release()
        return captured

    def strip_row(self, points: int, patches: int, rows: int, normals: bool) -> int:
        """To how many points a grid's rows are best filled up, to be cut into long strips."""
        if points * patches * rows < STRIPS_FROM:
            return points
        strips = -(-points // self._longest[normals])
        return -(-points // strips) * strips

    def _repeated(self, once: moderngl.Buffer, times: int) -> moderngl.Buffer:
        """The same content again and again: a map that all patches share is evaluated once."""
        buffer = self._ctx.buffer(reserve=once.size * times)
        self._ctx.copy_buffer(buffer, once, once.size)
        done = 1
        while done < times:
            more = min(done, times - done)
            size = more * once.size
            self._ctx.copy_buffer(buffer, buffer, size, write_offset=done * once.size)
            done += more
        once.release()
        return buffer

    def read(self, net: Array, parameters: Array, *, normals: bool = False) -> NDArray[np.float32]:
        """The same for all patches, handed back as an array (patches, k, 4 or 7)."""
        count = patch_count(net)
        captured = self.run(net, parameters, range(count), normals=normals)
        values = np.frombuffer(captured.read(), np.float32)
        captured.release()
        return values.reshape(count, len(parameters), FLOATS[normals])

    def formulas(self, x: Formula, y: Formula, w: float, parameters: Array) -> moderngl.Buffer:
        """Points (x(u), y(u), 0, 1), float32 (k, 4), at parameters (k,): parametric.vert."""
        defines = {"FORMULA_X(u, w)": x.glsl(), "FORMULA_Y(u, w)": y.glsl()}
        program = self._programs.get("parametric.vert", defines=defines, varyings=("point",))
        program.set(w=w)
        return self._capture(program, "parameter", parameters)

    def trace(self, net: Array, table: Array, fractions: Array) -> moderngl.Buffer:
        """Points, float32 (k, 4), at fractions (k,) of the length of curves: trace.vert."""
        curves = net.reshape(-1, net.shape[-2], 1, 4)
        program = self._programs.get(
            "trace.vert", defines=degree_defines(**{"": orders(curves)}), varyings=("point",)
        )
        self.texture(curves).use(0)
        self.texture(np.pad(table, ((0, 0), (0, 2)))).use(1)
        program.set(net=0, table=1, entries=len(table), pieces=len(curves), degree=orders(curves))
        return self._capture(program, "fraction", fractions)

    def _capture(self, program: Program, name: str, values: Array) -> moderngl.Buffer:
        """What a program of one float a vertex makes of the values (k,)."""
        given = self._ctx.buffer(values.astype(np.float32).tobytes())
        captured = self._ctx.buffer(reserve=len(values) * FLOATS[False] * 4)
        used = [(given, "1f", name)] if name in program.gl else []
        vertices = self._ctx.vertex_array(program.ready(), used)
        vertices.transform(captured, moderngl.POINTS, len(values))
        vertices.release()
        given.release()
        return captured

    def _upload(self, parameters: Array) -> Parameters:
        return self._parameters.get(parameters, None, lambda: self._uploaded(parameters))

    def _uploaded(self, parameters: Array) -> Parameters:
        buffer = self._ctx.buffer(parameters.astype(np.float32).tobytes())
        return Parameters(buffer, len(parameters))

    def sweep(self) -> None:
        """End of a frame."""
        self._textures.sweep()
        self._parameters.sweep()
        self._columns.sweep()


def strip_defines(length: int, normals: bool) -> dict[str, Any]:
    """What strip.vert is compiled with."""
    defines: dict[str, Any] = {
        "STRIP": length,
        "EACH(F)": "".join(f"F({k});" for k in range(length)),
    }
    return defines | ({"NORMALS": 1} if normals else {})


def strip_varyings(length: int, normals: bool) -> tuple[str, ...]:
    """What is captured of a strip, vertex by vertex."""
    names = ("point", "normal") if normals else ("point",)
    return tuple(f"{name}[{k}]" for k in range(length) for name in names)


def longest_divisor(number: int, most: int) -> int:
    """The largest divisor that is at most `most`."""
    return next(length for length in range(most, 0, -1) if number % length == 0)


def strip_columns(parameters: Array, shape: tuple[int, int]) -> Array:
    """v and 1-v of the points of a row: (k, 4)."""
    columns = np.zeros((shape[1], 4))
    columns[:, :2] = parameters[: shape[1], 2:]
    return columns


def strip_starts(parameters: Array, shape: tuple[int, int], length: int, patches: int) -> Array:
    """u, 1-u, number of the first point in v, patch: of each strip, (k, 4)."""
    u = parameters[:: shape[1], :2]
    first = np.arange(0, shape[1], length)
    starts = np.empty((patches, shape[0], len(first), 4))
    starts[..., :2] = u[:, None]
    starts[..., 2] = first
    starts[..., 3] = np.arange(patches)[:, None, None]
    return starts.reshape(-1, 4)
