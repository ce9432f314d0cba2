"""Colours that show shape, how textures lie on it, and how it is drawn.

Twin: shaders/lib/shading.glsl.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..geometry.net import control_net
from . import palette
from .layers import Array, Patches, Ramp
from .remember import remember

Shading = Literal[
    "light", "zebra", "gauss", "mean", "kind", "area", "stretch", "angle", "level", "error"
]
SYMBOLS = {
    "gauss": "Gauss curvature K",
    "mean": "mean curvature H",
    "area": "area of a small square",
    "stretch": "longest over shortest way",
    "angle": "angle between s and t",
    "level": "steps of patches and edges",
    "error": "pixels off the exact surface",
}
COLUMN = {"gauss": 0, "mean": 1}  # of `curvatures`
DISTORTION = {"area": 0, "stretch": 1, "angle": 2}  # of `distortions`: how a texture is attached
DRAWN = ("level", "error")  # of the triangles
OF_SUBJECT = (*DISTORTION, *DRAWN)  # shown on all patches of the subject, lit or not

ZEBRA_BANDS = 8
LOW_COLOR, HIGH_COLOR = palette.ALONG_U, palette.ALONG_V  # blue and vermillion
OVER_COLOR = palette.rgb("E69F00")  # orange
LEVEL_COLORS = tuple(map(palette.rgb, ("FFFFD9", "C7E9B4", "7FCDBB", "1D91C0", "225EA8", "0C2C84")))
LEVEL_FULL = 64.0  # steps
HALF_A_PIXEL = 0.5  # what an error is held against where no tolerance is asked for
RIM = 2.0  # figure units of a patch that have the colour of its edge's level

SQUARE = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
SQUARE.flags.writeable = False


class Scale(NamedTuple):
    """The value that is white, and how far from it the colour is full; of errors how many pixels
    are allowed, and of levels how wide the rims are."""

    middle: float = 0.0
    full: float = 1.0


PLAIN_SCALE = Scale()


def zebra_wave(normal: Array, sight: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Positive in bright bands, negative in dark ones; unit normals and directions to the eye
    (..., 3), in the eye's coordinates."""
    sight = np.asarray(sight, dtype=np.float64)
    mirrored = 2.0 * (normal * sight).sum(-1) * normal[..., 0] - sight[..., 0]
    return np.asarray(np.sin(np.pi * ZEBRA_BANDS * mirrored))


def diverging(value: ArrayLike) -> Array:
    """From -1 (blue) over 0 (white) to 1 (vermillion): (..., 3)."""
    value = np.asarray(value, dtype=np.float64)[..., None]
    end = np.where(value < 0.0, LOW_COLOR, HIGH_COLOR)
    return np.asarray(1.0 + np.minimum(np.abs(value), 1.0) * (end - 1.0))


def level_color(steps: ArrayLike) -> Array:
    """By the number of steps, logarithmically: pale for one, dark for LEVEL_FULL and more."""
    place = np.log2(np.maximum(steps, 1.0)) / np.log2(LEVEL_FULL)
    at = np.linspace(0.0, 1.0, len(LEVEL_COLORS))
    channels = np.array(LEVEL_COLORS).T
    return np.stack([np.interp(place, at, channel) for channel in channels], -1)


def error_color(share: ArrayLike) -> Array:
    """By what is allowed: white for nothing, blue up to 1; above from orange to vermillion at 2."""
    share = np.asarray(share, dtype=np.float64)[..., None]
    below = 1.0 + share * (np.array(LOW_COLOR) - 1.0)
    above = OVER_COLOR + np.minimum(share - 1.0, 1.0) * (np.array(HIGH_COLOR) - OVER_COLOR)
    return np.asarray(np.where(share <= 1.0, below, above))


def bar_colors(shading: Shading, values: Array) -> Array:
    """The colours (k, 3) of a bar from its first tick's value to its last one's."""
    if shading == "level":
        return level_color(2.0**values)
    return error_color(values) if shading == "error" else diverging(values)


def ticks(shading: Shading, scale: Scale) -> Iterator[tuple[float, str]]:
    """Where a bar of colours is told its value, from -1 to 1, and the value in words; of levels at
    their logarithm, of errors from 0 to 2 times what is allowed."""
    if shading == "level":
        most = int(np.log2(LEVEL_FULL))
        yield from ((at, f"{2**at}") for at in range(0, most, 2))
        yield most, f"≥ {2**most}"
        return
    if shading == "error":
        yield from ((0.0, "0"), (1.0, f"{scale.full:g}"), (2.0, f"≥ {2.0 * scale.full:g}"))
        return
    for at in (-1.0, 0.0, 1.0) if shading != "stretch" else (0.0, 1.0):
        value = scale.middle + at * scale.full
        if shading in ("area", "stretch"):
            words = f"{2.0**value:.2g}"
        elif shading == "angle":
            words = f"{90.0 + value:g}°"
        else:
            words = f"{value:g}"
        yield at, words.replace("-", "−")


def attached_by(layer: Patches) -> Array:
    """The map of what is attached to patches: their texture's, or where they have none, or a field
    computed on them, their own parameters."""
    texture = layer.texture
    if texture is not None and not (isinstance(texture.picture, Ramp) and texture.picture.scalar):
        return texture.net
    return SQUARE if layer.domains is None else parameters(layer.domains)


@remember
def parameters(domains: Array) -> Array:
    """(u,v) of a surface over its patches' domains (patches, 4): nets (patches, 2, 2, 4)."""
    u0, u1, v0, v1 = domains.T
    corners = [[(u, v) for v in (v0, v1)] for u in (u0, u1)]
    return control_net(np.moveaxis(np.array(corners), -1, 0))
