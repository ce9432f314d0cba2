"""The Bernstein basis. Twin: shaders/lib/bernstein.glsl, same names, same recursion."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def bernstein(degree: int, t: ArrayLike, complement: ArrayLike | None = None) -> Array:
    """All B_i^d(t) = C(d,i) t^i (1-t)^(d-i), i = 0..d, as the last axis: shape (..., degree + 1).

    `complement` is 1-t where the caller knows it better than the subtraction does; with it
    reversing an edge swaps two numbers and changes no bit. Any real t: outside [0,1] the
    polynomials are extrapolated, as glEvalCoord does. (The NURBS Book, algorithm A1.3.)
    """
    t = np.asarray(t, dtype=np.float64)
    s = 1.0 - t if complement is None else np.asarray(complement, dtype=np.float64)
    basis = np.zeros((degree + 1, *t.shape))
    basis[0] = 1.0
    for k in range(1, degree + 1):
        carry = np.zeros(t.shape)
        for i in range(k):
            above = basis[i].copy()
            basis[i] = carry + s * above
            carry = t * above
        basis[k] = carry
    return np.moveaxis(basis, 0, -1)


def bernstein_derivative(degree: int, t: ArrayLike, complement: ArrayLike | None = None) -> Array:
    """d/dt B_i^d = d (B_{i-1}^{d-1} - B_i^{d-1}), shape (..., degree + 1); zero for degree 0."""
    t = np.asarray(t, dtype=np.float64)
    if degree == 0:
        return np.zeros((*t.shape, 1))
    lower = bernstein(degree - 1, t, complement)
    edge = np.zeros((*t.shape, 1))
    before, here = np.concatenate([edge, lower], -1), np.concatenate([lower, edge], -1)
    return np.asarray(degree * (before - here))
