"""What a map does to a picture that it carries to a surface. Twin: shaders/lib/distortion.glsl.

A texture map q takes (u,v) into the picture, the patch p takes it into space, so the picture is
carried by p(q^-1). The columns of its derivative

      (a b) = (p_u p_v) (q_u q_v)^-1

are where the directions of s and t go: a small square becomes the parallelogram of a and b, a
small circle an ellipse whose half axes are the singular values.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .net import Array
from .partials import partials

FARTHEST = 64.0  # of the logarithms: an area that vanishes is told as 2^-64


def distortions(net: Array, maps: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """Area, stretch and angle, shape (..., k..., 3), of patches (..., m, n, 4) under their maps.

    The area is log2 |a x b|; the stretch log2 of the longest over the shortest half axis; the
    angle, in degrees, what the one between a and b has more than 90. NaN where q_u and q_v are
    parallel. `maps` are nets (m, n, 4) or one for each patch, of which (s,t) = (x,y)/w counts.
    """
    p, q = partials(net, u, v, 1), partials(maps, u, v, 1)
    p_u, p_v = p[1, 0], p[0, 1]
    (s_u, t_u), (s_v, t_v) = (np.moveaxis(d[..., :2], -1, 0) for d in (q[1, 0], q[0, 1]))
    determinant = (s_u * t_v - s_v * t_u)[..., None]
    determinant = np.where(determinant == 0.0, np.nan, determinant)
    a = (p_u * t_v[..., None] - p_v * t_u[..., None]) / determinant
    b = (p_v * s_u[..., None] - p_u * s_v[..., None]) / determinant
    e, f, g = (a * a).sum(-1), (a * b).sum(-1), (b * b).sum(-1)
    area = np.linalg.norm(np.cross(a, b), axis=-1)
    longest = (e + g + np.hypot(e - g, 2.0 * f)) / 2.0  # squared
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.stack([np.log2(area), np.log2(longest / area)], -1)
    logs = np.where(np.isnan(determinant), np.nan, np.clip(logs, -FARTHEST, FARTHEST))
    angle = np.degrees(np.arctan2(-f, area))
    return np.concatenate([logs, angle[..., None]], -1)


def sampled_distortions(nets: Array, maps: Array, samples: int = 8) -> Array:
    """The same at the middles of samples x samples cells of each patch: (P, k, 3)."""
    middle = (np.arange(samples) + 0.5) / samples
    u, v = (grid.ravel() for grid in np.meshgrid(middle, middle, indexing="ij"))
    return distortions(nets, maps, u, v)
