"""Control nets: float64 arrays of premultiplied homogeneous points (w x, w y, w z, w).

One patch is an array (m, n, 4), the first index going with u, the second with v; patches of
one order stand together as (patches, m, n, 4). Order = degree + 1, from 1 to MAX_ORDER.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

MAX_ORDER = 32
LARGEST = 1e18  # squares of this still fit in float32, so lengths on the GPU stay finite
SMALLEST_WEIGHT = 1e-18


def control_net(points: ArrayLike, weights: ArrayLike | None = None) -> Array:
    """A net (..., m, n, 4) from points (..., m, n, 2 or 3) in the plane or in space.

    `weights` (..., m, n) are positive, or zero where the denominator stays positive; without
    them the net is polynomial. Raises ValueError naming the first offending index.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.ndim < 3 or points.shape[-1] not in (2, 3):
        raise ValueError(f"expected points of shape (..., m, n, 2 or 3), found {points.shape}")
    net = np.zeros((*points.shape[:-1], 4))
    net[..., : points.shape[-1]] = points
    net[..., 3] = 1.0
    if weights is not None:
        factors = np.asarray(weights, dtype=np.float64)
        if factors.shape != points.shape[:-1]:
            raise ValueError(
                f"expected weights of shape {points.shape[:-1]}, found {factors.shape}"
            )
        net *= factors[..., None]
    return check_net(net)


def check_net(net: ArrayLike) -> Array:
    """The net as float64 if a GPU can draw it, else ValueError naming the first bad index.

    Refused: shapes other than (..., m, n, 4), orders outside 1..MAX_ORDER, NaN, infinities,
    coordinates (before or after division by w) larger than LARGEST, and weights that are
    negative or let the denominator vanish: inside the net zero is allowed, at its corners
    not, since there the denominator is the weight.
    """
    net = np.asarray(net, dtype=np.float64)
    if net.ndim < 3 or net.shape[-1] != 4:
        raise ValueError(f"expected a net of shape (..., m, n, 4), found {net.shape}")
    for order in net.shape[-3:-1]:
        if not 1 <= order <= MAX_ORDER:
            raise ValueError(f"expected an order from 1 to {MAX_ORDER}, found {order}")
    _refuse(~np.isfinite(net), net, "a finite number")
    _refuse(np.abs(net) > LARGEST, net, f"a coordinate of size up to {LARGEST:g}")
    weights = net[..., 3]
    _refuse(weights < 0.0, weights, "a weight of at least 0")
    _refuse(
        (weights > 0.0) & (weights < SMALLEST_WEIGHT), weights, "a weight of 0 or at least 1e-18"
    )
    corner = np.zeros(net.shape[-3:-1], dtype=bool)
    corner[[0, 0, -1, -1], [0, -1, 0, -1]] = True
    _refuse(corner & (weights == 0.0), weights, "a positive weight at the corner of the net")
    affine = net[..., :3] / np.where(weights > 0.0, weights, 1.0)[..., None]
    _refuse(np.abs(affine) > LARGEST, affine, f"a coordinate of size up to {LARGEST:g}")
    return net


def _refuse(bad: NDArray[np.bool_], values: Array, expected: str) -> None:
    if bad.any():
        index = tuple(int(i) for i in np.argwhere(bad)[0])
        raise ValueError(f"control net{list(index)}: expected {expected}, found {values[index]:g}")


def raise_degree(net: Array, degree_u: int, degree_v: int) -> Array:
    """The same map with a net of at least the degrees asked for (The NURBS Book, eq. 5.36).

    Mirror-symmetric in its arithmetic, and an edge of the result depends on that edge alone:
    what two neighbours share stays the same, bit for bit, whichever way each reads it.
    """
    net = _raise_axis(net, net.ndim - 3, degree_u)
    return _raise_axis(net, net.ndim - 2, degree_v)


def _raise_axis(net: Array, axis: int, degree: int) -> Array:
    points = np.moveaxis(net, axis, 0)
    while len(points) <= degree:
        order = len(points)
        i = np.arange(order + 1.0).reshape(-1, *[1] * (points.ndim - 1))
        before = np.concatenate([points[:1], points])
        here = np.concatenate([points, points[-1:]])
        mixed = (i * before + (order - i) * here) / order
        points = np.concatenate([points[:1], mixed[1:-1], points[-1:]])  # order * x / order != x
    return np.moveaxis(points, 0, axis)


def lower_degree(net: Array) -> Array:
    """The same map (m, n, 4) with the lowest degrees, at least 1, that give it to rounding.

    Mirror-symmetric in its arithmetic, as `raise_degree` is.
    """
    for axis in (0, 1):
        while net.shape[axis] > 2:
            lower = _lower_axis(net, axis)
            gap = np.abs(_raise_axis(lower, axis, net.shape[axis] - 1) - net).max()
            if gap > 1e-14 * np.abs(net).max():
                break
            net = lower
    return net


def _lower_axis(net: Array, axis: int) -> Array:
    """One degree less: from both ends to the middle, solving what raising did."""
    points = np.moveaxis(net, axis, 0)
    d = len(points) - 1
    left, right = [points[0]], [points[-1]]
    for i in range(1, (d + 1) // 2):
        left.append((d * points[i] - i * left[-1]) / (d - i))
        right.append((d * points[d - i] - i * right[-1]) / (d - i))
    middle = [(left.pop() + right.pop()) / 2.0] if d % 2 else []
    return np.moveaxis(np.array([*left, *middle, *right[::-1]]), 0, axis)


def bounding_box(points: Array) -> Array:
    """Smallest and largest coordinates of (..., d) points: shape (2, d)."""
    flat = points.reshape(-1, points.shape[-1])
    return np.stack([flat.min(0), flat.max(0)])
