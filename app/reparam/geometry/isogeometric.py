"""Poisson's problem on a curved domain, in the functions that parameterise it (isogeometric).

On Omega = r([0,1]^2) find p with -Laplace p = f inside and p = g on the boundary. The unknown is a
tensor-product spline on the square, carried to Omega by r: with J = (r_u r_v)

      grad p . grad q dx dy  =  (p_u p_v) G (q_u q_v)^T du dv,   G = det J (J^T J)^-1,

so nothing but r's derivatives is needed, at Gauss points that never touch the corners, where
det J may be 0. The coordinate functions x and y are among the unknowns if the degree is r's.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .bernstein import bernstein, bernstein_derivative
from .evaluate import evaluate, evaluate_derivatives
from .extraction import extraction, surface_to_bezier
from .net import Array

Function = Callable[[Array, Array], Array]

MOST_SPANS = 64  # in each direction: dense matrices of their fourth power


def spline_knots(degree: int, spans: int) -> Array:
    """Uniform knots on [0, 1], clamped."""
    inner = np.arange(1, spans) / spans
    return np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])


@dataclass(frozen=True, eq=False)
class Basis:
    """Splines of one direction at the Gauss points of their spans.

    Span s bears the splines s to s + degree: `values`, `slopes` (s, q, degree + 1) are theirs;
    `points`, `weights` (s, q) those of the quadrature.
    """

    degree: int
    spans: int

    @cached_property
    def points(self) -> Array:
        """Gauss points in [0, 1]."""
        nodes = np.polynomial.legendre.leggauss(self.degree + 2)[0]
        return (np.arange(self.spans)[:, None] + (nodes + 1.0) / 2.0) / self.spans

    @cached_property
    def weights(self) -> Array:
        """Their weights, which sum to 1."""
        weights = np.polynomial.legendre.leggauss(self.degree + 2)[1]
        return np.tile(weights / 2.0 / self.spans, (self.spans, 1))

    @cached_property
    def _matrices(self) -> Array:
        return extraction(spline_knots(self.degree, self.spans), self.degree + 1).matrices

    @cached_property
    def values(self) -> Array:
        """Of the splines on each span."""
        local = self.points * self.spans - np.arange(self.spans)[:, None]
        return np.asarray(bernstein(self.degree, local) @ self._matrices)

    @cached_property
    def slopes(self) -> Array:
        """Their derivatives."""
        local = self.points * self.spans - np.arange(self.spans)[:, None]
        return np.asarray(self.spans * bernstein_derivative(self.degree, local) @ self._matrices)

    @property
    def count(self) -> int:
        """How many splines there are."""
        return self.spans + self.degree

    def on_all(self, local: Array) -> Array:
        """(s q, count) from values or slopes of the splines on each span."""
        whole = np.zeros((self.spans, local.shape[1], self.count))
        for s in range(self.spans):
            whole[s, :, s : s + self.degree + 1] = local[s]
        return whole.reshape(-1, self.count)


@dataclass(frozen=True, eq=False)
class Solution:
    """The spline's coefficients (count, count), first index u."""

    net: Array
    basis: Basis
    coefficients: Array

    def pieces(self) -> tuple[Array, Array]:
        """r and p over each pair of spans: nets (P, 3, 3, 4) and (P, degree+1, degree+1)."""
        order, cuts = self.basis.degree + 1, np.arange(1, self.basis.spans) / self.basis.spans
        knots = spline_knots(self.basis.degree, self.basis.spans)
        field = surface_to_bezier((knots, knots), self.coefficients[..., None], (order, order))
        orders = self.net.shape[0], self.net.shape[1]
        ends = tuple(np.repeat([0.0, 1.0], k) for k in orders)
        domain = surface_to_bezier((ends[0], ends[1]), self.net, orders, (cuts, cuts))
        return domain.patches(), field.patches()[..., 0]

    def at(self, u: float, v: float) -> float:
        """The value at one parameter."""
        n = self.basis.spans
        s, t = (min(int(x * n), n - 1) for x in (u, v))
        field = self.pieces()[1].reshape(n, n, self.basis.degree + 1, -1)[s, t]
        row, column = (bernstein(self.basis.degree, x * n - k) for x, k in ((u, s), (v, t)))
        return float(row @ field @ column)

    def errors(
        self, exact: Function, gradient: Callable[[Array, Array], tuple[Array, Array]]
    ) -> tuple[float, float]:
        """The L2 norms of p - exact and of the gradient's error."""
        b = self.basis
        B, D = b.on_all(b.values), b.on_all(b.slopes)
        points, r_u, r_v, det = _geometry(self.net, b)
        p, p_u, p_v = (
            row @ self.coefficients @ column.T for row, column in ((B, B), (D, B), (B, D))
        )
        p_x = (p_u * r_v[..., 1] - p_v * r_u[..., 1]) / det
        p_y = (p_v * r_u[..., 0] - p_u * r_v[..., 0]) / det
        weight = np.outer(b.weights, b.weights) * det
        x, y = points[..., 0], points[..., 1]
        g_x, g_y = gradient(x, y)
        square = (p - exact(x, y)) ** 2
        slope = (p_x - g_x) ** 2 + (p_y - g_y) ** 2
        return float((square * weight).sum() ** 0.5), float((slope * weight).sum() ** 0.5)


def _geometry(net: Array, basis: Basis) -> tuple[Array, Array, Array, Array]:
    """r, r_u, r_v (Q, Q, 2) and det J (Q, Q) at all Gauss points."""
    t = basis.points.ravel()
    u, v = np.meshgrid(t, t, indexing="ij")
    points = evaluate(net, u, v)[..., :2]
    r_u, r_v = (derivative[..., :2] for derivative in evaluate_derivatives(net, u, v))
    return points, r_u, r_v, r_u[..., 0] * r_v[..., 1] - r_u[..., 1] * r_v[..., 0]


def solve(net: Array, degree: int, spans: int, source: Function, boundary: Function) -> Solution:
    """-Laplace p = source on the image of a polynomial map (m, n, 4), p = boundary on its rim.

    Raises ValueError where det J is not positive at a Gauss point, or for too many spans.
    """
    if not 1 <= spans <= MOST_SPANS:
        raise ValueError(f"spans: expected 1 to {MOST_SPANS}, found {spans}")
    basis = Basis(degree, spans)
    points, r_u, r_v, det = _geometry(net, basis)
    if det.min() <= 0.0:
        raise ValueError(f"expected a map with det J > 0, found {det.min():.3g}: it folds")
    matrix = _stiffness(basis, r_u, r_v, det)
    weight = np.outer(basis.weights, basis.weights) * det
    B = basis.on_all(basis.values)
    load = B.T @ (source(points[..., 0], points[..., 1]) * weight) @ B
    values = _on_rim(net, basis, boundary)
    free = np.flatnonzero(np.isnan(values.ravel()))
    fixed = np.flatnonzero(~np.isnan(values.ravel()))
    solution = values.ravel().copy()
    right = load.ravel()[free] - matrix[np.ix_(free, fixed)] @ solution[fixed]
    solution[free] = np.linalg.solve(matrix[np.ix_(free, free)], right)
    return Solution(net, basis, solution.reshape(basis.count, basis.count))


def _stiffness(basis: Basis, r_u: Array, r_v: Array, det: Array) -> Array:
    """(count^2, count^2): the integrals of G over all pairs of splines, span by span."""
    s, q = basis.points.shape
    weight = np.outer(basis.weights, basis.weights) / det

    def span_wise(values: Array) -> Array:
        return (values * weight).reshape(s, q, s, q)

    uu, vv = span_wise((r_v**2).sum(-1)), span_wise((r_u**2).sum(-1))
    uv = span_wise(-(r_u * r_v).sum(-1))
    N, D = basis.values, basis.slopes
    pairs = {
        name: np.einsum("sqi,sqa->sqia", f, g)
        for name, f, g in (("NN", N, N), ("DD", D, D), ("DN", D, N), ("ND", N, D))
    }
    local = sum(
        np.einsum("sptr,spia,trjb->stijab", factor, pairs[along], pairs[across], optimize=True)
        for factor, along, across in (
            (uu, "DD", "NN"), (vv, "NN", "DD"), (uv, "DN", "ND"), (uv, "ND", "DN"),
        )
    )  # fmt: skip
    k, m = basis.degree + 1, basis.count
    index = np.arange(s)[:, None] + np.arange(k)
    number = index[:, None, :, None] * m + index[None, :, None, :]  # (s, t, i, j)
    rows = np.broadcast_to(number[..., None, None], (s, s, k, k, k, k))
    columns = np.broadcast_to(number[:, :, None, None], (s, s, k, k, k, k))
    sums = np.bincount((rows * m * m + columns).ravel(), np.ravel(local), m**4).astype(np.float64)
    return np.asarray(sums.reshape(m * m, m * m))


def _on_rim(net: Array, basis: Basis, boundary: Function) -> Array:
    """Coefficients (count, count): those of the rim by projection along each edge, NaN inside."""
    B, t = basis.on_all(basis.values), basis.points.ravel()
    mass = B.T @ (basis.weights.ravel()[:, None] * B)
    zero, one = np.zeros_like(t), np.ones_like(t)
    values = np.full((basis.count, basis.count), np.nan)
    edges: list[tuple[ArrayLike, ArrayLike, Array]] = [
        (zero, t, values[0]), (one, t, values[-1]),
        (t, zero, values[:, 0]), (t, one, values[:, -1]),
    ]  # fmt: skip
    for u, v, row in edges:
        x, y = np.moveaxis(evaluate(net, u, v)[..., :2], -1, 0)
        row[:] = np.linalg.solve(mass, B.T @ (basis.weights.ravel() * boundary(x, y)))
    return values
