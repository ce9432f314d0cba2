"""Control nets as textures or attributes. Twin: shaders/lib/net.glsl reads them."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError

NET_UNIT = 15  # a texture unit that every stage of every OpenGL 3.3 has, far from a user's own
MAP_UNIT = NET_UNIT - 1  # and one more, for a texture map
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


def instance_vectors(degrees: tuple[int, int], components: int) -> int:
    """How many attributes of four floats hold the net of one patch."""
    return -(-(degrees[0] + 1) * (degrees[1] + 1) * components // 4)


def instance_defines(degrees: tuple[int, int], components: int) -> dict[str, int]:
    """What net.glsl is compiled with to read them."""
    vectors = instance_vectors(degrees, components)
    return {"INSTANCED": 1, "COMPONENTS": components, "CONTROLS": vectors}


def pack_instances(net: NDArray[np.float64], components: int) -> NDArray[np.float32]:
    """The attributes of nets (..., m, n, 4), of which `components` count: (patches, 4 vectors)."""
    points = net.reshape(-1, *net.shape[-3:])[..., :components]
    count = points[0].size
    packed = np.zeros((len(points), -(-count // 4) * 4), np.float32)
    packed[:, :count].reshape(points.shape)[...] = points  # a view, filled in one pass
    return packed


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


def rewrite(texture: moderngl.Texture, net: NDArray[np.float64], changed: list[range]) -> None:
    """Bring a texture of a net (patches, m, n, 4) up to date where these patches have changed.

    Only their texels travel: a run is the rest of a row, whole rows, the beginning of a row.
    """
    width, points = texture.size[0], net[0].size // 4
    for patches in changed:
        texels = net[patches.start : patches.stop].reshape(-1, 4).astype(np.float32)
        start, stop = patches.start * points, patches.stop * points
        first = start
        while first < stop:
            row, column = divmod(first, width)
            rows = 1 if column else max(1, (stop - first) // width)
            last = min(stop, first + rows * width - column)
            box = (column, row, (last - first) // rows, rows)
            texture.write(texels[first - start : last - start].tobytes(), viewport=box)
            first = last
