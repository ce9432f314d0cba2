"""The vertex evaluator: nets at lists of parameters, into buffers (evaluate.vert)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.formula import Formula
from .kept import Kept
from .nets import NET_UNIT, net_texture
from .programs import Program, Programs, degree_defines

Array = NDArray[np.float64]

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
        self._textures: Kept[moderngl.Texture] = Kept(lambda texture: texture.release())
        self._parameters: Kept[Parameters] = Kept(lambda p: p.buffer.release(), frames=64)

    def texture(self, net: Array) -> moderngl.Texture:
        """The net on the GPU; uploaded once for each array."""
        return self._textures.get(net, None, lambda: net_texture(self._ctx, net))

    def run(
        self,
        net: Array,
        parameters: Array,
        patches: Sequence[int] | range,
        *,
        normals: bool = False,
    ) -> moderngl.Buffer:
        """Points, and normals if asked, of consecutive patches at the parameters (k, 4).

        The buffer holds float32 (patches, k, 4), or (patches, k, 7) with normals; a net of one
        patch answers for all of them.
        """
        program = self._programs.get(
            "evaluate.vert",
            defines=degree_defines(**{"": orders(net)}) | ({"NORMALS": 1} if normals else {}),
            varyings=("point", "normal") if normals else ("point",),
        )
        shared = patch_count(net) == 1
        self.texture(net).use(NET_UNIT)
        program.set(
            net=NET_UNIT,
            degree=orders(net),
            first_patch=0 if shared else patches[0],
            patch_stride=0 if shared else 1,
        )
        where = self._upload(parameters)
        vertices = self._ctx.vertex_array(
            program.ready(),
            [(where.buffer, "4f", "parameters")] if "parameters" in program.gl else [],
        )
        size = len(patches) * where.count * FLOATS[normals] * 4
        captured = self._ctx.buffer(reserve=size)
        vertices.transform(captured, moderngl.POINTS, where.count, instances=len(patches))
        vertices.release()
        return captured

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
        return self._parameters.get(
            parameters,
            None,
            lambda: Parameters(
                self._ctx.buffer(parameters.astype(np.float32).tobytes()), len(parameters)
            ),
        )

    def sweep(self) -> None:
        """End of a frame."""
        self._textures.sweep()
        self._parameters.sweep()
