"""Colours that show shape. Twin: shaders/lib/shading.glsl, same names."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from . import palette
from .layers import Array

Shading = Literal["light", "zebra", "gauss", "mean", "kind"]
SYMBOLS = {"gauss": "Gauss curvature K", "mean": "mean curvature H"}
COLUMN = {"gauss": 0, "mean": 1}  # of `curvatures`

ZEBRA_BANDS = 8
LOW_COLOR, HIGH_COLOR = palette.ALONG_U, palette.ALONG_V  # blue and vermillion


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
