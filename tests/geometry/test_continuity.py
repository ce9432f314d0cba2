"""Joints of curves: what is recovered exactly, what is refused, and at which order."""

from __future__ import annotations

from fractions import Fraction
from math import comb, factorial

import numpy as np
import pytest

from reparam.geometry.continuity import Joint, angle, bell, composed, join, join_curves
from reparam.geometry.jets import Jet, bezier_jet, jet, rational_jet, spline_jet
from reparam.geometry.singular import image_order

THIRD = Fraction(1, 3)
LEFT, RIGHT = [[0, 0, 1], [THIRD, THIRD, 1]], [[THIRD, THIRD, 1], [1, 1, 1]]  # (7), (8)
R = [Fraction(2, 3), Fraction(2, 5), Fraction(-18, 7), Fraction(0), Fraction(0)]
CUBIC = [[0, 0], [1, 2], [3, -1], [2, 5]]
CORNER = [[-1, 1, 1], [0, 0, 1], [0, 0, 1]], [[0, 0, 1], [0, 0, 1], [1, 1, 1]]  # (11)
SIBLING = [[-1, -1, 1], [0, 0, 1], [0, 0, 1]], CORNER[1]

Polynomial = list[Fraction]


def times(a: Polynomial, b: Polynomial) -> Polynomial:
    out = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            out[i + j] += x * y
    return out


def composition(points: list[list[int]], derivatives: list[Fraction]) -> list[list[Fraction]]:
    """Derivatives 0..5 at h = 0 of the Bezier curve of r(h), by multiplying polynomials."""
    r = [Fraction(0), *(x / factorial(m) for m, x in enumerate(derivatives, 1))]
    rest = [Fraction(1), *(-x for x in r[1:])]
    degree = len(points) - 1
    sums = [[Fraction(0)] * 6 for _ in range(len(points[0]))]
    for i, point in enumerate(points):
        basis = [Fraction(comb(degree, i))]
        for factor in [r] * i + [rest] * (degree - i):
            basis = times(basis, factor)
        for axis, x in enumerate(point):
            for m, coefficient in enumerate(basis[:6]):
                sums[axis][m] += x * coefficient
    return [[sums[axis][m] * factorial(m) for axis in range(len(sums))] for m in range(6)]


def test_derivatives_disagree_and_the_curve_is_smooth() -> None:
    """(7), (8): u/3 at twice the speed is (1+2u)/3; r(u) = (u-1)/2."""
    found = join_curves(LEFT, RIGHT, 9)
    assert found == Joint(9, "", (Fraction(1, 2), *[Fraction(0)] * 8))
    floats = join_curves(np.array(LEFT, float), np.array(RIGHT, float), 9)
    assert floats.order == 9
    assert floats.derivatives == pytest.approx([0.5] + [0.0] * 8, abs=1e-15)


def test_r_is_recovered_exactly() -> None:
    f, g = jet(composition(CUBIC, R)), bezier_jet(CUBIC, 0, 5)
    assert f.exact
    assert join(f, g) == Joint(5, "", tuple(R))
    rough = join(*(Jet(x.derivatives.astype(float), x.sizes.astype(float)) for x in (f, g)))
    assert rough.order == 5
    assert rough.derivatives == pytest.approx([float(x) for x in R], abs=1e-12)


def test_composed() -> None:
    g = bezier_jet(CUBIC, 0, 5)
    assert (composed(g, R).derivatives == np.array(composition(CUBIC, R))).all()
    floats = composed(
        Jet(g.derivatives.astype(float), g.sizes.astype(float)), [float(x) for x in R]
    )
    np.testing.assert_allclose(
        floats.derivatives, np.array(composition(CUBIC, R), float), rtol=1e-13, atol=1e-12
    )


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_a_disturbed_derivative_stops_there(order: int, exact: bool) -> None:
    derivatives = composition(CUBIC, R)
    derivatives[order][0] += Fraction(1, 1000)
    f, g = jet(derivatives), bezier_jet(CUBIC, 0, 5)
    if not exact:
        f, g = (Jet(x.derivatives.astype(float), x.sizes.astype(float)) for x in (f, g))
    found = join(f, g)
    assert found.order == order - 1
    assert found.derivatives == pytest.approx(tuple(float(x) for x in R[: order - 1]), abs=1e-12)
    assert found.reason.startswith(f"order {order} fails" if order > 1 else "the direction turns")


def test_reasons() -> None:
    apart = join_curves(LEFT, [[1, 1, 1], [2, 2, 1]])
    assert (apart.order, apart.reason) == (-1, "the ends are 0.943 apart")
    back = join_curves([[0, 0, 1], [1, 0, 1]], [[1, 0, 1], [0, 0, 1]])
    assert (back.order, back.turn) == (0, 180.0)
    assert back.reason == "the tangents are opposed: a cusp"
    bent = join_curves([[0, 0, 1], [1, 0, 1]], [[1, 0, 1], [2, 1, 1]])
    assert (bent.order, bent.reason) == (0, "the direction turns by 45 degrees")
    point = join_curves([[1, 0, 1], [1, 0, 1]], [[1, 0, 1], [2, 1, 1]])
    assert (point.order, point.exponents) == (0, (0, 1))
    with pytest.raises(ValueError, match="jets of order 5, found 3 and 5"):
        join(bezier_jet(CUBIC, 1, 3), bezier_jet(CUBIC, 0, 5))
    with pytest.raises(ValueError, match="one space, found dimensions 2 and 3"):
        join(bezier_jet(CUBIC, 1, 5), bezier_jet([[0, 0, 0], [1, 1, 1]], 0, 5))
    with pytest.raises(ValueError, match="finite"):
        join_curves([[0.0, np.nan, 1.0], [0.0, 0.0, 1.0]], LEFT)


def test_singular_ends_are_judged_by_the_image() -> None:
    """(11) turns by 90 degrees; its sibling runs straight on, though both derivatives vanish."""
    for convert in (lambda net: net, lambda net: np.array(net, float)):
        corner, straight = join_curves(*map(convert, CORNER)), join_curves(*map(convert, SIBLING))
        assert (corner.order, corner.turn, corner.exponents) == (0, 90.0, (2, 2))
        assert (straight.order, straight.turn, straight.exponents) == (5, 0.0, (2, 2))
        assert not straight.regular


def power_curve(powers: list[dict[int, Fraction]], degree: int) -> list[list[Fraction]]:
    """The Bezier points, with weight 1, of polynomials {power: coefficient} in h."""
    net = []
    for i in range(degree + 1):
        row = [
            sum((x * Fraction(comb(i, m), comb(degree, m)) for m, x in axis.items()), Fraction(0))
            for axis in powers
        ]
        net.append([*row, Fraction(1)])
    return net


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize(
    ("x", "y", "order"),
    [
        ({2: 3, 3: 1}, {}, 5),  # a line, however it is run through
        ({2: 1}, {4: 1}, 1),  # the parabola y = x^2 continues a line with G1 alone
        ({2: 1}, {3: 1}, 1),  # y = x^(3/2): a half of the semicubical parabola
        ({2: 1}, {5: 1}, 2),  # y = x^(5/2)
        ({3: 1}, {7: 1}, 2),  # y = x^(7/3)
        ({2: 1, 3: 1}, {8: 1}, 3),  # y = x^4, told from h^8 only after a change of variables
    ],
)
def test_images_beside_a_line(
    x: dict[int, int], y: dict[int, int], order: int, exact: bool
) -> None:
    """The piece (x(h), y(h)) leaves where the line y = 0 arrives."""
    powers = [{m: Fraction(c) for m, c in axis.items()} for axis in (x, y)]
    net, line = power_curve(powers, 8), [[-1, 0, 1], [0, 0, 1]]
    if exact:
        found = join_curves(line, net)
    else:
        found = join_curves(np.array(line, float), np.array(net, float))
    assert found.order == order
    backwards = [[-p[0], p[1], p[2]] for p in net[::-1]]  # the mirror image arrives
    assert join_curves(backwards, [[0, 0, 1], [1, 0, 1]]).order == order


def test_singular_halves_of_one_parabola() -> None:
    """y = x^2 arrives as (-h^2, h^4), slowing down, and leaves as (2 h^3 + h^4, (2 h^3 + h^4)^2):
    one smooth curve. With another curvature only the tangents agree."""
    arrives = power_curve([{2: Fraction(-1)}, {4: Fraction(1)}], 4)[::-1]
    two, one, four = Fraction(2), Fraction(1), Fraction(4)
    leaves = power_curve([{3: two, 4: one}, {6: four, 7: four, 8: one}], 8)
    assert join_curves(arrives, leaves).order == 5
    assert join_curves(np.array(arrives, float), np.array(leaves, float)).order == 5
    leaves = power_curve([{3: two, 4: one}, {6: four, 7: four, 8: two}], 8)
    found = join_curves(arrives, leaves)
    assert (found.order, found.exponents) == (2, (2, 3))
    assert found.reason == "order 3 fails: the image bends like s^(8/3)"


def test_regular_joints_have_regular_images() -> None:
    """At regular ends the image and the derivatives of r give the same order."""
    random = np.random.default_rng(3)
    for order in range(2, 6):
        derivatives = composition(CUBIC, R)
        derivatives[order][1] += Fraction(int(random.integers(1, 9)))
        f, g = jet(derivatives), bezier_jet(CUBIC, 0, 5)
        assert image_order(f, g, (1, 1), 5, 0.0)[0] == join(f, g).order == order - 1


def test_pieces_of_one_rational_curve() -> None:
    """A circle's arc cut in two, and a spline of its own pieces: smooth to every order."""
    h, cut = np.pi / 5, 0.3
    corner = [np.cos(h), np.sin(h), np.cos(h)]
    arc = np.array([[1.0, 0.0, 1.0], corner, [np.cos(2 * h), np.sin(2 * h), 1.0]])
    legs = (1 - cut) * arc[:-1] + cut * arc[1:]
    middle = (1 - cut) * legs[0] + cut * legs[1]
    first, second = np.array([arc[0], legs[0], middle]), np.array([middle, legs[1], arc[2]])
    found = join_curves(first, second)
    assert found.order == 5
    assert found.derivatives[0] == pytest.approx(cut / (1 - cut), abs=1e-14)
    assert found.derivatives[1:] == pytest.approx([0.0] * 4, abs=1e-9)
    far = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1e6, -3e6, 1.0]])
    assert join_curves(first @ far, second @ far, 2).order == 2
    assert join_curves(first, second @ np.diag([1.0, 1.0 + 1e-6, 1.0]), 2).order < 2
    x, y = middle[:2] / middle[2]
    larger = np.array([[1.3, 0.0, 0.0], [0.0, 1.3, 0.0], [-0.3 * x, -0.3 * y, 1.0]])
    assert join_curves(first, second @ larger).order == 1  # a circle through the same tangent


def cox_de_boor(knots: list[Fraction], degree: int, i: int, t: Fraction) -> Fraction:
    """The basis function N_i, right-continuous, by its definition."""
    if degree == 0:
        return Fraction(knots[i] <= t < knots[i + 1])
    value = Fraction(0)
    if knots[i + degree] > knots[i]:
        share = (t - knots[i]) / (knots[i + degree] - knots[i])
        value += share * cox_de_boor(knots, degree - 1, i, t)
    if knots[i + degree + 1] > knots[i + 1]:
        share = (knots[i + degree + 1] - t) / (knots[i + degree + 1] - knots[i + 1])
        value += share * cox_de_boor(knots, degree - 1, i + 1, t)
    return value


def test_spline_jets() -> None:
    """At a knot of multiplicity m a cubic has 3 - m derivatives from both sides, and no more."""
    knots = [Fraction(x) for x in (0, 0, 0, 0, 1, 3, 3, 4, 6, 6, 6, 7)]
    points = [[0, 0], [1, 3], [2, -1], [4, 4], [5, 0], [7, 2], [8, 8], [9, 1]]
    for t in map(Fraction, ("1/2", "1", "2", "3", "7/2", "5")):
        exact = sum(np.array(p) * cox_de_boor(knots, 3, i, t) for i, p in enumerate(points))
        right = spline_jet(knots, points, t, 3, "right")
        assert (right.derivatives[0] == exact).all()
        left = spline_jet(knots, points, t, 3, "left")
        common = {Fraction(1): 2, Fraction(3): 1}.get(t, 3)
        agree = (left.derivatives == right.derivatives).all(1)
        assert agree.tolist() == [m <= common for m in range(4)]
        assert join(left, right, 3).order == common
    nurbs = np.array([[2 * x, 2 * y, 2] for x, y in points], float)
    lifted = spline_jet(np.array(knots, float), nurbs, 3.0, 3, "right", rational=True)
    plain = spline_jet(knots, points, 3, 3, "right")
    np.testing.assert_allclose(lifted.derivatives, plain.derivatives.astype(float), atol=1e-13)
    with pytest.raises(ValueError, match="piece on its right, found 6"):
        spline_jet(knots, points, 6, 3, "right")
    with pytest.raises(ValueError, match="knots that do not decrease"):
        spline_jet([0, 0, 2, 1], [[0, 0], [1, 1]], 1, 1, "left")


def test_rational_jets_against_differences() -> None:
    random = np.random.default_rng(7)
    net = np.concatenate([random.normal(size=(5, 3)), random.uniform(0.5, 2.0, (5, 1))], -1)
    exact = [[Fraction(x) for x in row] for row in net.tolist()]
    basis = [lambda t, i=i: comb(4, i) * t**i * (1 - t) ** (4 - i) for i in range(5)]

    def at(t: Fraction) -> list[Fraction]:
        total = [sum(b(t) * row[c] for b, row in zip(basis, exact, strict=True)) for c in range(4)]
        return [x / total[3] for x in total[:3]]

    step = Fraction(1, 10**8)
    values = [at(1 - k * step) for k in range(4)]
    for m in range(4):
        found = rational_jet(net, 1, 3).derivatives[m]
        differences = [
            float(sum((-1) ** k * comb(m, k) * values[k][axis] for k in range(m + 1)) / step**m)
            for axis in range(3)
        ]
        np.testing.assert_allclose(found, differences, rtol=1e-4, atol=1e-4)
        as_fractions = rational_jet(exact, 1, 3).derivatives[m].astype(float)
        np.testing.assert_allclose(found, as_fractions, rtol=1e-11, atol=1e-11)


def test_bell_polynomials() -> None:
    """B_{4,2} = 3 x_2^2 + 4 x_1 x_3, and Stirling's numbers for x = (1, 1, ...)."""
    assert bell([2, 3, 5, 7], 4) == [0, 7, 3 * 9 + 4 * 10, 6 * 4 * 3, 16]
    assert bell([1] * 5, 5) == [0, 1, 15, 25, 10, 1]


def test_angles_below_what_arccos_sees() -> None:
    for small in (1e-3, 1e-8, 1e-14):
        turned = [np.cos(small), np.sin(small)]
        assert angle([2.0, 0.0], turned) == pytest.approx(np.degrees(small), rel=1e-9)
