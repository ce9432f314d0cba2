"""Joins of patches: a known change of variables is found again, disturbances are seen."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest
from numpy.polynomial import polynomial

from reparam.geometry.body import Patch, body
from reparam.geometry.extraction import restricted
from reparam.geometry.merging import merging
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array, control_net, raise_degree
from reparam.geometry.patch_joins import fold, joins
from reparam.geometry.surface_spline import surface_spline

Poly = Array  # coefficients [i, j] of x^i y^j

# S(x, y) = (x, y, x^2/2 - xy + y^2/3 + x^3/4 - x y^2/5)
HEIGHT = np.zeros((4, 4))
HEIGHT[2, 0], HEIGHT[1, 1], HEIGHT[0, 2], HEIGHT[3, 0], HEIGHT[1, 2] = (
    1 / 2,
    -1.0,
    1 / 3,
    1 / 4,
    -0.2,
)
X, Y = np.zeros((2, 2)), np.zeros((2, 2))
X[1, 0] = Y[0, 1] = 1.0


def product(a: Poly, b: Poly) -> Poly:
    out = np.zeros((a.shape[0] + b.shape[0] - 1, a.shape[1] + b.shape[1] - 1))
    for (i, j), value in np.ndenumerate(a):
        out[i : i + b.shape[0], j : j + b.shape[1]] += value * b
    return out


def add(a: Poly, b: Poly) -> Poly:
    out = np.zeros(np.maximum(a.shape, b.shape))
    out[: a.shape[0], : a.shape[1]] += a
    out[: b.shape[0], : b.shape[1]] += b
    return out


def compose(f: Poly, x: Poly, y: Poly) -> Poly:
    total = np.zeros((1, 1))
    for (i, j), value in np.ndenumerate(f):
        if value:
            term = np.array([[value]])
            for factor in [x] * i + [y] * j:
                term = product(term, factor)
            total = add(total, term)
    return total


def bezier(coordinates: list[Poly], degree: int) -> Array:
    """The net (degree+1, degree+1, 4) of a polynomial surface."""
    points = np.zeros((degree + 1, degree + 1, 3))
    for k, f in enumerate(coordinates):
        for (i, j), value in np.ndenumerate(f):
            if value:
                for r in range(i, degree + 1):
                    for s in range(j, degree + 1):
                        rows = comb(r, i) / comb(degree, i) * comb(s, j) / comb(degree, j)
                        points[r, s, k] += value * rows
    return control_net(points)


# r(x, y) = (-(1 + y/2) x + (1 - y) x^2, y + (1/3 - y/4) x + x^2/5)
R_X = np.array([[0, 0], [-1, -0.5], [1, -1.0]])
R_Y = np.array([[0, 1], [1 / 3, -1 / 4], [1 / 5, 0.0]])
DEGREE = 7


def continued(change: float = 0.0, power: int = 2, sign: float = 1.0) -> Array:
    """S, and S + change * x^power composed with r: two nets joined along their edge x = 0."""
    other = HEIGHT.copy()
    other[power, 0] += change
    f = bezier([X, Y, HEIGHT], DEGREE)
    r_x = sign * R_X
    g = bezier([r_x, R_Y, compose(other, r_x, R_Y)], DEGREE)
    return np.stack([f, g])


def test_r_is_found_again() -> None:
    report = joins(continued())
    assert report.patches.tolist() == [[0, 1]]
    assert report.sides.tolist() == [[0, 0]]
    assert not report.reversed[0]
    t = np.linspace(0.0, 1.0, report.r.shape[2])
    for m in (1, 2, 3):
        for axis, f in enumerate((R_X, R_Y)):
            row = f[m] if m < len(f) else np.zeros(2)
            expected = polynomial.polyval(t, row) * [1, 1, 2, 6][m]
            assert np.abs(report.r[0, m - 1, :, axis] - expected).max() <= 1e-9, (m, axis)
    assert report.orders.tolist() == [3]
    assert report.beta.min() == pytest.approx(1.0)


@pytest.mark.parametrize(("power", "order"), [(1, 0), (2, 1), (3, 2)])
def test_a_disturbance_of_each_order_is_seen(power: int, order: int) -> None:
    report = joins(continued(1e-3, power))
    assert report.orders.tolist() == [order]
    assert report.gaps.max() <= 1e-15
    if power == 1:
        assert report.angles[0] == pytest.approx(np.degrees(1e-3), rel=0.2)


def test_a_surface_that_folds_back() -> None:
    report = joins(continued(sign=-1.0))
    assert report.orders.tolist() == [0]
    assert report.beta.max() < 0.0
    assert report.angles[0] == pytest.approx(180.0, abs=1e-6)


def test_every_pairing_of_sides() -> None:
    f, g = continued()
    flips = {0: lambda n: n, 1: lambda n: n[::-1], 2: lambda n: n.swapaxes(0, 1)}
    flips[3] = lambda n: n.swapaxes(0, 1)[:, ::-1]
    for one in range(4):
        for other in range(4):
            for backwards in (False, True):
                turned = g[:, ::-1] if backwards else g
                nets = np.stack([flips[one](f), flips[other](turned)])
                report = joins(nets)
                assert report.sides.tolist() == [[one, other]]
                assert report.reversed.tolist() == [backwards]
                assert report.orders.tolist() == [3]
                assert report.alpha[0, 0] == pytest.approx(1 / 3)
                mirrored = (one in (1, 2)) ^ (other in (1, 2)) ^ backwards
                assert report.opposed.tolist() == [not mirrored]


def test_surface_splines_have_the_change_of_variables_of_their_derivation() -> None:
    for name, n in (("cube", 3), ("icosahedron", 5), ("prism8", 8)):
        found = MESHES[name]()
        spline = surface_spline(found.topology, 0.5)
        report = joins(spline.nets(found.vertices), samples=9, highest=1)
        t = np.linspace(0.0, 1.0, report.r.shape[2])
        facet = spline.facet[report.patches]
        inner = (facet == n).all(1) & (report.sides[:, 0] % 2 == 0) & (report.sides[:, 1] % 2 == 0)
        inner &= report.sides[:, 0] != report.sides[:, 1]
        expected = 2.0 * np.cos(2.0 * np.pi / n) * (1.0 - t) ** 2
        assert inner.any()
        assert np.abs(report.beta[inner] - 1.0).max() <= 1e-12
        assert np.abs(report.alpha[inner] - expected).max() <= 1e-12


def test_poles_gaps_and_thrice_used_edges() -> None:
    t = np.linspace(0.0, 1.0, 2)
    square = control_net([[(x, y, 0) for y in t] for x in t])
    pole = square.copy()
    pole[0, :, :3] = [0.0, 0.5, 0.0]
    report = joins(pole[None])
    assert report.points == 1
    assert len(report.patches) == 0
    assert report.free.tolist() == [[0, 1], [0, 2], [0, 3]]
    apart = square + np.array([0.0, 1.0 + 1e-5, 0.0, 0.0])
    assert len(joins(np.stack([square, apart])).patches) == 0
    near = joins(np.stack([square, apart]), tolerance=1e-4)
    assert near.gaps[0] * near.size == pytest.approx(1e-5)
    three = np.stack([square] * 3)
    assert len(joins(three).patches) == 3 * 4


def test_mixed_degrees_and_weights() -> None:
    quarter = control_net([[(1, 0), (1, 1), (0, 1)]], [[1, 0.5**0.5, 1]])[0]
    rows = [quarter * [s, s, 1, 1] + quarter[:, 3:] * [0, 0, 1 - s, 0] for s in (1.0, 0.5)]
    ring = np.stack(rows)  # a cone: rational, exact circles
    line = np.stack([rows[1], 2 * rows[1] - rows[0]])
    both = body([Patch(ring), Patch(line)])
    report = joins(both.nets)
    assert report.orders.tolist() == [3]
    assert report.angles.max() <= 1e-10


def test_fold() -> None:
    flat = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
    rows = [(0, 0.0), (2, 0.0), (0, 1e-4)]  # there and back again, a little higher
    folded = control_net([[(x, 0, z), (x, 1, z)] for x, z in rows])
    assert fold(flat[None])[0] == pytest.approx(1.0)
    assert fold(folded[None], 31)[0] < 0.0


def patch_over(u: tuple[float, float], v: tuple[float, float]) -> Array:
    """A part of one surface z = f(x, y) over a rectangle: (4, 4, 4)."""
    corner = np.array([[u[0], v[0]]]), np.array([[u[1], v[1]]])
    whole = bezier([X, Y, HEIGHT], 3)
    return restricted(whole, *corner)[0]


def test_halves_and_quarters_of_an_edge() -> None:
    """Below, one patch; above it on its edge a half, the other way round, and two quarters."""
    half = patch_over((0.0, 0.5), (0.5, 1.0))[::-1, ::-1]
    quarters = [patch_over((0.5 + a, 0.75 + a), (0.5, 1.0)).swapaxes(0, 1) for a in (0.0, 0.25)]
    found = joins(np.stack([patch_over((0.0, 1.0), (0.0, 0.5)), half, *quarters]))
    rows = {
        (tuple(p), tuple(s), tuple(span[1]))
        for p, s, span in zip(
            found.patches.tolist(), found.sides.tolist(), found.spans.tolist(), strict=True
        )
    }
    assert rows == {
        ((1, 0), (3, 3), (0.0, 0.5)),
        ((2, 0), (0, 3), (0.5, 0.75)),
        ((3, 0), (0, 3), (0.75, 1.0)),
        ((2, 3), (3, 2), (0.0, 1.0)),
        ((1, 2), (0, 2), (0.0, 1.0)),
    }
    assert found.orders.min() == 3  # they are one surface
    assert found.gaps.max() < 1e-15
    assert found.angles.max() < 1e-12
    assert (0, 3) not in map(tuple, found.free.tolist())
    assert found.beta.min() > 0.0


def test_an_edge_that_is_covered_in_part_is_free_too() -> None:
    half = patch_over((0.0, 0.5), (0.5, 1.0))
    found = joins(np.stack([patch_over((0.0, 1.0), (0.0, 0.5)), half]))
    assert found.patches.tolist() == [[1, 0]]
    assert [0, 3] in found.free.tolist()
    tilted = half.copy()
    tilted[:, 1:, 2] += 0.01
    bent = joins(np.stack([patch_over((0.0, 1.0), (0.0, 0.5)), tilted]))
    assert bent.orders.tolist() == [0]
    assert bent.angles[0] > 1.0


@pytest.mark.parametrize("name", ["t_mesh", pytest.param("three_handles", marks=pytest.mark.slow)])
def test_a_merged_body_joins_at_its_t_junctions(name: str) -> None:
    found = MESHES[name]()
    spline = surface_spline(found.topology, 0.3)
    all_patches = joins(spline.nets(found.vertices), samples=9, highest=1)
    one = merging(spline)
    fewer = joins(one.nets(spline.nets(found.vertices)), samples=9, highest=1)
    assert np.ptp(fewer.spans[:, 1], axis=1).min() == 0.5
    assert (np.ptp(fewer.spans[:, 0], axis=1) == 1.0).all()
    assert fewer.angles.max() <= 1e-8
    assert fewer.gaps.max() <= 1e-15
    assert len(fewer.free) == len(all_patches.free) == 0
    lost = len(fewer.patches) + 4 * len(one.parts)  # four inner edges of each, and halves of outer
    assert lost <= len(all_patches.patches)


def test_patches_of_different_degrees() -> None:
    """A part of a cubic and one raised to degree 5 meet; `body` brings them to one degree."""
    left, right = patch_over((0.0, 0.5), (0.0, 1.0)), patch_over((0.5, 1.0), (0.0, 1.0))
    found = joins(body([Patch(left), Patch(raise_degree(right, 5, 4))]).nets)
    assert found.patches.tolist() == [[0, 1]]
    assert found.orders.tolist() == [3]
