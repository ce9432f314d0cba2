"""The bound that levels come from: no triangle is off by more than the tolerance."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from reparam.geometry.bends import bends
from reparam.geometry.camera import View, frame
from reparam.geometry.edge_levels import fitted, snapped
from reparam.geometry.evaluate import evaluate, sample_surface
from reparam.geometry.levels import (
    FINEST,
    LEAST_BASE,
    fewest_one_way,
    fewest_steps,
    isosceles,
    out_of_view,
    pixels_a_unit,
    share_used,
)
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.planar_maps import R
from reparam.geometry.stitching import stitched_patch
from reparam.geometry.torus import two_halves

SCALE = (256.0, 200.0)
TOLERANCE = 0.5
INSIDE = 4  # points along each side of a triangle that are looked at, less one


def random_net(random: np.random.Generator, rational: bool) -> Array:
    m, n = random.integers(2, 6, 2)
    net = np.ones((m, n, 4))
    net[..., :3] = random.uniform(-1.0, 1.0, (m, n, 3))
    return net * (10.0 ** random.uniform(-0.5, 0.5, (m, n, 1)) if rational else 1.0)


def seen(net: Array) -> Array:
    """From near by, w up to three times as large behind as in front."""
    camera = frame(sample_surface(net), 512, 400, View(azimuth=20.0, elevation=50.0), True, 60.0)
    return np.asarray(net @ camera.clip_from_model().T)


def triangles(steps: tuple[int, int], edges: tuple[int, int, int, int]) -> Array:
    """The (u, v) of the triangles (k, 3, 2) of a grid that ends in edges of fewer steps."""
    nu, nv = steps
    i, j = np.meshgrid(np.arange(nu + 1), np.arange(nv + 1), indexing="ij")
    u, v = i / nu, j / nv
    v[0], v[-1] = (snapped(j[0], nv, edges[k]) / edges[k] for k in (0, 2))
    u[:, 0], u[:, -1] = (snapped(i[:, 0], nu, edges[k]) / edges[k] for k in (1, 3))
    grid = np.stack([u, v], -1)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    rising = (2 * i[:-1, :-1] + 1 < nu) == (2 * j[:-1, :-1] + 1 < nv)
    one, other = np.stack([a, b, c, a, c, d], -2), np.stack([a, b, d, b, c, d], -2)
    return np.where(rising[..., None, None], one, other).reshape(-1, 3, 2)


def areas(triangles: Array) -> Array:
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return np.asarray(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2.0


def worst(net: Array, triangles: Array) -> float:
    """Pixels between triangles and surface at the same parameter."""
    corners = evaluate(net, triangles[..., 0], triangles[..., 1])
    found = 0.0
    for x, y in product(range(INSIDE + 1), repeat=2):
        if x + y <= INSIDE:
            share = np.array([x, y, INSIDE - x - y]) / INSIDE
            drawn = np.einsum("k,tkc->tc", share, corners)
            at = np.einsum("k,tkc->tc", share, triangles)
            exact = evaluate(net, at[:, 0], at[:, 1])
            off = drawn[:, :2] / drawn[:, 3:] - exact[:, :2] / exact[:, 3:]
            found = max(found, float(np.linalg.norm(off * np.array(SCALE), axis=-1).max()))
    return found


@pytest.mark.parametrize("rational", [False, True])
@pytest.mark.parametrize("perspective", [False, True])
def test_no_triangle_is_off_by_more(rational: bool, perspective: bool) -> None:
    """However its edges are stepped, as long as they are not coarser than the patch asks for."""
    random, ratios = np.random.default_rng(1), []
    for _ in range(9):
        net = random_net(random, rational)
        net = seen(net) if perspective else net
        nu, nv = (int(n) for n in fewest_steps(bends(net, SCALE), 4.0))
        finer = (nu + int(random.integers(0, 4)), nv + int(random.integers(0, 4)))
        u0, u1 = (int(random.integers(nv, finer[1] + 1)) for _ in range(2))
        v0, v1 = (int(random.integers(nu, finer[0] + 1)) for _ in range(2))
        for steps, edges in (((nu, nv), (nv, nu, nv, nu)), (finer, (u0, v0, u1, v1))):
            cells = triangles(steps, edges)
            assert (areas(cells) > -1e-12).all()
            assert areas(cells).sum() == pytest.approx(1.0)
            ratios.append(worst(net, cells[areas(cells) > 1e-12]) / 4.0)
    assert max(ratios) <= 1.0
    assert max(ratios) > 0.4  # and it is not idle either


@pytest.mark.parametrize("rational", [False, True])
def test_no_triangle_cut_one_way_is_off_by_more(rational: bool) -> None:
    """Whatever the steps of its edges are, as long as they are finer and fit."""
    random, ratios, ways = np.random.default_rng(3), [], set()
    for turn in range(24):
        net = random_net(random, rational)
        steps, falling = fewest_one_way(bends(net, SCALE), 4.0)
        ways.add(bool(falling))
        more = random.integers(0, 4, 4) * (turn % 3)
        edges = fitted(steps[None], (steps[[1, 0, 1, 0]] + more)[None], np.arange(4)[None])[0]
        places, corners = stitched_patch(*steps.tolist(), *edges.tolist(), int(falling))
        of = places.astype(np.float64)
        at = np.stack([of[:, 0] / of[:, 1], of[:, 2] / of[:, 3]], -1)
        ratios.append(worst(net, at[corners]) / 4.0)
    assert len(ways) == 2
    assert max(ratios) <= 1.0
    assert max(ratios) > 0.4


def test_a_triangle_between_two_edges_has_no_more_than_one_with_a_base() -> None:
    """P(2d), P(2d') and (1 - min(d, d'))^2 make no larger sum than two sides of 1 and the base."""
    one, other = np.meshgrid(np.linspace(0.0, 1.0, 41), np.linspace(0.0, 1.0, 41))
    share = np.array([(x, y, 40 - x - y) for x in range(41) for y in range(41 - x)]) / 40.0
    for base in (LEAST_BASE, 0.5, 0.8, 1.0):
        first, second = (base + (1.0 - (1.0 - k) ** 2) * (1.0 - base) for k in (one, other))
        third = (1.0 - np.minimum(one, other) / 2.0) ** 2
        sums = sum(
            np.multiply.outer(share[:, i] * share[:, (i + 1) % 3], m)
            for i, m in enumerate((first, second, third))
        )
        assert sums.max() <= isosceles(np.array(base), np.array(1.0)) * (1.0 + 1e-3)


def test_a_parabola_gets_what_it_needs() -> None:
    """z = 0, y = h (1 - (2u - 1)^2): n steps are off by h / n^2, and v needs one alone."""
    h = 0.5
    net = control_net([[(-1, 0), (-1, 0)], [(0, 2 * h), (0, 2 * h)], [(1, 0), (1, 0)]])
    nu, nv = fewest_steps(bends(net, SCALE), TOLERANCE)
    exact = np.sqrt(SCALE[1] * h / TOLERANCE)
    assert nv == 1
    assert exact <= nu <= np.sqrt(4.0 / 3.0) * exact + 1.0  # whatever triangles: a third more


def test_a_saddle_is_not_charged_for_what_cancels_out() -> None:
    """z = u^2 - v^2 seen from the side: A = -C, and the diagonals are straight."""
    u, v = np.meshgrid([0.0, 0.5, 1.0], [0.0, 0.5, 1.0], indexing="ij")
    square = np.array([0.0, 0.0, 1.0])
    net = np.stack([u - v, square[:, None] - square, 0.0 * u, np.ones((3, 3))], -1)
    steps = fewest_steps(bends(net, (200.0, 200.0)), TOLERANCE)
    summed = np.sqrt(2.0 * 2.0 * 200.0 / (8.0 * TOLERANCE))  # each way, had they been added up
    assert (steps < 0.85 * summed).all()
    assert worst(net, triangles((int(steps[0]), int(steps[1])), tuple(np.repeat(steps, 2)))) <= 1.0


def test_flat_patches_need_one_step() -> None:
    flat = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
    raised = bends(raise_degree(flat, 3, 4), SCALE)
    assert share_used(raised, np.ones(2), TOLERANCE) == pytest.approx(0.0, abs=1e-12)
    assert fewest_steps(raised, TOLERANCE).tolist() == [1, 1]
    assert fewest_steps(bends(flat, SCALE), TOLERANCE).tolist() == [1, 1]


def test_what_is_smaller_than_the_tolerance_needs_one_step() -> None:
    small = R * [0.2 / 256.0, 0.2 / 200.0, 1.0, 1.0]
    assert fewest_steps(bends(small, SCALE), 3.0).tolist() == [1, 1]
    assert fewest_steps(bends(small, SCALE), 0.05).prod() > 1


def test_isosceles() -> None:
    l1, l2 = np.meshgrid(np.linspace(0, 1, 201), np.linspace(0, 1, 201))
    l3 = 1.0 - l1 - l2
    for base, side in ((1.0, 1.0), (0.0, 1.0), (1.7, 1.0), (3.0, 1.0), (1.0, 0.0)):
        most = (l1 * l2 * base + (l1 + l2) * l3 * side)[l3 >= 0.0].max()
        assert isosceles(np.array(base), np.array(side)) == pytest.approx(most, rel=1e-3)


@pytest.mark.parametrize("shape", [(3, 4), (2, 3)])
@pytest.mark.parametrize("rational", [False, True])
def test_steps_keep_the_tolerance_and_are_few(shape: tuple[int, int], rational: bool) -> None:
    """Of all up to 60 each way; where one is 1, others would be few as well."""
    random = np.random.default_rng(2)
    nets = np.ones((60, *shape, 4))
    sizes = 10.0 ** random.uniform(-3, 0, (60, 1, shape[1], 1))
    nets[..., :3] = random.uniform(-1, 1, (60, *shape, 3)) * sizes
    if rational:
        nets *= random.uniform(0.5, 2.0, (60, *shape, 1))
    s = bends(nets, SCALE)
    steps = fewest_steps(s, TOLERANCE)
    assert (share_used(s, steps, TOLERANCE) <= 1.0).all()
    trials = np.stack(np.meshgrid(*2 * [np.arange(1, 61)], indexing="ij"), -1)[:, :, None]
    fine = share_used(s, trials, TOLERANCE) <= 1.0
    best = np.where(fine, trials.prod(-1), np.inf).min((0, 1))
    assert np.isfinite(best).mean() > 0.6
    ratio = (steps.prod(-1) / best)[np.isfinite(best)]
    assert np.median(ratio) < 1.05
    assert ratio.max() < 1.5


def test_rough_weights_do_not_mislead_the_search() -> None:
    """What so many steps use up tells how many are enough only where the steps are short."""
    random = np.random.default_rng(3)
    nets = random.uniform(-1, 1, (40, 3, 3, 4))
    nets[..., 3] = 1.0
    nets *= 10.0 ** random.uniform(-1.0, 1.0, (40, 3, 3, 1))
    s = bends(nets, SCALE)
    trial = np.unique(np.geomspace(1, FINEST, 60).astype(int))
    trials = np.stack(np.meshgrid(trial, trial, indexing="ij"), -1)[:, :, None]
    fine = share_used(s, trials, 4.0) <= 1.0
    best = np.where(fine, trials.prod(-1), np.inf).min((0, 1))
    assert (fewest_steps(s, 4.0).prod(-1) <= 2.0 * best).all()


def test_what_a_point_moves_within_a_triangle_counts() -> None:
    """Nothing bends of a patch measured by places of its own, but its weights do."""
    s = bends(two_halves().patches().reshape(-1, 3, 3, 4)[0], SCALE)
    assert s.speed.all()
    straight = replace(s, uu=0.0 * s.uu, uv=0.0 * s.uv, vv=0.0 * s.vv, spread=0.0 * s.spread)
    for name in ("from_u", "from_v", "edge", "between"):
        straight = replace(straight, **{name: 0.0 * getattr(s, name)})
    used = share_used(straight, np.array([20.0, 10.0]), TOLERANCE)
    squares = s.weight @ [1 / 400, 2 / 200, 1 / 100] / 8.0
    moved = s.speed @ [1 / 20, 1 / 10] / 3.0
    clear = 1.0 - s.growth @ [1 / 20, 1 / 10]
    assert float(used) == pytest.approx(float(squares * moved / clear / TOLERANCE))


def test_a_map_bent_another_way_has_a_say_in_the_slope() -> None:
    """The patch bends along v, a little, its map along u."""
    v, u = np.meshgrid([0.0, 0.5, 1.0], [0.0, 0.5, 1.0])
    patch = np.stack([u, v + 1e-3 * (v == 0.5), 0.0 * u, np.ones((3, 3))], -1)
    sought = np.stack([u + 0.2 * (u == 0.5), v, 0.0 * u, np.ones((3, 3))], -1)
    unit = pixels_a_unit(patch, sought, SCALE)
    steps = fewest_steps(bends(patch, SCALE), TOLERANCE, bends(sought, (1.0, 1.0)), unit)
    assert steps[1] == 1
    assert 4 < steps[0] < 16


def test_without_positive_weights_the_finest() -> None:
    net = R.copy()
    net[1, 1, 3] = 0.0
    assert (fewest_steps(bends(net, SCALE), TOLERANCE) == FINEST).all()


def test_out_of_view_is_told_by_the_hull() -> None:
    offsets = np.array([[0, 0, 0, 0], [3.1, 0, 0, 0], [0, -3.1, 0, 0]])
    assert out_of_view(R + offsets[:, None, None, :]).tolist() == [False, True, True]
    assert not out_of_view(R * [1, 1, 1, -1.0])
    across = control_net([[(-9, 9), (9, 9)], [(-9, -9), (9, -9)]])
    assert not out_of_view(across)


def test_pixels_a_unit() -> None:
    square = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
    assert pixels_a_unit(square, square, SCALE) == pytest.approx(256.0)
    finer = square * [4.0, 4.0, 1.0, 1.0]
    assert pixels_a_unit(square, finer, SCALE) == pytest.approx(64.0)
    point = control_net([[(0, 0), (0, 0)], [(0, 0), (0, 0)]])
    assert pixels_a_unit(square, point, SCALE) == 0.0
