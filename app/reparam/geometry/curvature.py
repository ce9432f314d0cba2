"""Gauss and mean curvature. Twin: shaders/lib/curvature.glsl, same names."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .net import Array
from .partials import partials

REGULAR = 1e-10  # the least squared sine between the tangents at which curvature is told


def curvatures(net: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """(K, H) of the projected surface, shape (..., k..., 2); (0, 0) where p_u x p_v vanishes.

    H is positive where the surface bends away from p_u x p_v: on a sphere seen from outside.
    """
    p = partials(net, u, v, 2)
    p_u, p_v, p_uu, p_uv, p_vv = p[1, 0], p[0, 1], p[2, 0], p[1, 1], p[0, 2]
    normal = np.cross(p_u, p_v)
    e, f, g, square = _dot(p_u, p_u), _dot(p_u, p_v), _dot(p_v, p_v), _dot(normal, normal)
    regular = square > REGULAR * e * g
    square = np.where(regular, square, 1.0)
    bend_u, twist, bend_v = _dot(normal, p_uu), _dot(normal, p_uv), _dot(normal, p_vv)
    gauss = (bend_u * bend_v - twist * twist) / square**2
    mean = -(e * bend_v - 2.0 * f * twist + g * bend_u) / (2.0 * square**1.5)
    return np.where(regular[..., None], np.stack([gauss, mean], -1), 0.0)


def _dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(-1))


def sampled_curvatures(nets: Array, samples: int = 5) -> Array:
    """(K, H) at samples x samples points inside each patch: (k, 2)."""
    t = (np.arange(samples) + 0.5) / samples
    u, v = np.meshgrid(t, t, indexing="ij")
    return curvatures(nets, u, v).reshape(-1, 2)


def round_scale(values: Array) -> float:
    """1, 2 or 5 times a power of ten that 19 of 20 sizes do not exceed; 1 where all is flat."""
    most = float(np.quantile(np.abs(values), 0.95))
    if most < 1e-9:
        return 1.0
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(k for k in (1.0, 2.0, 5.0, 10.0) if k * power >= most * 0.999) * power)
