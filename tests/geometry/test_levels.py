"""The bound that levels come from: no triangle is off by more than the tolerance."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate
from reparam.geometry.levels import (
    STEPS,
    balance,
    edge_levels,
    edge_numbers,
    grid_levels,
    level_coefficients,
    out_of_view,
    pixels_a_unit,
    second_derivatives,
)
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.planar_maps import R

HALF = np.array([256.0, 200.0])
TOLERANCE = 0.5
CLOSE = np.linspace(0.0, 1.0, 6)  # where in a cell the triangles are looked at


def random_net(random: np.random.Generator, rational: bool) -> Array:
    m, n = random.integers(2, 6, 2)
    net = np.ones((m, n, 4))
    net[..., :3] = random.uniform(-1.0, 1.0, (m, n, 3))
    return net * (10.0 ** random.uniform(-0.5, 0.5, (m, n, 1)) if rational else 1.0)


def worst(net: Array, nu: int, nv: int) -> float:
    """Pixels between triangles and surface at the same parameter, where either is in view."""
    i, j = np.meshgrid(np.arange(nu), np.arange(nv), indexing="ij")
    a, b, c, d = (
        evaluate(net, (i + x) / nu, (j + y) / nv) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))
    )
    found = 0.0
    for x, y in np.stack(np.meshgrid(CLOSE, CLOSE), -1).reshape(-1, 2):
        low = (1 - x) * a + (x - y) * b + y * c
        drawn = low if x >= y else (1 - y) * a + x * c + (y - x) * d
        exact = evaluate(net, (i + x) / nu, (j + y) / nv)
        drawn, exact = drawn[..., :2] / drawn[..., 3:], exact[..., :2] / exact[..., 3:]
        seen = (np.abs(drawn) <= 1).all(-1) | (np.abs(exact) <= 1).all(-1)
        off = np.linalg.norm((drawn - exact) * HALF, axis=-1)
        found = max(found, off[seen].max(initial=0.0))
    return found


@pytest.mark.parametrize("rational", [False, True])
def test_no_triangle_is_off_by_more(rational: bool) -> None:
    random, ratios = np.random.default_rng(1), []
    for _ in range(12):
        net = random_net(random, rational)
        nu, nv = balance(level_coefficients(net, (256.0, 200.0), 4.0))
        ratios.append(worst(net, int(nu), int(nv)) / 4.0)
    assert max(ratios) <= 1.0
    assert max(ratios) > (0.3 if rational else 0.6)  # and it is not idle either


def test_a_parabola_gets_what_it_needs() -> None:
    """z = 0, y = h (1 - (2u - 1)^2): n steps are off by h / n^2, and v needs one alone."""
    h = 0.5
    net = control_net([[(-1, 0), (-1, 0)], [(0, 2 * h), (0, 2 * h)], [(1, 0), (1, 0)]])
    nu, nv = balance(level_coefficients(net, (256.0, 200.0), TOLERANCE))
    assert (nu, nv) == (np.ceil(np.sqrt(200 * h / TOLERANCE)), 1)


def test_flat_patches_need_one_step() -> None:
    flat = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
    need = level_coefficients(raise_degree(flat, 3, 4), (256.0, 200.0), TOLERANCE)
    assert need == pytest.approx(0.0, abs=1e-12)
    assert balance(need).tolist() == [1, 1]
    assert balance(np.zeros(3)).tolist() == [1, 1]


def test_second_derivatives_of_r() -> None:
    """By U = 2u - 1: x_uu = -4 V, which goes from 4 to -4; x_uv = -4 U; y likewise."""
    uu, uv, vv = second_derivatives(R)
    assert uu[0, :, 0].tolist() == [4.0, 0.0, -4.0]
    assert (uu[..., 1:] == 0.0).all()
    assert vv[:, 0, 1].tolist() == [-4.0, 0.0, 4.0]
    assert np.abs(uv[..., :2]).max() == 4.0


def test_needs_are_met_and_tight() -> None:
    random = np.random.default_rng(2)
    need = 10.0 ** random.uniform(-4, 4, (2000, 3)) * (random.uniform(size=(2000, 3)) > 0.2)
    steps = balance(need)
    a, b, c = need.T
    nu, nv = steps.T
    assert (a / nu**2 + 2 * b / (nu * nv) + c / nv**2 <= 1.0 + 1e-12).all()
    best = [
        min(n * np.ceil(_least(*row, n)) for n in range(1, 400) if row[0] / n**2 < 1.0)
        for row in need[(need < 100.0).all(-1)][:200]
    ]
    ours = steps[(need < 100.0).all(-1)][:200].prod(-1)
    assert np.median(ours / best) < 1.2
    assert (ours / best).max() < 2.5


def _least(a: float, b: float, c: float, nu: int) -> float:
    """The smallest nv with a/nu^2 + 2b/(nu nv) + c/nv^2 <= 1."""
    room, half = 1.0 - a / nu**2, b / nu
    return max(1.0, (half + np.sqrt(half * half + c * room)) / room)


def test_without_positive_weights_the_finest() -> None:
    net = R.copy()
    net[1, 1, 3] = 0.0
    assert (balance(level_coefficients(net, (256.0, 200.0), 0.5)) == 4096).all()


def test_out_of_view_is_told_by_the_hull() -> None:
    offsets = np.array([[0, 0, 0, 0], [3.1, 0, 0, 0], [0, -3.1, 0, 0]])
    assert out_of_view(R + offsets[:, None, None, :]).tolist() == [False, True, True]
    assert not out_of_view(R * [1, 1, 1, -1.0])
    across = control_net([[(-9, 9), (9, 9)], [(-9, -9), (9, -9)]])
    assert not out_of_view(across)


def test_pixels_a_unit() -> None:
    square = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
    assert pixels_a_unit(square, square, (256.0, 200.0)) == pytest.approx(256.0)
    finer = square * [4.0, 4.0, 1.0, 1.0]
    assert pixels_a_unit(square, finer, (256.0, 200.0)) == pytest.approx(64.0)
    point = control_net([[(0, 0), (0, 0)], [(0, 0), (0, 0)]])
    assert pixels_a_unit(square, point, (256.0, 200.0)) == 0.0


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
    assert numbers.tolist() == [[0, 1, 0, 1]] * 3


def test_an_edge_takes_the_finest_of_both_sides() -> None:
    levels = np.array([[4, 9], [7, 5], [0, 0]])
    numbers = np.array([[0, 1, 2, 3], [2, 4, 5, 6], [7, 8, 9, 7]], np.int32)
    expected = [[9, 4, 9, 4], [9, 7, 5, 7], [1, 1, 1, 1]]
    assert edge_levels(levels, numbers).tolist() == expected


def test_grids_snap_without_spanning_more_than_a_step() -> None:
    random = np.random.default_rng(4)
    levels = random.integers(1, 300, (3000, 2))
    asked = np.maximum(random.integers(1, 500, (3000, 4)), levels[:, [1, 0, 1, 0]])
    fine, edges = grid_levels(levels, asked)
    assert np.isin(fine, STEPS).all()
    assert (edges >= asked).all()
    assert (edges <= 1.5 * asked).all()
    assert (fine >= levels).all()
    for edge, axis in enumerate((1, 0, 1, 0)):
        e, n = edges[:, edge], fine[:, axis]
        span = np.where(e == n, 1.0 / n, 0.5 / e + 1.0 / n)
        assert (span <= 1.0 / levels[:, axis] + 1e-12).all()
        assert (n >= e).all()
