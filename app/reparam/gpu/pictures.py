"""Pictures as textures: the ones in textures/ and the user's own."""

from __future__ import annotations

import os
from pathlib import Path

import moderngl

from ..assets import texture_path
from ..errors import FileFormatError
from ..files.picture import Pixels, read_picture
from ..scenes.layers import Picture
from .context import Capabilities

ANISOTROPY = 16.0


class Pictures:
    """Loads each picture once. One that cannot be had becomes the checkerboard and a warning."""

    def __init__(self, ctx: moderngl.Context, capabilities: Capabilities) -> None:
        self._ctx = ctx
        self._capabilities = capabilities
        # llvmpipe 22.3's anisotropic filter ignores textureGrad's derivatives and speckles the rim.
        best = 1.0 if capabilities.software else capabilities.anisotropy
        self._anisotropy = max(1.0, min(ANISOTROPY, best))
        self._textures: dict[str, tuple[moderngl.Texture, bool]] = {}
        self.warnings: list[str] = []

    def defines(self, picture: Picture) -> dict[str, int]:
        """What patch.frag must know beforehand: moderngl has no mirrored repeat."""
        return {"MIRRORED": 1} if picture.wrap == "mirror" and self._load(picture)[1] else {}

    def use(self, picture: Picture, unit: int) -> tuple[float, float]:
        """Bind the picture; returns the scale and offset from the map to it."""
        texture, own = self._load(picture)
        mirrored = picture.wrap == "mirror" and own
        texture.repeat_x = texture.repeat_y = not mirrored
        if picture.filter == "nearest":
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            texture.anisotropy = 1.0
        else:
            texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            texture.anisotropy = self._anisotropy
        texture.use(unit)
        return (picture.scale, picture.offset) if own else (2.0, 2.0)

    def _load(self, picture: Picture) -> tuple[moderngl.Texture, bool]:
        """The texture, and whether it is the one asked for."""
        if picture.source not in self._textures:
            try:
                pixels = read_picture(_path(picture.source), self._capabilities.largest)
                self._textures[picture.source] = (self._upload(pixels), True)
            except FileFormatError as error:
                if picture.source == Picture().source:
                    raise
                self.warnings.append(f"{error}; the checkerboard stands in")
                checkerboard = self._load(Picture())[0]
                self._textures[picture.source] = (checkerboard, False)
        return self._textures[picture.source]

    def _upload(self, pixels: Pixels) -> moderngl.Texture:
        texture = self._ctx.texture(pixels.size, 3, pixels.data, alignment=1)
        texture.build_mipmaps()
        return texture


def _path(source: str) -> Path:
    own = texture_path(source)
    return own if os.path.isfile(own) else Path(source)
