"""Patches layers drawn as finely as a tolerance in pixels asks for, each patch by itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..geometry.edge_levels import edge_levels, edge_marks, fitted, grid_levels, in_tiles, numbered
from ..geometry.levels import FINEST, box_corners, out_of_view
from ..geometry.net import Array
from ..scenes.layers import Patches
from .context import Capabilities
from .evaluation import Evaluation, orders, patch_count
from .fineness import Fineness
from .kept import Kept
from .nets import MAP_UNIT, NET_UNIT
from .plans import Ints, Plan, SetCommon, Tolerance
from .programs import Program, Programs, degree_defines
from .stitches import Stitches
from .tiles import HARDWARE_LEVEL, draws

FINEST_GRID = 1024  # of the vertex evaluator

Body = tuple[Patches, ...]


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
        self._software = capabilities.software
        self._edges: Kept[tuple[list[Array], NDArray[np.int64]]] = Kept(lambda _: None)
        self._own_edges: Kept[NDArray[np.uint64]] = Kept(lambda _: None)
        self._boxes: Kept[Array] = Kept(lambda _: None)
        self._plans: Kept[tuple[Body, list[Plan]]] = Kept(lambda _: None, frames=1)
        self._stitches = Stitches(ctx)

    def sweep(self) -> None:
        """End of a frame."""
        self._edges.sweep()
        self._own_edges.sweep()
        self._boxes.sweep()
        self._plans.sweep()
        self._stitches.sweep()

    def plan(self, layer: Patches, camera: Camera, evaluator: str, tolerance: Tolerance) -> Plan:
        """The levels of a layer's patches in this view."""
        beside = [each for each in tolerance.beside if orders(each.net) == orders(layer.net)]
        body = tuple(beside) if any(each is layer for each in beside) else (layer,)
        view = replace(camera, bias=0.0).clip_from_model().tobytes(), tolerance.viewport
        key = (tuple(map(id, body)), view, evaluator, tolerance.pixels)  # `body` is kept with them
        _, plans = self._plans.get(
            body[0].net, key, lambda: (body, self._plan(body, camera, evaluator, tolerance))
        )
        return next(p for each, p in zip(body, plans, strict=True) if each is layer)

    def _plan(self, body: Body, camera: Camera, evaluator: str, tolerance: Tolerance) -> list[Plan]:
        one_way = evaluator == "vertex"
        asked = [self._asked(layer, camera, tolerance, one_way) for layer in body]
        steps, falling = (np.concatenate(parts) for parts in zip(*asked, strict=True))
        sizes = [len(own) for own, _ in asked]
        owner = np.repeat(np.arange(len(body)), sizes)
        seen = np.flatnonzero(steps.any(-1))
        numbers = self._numbers([layer.net for layer in body])[seen]
        inner = np.minimum(steps[seen], FINEST_GRID if one_way else FINEST)
        edges, tiles = edge_levels(inner, numbers), np.ones_like(inner)
        if one_way:
            edges = fitted(inner, edges, numbers)
        else:
            inner = grid_levels(inner, edges)
            inner, edges, tiles = in_tiles(inner, edges, numbers, HARDWARE_LEVEL)
        whole = Plan(seen, inner, edges, tiles, falling[seen])
        if len(body) == 1:
            return [whole]
        plans, before = [], 0
        for k, size in enumerate(sizes):
            plan = whole.take(np.flatnonzero(owner[seen] == k))
            plans.append(replace(plan, patches=plan.patches - before))
            before += size
        return plans

    def _asked(
        self, layer: Patches, camera: Camera, tolerance: Tolerance, one_way: bool
    ) -> tuple[Ints, NDArray[np.bool_]]:
        """What the patches of a layer ask for: steps, and whether diagonals are to fall."""
        if self._out_of_view(layer, camera):
            count = patch_count(layer.net)
            return np.zeros((count, 2), np.int64), np.zeros(count, bool)
        return self._fineness.read(layer, camera, tolerance.viewport, tolerance.pixels, one_way)

    def _out_of_view(self, layer: Patches, camera: Camera) -> bool:
        """Whether all of a layer is: then no patch of it need be looked at."""
        box = self._boxes.get(layer.net, None, lambda: box_corners(layer.net))
        return bool(out_of_view(box @ camera.clip_from_model().T).all())

    def _numbers(self, nets: list[Array]) -> NDArray[np.int64]:
        """Of the edges of all nets, which are kept with them."""

        def make() -> tuple[list[Array], NDArray[np.int64]]:
            return nets, numbered(np.concatenate([self._marks(net) for net in nets]))

        return self._edges.get(nets[0], tuple(map(id, nets)), make)[1]

    def _marks(self, net: Array) -> NDArray[np.uint64]:
        """Of the edges of a net: kept, and after an edit those of the patches that it changed."""
        patches = net if net.ndim == 4 else net[None]

        def renew(marks: NDArray[np.uint64], changed: list[range]) -> None:
            for run in changed:
                marks[run.start : run.stop] = edge_marks(patches[run.start : run.stop])

        return self._own_edges.get(net, net.shape, lambda: edge_marks(patches), renew)

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
            self._stitches.draw(program, plan)
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

    # Tessellation ---------------------------------------------------------------------------

    def _tessellate(self, program: Program, plan: Plan) -> None:
        """A patch with a level above the hardware's is as many rows as it needs tiles."""
        rows = tiled(plan)
        numbers = self._ctx.buffer(rows.tobytes())
        self._ctx.patch_vertices = 1
        names = ("patch_index", "inner", "outer", "tile")
        array = self._ctx.vertex_array(program.ready(), [(numbers, "1i 2i 4i 4i", *names)])
        vertices = (rows[:, 9:] + 1).prod(-1)
        for first, count in draws(vertices, self._software):
            array.render(moderngl.PATCHES, vertices=count, first=first)
        array.release()
        numbers.release()


def tiled(plan: Plan) -> NDArray[np.int32]:
    """Rows (r, 11): patch, its levels, those of its edges; a tile's first step and steps."""
    tiles = plan.tiles
    counts = tiles.prod(-1)
    row = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    at = np.stack([place // tiles[row, 1], place % tiles[row, 1]], -1)
    levels, across = plan.inner[row], tiles[row]
    start, end = at * levels // across, (at + 1) * levels // across
    columns = [plan.patches[row], levels, plan.edges[row], start, end - start]
    return np.column_stack(columns).astype(np.int32)
