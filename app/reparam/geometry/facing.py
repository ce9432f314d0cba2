"""Whether a patch shows nothing but its back.

Twin: shaders/lib/facing.glsl. Seen as (x, y, w), a surface shows its back where det [p, a, b] < 0
with a and b its derivatives along u and v, and a triangle with corners p, p + a, p + b, be they as
far apart as they like, if a goes along u and b along v. For p is in the hull of the control points,
and a and b are in the cones of the net's legs. The determinant is linear in each, so

    det / w <= max(a_x b_y) - min(a_y b_x)
               + |x| (|a_y b_w| + |a_w b_y|) + |y| (|a_x b_w| + |a_w b_x|)

holds with bounds of each, best in coordinates in which the patch is a unit square about 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .net import Array


def faces_away(clip: Array) -> NDArray[np.bool_]:
    """For nets (P, m, n, 4) in clip coordinates, (P,): False where it cannot be told.

    A body that is closed and seen from outside hides such patches behind others.
    """
    points = clip[..., [0, 1, 3]]
    positive = np.asarray((points[..., 2] > 0.0).all((-2, -1)))
    points = np.where(positive[:, None, None, None], points, np.array([0.0, 0.0, 1.0]))
    corners = points[:, [0, -1, 0, -1], [0, 0, -1, -1]]
    a, b, c, d = np.moveaxis(corners[..., :2] / corners[..., 2:], 1, 0)
    along_u, along_v = b - a + d - c, c - a + d - b
    area = along_u[:, 0] * along_v[:, 1] - along_u[:, 1] * along_v[:, 0]
    sides = np.stack([along_u, -along_v], -1)
    sides = np.where((area < 0.0)[:, None, None], sides, np.eye(2))
    straight = np.linalg.inv(sides)[:, None, None]
    middle = ((a + b + c + d) / 4.0)[:, None, None]
    w = points[..., 2:]
    plane = (straight @ (points[..., :2] - middle * w)[..., None])[..., 0]
    points = np.concatenate([plane, w], -1)
    reach = np.abs(points[..., :2] / w).max((1, 2))
    (low_u, high_u), (low_v, high_v) = (
        (legs.min((1, 2)), legs.max((1, 2)))
        for legs in (np.diff(points, axis=1), np.diff(points, axis=2))
    )
    wide_u, wide_v = (np.maximum(np.abs(low_u), np.abs(high_u)),
                      np.maximum(np.abs(low_v), np.abs(high_v)))  # fmt: skip
    turn = _largest_product(low_u[:, 0], high_u[:, 0], low_v[:, 1], high_v[:, 1])
    turn = turn + _largest_product(-low_u[:, 1], -high_u[:, 1], low_v[:, 0], high_v[:, 0])
    tilt = wide_u[:, 1::-1] * wide_v[:, 2:] + wide_v[:, 1::-1] * wide_u[:, 2:]
    return np.asarray(positive & (area < 0.0) & (turn + (reach * tilt).sum(-1) < 0.0))


def _largest_product(a: Array, b: Array, c: Array, d: Array) -> Array:
    return np.maximum(np.maximum(a * c, a * d), np.maximum(b * c, b * d))
