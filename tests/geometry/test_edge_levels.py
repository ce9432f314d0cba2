"""Edges that patches share, and grids that end in them."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.edge_levels import (
    STEPS,
    edge_levels,
    edge_numbers,
    fitted,
    grid_levels,
    in_tiles,
    snapped,
)


@pytest.mark.parametrize("order", [2, 3, 5])
def test_edges_are_numbered_by_their_curve(order: int) -> None:
    random = np.random.default_rng(order)
    nets = random.normal(size=(8, order, order, 4))
    shared = random.normal(size=(order, 4))
    nets[0][0], nets[1][:, 0], nets[2][-1], nets[3][:, -1] = shared, shared, shared[::-1], shared
    numbers = edge_numbers(nets)
    same = numbers[[0, 1, 2, 3], [0, 1, 2, 3]]
    assert len(set(same.tolist())) == 1
    _, times = np.unique(numbers, return_counts=True)
    assert sorted(times.tolist()) == [1] * 28 + [4]


def test_zero_has_one_sign() -> None:
    nets = np.zeros((2, 2, 2, 4))
    nets[..., 3] = 1.0
    nets[1, ..., 0] = -0.0
    assert (edge_numbers(nets) == 0).all()


def test_edges_of_other_orders_in_u_and_v_stay_apart() -> None:
    numbers = edge_numbers(np.zeros((3, 2, 3, 4)))
    assert (numbers[:, [0, 2, 0]] == numbers[0, 0]).all()
    assert (numbers[:, [1, 3, 1]] == numbers[0, 1]).all()
    assert numbers[0, 0] != numbers[0, 1]


@pytest.mark.parametrize("unit", [1.0, 0.5**20, 1e-5])
def test_no_two_of_many_curves_have_one_number(unit: float) -> None:
    """Not those of whole numbers either, of whose bits most are 0."""
    ends = np.stack(np.divmod(np.arange(25.0), 5.0), -1) - 2.0
    first, last = np.divmod(np.arange(25 * 25), 25)
    nets = np.ones((25 * 25, 2, 2, 4))
    nets[:, 0, 0, :2], nets[:, 0, 1, :2] = ends[first] * unit, ends[last] * unit
    assert len(np.unique(edge_numbers(nets)[:, 0])) == 25 * 26 // 2


def test_an_edge_takes_the_finest_of_both_sides() -> None:
    levels = np.array([[4, 9], [7, 5], [0, 0]])
    numbers = np.array([[0, 1, 2, 3], [2, 4, 5, 6], [7, 8, 9, 7]])
    expected = [[9, 4, 9, 4], [9, 7, 5, 7], [1, 1, 1, 1]]
    assert edge_levels(levels, numbers).tolist() == expected


def test_an_edge_fits_the_steps_of_both_sides() -> None:
    """4 and 5 steps meet at 8: n go back by (n - gcd(n, e)) / (n e), no more than half a step."""
    levels = np.array([[4, 4], [4, 5], [3, 100], [3, 101]])
    numbers = np.array([[0, 1, 2, 3], [2, 4, 5, 6], [7, 8, 9, 10], [9, 11, 12, 13]])
    edges = edge_levels(levels, numbers)
    assert edges[:, [0, 2]].tolist() == [[4, 5], [5, 5], [100, 101], [101, 101]]
    found = fitted(levels, edges, numbers)
    assert found[0, 2] == found[1, 0] == 8
    assert found[2, 2] == found[3, 0] == 200 or found[3, 0] % 101 == 0
    assert (found[:, [0, 1, 3]] >= edges[:, [0, 1, 3]]).all()


def test_grids_have_as_many_steps_as_their_edges() -> None:
    levels = np.array([[4, 9], [7, 5]])
    edges = np.array([[9, 4, 10, 3], [5, 8, 5, 7]])
    assert grid_levels(levels, edges).tolist() == [[4, 10], [8, 5]]


@pytest.mark.parametrize("steps", [1, 2, 3, 7, 12, 61])
def test_no_triangle_at_an_edge_spans_more_than_its_step(steps: int) -> None:
    """Diagonals begin on the edge and end inside nearer to the middle."""
    k, half = np.arange(steps + 1), steps // 2
    for edge in range(1, steps + 1):
        found = snapped(k, steps, edge)
        assert found[[0, -1]].tolist() == [0, edge]
        assert set(np.diff(found)) <= {0, 1}
        on_edge, inner, step = found / edge, k / steps, 1.0 / edge + 1e-12
        assert (np.abs(inner - on_edge) < step).all()
        assert (np.abs(inner[1:] - on_edge[:-1])[: steps - half] <= step).all()
        assert (np.abs(on_edge[1:] - inner[:-1])[half:] <= step).all()
    assert (snapped(k, steps, steps) == k).all()


def test_tiles_have_as_many_steps_inside_and_on_edges() -> None:
    levels = np.array([[130, 20], [70, 64], [3, 300]])
    numbers = np.array([[0, 1, 2, 3], [2, 4, 5, 6], [7, 3, 8, 9]])
    edges = edge_levels(levels, numbers)
    inner, outer, tiles = in_tiles(grid_levels(levels, edges), edges, numbers, 64)
    assert tiles.tolist() == [[4, 1], [2, 1], [4, 8]]
    assert (inner >= levels).all()
    assert (outer >= edges).all()
    assert (inner % tiles == 0).all()
    assert (inner // tiles <= 64).all()
    along, cut = inner[:, [1, 0, 1, 0]], tiles[:, [1, 0, 1, 0]]
    assert (outer <= along).all()
    assert (outer % cut == 0).all()
    assert outer[0, 2] == outer[1, 0]
    assert outer[0, 3] == outer[2, 1]


def test_steps_are_few_and_near() -> None:
    assert STEPS[:8].tolist() == [1, 2, 3, 4, 6, 8, 12, 16]
    assert (STEPS[1:] / STEPS[:-1]).max() <= 2.0
