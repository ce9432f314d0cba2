"""Control nets: what is accepted, what is refused and with which words, raising the degree."""

from __future__ import annotations

from fractions import Fraction

import exact
import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate
from reparam.geometry.net import (
    LARGEST,
    MAX_ORDER,
    SMALLEST_WEIGHT,
    Array,
    bounding_box,
    check_net,
    control_net,
    raise_degree,
)

random = np.random.default_rng(4)
GRID = np.meshgrid(np.linspace(0.0, 1.0, 6), np.linspace(0.0, 1.0, 6), indexing="ij")


def changed(index: tuple[int, ...], value: float) -> Array:
    net = np.ones((3, 4, 4))
    net[index] = value
    return net


def test_control_net_premultiplies() -> None:
    points, weights = random.normal(size=(2, 3, 4, 3)), random.uniform(0.5, 2.0, (2, 3, 4))
    net = control_net(points, weights)
    assert (net[..., :3] == points * weights[..., None]).all()
    assert (net[..., 3] == weights).all()
    assert control_net(points[..., :2])[0, 0, 1].tolist() == [*points[0, 0, 1, :2], 0.0, 1.0]
    assert control_net(points.tolist()).dtype == np.float64


@pytest.mark.parametrize("shape", [(3, 3), (2, 2, 4), (2, 2, 1)])
def test_control_net_refuses_shapes(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"\(..., m, n, 2 or 3\), found \(" + str(shape[0])):
        control_net(np.ones(shape))
    with pytest.raises(ValueError, match=r"weights of shape \(2, 3\), found \(3, 2\)"):
        control_net(np.ones((2, 3, 3)), np.ones((3, 2)))


@pytest.mark.parametrize(
    ("net", "message"),
    [
        (np.ones((3, 4)), r"shape \(..., m, n, 4\), found \(3, 4\)"),
        (np.ones((3, 3, 3)), r"shape \(..., m, n, 4\), found \(3, 3, 3\)"),
        (np.ones((0, 3, 4)), "an order from 1 to 32, found 0"),
        (np.ones((3, 0, 4)), "an order from 1 to 32, found 0"),
        (np.ones((3, MAX_ORDER + 1, 4)), "an order from 1 to 32, found 33"),
        (np.ones((MAX_ORDER + 1, 3, 4)), "an order from 1 to 32, found 33"),
        (changed((1, 2, 0), np.nan), r"net\[1, 2, 0\]: expected a finite number, found nan"),
        (changed((2, 3, 3), np.inf), r"net\[2, 3, 3\]: expected a finite number, found inf"),
        (changed((0, 1, 2), -1.1e18), r"net\[0, 1, 2\]: .*size up to 1e\+18, found -1.1e\+18"),
        (changed((1, 1, 3), 1.1e18), r"net\[1, 1, 3\]: .*size up to 1e\+18, found 1.1e\+18"),
        (changed((2, 1, 3), -0.5), r"net\[2, 1\]: expected a weight of at least 0, found -0.5"),
        (changed((1, 1, 3), 1e-19), r"net\[1, 1\]: expected a weight of 0 or .*, found 1e-19"),
        (changed((0, 0, 3), 0.0), r"net\[0, 0\]: expected a positive weight at the corner"),
        (changed((0, 3, 3), 0.0), r"net\[0, 3\]: expected a positive weight at the corner"),
        (changed((2, 0, 3), 0.0), r"net\[2, 0\]: expected a positive weight at the corner"),
        (changed((2, 3, 3), 0.0), r"net\[2, 3\]: expected a positive weight at the corner"),
    ],
)
def test_refused(net: Array, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_net(net)


def test_refused_after_the_division() -> None:
    net = changed((1, 2, 3), 1e-10)
    net[1, 2, 1] = 2e8
    with pytest.raises(ValueError, match=r"net\[1, 2, 1\]: .*size up to 1e\+18, found 2e\+18"):
        check_net(net)


def test_first_offender_is_named_among_stacked_nets() -> None:
    nets = np.ones((4, 2, 3, 4))
    nets[2, 1, 0, 1] = nets[3, 0, 0, 0] = np.nan
    with pytest.raises(ValueError, match=r"net\[2, 1, 0, 1\]"):
        check_net(nets)


@pytest.mark.parametrize(
    "net",
    [
        np.ones((1, 1, 4)),
        np.ones((MAX_ORDER, MAX_ORDER, 4)),
        changed((1, 1, 0), LARGEST),
        changed((0, 2, 3), 0.0),
        changed((1, 1, 3), 0.0),
        np.full((2, 2, 4), SMALLEST_WEIGHT),
        np.ones((5, 2, 2, 4)) * [0.0, 0.0, 0.0, 1.0],
    ],
)
def test_limits_are_accepted(net: Array) -> None:
    assert (check_net(net) == net).all()


@pytest.mark.parametrize("to", [(2, 3), (3, 3), (5, 4), (9, 16)])
def test_raising_the_degree_keeps_the_map(to: tuple[int, int]) -> None:
    nets = exact.random_net(random, 2, 3, 4)
    raised = raise_degree(nets, *to)
    assert raised.shape == (4, to[0] + 1, to[1] + 1, 4)
    np.testing.assert_allclose(evaluate(raised, *GRID), evaluate(nets, *GRID), atol=1e-14)
    corners = np.ix_(range(4), [0, -1], [0, -1])
    assert (raised[corners] == nets[corners]).all()


def test_raised_line_is_equation_5_36() -> None:
    net = np.array([[[0.0, 8.0, -3.0, 1.0]], [[9.0, 2.0, 5.0, 2.0]], [[3.0, 4.0, 0.25, 4.0]]])
    expected = [
        [Fraction(i, 3) * Fraction(a) + (1 - Fraction(i, 3)) * Fraction(b) for a, b in pairs]
        for i, pairs in ((k, zip(net[k - 1, 0], net[k, 0], strict=True)) for k in (1, 2))
    ]
    raised = raise_degree(net, 3, 0)
    assert raised.shape == (4, 1, 4)
    np.testing.assert_allclose(raised[1:3, 0], np.array(expected, float), rtol=1e-15)


def test_edges_do_not_depend_on_direction_or_on_the_rest() -> None:
    first, second = exact.random_net(random, 3, 2), exact.random_net(random, 4, 3)
    second[0] = first[::-1, 2]
    other = second.copy()
    other[1:] += 1.0
    a, b, c = (raise_degree(net, 7, 7) for net in (first, second, other))
    assert (a[::-1, -1] == b[0]).all()
    assert (b[0] == c[0]).all()
    assert (raise_degree(first[::-1, ::-1], 7, 7)[::-1, ::-1] == a).all()
    assert (raise_degree(first.swapaxes(0, 1), 7, 7).swapaxes(0, 1)[0] == a[0]).all()


def test_no_lower_degree() -> None:
    net = exact.random_net(random, 3, 2)
    assert (raise_degree(net, 1, 1) == net).all()


def test_bounding_box() -> None:
    box = bounding_box(np.array([[[1.0, -2.0], [0.0, 5.0]], [[-4.0, 0.0], [2.0, 2.0]]]))
    assert box.tolist() == [[-4.0, -2.0], [2.0, 5.0]]
