"""Curvature combs: a tooth for each of many points of a curve, as long as it is bent there."""

from __future__ import annotations

import numpy as np

from ..geometry.curve import curvature, curve_derivatives
from . import palette
from .layers import Array, Color, Layer, Polylines


def comb_teeth(net: Array, scale: float, teeth: int = 48) -> Array:
    """Teeth (curves, teeth + 1, 2, 3) of planar curves (n, 4) or (curves, n, 4).

    From each point away from the centre of curvature by `scale` times the curvature; a point
    where the derivative vanishes has no tooth.
    """
    nets = net.reshape(-1, *net.shape[-2:])
    t = np.linspace(0.0, 1.0, teeth + 1)
    at, tangent = curve_derivatives(nets, t, 1)
    length = np.linalg.norm(tangent, axis=-1, keepdims=True)
    right = np.stack([tangent[..., 1], -tangent[..., 0], 0.0 * tangent[..., 0]], -1)
    with np.errstate(invalid="ignore", divide="ignore"):
        tips = at + scale * curvature(nets, t)[..., None] * right / length
    return np.stack([at, np.where(np.isfinite(tips), tips, at)], -2)


def curvature_comb(
    net: Array, scale: float, teeth: int = 48, color: Color = palette.DERIVATIVE
) -> tuple[Layer, ...]:
    """The teeth and the line along their tips, one line a curve: a jump of curvature is a jump
    of the tips."""
    ends = comb_teeth(net, scale, teeth)
    return (
        Polylines(ends.reshape(-1, 2, 3), color, 0.7),
        Polylines(np.ascontiguousarray(ends[..., 1, :]), color, 1.2),
    )
