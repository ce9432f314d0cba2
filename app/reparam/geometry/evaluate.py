"""The evaluator in float64. Twin: shaders/lib/evaluate.glsl, same names."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import bernstein, bernstein_derivative

Array = NDArray[np.float64]

SAMPLES = 1 << 20  # of a surface, at most
FINEST = 64


def pair(t: ArrayLike) -> tuple[Array, Array]:
    """The parameter as the evaluator takes it: (t, 1-t)."""
    t = np.asarray(t, dtype=np.float64)
    return t, 1.0 - t


def grid_parameters(level: int) -> Array:
    """(u, 1-u, v, 1-v) of the (level+1)^2 grid points, u slowest: shape ((level+1)^2, 4).

    Point k of n is the pair (k/n, (n-k)/n), each correctly rounded: the grid hits 0 and 1
    exactly and is its own mirror image, bit for bit.
    """
    t = np.arange(level + 1) / level
    u, v = np.meshgrid(np.arange(level + 1), np.arange(level + 1), indexing="ij")
    return np.stack([t[u], t[level - u], t[v], t[level - v]], -1).reshape(-1, 4)


def evaluate(net: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """Homogeneous points sum_ij c_ij B_i(u) B_j(v) of a net (..., m, n, 4).

    u and v have one shape (k...); the result has shape (..., k..., 4).
    """
    row, column = bernstein(net.shape[-3] - 1, u), bernstein(net.shape[-2] - 1, v)
    return _combine(net, row, column)


def evaluate_derivatives(net: Array, u: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
    """Homogeneous partial derivatives (d/du, d/dv), each shaped like `evaluate`'s result."""
    m, n = net.shape[-3] - 1, net.shape[-2] - 1
    along_u = _combine(net, bernstein_derivative(m, u), bernstein(n, v))
    along_v = _combine(net, bernstein(m, u), bernstein_derivative(n, v))
    return along_u, along_v


def _combine(net: Array, row: Array, column: Array) -> Array:
    shape = row.shape[:-1]
    row, column = row.reshape(-1, row.shape[-1]), column.reshape(-1, column.shape[-1])
    points = np.einsum("ki,kj,...ijc->...kc", row, column, net, optimize=True)
    return np.asarray(points.reshape(*net.shape[:-3], *shape, 4))


def project(points: Array) -> Array:
    """(x, y, z) of homogeneous points (..., 4)."""
    return np.asarray(points[..., :3] / points[..., 3:])


def sample_surface(nets: Array) -> Array:
    """Points (k, 3) of a net or of many, on grids dense enough to frame the surface by."""
    count = nets.shape[0] if nets.ndim == 4 else 1
    level = int(np.clip(np.sqrt(SAMPLES / count) - 1, 2, FINEST))
    t = np.linspace(0.0, 1.0, level + 1)
    return project(evaluate(nets, *np.meshgrid(t, t, indexing="ij"))).reshape(-1, 3)


def jacobian_determinant(net: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """det d(x,y)/d(u,v) of a polynomial map into the plane (all weights 1)."""
    along_u, along_v = evaluate_derivatives(net, u, v)
    return np.asarray(along_u[..., 0] * along_v[..., 1] - along_u[..., 1] * along_v[..., 0])
