"""Paths: Bezier curves end to start, run through at constant speed (note, section on (5))."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arclength import TABLE, ArcLength
from .bernstein import bernstein, bernstein_derivative
from .extraction import curve_to_bezier
from .nurbs import clamped_knots

Array = NDArray[np.float64]

ASIDE = 1e-7  # of a piece: where a tangent is looked for if there is none at the point itself


@dataclass(frozen=True, eq=False)
class Path:
    """Nets (pieces, n, 4); piece i is run through by u in [i, i+1].

    `intervals` (pieces, 2) are the parameters that the curve's author knows them by.
    """

    nets: Array
    intervals: Array

    def _local(self, u: ArrayLike) -> tuple[NDArray[np.int64], Array]:
        u = np.asarray(u, dtype=np.float64)
        piece = np.clip(np.floor(u).astype(np.int64), 0, len(self.nets) - 1)
        return piece, np.clip(u - piece, 0.0, 1.0)

    def points(self, u: ArrayLike) -> Array:
        """Points (k, 3) at the parameters u (k,)."""
        return self._evaluate(u)[0]

    def derivative(self, u: ArrayLike) -> Array:
        """d/du of the points: (k, 3)."""
        return self._evaluate(u)[1]

    def _evaluate(self, u: ArrayLike) -> tuple[Array, Array]:
        piece, t = self._local(u)
        degree = self.nets.shape[1] - 1
        nets = self.nets[piece]
        value = np.einsum("kn,knc->kc", bernstein(degree, t), nets)
        slope = np.einsum("kn,knc->kc", bernstein_derivative(degree, t), nets)
        at = value[:, :3] / value[:, 3:]
        return at, (slope[:, :3] - slope[:, 3:] * at) / value[:, 3:]

    def speed(self, u: ArrayLike) -> Array:
        """|x'(u)|: shape (k,)."""
        return np.asarray(np.linalg.norm(self.derivative(u), axis=-1))

    def tangents(self, u: ArrayLike) -> Array:
        """Unit directions of travel (k, 3); at a cusp the one that it is left in.

        Zero where the whole neighbourhood is one point.
        """
        u = np.asarray(u, dtype=np.float64)
        direction = self.derivative(u)
        length = np.linalg.norm(direction, axis=-1, keepdims=True)
        scale = max(self.arc.length, 1e-300)
        still = length[:, 0] <= 1e-9 * scale
        if still.any():
            last = float(len(self.nets))
            before = np.minimum(u[still], last - ASIDE)
            step = self.points(before + ASIDE) - self.points(before)
            direction[still] = step
            length[still] = np.linalg.norm(step, axis=-1, keepdims=True)
        return np.asarray(
            np.divide(direction, length, out=np.zeros_like(direction), where=length > 0)
        )

    def parameters(self, u: ArrayLike) -> Array:
        """The author's parameters for u."""
        piece, t = self._local(u)
        low, high = self.intervals[piece].T
        return np.asarray(low + t * (high - low))

    @cached_property
    def arc(self) -> ArcLength:
        """The path's arc length."""
        return ArcLength(self.speed, np.arange(len(self.nets) + 1.0).tolist())

    @cached_property
    def table(self) -> Array:
        """(u, du/dfraction) at equal fractions of the length, for the GPU (scenes' Traced)."""
        return self.arc.table(TABLE) * [1.0, self.arc.length]


def bezier_path(net: Array) -> Path:
    """One Bezier curve (n, 4) with its own parameter in [0,1], or several, one after another."""
    nets = net.reshape(-1, *net.shape[-2:])
    starts = np.arange(float(len(nets)))
    return Path(nets, np.stack([starts, starts + 1.0], -1))


def spline_path(points: Array, degree: int, knots: ArrayLike | None = None) -> Path:
    """The B-spline of homogeneous points (n, 4); clamped uniform knots if none are given.

    Raises KnotError (a ValueError) for knots that no spline of this degree has.
    """
    order = degree + 1
    if knots is None:
        knots = clamped_knots(len(points), order)
    pieces = curve_to_bezier(knots, points, order)
    return Path(pieces.nets, pieces.intervals)


def hermite(table: Array, fraction: ArrayLike) -> Array:
    """The parameters at fractions of the length, by cubic Hermite interpolation of a Path's table.

    Twin: parameter_at in shaders/trace.vert.
    """
    last = len(table) - 1
    at = np.clip(np.asarray(fraction, dtype=np.float64), 0.0, 1.0) * last
    k = np.minimum(at.astype(np.int64), last - 1)
    x, step = at - k, 1.0 / last
    (u0, d0), (u1, d1) = table[k].T, table[k + 1].T
    bent = step * x * (1.0 - x) * ((1.0 - x) * d0 - x * d1)
    return np.asarray(u0 + x * x * (3.0 - 2.0 * x) * (u1 - u0) + bent)
