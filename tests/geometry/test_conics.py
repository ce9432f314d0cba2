"""Circle partitions, edits of their nets, and sections with continuous curvature."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.bernstein import bernstein
from reparam.geometry.conics import ConicNet, circle_net
from reparam.geometry.continuity import angle, join_curves
from reparam.geometry.jets import rational_jet
from reparam.geometry.sections import (
    curved_section,
    end_curvatures,
    spline_pieces,
    with_end_curvatures,
)

Array = NDArray[np.float64]

DEGREES = [70, 30, 30, 30, 40, 100 / 3, 100 / 3, 100 / 3, 60]
HALF = np.radians(DEGREES) / 2
KEPT = [0, 4, 8]
random = np.random.default_rng(11)


def off_circle(net: Array, radius: float = 1.0) -> float:
    x, y, _, w = (bernstein(len(net) - 1, np.linspace(0.0, 1.0, 101)) @ net).T
    return float(np.abs(np.hypot(x / w, y / w) - radius).max())


def edited() -> ConicNet:
    net = circle_net(HALF)
    return net.moved(2, net.points[2] + [0.35, 0.5]).moved(6, net.points[6] + [-0.2, -0.6])


def test_the_pieces_are_the_circle() -> None:
    for n in (3, 4, 7):
        net = circle_net(np.full(n, np.pi / n), 2.5)
        np.testing.assert_allclose(net.weights, np.cos(np.pi / n), atol=1e-15)
        assert np.hypot(*net.points.T) == pytest.approx(2.5 / np.cos(np.pi / n), abs=1e-14)
        assert max(off_circle(piece, 2.5) for piece in net.pieces()) < 3e-15
    assert max(off_circle(piece) for piece in circle_net(HALF).pieces()) < 1e-15
    moved = circle_net(HALF, 1.0, (3.0, -2.0), 0.4).joints() - [3.0, -2.0]
    assert np.hypot(*moved.T) == pytest.approx(1.0, abs=1e-15)
    assert np.degrees(np.arctan2(*moved[0, ::-1])) == pytest.approx(70 + np.degrees(0.4))


def test_kept_pieces_keep_every_bit() -> None:
    before, after = circle_net(HALF).pieces(), edited().pieces()
    same = [bool((a == b).all()) for a, b in zip(before, after, strict=True)]
    assert same == [i in KEPT for i in range(9)]
    assert max(off_circle(after[i]) for i in KEPT) <= 4.5e-16


@pytest.mark.parametrize("weight", [None, 0.3, 4.0])
def test_tangents_agree_however_the_net_is_edited(weight: float | None) -> None:
    net = edited() if weight is None else edited().weighted(2, weight).weighted(3, 1 / weight)
    for i in range(20):
        net = net.moved(i % 9, net.points[i % 9] + random.normal(size=2) * 0.05)
    pieces = net.pieces()
    for f, g in zip(pieces, np.roll(pieces, -1, 0), strict=True):
        arrival = rational_jet(f, 1, 1).derivatives[1]
        assert angle(arrival, rational_jet(g, 0, 1).derivatives[1]) < 1e-12
        assert join_curves(f, g, 1).order == 1
        assert (f[2] == g[0]).all()
    assert join_curves(pieces[1], pieces[2]).order == 1  # and no more


@pytest.mark.parametrize(
    ("half", "message"),
    [
        ([1.0, 1.0], "at least three"),
        ([1.6, 0.8, 0.74], r"\[0\]: expected a half angle in \(0, pi/2\)"),
        ([1.0, 1.0, 1.0], "sum to pi, found 3"),
        ([1.5, 1.5, np.nan], r"\[2\]: expected a half angle"),
    ],
)
def test_refused_partitions(half: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        circle_net(half)


def test_refused_nets() -> None:
    net = circle_net(HALF)
    with pytest.raises(ValueError, match=r"\[3\]: expected a control point that differs"):
        net.moved(3, net.points[4])
    with pytest.raises(ValueError, match=r"\[5\]: expected a finite control point"):
        net.moved(5, [np.nan, 0.0])
    with pytest.raises(ValueError, match=r"\[1\]: expected a weight > 0, found 0"):
        net.weighted(1, 0.0)
    with pytest.raises(ValueError, match=r"\[0\]: expected a ratio in \(0, 1\)"):
        ConicNet(net.points, net.weights, np.concatenate([[1.0], net.ratios[1:]]))
    with pytest.raises(ValueError, match="expected points"):
        ConicNet(net.points, net.weights[:-1], net.ratios)


def section(first: int, last: int, inner: list[Array]) -> Array:
    """A polygon from where piece `first` starts to where piece `last` ends, tangents kept."""
    pieces = circle_net(HALF).pieces()
    a, b = pieces[first][0, :2], pieces[last][2, :2]
    reach = np.linalg.norm(b - a) / 3
    along, back = np.array([-a[1], a[0]]), np.array([b[1], -b[0]])
    return np.array([a, a + reach * along, *inner, b + reach * back, b])


TOP, BOTTOM = circle_net(HALF).points[[2, 6]]


@pytest.mark.parametrize(
    ("inner", "degrees"),
    [
        ([], [3]),
        ([TOP * 1.25], [3, 3]),
        ([TOP * 1.2 + [0.25, 0.0], TOP * 1.2 + [-0.1, -0.05]], [3, 3, 3]),
        ([TOP * 0.4, TOP * 1.5], None),  # bends the wrong way: an inflection
    ],
)
def test_sections_have_continuous_curvature(inner: list[Array], degrees: list[int] | None) -> None:
    pieces = circle_net(HALF).pieces()
    nets = curved_section(section(1, 3, inner), 1.0, 1.0)
    found = [len(net) - 1 for net in nets]
    assert found == degrees if degrees else 5 in found
    whole = [pieces[0], *nets, pieces[4]]
    for f, g in pairwise(whole):
        assert np.abs(rational_jet(f, 1, 1).derivatives[0] - g[0, :3] / g[0, 3]).max() < 1e-15
        arrival = rational_jet(f, 1, 1).derivatives[1]
        assert angle(arrival, rational_jet(g, 0, 1).derivatives[1]) < 1e-10
        assert end_curvatures(f)[1] == pytest.approx(end_curvatures(g)[0], abs=1e-10)
        assert join_curves(f, g, 2).order == 2


def test_weights_for_the_curvatures() -> None:
    """A quarter of the circle from its cubic polygon needs its known weights."""
    k = 0.5522847498
    cubic = np.array([[1, 0, 0, 1], [1, k, 0, 1], [k, 1, 0, 1], [0, 1, 0, 1]], float)
    for start, end in ((1.0, 1.0), (0.3, 2.0), (-1.0, 1.0), (0.0, 0.0), (1e-9, 1.0)):
        mended = with_end_curvatures(cubic, start, end)
        assert end_curvatures(mended) == pytest.approx((start, end), abs=1e-12)
        assert len(mended) == (4 if min(start, end) > 0.1 else 6)
        assert (mended[[0, -1]] == cubic[[0, -1]]).all()


def test_spline_pieces_are_c2() -> None:
    polygon = random.normal(size=(7, 2))
    nets = spline_pieces(polygon)
    assert nets.shape == (4, 4, 4)
    for f, g in pairwise(nets):
        before, after = (rational_jet(net, end, 3) for net, end in ((f, 1), (g, 0)))
        agree = np.abs(before.derivatives - after.derivatives).max(1) < 1e-12
        assert agree.tolist() == [True, True, True, False]
    assert (nets[0, 0, :2] == polygon[0]).all()
    assert (nets[-1, -1, :2] == polygon[-1]).all()
    with pytest.raises(ValueError, match="at least 4 points, found shape"):
        spline_pieces(polygon[:3])
    with pytest.raises(ValueError, match="points that coincide"):
        curved_section(polygon[[0, 0, 1, 2]], 1.0, 1.0)
