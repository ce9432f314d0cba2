"""Colours that show shape, and how textures lie on it. Twin: shaders/lib/shading.glsl."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..geometry.net import control_net
from . import palette
from .layers import Array, Patches, Ramp
from .remember import remember

Shading = Literal["light", "zebra", "gauss", "mean", "kind", "area", "stretch", "angle"]
SYMBOLS = {
    "gauss": "Gauss curvature K",
    "mean": "mean curvature H",
    "area": "area of a small square",
    "stretch": "longest over shortest way",
    "angle": "angle between s and t",
}
COLUMN = {"gauss": 0, "mean": 1}  # of `curvatures`
DISTORTION = {"area": 0, "stretch": 1, "angle": 2}  # of `distortions`: how a texture is attached

ZEBRA_BANDS = 8
LOW_COLOR, HIGH_COLOR = palette.ALONG_U, palette.ALONG_V  # blue and vermillion

SQUARE = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
SQUARE.flags.writeable = False


class Scale(NamedTuple):
    """The value that is white, and how far from it the colour is full."""

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


def ticks(shading: Shading, scale: Scale) -> Iterator[tuple[float, str]]:
    """Where a bar of colours is told its value, from -1 to 1, and the value in words."""
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
