"""Pythagorean hodographs: closed-form length, Hermite interpolation, and what averaging breaks."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reparam.geometry.bernstein import bernstein, bernstein_derivative
from reparam.geometry.pythagorean import (
    PythagoreanCurve,
    exact_points,
    hermite,
    hermite_solutions,
    is_pythagorean,
    multiplicities,
    squared_speed,
)

random = np.random.default_rng(1)
W1, W2 = [(1, 3), (3, 2)], [(2, 1), (1, 2)]  # (1 + 2u) + (3 - u) i and (2 - u) + (1 + u) i


def quadrature(curve: PythagoreanCurve, end: float = 1.0) -> float:
    """The length from 0 to `end` by Gauss-Legendre from the control points."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    edges = np.linspace(0.0, end, 33)
    middle, half = (edges[1:] + edges[:-1]) / 2, end / 64
    t = middle[:, None] + half * nodes
    slope = bernstein_derivative(len(curve.points) - 1, t) @ curve.points
    return float((np.hypot(slope[..., 0], slope[..., 1]) @ weights).sum() * half)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_length_in_closed_form(degree: int) -> None:
    curve = PythagoreanCurve(random.normal(size=(degree + 1, 2)) @ [1, 1j], 2 - 1j)
    assert curve.points.shape == (2 * degree + 2, 2)
    assert curve.points[0].tolist() == [2.0, -1.0]
    assert curve.length == pytest.approx(quadrature(curve), rel=1e-14)
    assert curve.arc_length(0.3) == pytest.approx(quadrature(curve, 0.3), rel=1e-14)
    assert curve.arc_length([0.0, 1.0]) == pytest.approx([0.0, curve.length], rel=1e-15)
    t = np.linspace(0.0, 1.0, 50)
    slope = bernstein_derivative(2 * degree + 1, t) @ curve.points
    np.testing.assert_allclose(
        np.hypot(*slope.T), bernstein(2 * degree, t) @ curve.speed, atol=1e-13
    )


def test_hermite_interpolates_and_bends_least() -> None:
    ends = (0.0, 1 + 0.3j, 1 + 2j, 1.5 - 0.5j)
    solutions = list(hermite_solutions(*ends))
    assert len({round(curve.bending(), 6) for curve in solutions}) == 4
    assert len({round(curve.length, 9) for curve in solutions}) == 2  # w_1 = -3/4 (..) +- root
    for curve in solutions:
        first, last = 5 * np.diff(curve.points, axis=0)[[0, -1]]
        assert first == pytest.approx([1, 2], abs=1e-13)
        assert last == pytest.approx([1.5, -0.5], abs=1e-13)
        assert curve.points[-1] == pytest.approx([1, 0.3], abs=1e-13)
    chosen = hermite(*ends)
    assert chosen.bending() == min(curve.bending() for curve in solutions)
    assert hermite(0, 1, 1, 1).points[:, 1] == pytest.approx([0.0] * 6, abs=1e-15)
    with pytest.raises(ValueError, match="end derivatives other than 0, found 0 and 1"):
        hermite(0, 1, 0, 1)


def test_bending_of_a_known_curve() -> None:
    """w = 1 + i u: x = u - u^3/3, y = u^2: curvature 2/(1+u^2)^2 and speed 1 + u^2."""
    curve = PythagoreanCurve(np.array([1.0, 1.0 + 1.0j]))
    nodes, weights = np.polynomial.legendre.leggauss(200)
    u = (nodes + 1) / 2
    assert curve.bending() == pytest.approx(float(weights / 2 @ (4 / (1 + u * u) ** 3)), rel=1e-13)
    assert curve.length == pytest.approx(4 / 3, rel=1e-15)
    assert PythagoreanCurve(np.array([1.0, -1.0 + 0j])).bending() == np.inf


def test_the_average_is_not_pythagorean() -> None:
    """5 (u^2 - 4u + 5) (9u^2 + 12u + 5) / 4: square-free, so no square of a polynomial."""
    first, second = exact_points(W1), exact_points(W2)
    assert is_pythagorean(first)
    assert is_pythagorean(second)
    assert squared_speed(first) == [100, -40, 104, -20, 25]  # (5u^2 - 2u + 10)^2
    average = [
        [(a + b) / 2 for a, b in zip(p, q, strict=True)] for p, q in zip(first, second, strict=True)
    ]
    quarter = Fraction(5, 4)
    product = [25, 60 - 20, 45 - 48 + 5, 12 - 36, 9]
    assert squared_speed(average) == [quarter * x for x in product]
    assert multiplicities(squared_speed(average)) == [4]
    assert not is_pythagorean(average)


def test_exact_points_are_those_of_the_floats() -> None:
    preimage = [(1, 3), (3, 2), (-1, 4)]
    floats = PythagoreanCurve(np.array([1 + 3j, 3 + 2j, -1 + 4j])).points
    np.testing.assert_allclose(np.array(exact_points(preimage), float), floats, atol=1e-14)
    assert is_pythagorean(exact_points(preimage))


def test_multiplicities() -> None:
    """(u - 1) (u^2 + 1)^2 u^3, and a line run through as u^3."""
    p = [Fraction(1)]
    for factor in ([-1, 1], [1, 0, 1], [1, 0, 1], [0, 1], [0, 1], [0, 1]):
        p = [
            sum(
                (p[i] * factor[k - i] for i in range(len(p)) if 0 <= k - i < len(factor)),
                Fraction(0),
            )
            for k in range(len(p) + len(factor) - 1)
        ]
    assert multiplicities(p) == [1, 2, 1]
    assert is_pythagorean([[0, 0], [0, 0], [0, 0], [3, 4]])
    assert not is_pythagorean([[0, 0], [1, 1], [2, 0]])
    with pytest.raises(ValueError, match="other than 0"):
        multiplicities([])
