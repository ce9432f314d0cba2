"""Patches layers: evaluated and drawn, by the vertex evaluator or by tessellation."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import moderngl

from ..geometry.camera import Camera
from ..scenes.layers import Color, Patches
from ..scenes.shading import PLAIN_SCALE, Scale, Shading
from .batches import Batches
from .context import Capabilities
from .evaluation import Evaluation, orders, patch_count
from .looks import Look, Looks, look_of
from .meshes import triangle_indices
from .pictures import Pictures
from .plans import Tolerance
from .programs import Program, Programs, degree_defines
from .tiles import Tiles, draws, tile_rows, tiles
from .trims import Part, Trims, decided

if TYPE_CHECKING:
    from .adaptive import Adaptive

Fine = int | Tolerance  # steps in u and in v of every patch, or what a drawn point may be off


class Surfaces:
    """Draws Patches layers into the current framebuffer."""

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
        self._capabilities = capabilities
        self.pictures = Pictures(ctx, capabilities)
        self.trims = Trims(ctx)
        self.looks = Looks(ctx, evaluation, self.pictures, self.trims)
        self._batches = Batches(evaluation)
        self._indices: dict[tuple[int, int], moderngl.Buffer] = {}

    @cached_property
    def adaptive(self) -> Adaptive:
        """What draws by a tolerance; a plain picture starts without it."""
        from .adaptive import Adaptive

        return Adaptive(self._ctx, self._programs, self._evaluation, self._capabilities)

    def draw(
        self,
        layer: Patches,
        camera: Camera,
        evaluator: str,
        fine: Fine,
        shading: Shading = "light",
        scale: Scale = PLAIN_SCALE,
        *,
        by_sample: bool = False,
    ) -> None:
        """The layer as its picture, colour and light say; if lit, as `shading` says instead, and if
        that is about textures or triangles, lit or not.

        `scale` says which value is white and which has the full colour. The edge of a trimmed
        surface is blended with what is behind it by the share of the pixel that stays. With
        `by_sample` each of the pixel's samples is decided instead: in space, where what is behind
        may not be drawn yet, and for surfaces that share a trim curve, where two shares would let
        the ground shine through.
        """
        self._draw(layer, camera, evaluator, fine, look_of(layer, shading, scale, by_sample))

    def draw_wireframe(
        self, layer: Patches, camera: Camera, evaluator: str, fine: Fine, color: Color
    ) -> None:
        """The edges of the triangles that `draw` draws."""
        self._ctx.wireframe = True
        try:
            self._draw(layer, camera, evaluator, fine, Look(color, pictured=False, bare=True))
        finally:
            self._ctx.wireframe = False

    def _draw(self, layer: Patches, camera: Camera, evaluator: str, fine: Fine, look: Look) -> None:
        if isinstance(fine, Tolerance):
            plan = self.adaptive.plan(layer, camera, evaluator, fine)
            for trimmed, part in self.trims.planned(layer, plan):
                self.adaptive.draw(
                    layer,
                    evaluator,
                    part,
                    "patch.frag",
                    decided(self.looks.defines(layer, look), trimmed),
                    lambda program: self.looks.set(program, layer, camera, look),
                )
        elif evaluator == "vertex":
            self._draw_meshes(layer, camera, fine, look)
        else:
            self._draw_tessellated(layer, camera, fine, look)

    def sweep(self) -> None:
        """End of a frame."""
        self._batches.sweep()
        if "adaptive" in vars(self):
            self.adaptive.sweep()
        self.trims.sweep()

    def forget(self) -> None:
        """Drop what older shaders evaluated."""
        self._batches.forget()

    # The vertex evaluator -------------------------------------------------------------------

    def _draw_meshes(self, layer: Patches, camera: Camera, level: int, look: Look) -> None:
        defines = self.looks.defines(layer, look)
        texture_net = layer.texture.net if layer.texture and "TEXTURED" in defines else None
        count = patch_count(layer.net)
        positions = self._batches.evaluated(layer.net, level, count, layer.lit)
        maps = (
            self._batches.evaluated(texture_net, level, count, False)
            if texture_net is not None
            else None
        )
        for batch in positions:
            points = "4f 3f" if "LIT" in defines else "4f 12x" if layer.lit else "4f"
            names = ("point", "normal") if "LIT" in defines else ("point",)
            content = [(batch.vertices, points, *names)]
            if maps is not None:
                content.append((next(maps).vertices, "4f", "map"))
            for part in self._parts(layer, level, batch.patches):
                program = self._programs.get(
                    "mesh.vert", "patch.frag", defines=decided(defines, part.trimmed)
                )
                self.looks.set(program, layer, camera, look)
                program.set(level=level, first_patch=batch.patches.start)
                vertices = self._ctx.vertex_array(program.ready(), content, part.indices)
                vertices.render(vertices=part.count)
                vertices.release()

    def _parts(self, layer: Patches, level: int, patches: range) -> list[Part]:
        """The triangles to draw; in a trimmed surface only some must ask for each fragment."""
        if layer.trim is not None:
            return self.trims.parts(layer, level, patches)
        count = len(patches)
        return [Part(False, self._triangles(level, count), 6 * level * level * count)]

    def _triangles(self, level: int, patches: int) -> moderngl.Buffer:
        """Indices of two triangles a cell, counter-clockwise in (u,v), as the normal has it."""
        room = 1 << (patches - 1).bit_length()
        key = (level, room)
        if key not in self._indices:
            self._indices[key] = self._ctx.buffer(triangle_indices(level, room).tobytes())
        return self._indices[key]

    # Tessellation ---------------------------------------------------------------------------

    def _draw_tessellated(self, layer: Patches, camera: Camera, level: int, look: Look) -> None:
        defines = self.looks.defines(layer, look)
        nets = {"POSITION_": orders(layer.net)}
        if "TEXTURED" in defines:
            assert layer.texture is not None
            nets["TEXTURE_"] = orders(layer.texture.net)
        for trimmed, rows in self._tiles(layer, level):
            program = self._programs.get(
                "patch.tess.vert",
                "patch.tesc",
                "patch.tese",
                "patch.frag",
                defines={**degree_defines(**nets), **decided(defines, trimmed)},
            )
            self._set_nets(program, layer, level)
            self.looks.set(program, layer, camera, look)
            self._draw_tiles(program, rows)

    def _tiles(self, layer: Patches, level: int) -> list[tuple[bool, Tiles]]:
        """The tiles to draw; of a trimmed surface small ones, first those that no curve comes
        near, then those whose fragments are to be decided."""
        if layer.trim is None:
            return [(False, tile_rows(patch_count(layer.net), tiles(level)))]
        return self.trims.tiles(layer, level)

    def _set_nets(self, program: Program, layer: Patches, level: int) -> None:
        self._evaluation.texture(layer.net).use(0)
        program.set(position_net=0, position_degree=orders(layer.net), level=level)
        if "TEXTURED" in program.defines:
            assert layer.texture is not None
            self._evaluation.texture(layer.texture.net).use(1)
            program.set(
                texture_net=1,
                texture_degree=orders(layer.texture.net),
                texture_stride=0 if patch_count(layer.texture.net) == 1 else 1,
            )

    def tessellate(self, program: Program, count: int, level: int) -> None:
        """Draw all patches with a tessellation program, tile by tile and chunk by chunk."""
        self._draw_tiles(program, tile_rows(count, tiles(level)))

    def _draw_tiles(self, program: Program, rows: Tiles) -> None:
        self._ctx.patch_vertices = 1
        buffer = self._ctx.buffer(rows.tobytes())
        content = [(buffer, "1i 4i", "patch_index", "tile")]
        vertices = self._ctx.vertex_array(program.ready(), content)
        for first, count in draws((rows[:, 3:] + 1).prod(-1), self._capabilities.software):
            vertices.render(moderngl.PATCHES, vertices=count, first=first)
        vertices.release()
        buffer.release()
