"""Partial derivatives of the projected surface, to any order."""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import ArrayLike

from .evaluate import evaluate
from .net import Array


def derivative_net(net: Array, axis: int) -> Array:
    """The net of the derivative along u (axis 0) or v (1): degree times the differences of the
    coefficients; of degree 0 the zero net of the same shape."""
    along = net.ndim - 3 + axis
    degree = net.shape[along] - 1
    return degree * np.diff(net, axis=along) if degree else np.zeros_like(net)


def partials(net: Array, u: ArrayLike, v: ArrayLike, order: int) -> Array:
    """All d^(i+j) p / du^i dv^j with i + j <= order of the surface p = (x, y, z)/w.

    Shape (order + 1, order + 1, ..., k..., 3) for a net (..., m, n, 4) and parameters (k...); the
    entries with i + j > order are NaN. (The NURBS Book, algorithm A4.4.)
    """
    homogeneous: dict[tuple[int, int], Array] = {}
    row = net
    for i in range(order + 1):
        cell = row
        for j in range(order + 1 - i):
            homogeneous[i, j] = evaluate(cell, u, v)
            cell = derivative_net(cell, 1)
        row = derivative_net(row, 0)
    weight = homogeneous[0, 0][..., 3:]
    result = np.full((order + 1, order + 1, *weight.shape[:-1], 3), np.nan)
    for total in range(order + 1):
        for i in range(total + 1):
            j = total - i
            value = homogeneous[i, j][..., :3].copy()
            for a in range(i + 1):
                for b in range(j + 1):
                    if (a, b) != (0, 0):
                        w = comb(i, a) * comb(j, b) * homogeneous[a, b][..., 3:]
                        value -= w * result[i - a, j - b]
            result[i, j] = value / weight
    return result
