"""Roots of polynomials in Bernstein form."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.bernstein import bernstein
from reparam.geometry.net import Array
from reparam.geometry.roots import bernstein_roots, halve, multiply


def from_roots(roots: list[float]) -> Array:
    """Bernstein coefficients of the product of (t - root)."""
    product = np.ones(1)
    for root in roots:
        product = multiply(product, np.array([-root, 1.0 - root]))
    return product


@pytest.mark.parametrize(
    "roots",
    [
        [],
        [0.5],
        [0.25, 0.5, 0.75],
        [0.3, 0.3 + 1e-5],
        [-0.2, 0.4, 1.3],
        [0.0, 0.7, 1.0],
        list(np.linspace(0.05, 0.95, 13)),
    ],
)
def test_simple_roots_are_all_found(roots: list[float]) -> None:
    polynomials = np.stack([from_roots(roots), -3.0 * from_roots(roots)])
    row, found = bernstein_roots(polynomials)
    expected = [root for root in roots if 0.0 < root < 1.0]
    for number in (0, 1):
        np.testing.assert_allclose(found[row == number], expected, atol=1e-9)


def test_many_fold_roots_are_near() -> None:
    _, found = bernstein_roots(from_roots([0.3, 0.3, 0.8, 0.8, 0.8])[None])
    assert len(found) >= 1
    assert (np.minimum(np.abs(found - 0.3), np.abs(found - 0.8)) < 1e-4).all()
    assert np.abs(found - 0.8).min() < 1e-4


def test_random_polynomials_against_eigenvalues() -> None:
    random = np.random.default_rng(1)
    for degree in range(1, 10):
        coefficients = random.normal(size=(40, degree + 1))
        row, found = bernstein_roots(coefficients)
        t = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1)) / 2.0 + 0.5
        for number, coefficient in enumerate(coefficients):
            power = np.polyfit(t, bernstein(degree, t) @ coefficient, degree)
            roots = np.roots(power)
            real = np.sort(roots[np.abs(roots.imag) < 1e-9].real)
            real = real[(real > 0.0) & (real < 1.0)]
            np.testing.assert_allclose(found[row == number], real, atol=1e-6)


def test_products_and_halves() -> None:
    random = np.random.default_rng(2)
    a, b = random.normal(size=(3, 5)), random.normal(size=(3, 3))
    t = np.linspace(0.0, 1.0, 9)
    values = (bernstein(4, t) @ a.T) * (bernstein(2, t) @ b.T)
    np.testing.assert_allclose(bernstein(6, t) @ multiply(a, b).T, values, atol=1e-13)
    left, right = halve(a)
    np.testing.assert_allclose(bernstein(4, t) @ left.T, bernstein(4, t / 2) @ a.T, atol=1e-14)
    np.testing.assert_allclose(
        bernstein(4, t) @ right.T, bernstein(4, (t + 1) / 2) @ a.T, atol=1e-14
    )


def test_nothing_and_zero_have_no_roots() -> None:
    for polynomials in (np.zeros((0, 4)), np.zeros((2, 4)), np.ones((2, 1))):
        row, found = bernstein_roots(polynomials)
        assert len(row) == len(found) == 0
