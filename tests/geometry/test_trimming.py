"""Trim regions in float64: areas, what is inside, how far the curves are, and bad loops."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.net import Array
from reparam.geometry.trimming import (
    BadTrimPiece,
    CrossingTrims,
    EmptyTrim,
    MisorientedTrims,
    TrimError,
    UnconnectedTrim,
    trim_region,
)
from reparam.geometry.trimming.contacts import parts_of, sectors
from reparam.geometry.trimming.pieces import curve_points
from trim_cases import (
    CASES,
    NINE,
    SQUARE,
    Loop,
    bezier,
    blob,
    circle,
    crescent,
    discs,
    petals,
    red_book,
    region_of,
    reverse,
    star,
)


def polygons(loops: list[Loop], steps: int) -> list[Array]:
    """The loops as fine polygons: parameters in even steps."""
    t = np.linspace(0.0, 1.0, steps + 1)
    result = []
    for loop in loops:
        points = [
            piece
            if piece.shape[1] == 2
            else curve_points(np.broadcast_to(piece, (len(t), *piece.shape)), t)
            for piece in loop
        ]
        result.append(np.concatenate(points))
    return result


def angle_sum(loops: list[Loop], points: Array) -> NDArray[np.intp]:
    """Winding numbers (k,) by the angle that each polygon turns about each point."""
    total = np.zeros(len(points))
    for polygon in polygons(loops, 80):
        z = polygon @ [1.0, 1j]
        ratio = (np.append(z[1:], z[0]) - (points @ [1.0, 1j])[:, None]) / (
            z - (points @ [1.0, 1j])[:, None]
        )
        total += np.angle(ratio).sum(1) / (2.0 * np.pi)
    return total.round().astype(np.intp)


def shoelace(polygon: Array) -> float:
    u, v = polygon.T
    return float((u * np.roll(v, -1) - v * np.roll(u, -1)).sum() / 2.0)


@pytest.mark.parametrize("name", CASES)
def test_inside_is_what_an_angle_sum_says(name: str) -> None:
    loops, region = CASES[name](), region_of(name)
    points = np.random.default_rng(2).uniform(0.0, 1.0, (400, 2))
    expected = angle_sum(loops, points)
    if name in ("sixty-four", "no loops"):
        expected += 1  # all outermost loops are clockwise
    wrong = region.inside(*points.T) != (expected == 1)
    assert (np.abs(region.signed_distance(*points[wrong].T)) < 1e-4).all()
    assert wrong.sum() <= 3


def test_areas_of_circles() -> None:
    disc = np.pi * 0.09
    for loops, expected in [
        ([circle()], disc),
        ([reverse(circle())], 1.0 - disc),
        ([SQUARE, reverse(circle())], 1.0 - disc),
        ([SQUARE, reverse(circle()), circle(radius=0.1)], 1.0 - disc + np.pi * 0.01),
        ([], 1.0),
        ([circle((1.0, 0.5))], disc / 2.0),
        ([reverse(circle((1.0, 1.0)))], 1.0 - disc / 4.0),
        ([circle(radius=3.0)], 1.0),
        ([reverse(circle(radius=3.0))], 0.0),
        ([circle((5.0, 0.5))], 0.0),
        ([reverse(circle((5.0, 0.5)))], 1.0),
    ]:
        assert trim_region(loops).area() == pytest.approx(expected, abs=1e-14)


def test_areas_of_polynomial_loops() -> None:
    hole = 2.25 / 30.0 + 0.5 * 0.25 / 2.0  # v = .5 + .75 t (1-t), du = 3 t (1-t) dt; a triangle
    assert trim_region(red_book()).area() == pytest.approx(1.0 - hole, abs=1e-14)
    random = np.random.default_rng(3)
    for _ in range(5):
        loop = blob(random, (0.5, 0.5), 0.45)
        fine, coarse = (shoelace(polygons([loop], n)[0]) for n in (800, 400))
        expected = (4.0 * fine - coarse) / 3.0
        assert trim_region([loop]).area() == pytest.approx(expected, abs=1e-9)


def test_another_domain() -> None:
    stretch = np.array([[40.0, 0, 0], [0, 0.5, 0], [100.0, -3.0, 1.0]])
    loop = [piece @ stretch for piece in circle()]
    region = trim_region([reverse(loop)], (100.0, 140.0, -3.0, -2.5))
    assert region.area() == pytest.approx(20.0 * (1.0 - np.pi * 0.09), abs=1e-12)
    points = np.random.default_rng(4).uniform(0.0, 1.0, (1000, 2))
    u, v = region.from_square(points).T
    np.testing.assert_allclose(region.to_square(u, v), points, atol=1e-13)
    assert (region.inside(u, v) == (np.hypot(*(points - 0.5).T) > 0.3)).all()
    assert region.inside(120.0, -2.75).shape == ()


def test_signed_distance() -> None:
    region = trim_region([SQUARE, reverse(circle())])
    points = np.random.default_rng(5).uniform(0.0, 1.0, (300, 2))
    expected = np.hypot(*(points - 0.5).T) - 0.3
    np.testing.assert_allclose(region.signed_distance(*points.T), expected, atol=1e-11)
    assert trim_region([]).signed_distance(0.5, 0.5) == np.inf


def test_pieces_are_monotone_and_closed() -> None:
    for name in CASES:
        pieces = region_of(name).pieces
        t = np.linspace(0.0, 1.0, 33)
        low, high = pieces.span.T[..., None]
        places = low + t * (high - low)
        index = np.repeat(np.arange(len(pieces)), 33)
        points = pieces.points(index, places.ravel()).reshape(-1, 33, 2)
        steps = np.diff(points, axis=1)
        way = np.sign(pieces.ends[:, 1] - pieces.ends[:, 0])[:, None]
        assert (steps * way >= -1e-13).all()
        size = np.abs(steps)
        flat = size[..., 0] >= size[..., 1] - 1e-12
        steep = size[..., 1] >= size[..., 0] - 1e-12
        assert (flat.all(1) | steep.all(1)).all()
        starts, ends = (np.unique(pieces.ends[:, k], axis=0, return_counts=True) for k in (0, 1))
        assert (starts[0] == ends[0]).all()
        assert (starts[1] == ends[1]).all()


def test_loops_may_touch() -> None:
    disc = np.pi * 0.04
    apart = [circle((0.3, 0.5), 0.2), circle((0.7, 0.5), 0.2)]
    assert trim_region(apart).area() == pytest.approx(2.0 * disc, abs=1e-14)
    within = [circle((0.5, 0.5), 0.4), reverse(circle((0.3, 0.5), 0.2))]
    assert trim_region(within).area() == pytest.approx(3.0 * disc, abs=1e-14)
    filled = [circle(), reverse(circle(radius=0.2)), circle(radius=0.2)]
    assert trim_region(filled).area() == pytest.approx(np.pi * 0.09, abs=1e-14)
    halves = [
        [np.array([(0, 0), (0.5, 0), (0.5, 1), (0, 1), (0, 0)])],
        [np.array([(0.5, 0), (1, 0), (1, 1), (0.5, 1), (0.5, 0)])],
    ]
    assert trim_region(halves).area() == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("bend", [0.0, 0.3])
def test_many_loops_may_touch_in_one_point(bend: float) -> None:
    """So many that pairs of their pieces must not be followed up one by one."""
    loops = petals(150, bend)
    area = sum(shoelace(polygon) for polygon in polygons(loops, 200))
    assert trim_region(loops).area() == pytest.approx(area, abs=1e-5)
    with pytest.raises(CrossingTrims, match=r"trim loop 148, piece 2: .* crossing loop 149, piece"):
        trim_region(petals(150, bend, 0.5))


def test_tangent_loops_are_told_from_crossing_ones() -> None:
    """Circles within circles, all through one point."""
    nested = [circle((0.05 + r, 0.5), r) for r in np.linspace(0.45, 0.1, 12)]
    loops = [loop if k % 2 == 0 else reverse(loop) for k, loop in enumerate(nested)]
    squares = np.linspace(0.45, 0.1, 12) ** 2 * np.pi
    expected = squares[::2].sum() - squares[1::2].sum()
    assert trim_region(loops).area() == pytest.approx(expected, abs=1e-12)
    loops[5] = [piece + piece[:, 2:] * [0.0, 1e-3, 0.0] for piece in loops[5]]
    with pytest.raises(CrossingTrims):
        trim_region(loops)


def test_loops_from_one_point_that_cross_elsewhere() -> None:
    """A line, and a curve that starts below it, crosses it and comes back below it."""
    line = np.array([(0.1, 0.1), (0.9, 0.5)])
    curve = bezier((0.1, 0.1), (0.9 / 3 + 0.2 / 3, 0.2013), (0.1 + 1.6 / 3, 0.4227), (0.9, 0.464))
    above = [line, np.array([(0.9, 0.5), (0.9, 0.95), (0.1, 0.95), (0.1, 0.1)])]
    below = [curve, np.array([(0.9, 0.464), (0.9, 0.05), (0.1, 0.05), (0.1, 0.1)])]
    with pytest.raises(CrossingTrims, match="trim loop 0, piece 0: "):
        trim_region([above, reverse(below)])
    apart = bezier((0.1, 0.1), (1.1 / 3, 0.18), (0.1 + 1.6 / 3, 0.36), (0.9, 0.464))
    assert trim_region([above, reverse([apart, *below[1:]])]).area() > 0.5


def test_parts_of_curves_and_where_they_lie() -> None:
    random = np.random.default_rng(8)
    curves = random.uniform(0.1, 1.0, (6, 5, 3))
    span = np.sort(random.uniform(0.0, 1.0, (6, 2)), 1)
    parts = parts_of(curves, span)
    for share in (0.0, 0.3, 1.0):
        expected = curve_points(curves, span[:, 0] + share * (span[:, 1] - span[:, 0]))
        assert curve_points(parts, np.full(6, share)) == pytest.approx(expected, abs=1e-12)
    pieces = region_of("blobs").pieces
    direction, least, most = sectors(pieces)
    number = np.arange(len(pieces))
    for share in (0.02, 0.5, 0.98):
        points = pieces.points(number, pieces.span @ [1.0 - share, share])
        for side in (0, 1):
            way = points - pieces.ends[:, side]
            turn = np.arctan2(way[:, 1], way[:, 0]) - direction[:, side]
            turn = np.remainder(turn + np.pi, 2.0 * np.pi) - np.pi
            assert (turn > least[:, side] - 1e-7).all()
            assert (turn < most[:, side] + 1e-7).all()


def test_small_gaps_are_joined_and_points_dropped() -> None:
    doubled = np.array([(0.1, 0.1), (0.9, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.1 + 4e-6)])
    assert trim_region([[doubled]]).area() == pytest.approx(0.32, abs=1e-5)
    arcs = circle()
    arcs[2] = arcs[2] + arcs[2][:, 2:] * [4e-6, 0.0, 0.0]
    point = np.array([(0.8, 0.5), (0.8, 0.5)])
    assert trim_region([[*arcs, point]]).area() == pytest.approx(np.pi * 0.09, abs=1e-5)


SHORT = circle()[:3]
EIGHT: Loop = [np.array([(0.1, 0.1), (0.9, 0.9), (0.9, 0.1), (0.1, 0.8), (0.1, 0.1)])]
CURL: Loop = [
    bezier((0.3, 0.3), (1.4, 0.9), (-0.4, 0.9), (0.7, 0.3)),
    np.array([(0.7, 0.3), (0.3, 0.3)]),
]
NARROW = [circle(), [np.array([(0.5, 0.5), (0.9, 0.5), (0.9, 0.5001), (0.5, 0.5)])]]
BAD: dict[str, tuple[list[Loop], type[TrimError], int, int | None]] = {
    "gap": ([SQUARE, reverse(SHORT)], UnconnectedTrim, 1, 2),
    "open polyline": ([[np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)])]], UnconnectedTrim, 0, 0),
    "gap of 1e-5": ([[np.array([(0, 0), (1, 0), (1, 1), (0, 1e-5)])]], UnconnectedTrim, 0, 0),
    "head to head": ([[*circle()[:2], *reverse(circle()[2:])]], UnconnectedTrim, 0, 1),
    "no pieces": ([SQUARE, []], EmptyTrim, 1, None),
    "a point": ([[np.full((3, 2), 0.5)]], EmptyTrim, 0, None),
    "there and back": ([[np.array([(0.1, 0.1), (0.5, 0.6), (0.1, 0.1)])]], EmptyTrim, 0, None),
    "crossing": ([circle(), circle((0.2, 0.5), 0.1)], CrossingTrims, 0, None),
    "crossing at a small angle": (NARROW, CrossingTrims, 0, None),
    "figure of eight": ([EIGHT], CrossingTrims, 0, 0),
    "curl": ([CURL], CrossingTrims, 0, 0),
    "twice the same": ([circle(), circle()], CrossingTrims, 0, None),
    "two alike nested": ([circle(), circle(radius=0.1)], MisorientedTrims, 1, None),
    "two holes nested": (
        [SQUARE, reverse(circle()), reverse(circle(radius=0.1))], MisorientedTrims, 2, None,
    ),
    "side by side": (
        [circle((0.3, 0.5), 0.1), reverse(circle((0.7, 0.5), 0.1))], MisorientedTrims, 1, None,
    ),
    "shape": ([[np.ones((3, 4))]], BadTrimPiece, 0, 0),
    "one point": ([SQUARE, [np.ones((1, 3))]], BadTrimPiece, 1, 0),
    "weight": ([[NINE[:3] * [1, 1, 0]]], BadTrimPiece, 0, 0),
    "order": ([[np.ones((33, 3))]], BadTrimPiece, 0, 0),
    "nan": ([[*circle()[:3], np.full((3, 3), np.nan)]], BadTrimPiece, 0, 3),
    "infinite": ([[np.array([(0, 0), (np.inf, 0), (0, 0)])]], BadTrimPiece, 0, 0),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_loops_are_named(name: str) -> None:
    loops, kind, loop, piece = BAD[name]
    with pytest.raises(kind, match=rf"^trim loop {loop}\b.*: expected .*, found ") as caught:
        trim_region(loops)
    assert caught.value.loop == loop
    if piece is not None:
        assert caught.value.piece == piece


def test_bad_domain() -> None:
    with pytest.raises(ValueError, match="trim domain: expected u0 < u1"):
        trim_region([], (0.0, 0.0, 0.0, 1.0))


def test_near_misses_are_no_crossings() -> None:
    outer, inner = star((0.5, 0.5), 0.4, 7), reverse(star((0.5, 0.5), 0.39999, 7))
    shares = [shoelace(loop[0]) for loop in (outer, inner)]
    assert trim_region([outer, inner]).area() == pytest.approx(sum(shares), abs=1e-13)
    with pytest.raises(CrossingTrims):
        trim_region([crescent(0.3, 1e-2), reverse(crescent(0.299, 2e-3))])


def test_thousands_of_arcs() -> None:
    region = trim_region(discs(30))
    assert region.area() == pytest.approx(1.0 - np.pi * 0.16, abs=1e-12)
    points = np.random.default_rng(6).uniform(0.0, 1.0, (9000, 2))
    expected = np.hypot(*(points * 30.0 % 1.0 - 0.5).T) > 0.4
    assert (region.inside(*points.T) == expected).all()
