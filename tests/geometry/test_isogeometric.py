"""Poisson on curved domains: exact where it can be, optimal rates, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.isogeometric import Basis, solve
from reparam.geometry.net import Array, control_net
from reparam.geometry.planar_maps import R

SQUARE = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
GRID = np.meshgrid(np.linspace(0.0, 1.0, 4), np.linspace(0.0, 1.0, 4), indexing="ij")


def one(x: Array, y: Array) -> Array:
    return 1.0 + 0.0 * x * y


def zero(x: Array, y: Array) -> Array:
    return 0.0 * x * y


@pytest.mark.parametrize("degree", [1, 2, 4])
def test_the_basis_is_a_partition_of_unity(degree: int) -> None:
    basis = Basis(degree, 5)
    assert basis.values.sum(-1) == pytest.approx(1.0)
    assert basis.slopes.sum(-1) == pytest.approx(0.0, abs=1e-12)
    assert basis.weights.sum() == pytest.approx(1.0)
    whole = basis.on_all(basis.values)
    assert whole.shape == (5 * (degree + 2), 5 + degree)
    area = basis.weights.ravel() @ whole
    assert area[0] == pytest.approx(1 / 5 / (degree + 1))


@pytest.mark.parametrize(("degree", "works"), [(1, False), (2, True), (3, True)])
def test_linear_functions_are_among_the_splines_of_rs_degree(degree: int, works: bool) -> None:
    found = solve(R, degree, 4, zero, lambda x, y: 2.0 * x - 3.0 * y + 1.0)
    value, slope = found.errors(
        lambda x, y: 2.0 * x - 3.0 * y + 1.0, lambda x, y: (2.0 + 0.0 * x, -3.0 + 0.0 * y)
    )
    assert (value < 1e-13) == works
    assert (slope < 1e-12) == works


def test_rates() -> None:
    errors = []
    for spans in (8, 16):
        found = solve(
            R, 2, spans, lambda x, y: 3.0 * np.cos(2.0 * x) * np.exp(y),
            lambda x, y: np.cos(2.0 * x) * np.exp(y) + x * y,
        )  # fmt: skip
        errors.append(
            found.errors(
                lambda x, y: np.cos(2.0 * x) * np.exp(y) + x * y,
                lambda x, y: (
                    -2.0 * np.sin(2.0 * x) * np.exp(y) + y,
                    np.cos(2.0 * x) * np.exp(y) + x,
                ),
            )
        )
    rates = np.log2(np.array(errors[0]) / errors[1])
    assert rates == pytest.approx([3.0, 2.0], abs=0.2)


def test_torsion_of_a_square_shaft() -> None:
    found = solve(SQUARE, 3, 12, one, zero)
    assert found.at(0.5, 0.5) == pytest.approx(0.0736713533, abs=2e-6)  # its Fourier series
    assert found.at(0.25, 0.75) == pytest.approx(found.at(0.75, 0.25), abs=1e-14)
    assert solve(R, 2, 16, one, zero).at(0.5, 0.5) == pytest.approx(0.52870, abs=1e-5)


def test_pieces_are_r_and_the_field() -> None:
    found = solve(R, 2, 3, zero, lambda x, y: x + 0.0 * y)
    nets, field = found.pieces()
    assert nets.shape == (9, 3, 3, 4)
    u, v = (GRID[0] + 1) / 3, (GRID[1] + 2) / 3  # span 1 in u, 2 in v
    assert evaluate(nets[5], *GRID) == pytest.approx(evaluate(R, u, v))
    net = np.ones((3, 3, 4))
    net[..., 0] = field[5]
    assert project(evaluate(net, *GRID))[..., 0] == pytest.approx(
        project(evaluate(R, u, v))[..., 0]
    )


def test_what_is_refused() -> None:
    with pytest.raises(ValueError, match=r"expected a map with det J > 0, found -1: it folds"):
        solve(SQUARE[::-1], 1, 2, one, zero)
    for spans in (0, 65):
        with pytest.raises(ValueError, match=f"spans: expected 1 to 64, found {spans}"):
            solve(SQUARE, 1, spans, one, zero)
