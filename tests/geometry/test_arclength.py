"""Arc length: closed forms, near and at a cusp, and points at equal lengths."""

from __future__ import annotations

from math import asinh, atan, sqrt

import numpy as np
import pytest

from reparam.geometry.arclength import ArcLength, polygon_length
from reparam.geometry.curve import circular_arc, curve_net, curve_points, speed

CURVES = {
    "line": [[0, 0], [1, 1]],
    "parabola": [[0, 0], [0.5, 0], [1, 1]],
    "S": [[0, 0], [1, 1], [2, -1], [3, 0]],
    "near a cusp": [[0, 0], [1.02, 1], [-0.02, 1], [1, 0]],
    "cusp": [[0, 0], [1, 1], [0, 1], [1, 0]],
    "starts at rest": [[0, 0], [0, 0], [1, 1]],
    "wild": [[np.cos(7.0 * k**1.5), np.sin(5.0 * k)] for k in range(14)],
}


def arc(name: str) -> ArcLength:
    net = curve_net(CURVES[name])
    return ArcLength(lambda u: speed(net, u))


def test_closed_forms() -> None:
    parabola = sqrt(5.0) / 2.0 + asinh(2.0) / 4.0  # (x, x^2) from 0 to 1
    assert abs(arc("parabola").length - parabola) < 1e-15
    assert abs(arc("line").length - sqrt(2.0)) < 1e-15
    quarter = circular_arc(3.0, 0.2, 0.2 + np.pi / 2.0)
    assert abs(ArcLength(lambda u: speed(quarter, u)).length - 1.5 * np.pi) < 1e-14
    stereographic = ArcLength(lambda t: 2.0 / (1.0 + t * t), (-4.0, 4.0))
    assert abs(stereographic.length - 4.0 * atan(4.0)) < 1e-14
    assert abs(float(stereographic.s(np.array([1.0]))[0]) - 2.0 * (atan(4.0) + atan(1.0))) < 1e-14


@pytest.mark.parametrize("name", CURVES)
def test_equal_lengths(name: str) -> None:
    curve = arc(name)
    u = curve.spaced(1001)
    assert (np.diff(u) > 0.0).all()
    assert np.abs(np.diff(curve.s(u)) - curve.length / 1000).max() < 1e-14 * curve.length
    chords = curve_points(curve_net(CURVES[name]), np.linspace(0.0, 1.0, 200_001))
    assert abs(float(polygon_length(chords)) - curve.length) < 1e-8 * curve.length


def test_inverse_of_each_other() -> None:
    for name in CURVES:
        curve = arc(name)
        s = np.random.default_rng(2).uniform(0.0, curve.length, 200)
        assert np.abs(curve.s(curve.u(s)) - s).max() < 1e-14 * curve.length
        assert curve.u([-1.0, 1e9]).tolist() == [0.0, 1.0]


def test_breaks() -> None:
    def speeds(u: np.ndarray) -> np.ndarray:  # 1 on [0, 1), 3 on [1, 2]
        return np.where(u < 1.0, 1.0, 3.0)

    curve = ArcLength(speeds, (0.0, 1.0, 2.0))
    assert abs(curve.length - 4.0) < 1e-15
    assert np.abs(curve.u([0.5, 1.0, 2.5]) - [0.5, 1.0, 1.5]).max() < 1e-15
    with pytest.raises(ValueError, match="increasing breaks"):
        ArcLength(speeds, (0.0, 0.0, 1.0))
    with pytest.raises(ValueError, match="finite speed"):
        ArcLength(lambda u: u + np.inf)


def test_a_curve_that_is_a_point() -> None:
    point = ArcLength(lambda u: 0.0 * u)
    assert point.length == 0.0
    assert np.isfinite(point.spaced(5)).all()
    assert np.isfinite(point.table()).all()


@pytest.mark.parametrize("name", ["parabola", "S", "near a cusp"])
def test_the_table_is_enough_to_trace_with(name: str) -> None:
    """Cubic Hermite interpolation of the table, as the GPU does it."""
    curve = arc(name)
    table = curve.table()
    at = np.random.default_rng(1).uniform(0.0, len(table) - 1, 500)
    k, h = np.floor(at).astype(int), curve.length / (len(table) - 1)
    x = at - k
    (u0, d0), (u1, d1) = table[k].T, table[k + 1].T
    u = (1 + 2 * x) * (1 - x) ** 2 * u0 + x * x * (3 - 2 * x) * u1
    u += h * x * (1 - x) * ((1 - x) * d0 - x * d1)
    off = np.abs(curve.s(u) - at * h).max() / curve.length
    assert off < (5e-4 if name == "near a cusp" else 1e-9)
