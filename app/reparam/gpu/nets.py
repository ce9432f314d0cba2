"""Control nets as textures. Twin: shaders/lib/net.glsl reads them."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError

NET_UNIT = 15  # a texture unit that every stage of every OpenGL 3.3 has, far from a user's own
NET_WIDTH = 4096  # texels in a row; 2^26 control points fit where textures reach 16384


def pack(net: NDArray[np.float64]) -> NDArray[np.float32]:
    """The texels of a net (..., m, n, 4): shape (rows, width, 4), patch after patch, v fastest.

    The width is NET_WIDTH as soon as there is more than one row.
    """
    points = net.reshape(-1, 4)
    width = min(len(points), NET_WIDTH)
    rows = -(-len(points) // width)
    texels = np.zeros((rows * width, 4), np.float32)
    texels[: len(points)] = points
    return texels.reshape(rows, width, 4)


def net_texture(ctx: moderngl.Context, net: NDArray[np.float64]) -> moderngl.Texture:
    """A net on the GPU, RGBA32F. Raises GraphicsError where it is too large."""
    most = NET_WIDTH * int(ctx.info["GL_MAX_TEXTURE_SIZE"])
    if net.size // 4 > most:
        raise GraphicsError(
            f"expected at most {most} control points in a layer, found {net.size // 4}"
        )
    texels = pack(net)
    texture = ctx.texture((texels.shape[1], texels.shape[0]), 4, texels.tobytes(), dtype="f4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    return texture
