"""Catmull-Clark near a vertex: eigenvalues, limit points, the characteristic map."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate, jacobian_determinant, project
from reparam.geometry.patch_joins import joins
from reparam.geometry.subdivision import (
    characteristic_points,
    count,
    matrix,
    parameters,
    point,
    ring,
    rings,
    star,
    subdominant,
)

VALENCES = range(3, 13)
GRID = np.meshgrid(np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 9), indexing="ij")


@pytest.mark.parametrize("n", VALENCES)
def test_eigenvalues(n: int) -> None:
    assert matrix(n).sum(1) == pytest.approx(1.0)
    values = np.sort(np.linalg.eigvals(matrix(n)).real)[::-1]
    assert values[0] == pytest.approx(1.0)
    assert values[1:3] == pytest.approx(subdominant(n), abs=1e-12)
    assert values[3] < subdominant(n) - 1e-3


@pytest.mark.parametrize("n", [3, 5, 8])
def test_limit_point(n: int) -> None:
    points = np.random.default_rng(n).normal(size=(count(n), 3))
    edges = sum(points[point(n, k, 1, 0)] for k in range(n))
    faces = sum(points[point(n, k, 1, 1)] for k in range(n))
    limit = (n * n * points[0] + 4 * edges + faces) / (n * (n + 5))
    for _ in range(80):
        points = matrix(n) @ points
    assert points[0] == pytest.approx(limit, abs=1e-12)


@pytest.mark.parametrize("n", VALENCES)
def test_the_characteristic_map(n: int) -> None:
    chi = characteristic_points(n)
    assert matrix(n) @ chi == pytest.approx(subdominant(n) * chi, abs=1e-12)
    turn = 2.0 * np.pi / n
    for k in range(n):
        expected = [np.cos(k * turn), np.sin(k * turn)]
        assert chi[point(n, k, 1, 0)] == pytest.approx(expected, abs=1e-12)
    first = ring(n, chi)
    assert jacobian_determinant(first, *GRID).min() > 0.1
    report = joins(first)
    assert len(report.patches) == 3 * n
    assert report.orders.min() == 3
    assert report.gaps.max() <= 1e-15


def test_valence_four_is_the_plane_itself() -> None:
    chi = characteristic_points(4)
    assert chi[point(4, 0, 3, 2)] == pytest.approx([3.0, 2.0])
    first = project(evaluate(ring(4, chi)[:3], *GRID))[..., :2]
    assert first == pytest.approx(project(evaluate(parameters(4)[:3], *GRID))[..., :2])


@pytest.mark.parametrize("n", [3, 7])
def test_each_ring_fits_into_the_one_before(n: int) -> None:
    both = rings(ring(n, characteristic_points(n)), subdominant(n), 2)
    outer, inner = project(evaluate(both, *GRID))[: 3 * n], project(evaluate(both, *GRID))[3 * n :]
    # the outer edge u = 2 of cells (1, 0), (1, 1) inside is the inner edge u = 1 of cell (1, 0)
    fine = np.concatenate([inner[0, -1], inner[1, -1, 1:]])
    assert fine[::2] == pytest.approx(outer[0, 0], abs=1e-14)


def test_the_star_is_a_mesh() -> None:
    found = star(5)
    assert found.topology.valence[0] == 5
    assert len(found.topology.sizes) == 45
    assert found.topology.euler_characteristic() == 1
