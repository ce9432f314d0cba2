"""Pictures as textures: the ones in textures/ and the user's own."""

from __future__ import annotations

import moderngl

from ..files.picture import find_picture, read_picture
from ..scenes.layers import Picture
from .context import Capabilities

ANISOTROPY = 16.0


class Pictures:
    """Loads each picture once."""

    def __init__(self, ctx: moderngl.Context, capabilities: Capabilities) -> None:
        self._ctx = ctx
        # llvmpipe 22.3's anisotropic filter ignores textureGrad's derivatives and speckles the rim.
        best = 1.0 if capabilities.software else capabilities.anisotropy
        self._anisotropy = max(1.0, min(ANISOTROPY, best))
        self._textures: dict[str, moderngl.Texture] = {}

    def use(self, picture: Picture, unit: int) -> moderngl.Texture:
        """Bind the picture, looked up as it wants to be, and hand it back.

        Raises FileFormatError if it cannot be read, GraphicsError if it is too large.
        """
        if picture.source not in self._textures:
            self._textures[picture.source] = self._load(picture.source)
        texture = self._textures[picture.source]
        # moderngl has no mirrored repeat: patch.frag folds the coordinates.
        texture.repeat_x = texture.repeat_y = picture.wrap == "repeat"
        if picture.filter == "nearest":
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            texture.anisotropy = 1.0
        else:
            texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            texture.anisotropy = self._anisotropy
        texture.use(unit)
        return texture

    def _load(self, source: str) -> moderngl.Texture:
        pixels = read_picture(find_picture(source))
        texture = self._ctx.texture(pixels.size, 3, pixels.data, alignment=1)
        texture.build_mipmaps()
        return texture
