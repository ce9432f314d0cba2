"""Bezier curves, rational or not: nets (..., n, 4) of premultiplied points (w x, w y, w z, w)."""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import bernstein
from .evaluate import project
from .net import control_net

Array = NDArray[np.float64]


def curve_net(points: ArrayLike, weights: ArrayLike | None = None) -> Array:
    """A net (..., n, 4) from control points (..., n, 2 or 3) and positive weights (..., n).

    Raises ValueError naming the first offending index, as `control_net` does.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.ndim < 2:
        raise ValueError(f"expected points of shape (..., n, 2 or 3), found {points.shape}")
    factors = None if weights is None else np.asarray(weights, dtype=np.float64)[..., None]
    return np.asarray(control_net(points[..., None, :], factors)[..., 0, :])


def evaluate_curve(net: Array, t: ArrayLike) -> Array:
    """Homogeneous points sum_i c_i B_i(t): shape (..., k, 4) for t of shape (k,)."""
    basis = bernstein(net.shape[-2] - 1, np.atleast_1d(t))
    return np.asarray(basis @ net)


def homogeneous_derivatives(net: Array, t: ArrayLike, order: int) -> Array:
    """d^m/dt^m of the homogeneous curve, m = 0..order: shape (order + 1, ..., k, 4)."""
    found, differences = [], net
    for m in range(order + 1):
        found.append(evaluate_curve(differences, t))
        degree = net.shape[-2] - 1 - m
        if degree > 0:
            differences = degree * np.diff(differences, axis=-2)
        else:
            differences = np.zeros_like(net[..., :1, :])
    return np.stack(found)


def curve_derivatives(net: Array, t: ArrayLike, order: int) -> Array:
    """d^m/dt^m of the curve in space, m = 0..order: shape (order + 1, ..., k, 3).

    By Leibniz' rule for X = w p (The NURBS Book, eq. 4.8).
    """
    homogeneous = homogeneous_derivatives(net, t, order)
    points, weights = homogeneous[..., :3], homogeneous[..., 3:]
    found: list[Array] = []
    for m in range(order + 1):
        rest = points[m].copy()
        for j in range(1, m + 1):
            rest -= comb(m, j) * weights[j] * found[m - j]
        found.append(rest / weights[0])
    return np.stack(found)


def restrict(net: Array, start: float, end: float) -> Array:
    """The same curves (..., n, 4) over [start, end] as over [0, 1], by the blossom: exact."""
    if (start, end) == (0.0, 1.0):
        return net
    degree = net.shape[-2] - 1
    found = []
    for i in range(degree + 1):
        points = net
        for t in (end,) * i + (start,) * (degree - i):
            points = (1.0 - t) * points[..., :-1, :] + t * points[..., 1:, :]
        found.append(points[..., 0, :])
    return np.stack(found, -2)


def curve_points(net: Array, t: ArrayLike) -> Array:
    """Points (..., k, 3) in space."""
    return project(evaluate_curve(net, t))


def speed(net: Array, t: ArrayLike) -> Array:
    """|x'(t)|: shape (..., k)."""
    return np.asarray(np.linalg.norm(curve_derivatives(net, t, 1)[1], axis=-1))


def curvature(net: Array, t: ArrayLike) -> Array:
    """Signed curvature (x' y'' - y' x'') / |x'|^3 of a curve in the plane; NaN where x' = 0."""
    _, first, second = curve_derivatives(net, t, 2)
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(cross / np.linalg.norm(first, axis=-1) ** 3)


def circular_arc(radius: float, start: float, end: float) -> Array:
    """The arc from angle `start` to `end`, less than half a turn, as a rational quadratic (3, 4).

    The middle weight is the cosine of half the angle, the middle point where the tangents meet.
    """
    half = (end - start) / 2.0
    if not 0.0 < abs(half) < np.pi / 2.0:
        raise ValueError(f"expected an arc of less than half a turn, found {end - start:g} radians")
    angles = np.array([start, (start + end) / 2.0, end])
    lengths = np.array([1.0, 1.0 / np.cos(half), 1.0]) * radius
    points = np.stack([np.cos(angles), np.sin(angles)], -1) * lengths[:, None]
    return curve_net(points, [1.0, np.cos(half), 1.0])
