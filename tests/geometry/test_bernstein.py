"""The basis against rational numbers, for every degree that a net can have."""

from __future__ import annotations

from fractions import Fraction

import exact
import numpy as np
import pytest

from reparam.geometry.bernstein import bernstein, bernstein_derivative
from reparam.geometry.evaluate import grid_parameters, pair
from reparam.geometry.net import MAX_ORDER

DEGREES = range(MAX_ORDER)
INSIDE = [Fraction(k, 8) for k in range(9)] + [Fraction(1, 3), Fraction(10**6 - 1, 10**6)]
OUTSIDE = [Fraction(-1, 2), Fraction(5, 4), Fraction(-3), Fraction(2)]


def complement(t: list[Fraction]) -> list[float]:
    return [float(1 - x) for x in t]


@pytest.mark.parametrize("degree", DEGREES)
def test_values_inside(degree: int) -> None:
    found = bernstein(degree, [float(t) for t in INSIDE], complement(INSIDE))
    expected = np.array([exact.bernstein(degree, t) for t in INSIDE], float)
    assert found.shape == (len(INSIDE), degree + 1)
    np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-300)


@pytest.mark.parametrize("degree", DEGREES)
def test_values_extrapolate(degree: int) -> None:
    found = bernstein(degree, [float(t) for t in OUTSIDE])
    expected = np.array([exact.bernstein(degree, t) for t in OUTSIDE], float)
    np.testing.assert_allclose(found, expected, rtol=1e-13)


@pytest.mark.parametrize("degree", DEGREES)
def test_derivatives(degree: int) -> None:
    for points in (INSIDE, OUTSIDE):
        found = bernstein_derivative(degree, [float(t) for t in points], complement(points))
        expected = np.array([exact.bernstein_derivative(degree, t) for t in points], float)
        scale = np.abs(expected).max(-1, keepdims=True) + 1e-300
        assert found.shape == (len(points), degree + 1)
        assert (np.abs(found - expected) / scale).max() < 1e-13


@pytest.mark.parametrize("degree", DEGREES)
def test_partition_of_unity(degree: int) -> None:
    t = np.linspace(0.0, 1.0, 33)
    np.testing.assert_allclose(bernstein(degree, t).sum(-1), 1.0, rtol=1e-14)
    np.testing.assert_allclose(bernstein_derivative(degree, t).sum(-1), 0.0, atol=1e-12)


@pytest.mark.parametrize("degree", DEGREES)
@pytest.mark.parametrize("level", [7, 13, 100])
def test_mirror_image_bit_for_bit(degree: int, level: int) -> None:
    t = np.arange(level + 1) / level
    basis = bernstein(degree, t, t[::-1])
    slope = bernstein_derivative(degree, t, t[::-1])
    assert (basis == basis[::-1, ::-1]).all()
    assert (slope == -slope[::-1, ::-1]).all()


@pytest.mark.parametrize("degree", [1, 2, 8, 31])
def test_ends_are_exact(degree: int) -> None:
    basis = bernstein(degree, [0.0, 1.0])
    assert (basis == np.eye(degree + 1)[[0, -1]]).all()


@pytest.mark.parametrize("shape", [(), (3,), (2, 3)])
def test_shape_of_the_parameters_is_kept(shape: tuple[int, ...]) -> None:
    t = np.full(shape, 0.25)
    for values in (bernstein(2, t), bernstein_derivative(2, t)):
        assert values.shape == (*shape, 3)
    assert (bernstein_derivative(0, t) == 0.0).all()
    assert bernstein(2, t).reshape(-1, 3)[0].tolist() == [0.5625, 0.375, 0.0625]


@pytest.mark.parametrize("level", [1, 2, 7, 13, 49, 64])
def test_grid_is_correctly_rounded_and_its_own_mirror_image(level: int) -> None:
    grid = grid_parameters(level).reshape(level + 1, level + 1, 4)
    u, s, v, t = np.moveaxis(grid, -1, 0)
    expected = [float(Fraction(k, level)) for k in range(level + 1)]
    assert u[:, 0].tolist() == expected
    assert v[0].tolist() == expected
    assert (u == u[:, :1]).all()
    assert (v == v[:1]).all()
    assert (s == u[::-1]).all()
    assert (t == v[:, ::-1]).all()


def test_pair() -> None:
    t, s = pair([0.0, 0.25, 1.5])
    assert t.tolist() == [0.0, 0.25, 1.5]
    assert s.tolist() == [1.0, 0.75, -0.5]
