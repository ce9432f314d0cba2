"""Patches layers: evaluated and drawn, by the vertex evaluator or by tessellation."""

from __future__ import annotations

from dataclasses import dataclass, replace

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..scenes.layers import Color, Patches, Picture, Ramp, Texture
from ..scenes.shading import DISTORTION, DRAWN, PLAIN_SCALE, Scale, Shading, attached_by
from .adaptive import Adaptive, Tolerance
from .batches import Batches
from .context import Capabilities
from .evaluation import Evaluation, orders, patch_count
from .fineness import MAP_UNIT
from .meshes import triangle_indices
from .nets import NET_UNIT
from .pictures import Pictures
from .programs import Program, Programs, degree_defines
from .tiles import Tiles, draws, tile_rows, tiles
from .trims import Edges, Part, Trims, decided, trim_defines

Array = NDArray[np.float64]

SHAPED = ("zebra", "gauss", "mean")  # told by the patch's own derivatives, fragment by fragment
WHITE = (1.0, 1.0, 1.0)
RAMP = Picture("ramp", wrap="mirror")

Fine = int | Tolerance  # steps in u and in v of every patch, or what a drawn point may be off


@dataclass(frozen=True)
class Look:
    """One colour, one shading, with the layer's picture or without; `bare` without light too.

    `map` is what fragments evaluate beside the position: what a texture is attached by, or a field.
    """

    color: Color
    shading: Shading = "light"
    scale: Scale = PLAIN_SCALE
    pictured: bool = True
    bare: bool = False
    map: Array | None = None
    edges: Edges = "shares"  # of what is trimmed, where pixels have several samples


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
        self._software = capabilities.software
        self.pictures = Pictures(ctx, capabilities)
        self.adaptive = Adaptive(ctx, programs, evaluation, capabilities)
        self.trims = Trims(ctx)
        self._batches = Batches(evaluation)
        self._indices: dict[tuple[int, int], moderngl.Buffer] = {}

    def draw(
        self,
        layer: Patches,
        camera: Camera,
        evaluator: str,
        fine: Fine,
        shading: Shading = "light",
        scale: Scale = PLAIN_SCALE,
        *,
        spatial: bool = False,
    ) -> None:
        """The layer as its picture, colour and light say; if lit, as `shading` says instead, and if
        that is about textures or triangles, lit or not.

        `scale` says which value is white and which has the full colour. The edge of a trimmed
        surface is blended with what is behind it; in space that may not be drawn yet, so there each
        of the pixel's samples is decided, and surfaces that share a trim curve meet.
        """
        look = Look(layer.color)
        if shading in DISTORTION:
            look = Look(WHITE, shading, scale, pictured=False, map=attached_by(layer))
        elif shading in DRAWN or (layer.lit and shading != "light"):
            color = layer.kind.color if shading == "kind" else WHITE
            look = Look(color, shading, scale, pictured=False)
        elif layer.texture is not None and layer.texture.exact:
            look = Look(layer.color, map=layer.texture.net)
        if spatial:
            look = replace(look, edges="samples")
        self._draw(layer, camera, evaluator, fine, look)

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
                    decided(self.defines(layer, look), trimmed),
                    lambda program: self.set_common(program, layer, camera, look),
                )
        elif evaluator == "vertex":
            self._draw_meshes(layer, camera, fine, look)
        else:
            self._draw_tessellated(layer, camera, fine, look)

    def sweep(self) -> None:
        """End of a frame."""
        self._batches.sweep()
        self.adaptive.sweep()
        self.trims.sweep()

    def forget(self) -> None:
        """Drop what older shaders evaluated."""
        self._batches.forget()

    def defines(self, layer: Patches, look: Look) -> dict[str, int | str]:
        """What the shaders of a layer are compiled with."""
        defines: dict[str, int | str] = {}
        if look.shading in (*SHAPED, *DRAWN):
            defines |= {"LOCATED": 1, look.shading.upper(): 1}
            defines |= degree_defines(POSITION_=orders(layer.net))
        if look.shading in SHAPED:
            defines["SHAPED"] = 1
        if look.map is not None:
            defines |= {"MAPPED": 1, "LOCATED": 1}
            if look.shading in DISTORTION:
                defines |= {"DISTORTED": 1, look.shading.upper(): 1}
            defines |= degree_defines(POSITION_=orders(layer.net), MAP_=orders(look.map))
        if layer.texture is not None and look.pictured:
            defines |= _picture_defines(layer.texture)
        if layer.lit and not look.bare:
            defines["LIT"] = 1
        if layer.trim is not None:
            several = self._ctx.fbo.samples > 1 and not look.bare
            defines |= trim_defines(layer.trim, look.edges if several else "pixels")
        return defines

    def set_common(self, program: Program, layer: Patches, camera: Camera, look: Look) -> None:
        """The uniforms of patch.frag and of what both evaluators hand to it."""
        program.set(
            clip_from_model=camera.clip_from_model().T.astype(np.float32).tobytes(),
            color=(*look.color, 1.0),
        )
        if "LOCATED" in program.defines:
            self._evaluation.texture(layer.net).use(NET_UNIT)
            program.set(
                position_net=NET_UNIT, position_degree=orders(layer.net), scale=look.scale.full
            )
        if "SHAPED" in program.defines:
            program.set(sight=camera.sight(self._ctx.viewport))
        if "ERROR" in program.defines:
            _, _, width, height = self._ctx.viewport
            program.set(half_size=(width / 2.0, height / 2.0))
        if "MAPPED" in program.defines:
            self._set_map(program, look)
        if "LIT" in program.defines:
            program.set(view_from_model=camera.rotation.T.astype(np.float32).tobytes())
        if "PICTURE" in program.defines:
            assert layer.texture is not None
            self._set_picture(program, layer.texture)
        if "TRIMMED" in program.defines:
            self.trims.bind(program, layer, unit=3)

    def _set_picture(self, program: Program, texture: Texture) -> None:
        picture = texture.picture
        if isinstance(picture, Ramp):
            self.pictures.use(RAMP, unit=2)
            program.set(image=2, low=picture.low, high=picture.high)
            program.set(contours=float(picture.contours))
            if "TEXTURED" in program.defines:
                program.set(image_from_map=(1.0, 1.0, 0.0, 0.0))
            return
        self.pictures.use(picture, unit=2)
        scale, offset = picture.scale, picture.offset
        reach = 0.75 if picture.filter == "smooth" else 0.0
        program.set(image=2, image_from_map=(scale, scale, offset, offset), reach=reach)

    def _set_map(self, program: Program, look: Look) -> None:
        assert look.map is not None
        self._evaluation.texture(look.map).use(MAP_UNIT)
        program.set(
            map_net=MAP_UNIT,
            map_degree=orders(look.map),
            map_stride=0 if patch_count(look.map) == 1 else 1,
        )
        if "DISTORTED" in program.defines:
            program.set(middle=look.scale.middle)

    # The vertex evaluator -------------------------------------------------------------------

    def _draw_meshes(self, layer: Patches, camera: Camera, level: int, look: Look) -> None:
        defines = self.defines(layer, look)
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
                self.set_common(program, layer, camera, look)
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
        defines = self.defines(layer, look)
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
            self.set_common(program, layer, camera, look)
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
        for first, count in draws((rows[:, 3:] + 1).prod(-1), self._software):
            vertices.render(moderngl.PATCHES, vertices=count, first=first)
        vertices.release()
        buffer.release()


def _picture_defines(texture: Texture) -> dict[str, int | str]:
    picture = texture.picture
    if isinstance(picture, Ramp):
        formula = picture.formula.glsl() if picture.formula else "x"
        where = "EXACT" if texture.exact else "TEXTURED"
        return {"PICTURE": 1, "RAMP": 1, "FIELD(x, y)": formula, where: 1}
    mirrored = {"MIRRORED": 1} if picture.wrap == "mirror" else {}
    return {"PICTURE": 1, "TEXTURED": 1, **mirrored}
