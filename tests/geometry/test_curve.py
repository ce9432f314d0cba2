"""Bezier curves in float64: against closed forms and finite differences."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from reparam.geometry.curve import (
    circular_arc,
    curvature,
    curve_derivatives,
    curve_net,
    curve_points,
    speed,
)

T = np.linspace(0.0, 1.0, 17)


def test_a_parabola_and_its_derivatives() -> None:
    net = curve_net([[0, 0], [0.5, 0], [1, 1]])
    zero, one, two = (0 * T, 1 + 0 * T, 2 + 0 * T)
    expected = [[T, T * T, zero], [one, 2 * T, zero], [zero, two, zero], [zero, zero, zero]]
    found = curve_derivatives(net, T, 3)
    assert np.abs(found - np.moveaxis(np.array(expected), 1, -1)).max() < 1e-14
    assert np.abs(speed(net, T) - np.sqrt(1 + 4 * T * T)).max() < 1e-14


def test_an_arc_is_round() -> None:
    arc = circular_arc(2.0, 0.3, 0.3 + 0.9 * pi)
    assert np.abs(np.linalg.norm(curve_points(arc, T), axis=-1) - 2.0).max() < 1e-15 * 4
    assert np.abs(curvature(arc, T) - 0.5).max() < 1e-12
    assert np.abs(curvature(arc[::-1], T) + 0.5).max() < 1e-12
    for turn in (pi, -pi, 0.0, float("nan")):
        with pytest.raises(ValueError, match="less than half a turn"):
            circular_arc(1.0, 0.0, turn)


def test_derivatives_of_a_rational_curve() -> None:
    net = curve_net([[0, 0, 1], [1, 2, 0], [3, 1, 4], [4, -1, 2]], [1.0, 3.0, 0.5, 2.0])
    h = 1e-5
    t = T[1:-1]
    derivatives = curve_derivatives(net, t, 2)
    before, after = curve_derivatives(net, t - h, 2), curve_derivatives(net, t + h, 2)
    assert np.abs((after - before)[:2] / (2 * h) - derivatives[1:]).max() < 1e-6


def test_curves_of_one_order_go_together() -> None:
    points = np.random.default_rng(3).uniform(-1, 1, (5, 4, 3))
    nets = curve_net(points)
    assert nets.shape == (5, 4, 4)
    together = curve_derivatives(nets, T, 2)
    assert together.shape == (3, 5, 17, 3)
    assert np.array_equal(together[:, 2], curve_derivatives(nets[2], T, 2))


def test_bad_points() -> None:
    with pytest.raises(ValueError, match="expected points of shape"):
        curve_net([1.0, 2.0])
    with pytest.raises(ValueError, match="a finite number"):
        curve_net([[0, 0], [1, float("inf")]])
    with pytest.raises(ValueError, match="a weight"):
        curve_net([[0, 0], [1, 1], [2, 0]], [1.0, -1.0, 1.0])
