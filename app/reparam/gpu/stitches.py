"""The vertex evaluator's triangles of patches that each have their own levels, all in one draw."""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np

from ..geometry.stitching import stitched
from .kept import Kept
from .plans import Plan
from .programs import Program

VERTEX = np.dtype([("patch", "i4"), ("place", "u2", 4)])


@dataclass(frozen=True)
class Stitch:
    """Vertices for adaptive.vert, the levels of their patches if asked for, and the triangles."""

    vertices: moderngl.Buffer
    levels: moderngl.Buffer | None
    triangles: moderngl.Buffer

    def release(self) -> None:
        """Give the memory back."""
        for buffer in (self.vertices, self.levels, self.triangles):
            if buffer is not None:
                buffer.release()


class Stitches:
    """Draws what is planned; while the plan stays, so do the triangles."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._kept: Kept[Stitch] = Kept(Stitch.release, frames=1)

    def draw(self, program: Program, plan: Plan) -> None:
        """All patches of a plan."""
        levels = "LEVEL" in program.defines
        stitch = self._kept.get(plan.patches, levels, lambda: self._stitch(plan, levels))
        content = [(stitch.vertices, "1i 4u2", "patch_index", "place")]
        if stitch.levels is not None:
            content.append((stitch.levels, "2i 4i", "inner", "outer"))
        array = self._ctx.vertex_array(program.ready(), content, stitch.triangles)
        array.render()
        array.release()

    def _stitch(self, plan: Plan, levels: bool) -> Stitch:
        found = stitched(plan.inner, plan.edges, plan.falling)
        vertices = np.empty(len(found.rows), VERTEX)
        vertices["patch"], vertices["place"] = plan.patches[found.rows], found.places
        rows = np.concatenate([plan.inner, plan.edges], 1).astype(np.int32) if levels else None
        return Stitch(
            self._ctx.buffer(vertices.tobytes()),
            None if rows is None else self._ctx.buffer(rows[found.rows].tobytes()),
            self._ctx.buffer(found.triangles.tobytes()),
        )

    def sweep(self) -> None:
        """End of a frame."""
        self._kept.sweep()
