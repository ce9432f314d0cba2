"""Patches layers drawn as finely as a tolerance in pixels asks for, each patch by itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..geometry.levels import edge_levels, edge_numbers, grid_levels
from ..geometry.net import Array
from ..scenes.layers import Patches
from .context import Capabilities
from .evaluation import Evaluation, orders, patch_count
from .fineness import MAP_UNIT, Fineness
from .kept import Kept
from .nets import NET_UNIT
from .programs import Program, Programs, degree_defines

HARDWARE_LEVEL = 64  # what every OpenGL 4 promises
FINEST_GRID = 1024  # of the vertex evaluator, which keeps its grids
SOFTWARE_CHUNK = 64  # llvmpipe's tessellator is quadratic in the patches of one draw

# Where an edge has other steps than the patch, how they are stitched is the driver's: triangles
# there may span a third more than a step. (The vertex evaluator's own stitching spans no more.)
STITCHING = {"vertex": 1.0, "tessellation": 1.35**2}

Ints = NDArray[np.int64]
SetCommon = Callable[[Program], None]


@dataclass(frozen=True)
class Tolerance:
    """How far off a drawn point may be, in pixels of a viewport."""

    pixels: float
    viewport: tuple[int, int]


@dataclass(frozen=True)
class Plan:
    """The patches in view (k,), their levels (k, 2), and those of their edges (k, 4)."""

    patches: Ints
    inner: Ints
    edges: Ints

    def triangles(self) -> int:
        """About how many triangles they make: two a cell."""
        return int(2 * self.inner.prod(-1).sum())


def uniform_plan(layer: Patches, level: int) -> Plan:
    """One level for all patches and edges."""
    count = patch_count(layer.net)
    return Plan(np.arange(count), np.full((count, 2), level), np.full((count, 4), level))


class Adaptive:
    """Plans and draws. The bound is computed on the GPU; edges take the finest of both sides."""

    def __init__(
        self,
        ctx: moderngl.Context,
        programs: Programs,
        evaluation: Evaluation,
        capabilities: Capabilities,
    ) -> None:
        self._ctx = ctx
        self._programs = programs
        self._evaluation = evaluation
        self._fineness = Fineness(ctx, programs, evaluation)
        self._chunk = SOFTWARE_CHUNK if capabilities.software else 1 << 20
        self._edges: Kept[NDArray[np.int32]] = Kept(lambda _: None)
        self._grids: dict[tuple[int, int], tuple[moderngl.Buffer, moderngl.Buffer]] = {}

    def sweep(self) -> None:
        """End of a frame."""
        self._edges.sweep()

    def plan(self, layer: Patches, camera: Camera, evaluator: str, tolerance: Tolerance) -> Plan:
        """The levels of a layer's patches in this view."""
        pixels = tolerance.pixels / STITCHING[evaluator]
        steps = self._fineness.read(layer, camera, tolerance.viewport, pixels)
        edges = edge_levels(steps, self._edges.get(layer.net, None, lambda: _numbers(layer.net)))
        seen = np.flatnonzero(steps.any(-1))
        return Plan(seen, steps[seen], edges[seen])

    def draw(
        self,
        layer: Patches,
        evaluator: str,
        plan: Plan,
        fragment: str,
        defines: Mapping[str, int | str],
        set_common: SetCommon,
    ) -> None:
        """Draw as planned, with a fragment shader and the uniforms that `set_common` gives it."""
        if not len(plan.patches):
            return
        stages = {
            "vertex": ("adaptive.vert", fragment),
            "tessellation": ("patch.tess.vert", "patch.tesc", "patch.tese", fragment),
        }[evaluator]
        nets = {"POSITION_": orders(layer.net)}
        if "TEXTURED" in defines:
            assert layer.texture is not None
            nets["TEXTURE_"] = orders(layer.texture.net)
        program = self._programs.get(
            *stages, defines={**degree_defines(**nets), **defines, "ADAPTIVE": 1}
        )
        self._set_nets(program, layer)
        set_common(program)
        if evaluator == "vertex":
            self._draw_grids(program, plan)
        else:
            self._tessellate(program, plan)

    def _set_nets(self, program: Program, layer: Patches) -> None:
        self._evaluation.texture(layer.net).use(NET_UNIT)
        program.set(position_net=NET_UNIT, position_degree=orders(layer.net))
        if "TEXTURED" in program.defines:
            assert layer.texture is not None
            self._evaluation.texture(layer.texture.net).use(MAP_UNIT)
            program.set(
                texture_net=MAP_UNIT,
                texture_degree=orders(layer.texture.net),
                texture_stride=0 if patch_count(layer.texture.net) == 1 else 1,
            )

    # The vertex evaluator: patches of one level together -------------------------------------

    def _draw_grids(self, program: Program, plan: Plan) -> None:
        inner, outer = (np.minimum(levels, FINEST_GRID) for levels in (plan.inner, plan.edges))
        uniform = (outer == inner[0, 0]).all() and (inner == inner[0, 0]).all()
        levels, edges = (inner, outer) if uniform else grid_levels(inner, outer)
        order = np.lexsort(levels.T)
        _, starts = np.unique(levels[order], axis=0, return_index=True)
        for group in np.split(order, np.sort(starts)[1:]):
            level = (int(levels[group[0], 0]), int(levels[group[0], 1]))
            vertices, indices = self._grid(level)
            rows = np.column_stack([plan.patches[group], edges[group]]).astype(np.int32)
            instances = self._ctx.buffer(rows.tobytes())
            program.set(level=level)
            array = self._ctx.vertex_array(
                program.ready(),
                [(vertices, "2i", "step_index"), (instances, "1i 4i /i", "patch_index", "outer")],
                indices,
            )
            array.render(instances=len(group))
            array.release()
            instances.release()

    def _grid(self, level: tuple[int, int]) -> tuple[moderngl.Buffer, moderngl.Buffer]:
        if level not in self._grids:
            corner = np.arange((level[0] + 1) * (level[1] + 1), dtype=np.int32)
            steps = np.stack(np.divmod(corner, level[1] + 1), -1).astype(np.int32)
            grid = corner.reshape(level[0] + 1, level[1] + 1)
            a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
            cells = np.stack([a, b, c, a, c, d], -1)
            self._grids[level] = (
                self._ctx.buffer(steps.tobytes()),
                self._ctx.buffer(cells.tobytes()),
            )
        return self._grids[level]

    # Tessellation ---------------------------------------------------------------------------

    def _tessellate(self, program: Program, plan: Plan) -> None:
        """All tiles of all patches; only levels above the hardware's need more than one."""
        rows = np.column_stack([plan.patches, plan.inner, plan.edges]).astype(np.int32)
        finest = int(max(plan.inner.max(), plan.edges.max()))
        tiles = -(-finest // HARDWARE_LEVEL)
        numbers = self._ctx.buffer(rows.tobytes())
        self._ctx.patch_vertices = 1
        for u in range(tiles):
            for v in range(tiles):
                program.set(tile=(u, v, tiles))
                array = self._ctx.vertex_array(
                    program.ready(), [(numbers, "1i 2i 4i", "patch_index", "inner", "outer")]
                )
                for first in range(0, len(rows), self._chunk):
                    count = min(self._chunk, len(rows) - first)
                    array.render(moderngl.PATCHES, vertices=count, first=first)
                array.release()
        numbers.release()


def _numbers(net: Array) -> NDArray[np.int32]:
    return edge_numbers(net if net.ndim == 4 else net[None])
