"""r of equation (13), its determinant, area and perimeter; the morph that must not fold."""

from __future__ import annotations

from math import log, sqrt

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate, jacobian_determinant
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.planar_maps import (
    ALIGNED_IDENTITY,
    R,
    area,
    determinant_coefficients,
    morph,
    perimeter,
)

T = np.linspace(0.0, 1.0, 41)
u, v = np.meshgrid(T, T, indexing="ij")
U, V = 2.0 * u - 1.0, 2.0 * v - 1.0
REFLECTED = ALIGNED_IDENTITY[::-1]  # (V, U): the first row taken for the bottom one


def determinant(net: Array) -> Array:
    return jacobian_determinant(net, u, v)


def test_r_is_equation_13() -> None:
    x, y, z, w = np.moveaxis(evaluate(R, u, v), -1, 0)
    np.testing.assert_allclose(x, V * (3.0 - U**2) / 2.0, atol=1e-15)
    np.testing.assert_allclose(y, -U * (3.0 - V**2) / 2.0, atol=1e-15)
    assert (z == 0.0).all()
    np.testing.assert_allclose(w, 1.0, rtol=1e-15)


def test_first_row_is_at_the_top() -> None:
    assert R[0, :, :2].tolist() == [[-1, 1], [0, 2], [1, 1]]
    assert evaluate(R, 0.0, 0.5)[:2].tolist() == [0.0, 1.5]
    assert evaluate(R, 0.5, 1.0)[:2].tolist() == [1.5, 0.0]


def test_aligned_identity() -> None:
    x, y, _, _ = np.moveaxis(evaluate(ALIGNED_IDENTITY, u, v), -1, 0)
    np.testing.assert_allclose(x, V, atol=1e-15)
    np.testing.assert_allclose(y, -U, atol=1e-15)
    np.testing.assert_allclose(determinant(ALIGNED_IDENTITY), 4.0, rtol=1e-15)


def test_determinant_of_r() -> None:
    expected = 4.0 * 0.75 * (3.0 - U**2 - V**2 - U**2 * V**2)
    np.testing.assert_allclose(determinant(R), expected, atol=1e-14)
    assert expected[20, 20] == 9.0
    assert (determinant(R)[[0, 0, -1, -1], [0, -1, 0, -1]] == 0.0).all()


def test_area_and_perimeter_of_r() -> None:
    assert area(R) == pytest.approx(20 / 3, abs=1e-14)
    assert perimeter(R) == pytest.approx(4 * sqrt(2) + 4 * log(1 + sqrt(2)), abs=1e-13)
    assert perimeter(R) == pytest.approx(9.18234860, abs=5e-9)


def test_area_and_perimeter_of_others() -> None:
    assert area(ALIGNED_IDENTITY) == pytest.approx(4.0)
    assert perimeter(ALIGNED_IDENTITY) == pytest.approx(8.0)
    slanted = control_net([[(0, 0), (3, 4)], [(5, 0), (8, 4)]])
    assert area(slanted) == pytest.approx(20.0)
    assert perimeter(slanted) == pytest.approx(20.0)
    assert area(slanted[::-1]) == pytest.approx(-20.0)
    lopsided = control_net([[(0, 0), (0, 1)], [(4, 0), (4, 4)]])
    assert area(lopsided) == pytest.approx(10.0)
    assert perimeter(lopsided) == pytest.approx(1.0 + 5.0 + 4.0 + 4.0)


@pytest.mark.parametrize("weight", [0.0, 0.25, 0.5, 0.75, 0.99, 1.0])
def test_morph_is_affine_in_its_weight(weight: float) -> None:
    net = morph(R, weight)
    assert net.shape == (3, 3, 4)
    expected = (1.0 - weight) * evaluate(ALIGNED_IDENTITY, u, v) + weight * evaluate(R, u, v)
    np.testing.assert_allclose(evaluate(net, u, v), expected, atol=1e-15)


def test_morph_of_other_degrees() -> None:
    assert morph(control_net([[(2, 1)]]), 0.5).shape == (2, 2, 4)
    assert morph(raise_degree(R, 4, 2), 0.3).shape == (5, 3, 4)
    assert (morph(R, 1.0) == R).all()


@pytest.mark.parametrize("net", [R, morph(R, 0.4), ALIGNED_IDENTITY, raise_degree(R, 4, 3)])
def test_determinant_coefficients_are_those_of_the_determinant(net: Array) -> None:
    coefficients = determinant_coefficients(net)
    assert coefficients.shape == (2 * net.shape[0] - 2, 2 * net.shape[1] - 2)
    as_net = np.zeros((*coefficients.shape, 4))
    as_net[..., 0] = coefficients
    np.testing.assert_allclose(evaluate(as_net, u, v)[..., 0], determinant(net), atol=1e-11)


@pytest.mark.parametrize("weight", [0.0, 0.25, 0.5, 0.75, 0.9, 0.99])
def test_nothing_folds_before_r_is_reached(weight: float) -> None:
    coefficients = determinant_coefficients(morph(R, weight))
    assert coefficients.min() == pytest.approx(4.0 * (1.0 - weight**2), abs=1e-12)
    assert determinant(morph(R, weight)).min() > 0.0


def test_only_the_corners_of_r_are_singular() -> None:
    coefficients = determinant_coefficients(R)
    corners = np.zeros((4, 4), dtype=bool)
    corners[[0, 0, -1, -1], [0, -1, 0, -1]] = True
    assert np.abs(coefficients[corners]).max() < 1e-12
    assert coefficients[~corners].min() > 1.0


@pytest.mark.parametrize("weight", [0.0, 0.25, 0.5, 0.75, 0.99])
def test_morph_from_a_reflected_identity_is_seen_to_fold(weight: float) -> None:
    folding = (1.0 - weight) * raise_degree(REFLECTED, 2, 2) + weight * R
    least = -4.0 * (1.0 - weight) ** 2
    assert determinant_coefficients(folding).min() == pytest.approx(least, abs=1e-12)
    assert determinant(folding).min() == pytest.approx(least, abs=1e-12)
