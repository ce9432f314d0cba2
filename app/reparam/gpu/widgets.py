"""Draws what Dear ImGui has laid out (widgets.*): triangles, cut by rectangles, from its atlas."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING

import moderngl
import numpy as np

from .programs import Programs

if TYPE_CHECKING:
    from imgui_bundle import imgui

VERTEX = 20  # bytes: place, texel and tint
INDEX = 4


class Widgets:
    """Triangles into the current framebuffer, and the textures that Dear ImGui asks for."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        self._textures: dict[int, moderngl.Texture] = {}

    def draw(self, data: imgui.ImDrawData) -> None:
        """All of it, over what is there. The viewport and the scissor are left as they were."""
        for texture in data.textures:
            self._renew(texture)
        scale, before = data.framebuffer_scale, self._ctx.viewport
        width, height = (data.display_size.x * scale.x, data.display_size.y * scale.y)
        self._ctx.viewport = (0, 0, round(width), round(height))
        self._ctx.enable_only(moderngl.BLEND)
        self._ctx.blend_func = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)
        program = self._programs.get("widgets.vert", "widgets.frag")
        program.set(window=(data.display_size.x, data.display_size.y), atlas=0)
        for commands in data.cmd_lists:
            vertices = _bytes(commands.vtx_buffer, VERTEX)
            indices = _bytes(commands.idx_buffer, INDEX)
            if not indices:
                continue
            buffers = (self._ctx.buffer(vertices), self._ctx.buffer(indices))
            array = self._ctx.vertex_array(
                program.ready(),
                [(buffers[0], "2f 2f 4f1", "place", "texel", "tint")],
                index_buffer=buffers[1],
                index_element_size=INDEX,
            )
            for command in commands.cmd_buffer:
                left, top, right, bottom = command.clip_rect
                x, y = max(0, round(left * scale.x)), max(0, round(height - bottom * scale.y))
                across, up = round(right * scale.x) - x, round(height - top * scale.y) - y
                if across <= 0 or up <= 0:
                    continue
                self._ctx.scissor = (x, y, across, up)
                self._textures[command.get_tex_id()].use(0)
                array.render(moderngl.TRIANGLES, command.elem_count, first=command.idx_offset)
            array.release()
            for buffer in buffers:
                buffer.release()
        self._ctx.scissor = None
        self._ctx.viewport = before

    def _renew(self, texture: imgui.ImTextureData) -> None:
        """Make, change or drop a texture, as it wants."""
        from imgui_bundle import imgui

        status = imgui.ImTextureStatus
        if texture.status == status.want_create:
            made = self._ctx.texture((texture.width, texture.height), 4, _pixels(texture).tobytes())
            texture.set_tex_id(made.glo)
            self._textures[made.glo] = made
        elif texture.status == status.want_updates:
            pixels = _pixels(texture)
            for part in texture.updates:
                box = pixels[part.y : part.y + part.h, part.x : part.x + part.w]
                place = (part.x, part.y, part.w, part.h)
                self._textures[texture.tex_id].write(box.tobytes(), viewport=place)
        elif texture.status == status.want_destroy:
            self._textures.pop(texture.tex_id).release()
            texture.set_tex_id(0)
            texture.set_status(status.destroyed)
            return
        else:
            return
        texture.set_status(status.ok)


def _pixels(texture: imgui.ImTextureData) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    return texture.get_pixels_array().reshape(texture.height, texture.width, 4)


def _bytes(vector: object, size: int) -> bytes:
    """What an ImVector of things of that size holds."""
    count = vector.size()  # type: ignore[attr-defined]
    return ctypes.string_at(vector.data_address(), count * size) if count else b""  # type: ignore[attr-defined]
