"""Splines against the Cox-de Boor recursion in rational numbers, for any knots."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from reparam.geometry.bernstein import bernstein
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.extraction import curve_to_bezier, extraction, restricted, surface_to_bezier
from reparam.geometry.net import Array
from reparam.geometry.nurbs import (
    KnotError,
    KnotFault,
    basis_functions,
    breakpoints,
    check_knots,
    clamped_knots,
    domain,
    evaluate_curve,
    evaluate_surface,
    find_span,
    insert_knot,
)

S2 = np.sqrt(0.5)
CIRCLE_KNOTS = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]
CIRCLE = np.array([(1, 0, 0, 1), (S2, S2, 0, S2), (0, 1, 0, 1), (-S2, S2, 0, S2), (-1, 0, 0, 1),
                   (-S2, -S2, 0, S2), (0, -1, 0, 1), (S2, -S2, 0, S2), (1, 0, 0, 1)])  # fmt: skip

# knots in eighths, order: clamped, unclamped, every multiplicity up to the order, off [0,1]
VECTORS = {
    "order 1": ([0, 1, 3, 8], 1),
    "order 1, one span": ([0, 8], 1),
    "linear, jump": ([0, 0, 3, 3, 8, 8], 2),
    "quadratic, unclamped": ([-3, -1, 0, 2, 3, 7, 9, 12], 3),
    "cubic, clamped": ([0, 0, 0, 0, 2, 3, 7, 8, 8, 8, 8], 4),
    "cubic, double and triple": ([0, 0, 0, 0, 3, 3, 6, 6, 6, 8, 8, 8, 8], 4),
    "cubic, jump": ([0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8], 4),
    "cubic, half clamped": ([-8, -5, 0, 0, 1, 3, 8, 8, 11, 12], 4),
    "cubic, jump at the first parameter": ([-4, -3, -2, 0, 0, 0, 0, 8, 9, 10, 11], 4),
    "order 7, negative": ([-9, -9, -9, -8, -8, -7, -5, -5, -5, -2, 0, 0, 1, 2, 3, 4, 5], 7),
    "order 12": ([*range(-11, 13), 12, 12, 12, *range(13, 25)], 12),
    "order 32": ([*[0] * 30, *range(4), 3, 3, 4, 5, 5, *[8] * 31], 32),
}


def exact_basis(knots: list[Fraction], order: int, i: int, t: Fraction, last: Fraction) -> Fraction:
    """N_i of this order by its definition: 0/0 is 0; the last parameter is in the span before."""
    if order == 1:
        closed_above = knots[i] < t <= knots[i + 1]
        return Fraction(int(closed_above if t == last else knots[i] <= t < knots[i + 1]))
    value = Fraction(0)
    for j, start, end, sign in ((i, i, i + order - 1, 1), (i + 1, i + order, i + 1, -1)):
        width = (knots[end] - knots[start]) * sign
        if width:
            below = exact_basis(knots, order - 1, j, t, last)
            value += below and (t - knots[start]) * sign / width * below
    return value


def exact_spline(knots: list[float], points: Array, order: int, t: Fraction) -> Array:
    exact = [Fraction(k) for k in knots]
    last = exact[-order]
    span = int(find_span(np.array(knots, float), order, float(t)))
    total = [Fraction(0)] * points.shape[1]
    for i in range(span - order + 1, span + 1):
        weight = exact_basis(exact, order, i, t, last)
        total = [s + weight * Fraction(x) for s, x in zip(total, points[i].tolist(), strict=True)]
    return np.array(total, float)


def spline(name: str, components: int = 4) -> tuple[Array, Array, int]:
    eighths, order = VECTORS[name]
    knots = np.array(eighths) / 8.0
    random = np.random.default_rng(len(name))
    points = random.uniform(-1.0, 1.0, (len(knots) - order, components))
    points[:, -1] = random.uniform(0.5, 2.0, len(points))
    return check_knots(knots, order, len(points)), points, order


SMALL = [name for name in VECTORS if "order 32" not in name and "order 12" not in name]


@pytest.mark.parametrize("name", SMALL)
def test_values_by_definition(name: str) -> None:
    knots, points, order = spline(name)
    low, high = domain(knots, order)
    parameters = [*breakpoints(knots, order), *np.linspace(low, high, 6)[1:-1]]
    expected = [exact_spline(knots.tolist(), points, order, Fraction(t)) for t in parameters]
    found = evaluate_curve(knots, points, order, np.array(parameters))
    np.testing.assert_allclose(found, np.array(expected), atol=2e-15, rtol=1e-14)
    span, values = basis_functions(knots, order, parameters)
    np.testing.assert_allclose(values.sum(-1), 1.0, rtol=1e-15)
    assert (knots[span] < knots[span + 1]).all()


@pytest.mark.parametrize("name", SMALL)
def test_pieces_by_definition(name: str) -> None:
    knots, points, order = spline(name)
    pieces = curve_to_bezier(knots, points, order)
    ends = breakpoints(knots, order)
    assert pieces.intervals.tolist() == [[a, b] for a, b in pairwise(ends)]
    for net, (a, b) in zip(pieces.nets, pieces.intervals, strict=True):
        for local in (Fraction(0), Fraction(1, 3), Fraction(4, 7)):
            t = Fraction(a) + (Fraction(b) - Fraction(a)) * local
            expected = exact_spline(knots.tolist(), points, order, t)
            found = bernstein(order - 1, float(local)) @ net
            np.testing.assert_allclose(found, expected, atol=2e-15, rtol=1e-14)


@pytest.mark.parametrize("name", ["order 12", "order 32"])
def test_pieces_of_high_order(name: str) -> None:
    knots, points, order = spline(name)
    pieces = curve_to_bezier(knots, points, order)
    for net, (a, b) in zip(pieces.nets, pieces.intervals, strict=True):
        t = np.linspace(0.0, 1.0, 7)[:-1]
        expected = evaluate_curve(knots, points, order, a + (b - a) * t)
        np.testing.assert_allclose(bernstein(order - 1, t) @ net, expected, atol=5e-14)


@pytest.mark.parametrize("name", VECTORS)
def test_neighbours_share_their_point_unless_the_spline_jumps(name: str) -> None:
    knots, points, order = spline(name)
    pieces = curve_to_bezier(knots, points, order)
    for before, after, t in zip(
        pieces.nets, pieces.nets[1:], pieces.intervals[1:, 0], strict=False
    ):
        jumps = np.count_nonzero(knots == t) >= order
        assert (before[-1] == after[0]).all() == (not jumps)


@pytest.mark.parametrize("name", VECTORS)
def test_extraction_averages(name: str) -> None:
    """Weights of an average: none negative, sum 1; a clamped end keeps its control point."""
    knots, points, order = spline(name)
    matrices = extraction(knots, order).matrices
    assert matrices.min() >= 0.0
    np.testing.assert_allclose(matrices.sum(-1), 1.0, rtol=1e-14)
    if np.count_nonzero(knots == knots[0]) == order:
        assert (curve_to_bezier(knots, points, order).nets[0, 0] == points[0]).all()


@pytest.mark.parametrize("name", SMALL)
def test_inserted_knots_change_nothing(name: str) -> None:
    knots, points, order = spline(name)
    low, high = domain(knots, order)
    inner = low + (high - low) * 0.37
    more, refined = insert_knot(knots, points, order, inner, order)
    assert check_knots(more, order, len(refined)).tolist() == sorted([*knots, *[inner] * order])
    for t in breakpoints(knots, order):
        if np.count_nonzero(more == t) < order:
            more, refined = insert_knot(more, refined, order, float(t))
    parameters = np.linspace(low, high, 41)
    before = evaluate_curve(knots, points, order, parameters)
    np.testing.assert_allclose(evaluate_curve(more, refined, order, parameters), before, atol=4e-15)


def test_insertion_and_extraction_agree() -> None:
    knots, points, order = spline("cubic, double and triple")
    pieces = curve_to_bezier(knots, points, order)
    for t in breakpoints(knots, order):
        times = order - np.count_nonzero(knots == t)
        knots, points = insert_knot(knots, points, order, float(t), int(times))
    np.testing.assert_allclose(points.reshape(pieces.nets.shape), pieces.nets, atol=1e-15)


def test_periodic_spline_closes() -> None:
    knots, order = np.arange(-3.0, 9.0), 4
    ring = np.random.default_rng(1).normal(size=(5, 3))
    pieces = curve_to_bezier(knots, np.concatenate([ring, ring[:3]]), order)
    assert len(pieces.nets) == 5
    first, last = pieces.nets[0], pieces.nets[-1]
    np.testing.assert_allclose(last[3], first[0], atol=1e-15)
    np.testing.assert_allclose(last[3] - last[2], first[1] - first[0], atol=1e-15)


def test_circle_stays_round() -> None:
    pieces = curve_to_bezier(CIRCLE_KNOTS, CIRCLE, 3)
    points = np.einsum("tk,skc->stc", bernstein(2, np.linspace(0.0, 1.0, 9)), pieces.nets)
    radius = np.hypot(points[..., 0], points[..., 1]) / points[..., 3]
    np.testing.assert_allclose(radius, 1.0, atol=4e-16)


def test_surfaces_are_exact_and_share_their_edges() -> None:
    (u_knots, _, order_u), (v_knots, _, order_v) = (
        spline("cubic, jump"),
        spline("quadratic, unclamped"),
    )
    random = np.random.default_rng(2)
    points = random.uniform(-1.0, 1.0, (len(u_knots) - order_u, len(v_knots) - order_v, 4))
    surface = surface_to_bezier((u_knots, v_knots), points, (order_u, order_v))
    assert surface.nets.shape == (2, 3, 4, 3, 4)
    local = np.linspace(0.0, 1.0, 5)[:-1]
    for net, domain_uv in zip(surface.patches(), surface.domains(), strict=True):
        a, b = domain_uv[0, 0], domain_uv[1, 1]
        assert domain_uv[1, 0].tolist() == [b[0], a[1]]
        grid = np.meshgrid(*(a[i] + (b - a)[i] * local for i in (0, 1)), indexing="ij")
        expected = evaluate_surface((u_knots, v_knots), points, (order_u, order_v), *grid)
        found = evaluate(net, *np.meshgrid(local, local, indexing="ij"))
        np.testing.assert_allclose(found, expected, atol=4e-15)
    assert (surface.nets[:, :-1, :, -1] == surface.nets[:, 1:, :, 0]).all()
    assert not (surface.nets[0, :, -1] == surface.nets[1, :, 0]).any(), "u jumps in the middle"


def test_rational_surface_is_a_torus() -> None:
    net = np.empty((9, 9, 4))
    for i, (x, y, _, w) in enumerate(CIRCLE):
        radius = 2.0 * CIRCLE[:, 3] + 0.75 * CIRCLE[:, 0]
        net[i] = np.stack([x * radius, y * radius, 0.75 * w * CIRCLE[:, 1], w * CIRCLE[:, 3]], -1)
    patches = surface_to_bezier((CIRCLE_KNOTS, CIRCLE_KNOTS), net, (3, 3)).patches()
    t = np.linspace(0.0, 1.0, 5)
    x, y, z = np.moveaxis(project(evaluate(patches, *np.meshgrid(t, t, indexing="ij"))), -1, 0)
    np.testing.assert_allclose((np.hypot(x, y) - 2.0) ** 2 + z**2, 0.75**2, atol=2e-15)


def test_cuts_are_cuts() -> None:
    knots, points, order = spline("cubic, clamped")
    pieces = curve_to_bezier(knots, points, order, [0.5, 0.25, 3.0])
    assert pieces.intervals[:, 0].tolist() == [0.0, 0.25, 0.375, 0.5, 0.875]
    for net, (a, b) in zip(pieces.nets, pieces.intervals, strict=True):
        middle = evaluate_curve(knots, points, order, (a + b) / 2)
        np.testing.assert_allclose(bernstein(3, 0.5) @ net, middle, atol=1e-15)
    assert (pieces.nets[1:, 0] == pieces.nets[:-1, -1]).all()


def test_restricted_to_rectangles() -> None:
    net = np.random.default_rng(3).normal(size=(4, 3, 2))
    low, high = np.array([[0.0, 0.25], [0.5, 0.5]]), np.array([[1.0, 0.75], [0.625, 1.0]])
    local = np.linspace(0.0, 1.0, 5)
    for part, (u0, v0), (u1, v1) in zip(restricted(net, low, high), low, high, strict=True):
        rows, columns = (bernstein(d, t) for d, t in (
            (3, u0 + (u1 - u0) * local), (2, v0 + (v1 - v0) * local)))  # fmt: skip
        found = np.einsum("ki,lj,ijc->klc", bernstein(3, local), bernstein(2, local), part)
        expected = np.einsum("ki,lj,ijc->klc", rows, columns, net)
        np.testing.assert_allclose(found, expected, atol=1e-15)
    assert (restricted(net, [[0.0, 0.0]], [[1.0, 1.0]])[0] == net).all()


def test_clamped_knots() -> None:
    assert clamped_knots(5, 3).tolist() == [0, 0, 0, 1 / 3, 2 / 3, 1, 1, 1]
    assert clamped_knots(4, 4).tolist() == [0, 0, 0, 0, 1, 1, 1, 1]


@pytest.mark.parametrize(
    ("knots", "order", "points", "fault", "message"),
    [
        ([0, 1], 0, None, KnotFault.ORDER, "order from 1 to 32, found 0"),
        ([0, 1], 33, None, KnotFault.ORDER, "found 33"),
        ([0, 0, 0, 1, 1, 1], 4, None, KnotFault.TOO_FEW, "at least 8 knots for order 4, found 6"),
        ([1, 1, 1, 1], 2, None, KnotFault.EMPTY_RANGE, "range of knots that is not empty"),
        ([0, 0, 1, 0.5, 2, 2], 2, None, KnotFault.DECREASING, "found 1, 0.5 at 2"),
        ([0, 0, 1, 1, 1, 2, 2], 2, None, KnotFault.MULTIPLICITY, "at most 2 times .* 3 at 1"),
        ([0, 0, np.nan, 1, 1], 2, None, KnotFault.NOT_FINITE, "finite knot 2"),
        ([0, 0, 1, 1], 2, 3, KnotFault.POINTS, "5 knots for 3 points of order 2, found 4"),
    ],
)
def test_bad_knots(
    knots: list[float], order: int, points: int | None, fault: KnotFault, message: str
) -> None:
    with pytest.raises(KnotError, match=message) as caught:
        check_knots(knots, order, points)
    assert caught.value.fault is fault


def test_bad_insertions() -> None:
    knots, points, order = spline("cubic, clamped")
    with pytest.raises(KnotError, match="a knot from 0 to 1"):
        insert_knot(knots, points, order, 1.5)
    with pytest.raises(KnotError, match="at most 4 times, found 4 more of"):
        insert_knot(knots, points, order, 0.25, 4)
