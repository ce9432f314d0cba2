"""How fast a rational patch can run and how sharply it can bend: bounds from its control net.

With R = X / w about a centre c of the patch (X - c w for X), at every parameter

    R_a  = (X_a - w_a R) / w
    R_ab = (X_ab - w_a R_b - w_b R_a - w_ab R) / w

and each Bezier polynomial on the right is no larger than its largest control point, R no longer
than the farthest control point, w no less than its least weight. Polynomial patches lose nothing;
rational ones little once they are short, so callers hand in pieces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .net import Array, raise_degree


@dataclass(frozen=True, eq=False)
class Bounds:
    """Of many nets: largest |R_u|, |R_v|, |R_uu|, |R_uv|, |R_vv| of each, arrays (...,).

    Infinite where a weight is not positive.
    """

    u: Array
    v: Array
    uu: Array
    uv: Array
    vv: Array


def hodograph(net: Array, axis: int) -> Array:
    """The derivative's net along axis -3 (u) or -2 (v), raised to the net's own degrees."""
    degree = net.shape[axis] - 1
    if degree == 0:
        return np.zeros_like(net)
    m, n = net.shape[-3] - 1, net.shape[-2] - 1
    return raise_degree(degree * np.diff(net, axis=axis), m, n)


def directional_bound(net: Array, along_u: ArrayLike, along_v: ArrayLike) -> Array:
    """The largest |a R_u + b R_v| on each net (..., m, n, d + 1) of homogeneous points.

    a and b have the shape (...,) of the result, or broadcast to it. Infinite where a weight is
    not positive.
    """
    a, b = (np.asarray(x, dtype=np.float64)[..., None, None, None] for x in (along_u, along_v))
    centred, radius, weight, bounded = _centred(net)
    slope = a * hodograph(centred, -3) + b * hodograph(centred, -2)
    return np.where(bounded, (_longest(slope) + _steepest(slope) * radius) / weight, np.inf)


def bounds(net: Array) -> Bounds:
    """All of them, for each net (..., m, n, d + 1) of homogeneous points."""
    net, radius, weight, bounded = _centred(net)
    u, v = hodograph(net, -3), hodograph(net, -2)
    steep_u, steep_v = _steepest(u), _steepest(v)
    first_u, first_v = (
        (_longest(slope) + steep * radius) / weight for slope, steep in ((u, steep_u), (v, steep_v))
    )
    found = [first_u, first_v]
    for slope, turning in (
        (hodograph(u, -3), 2.0 * steep_u * first_u),
        (hodograph(u, -2), steep_u * first_v + steep_v * first_u),
        (hodograph(v, -2), 2.0 * steep_v * first_v),
    ):
        found.append((_longest(slope) + turning + _steepest(slope) * radius) / weight)
    return Bounds(*(np.where(bounded, bound, np.inf) for bound in found))


def _centred(net: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """The net about the middle of its control points, its radius, its least weight.

    And whether all weights are positive; where not, 1 stands in.
    """
    weights = net[..., -1]
    bounded = np.asarray((weights > 0.0).all((-2, -1)))
    safe = np.where(weights > 0.0, weights, 1.0)
    affine = net[..., :-1] / safe[..., None]
    center = (affine.min((-3, -2)) + affine.max((-3, -2))) / 2.0
    moved = net.copy()
    moved[..., :-1] -= center[..., None, None, :] * weights[..., None]
    radius = np.linalg.norm(moved[..., :-1] / safe[..., None], axis=-1).max((-2, -1))
    return moved, radius, safe.min((-2, -1)), bounded


def _longest(net: Array) -> Array:
    return np.asarray(np.linalg.norm(net[..., :-1], axis=-1).max((-2, -1)))


def _steepest(net: Array) -> Array:
    return np.asarray(np.abs(net[..., -1]).max((-2, -1)))
