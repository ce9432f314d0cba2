"""The vertex evaluator: nets at lists of parameters, into buffers (evaluate.vert)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.formula import Formula
from .kept import Kept
from .nets import (
    NET_UNIT,
    instance_defines,
    instance_vectors,
    net_texture,
    pack_instances,
    rewrite,
)
from .programs import SPECIALISED_DEGREE, Program, Programs, degree_defines

Array = NDArray[np.float64]

MOST_VECTORS = 12  # attributes for a net: 16 are everywhere, less parameters, normal, ...
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


@dataclass(frozen=True)
class Carried:
    """Nets as vertex attributes, a patch an instance (shaders/lib/net.glsl); to be released."""

    buffer: moderngl.Buffer
    layout: str
    defines: dict[str, int]


class Evaluation:
    """Evaluates nets by transform feedback. Owns the nets' textures and the parameter lists."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        self._textures: Kept[moderngl.Texture] = Kept(lambda texture: texture.release())
        self._parameters: Kept[Parameters] = Kept(lambda p: p.buffer.release(), frames=64)

    def texture(self, net: Array) -> moderngl.Texture:
        """The net on the GPU; uploaded once for each array, and after an edit what it changed."""

        def renew(texture: moderngl.Texture, changed: list[range]) -> None:
            rewrite(texture, net, changed)

        several = patch_count(net) > 1
        return self._textures.get(
            net, net.shape, lambda: net_texture(self._ctx, net), renew if several else None
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
        program = self._program(net, normals, {})
        self.texture(net).use(NET_UNIT)
        program.set(
            net=NET_UNIT,
            degree=orders(net),
            first_patch=0 if patch_count(net) == 1 else patches[0],
        )
        return self._feed_back(program, parameters, [], len(patches), into)

    def run_map(
        self, net: Array, components: int, parameters: Array, patches: int, *, normals: bool = False
    ) -> moderngl.Buffer:
        """The same of all patches of a map with so many components that count. Nothing is kept:
        its control points travel as attributes if they fit, twice as fast as in a texture."""
        if patch_count(net) == 1 and patches > 1:
            captured = self.run_map(net, components, parameters, 1, normals=normals)
            return self._repeated(captured, patches)
        carried = self.carry(net, components)
        if carried is None:
            return self.run(net, parameters, range(patches), normals=normals)
        program = self._program(net, normals, carried.defines)
        content = [(carried.buffer, carried.layout, "control")]
        captured = self._feed_back(program, parameters, content, patches)
        carried.buffer.release()
        return captured

    def carry(self, net: Array, components: int) -> Carried | None:
        """The control points of all patches as attributes; None where there are too many."""
        vectors = instance_vectors(orders(net), components)
        if vectors > MOST_VECTORS or max(orders(net)) > SPECIALISED_DEGREE:
            return None
        buffer = self._ctx.buffer(pack_instances(net, components).tobytes())
        return Carried(buffer, f"{4 * vectors}f/i", instance_defines(orders(net), components))

    def parameters(self, parameters: Array) -> moderngl.Buffer:
        """A list of (u, 1-u, v, 1-v) on the GPU, kept while it is used."""
        return self._upload(parameters).buffer

    def _program(self, net: Array, normals: bool, defines: dict[str, int]) -> Program:
        return self._programs.get(
            "evaluate.vert",
            defines=degree_defines(**{"": orders(net)})
            | ({"NORMALS": 1} if normals else {})
            | defines,
            varyings=("point", "normal") if normals else ("point",),
        )

    def _feed_back(
        self,
        program: Program,
        parameters: Array,
        content: list[Any],
        patches: int,
        into: tuple[moderngl.Buffer, int] | None = None,
    ) -> moderngl.Buffer:
        """What the program makes of the parameters, for each patch an instance: in a buffer of
        its own, or `into` one that is there, from so many patches on."""
        where = self._upload(parameters)
        if "parameters" in program.gl:
            content = [(where.buffer, "4f", "parameters"), *content]
        vertices = self._ctx.vertex_array(program.ready(), content)
        normals = "NORMALS" in program.defines
        size = where.count * FLOATS[normals] * 4
        captured, before = into or (self._ctx.buffer(reserve=patches * size), 0)
        vertices.transform(
            captured,
            moderngl.POINTS,
            where.count,
            instances=patches,
            buffer_offset=before * size,
        )
        vertices.release()
        return captured

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
