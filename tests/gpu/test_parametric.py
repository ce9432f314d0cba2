"""Curves from formulas, and points traced at constant speed: the GPU against float64."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.arclength import ArcLength
from reparam.geometry.change import NAMED, named_change
from reparam.geometry.curve import circular_arc, curve_net, curve_points, speed
from reparam.geometry.parsing import parse
from reparam.snapshot import Studio

U = np.linspace(0.0, 1.0, 1001).astype(np.float32).astype(np.float64)
CLOSE = 1e-6


def on_gpu(studio: Studio, x: str, y: str = "u", w: float = 0.0, at: np.ndarray = U) -> np.ndarray:
    studio.ctx.__enter__()  # current, should there be another
    studio.ctx.extra.use()
    names = ("u", "w")
    buffer = studio.painter.evaluation.formulas(parse(x, names), parse(y, names), w, at)
    points = np.frombuffer(buffer.read(), np.float32).reshape(-1, 4)
    buffer.release()
    assert (points[:, 2:] == [0.0, 1.0]).all()
    return points[:, :2].astype(np.float64)


FORMULAS = [
    "cos(2 pi u)", "sin(2 pi u)", "tan(u)", "atan(8u - 4)", "2(8u-4)/(1+(8u-4)^2)", "u^3 - u^2/u",
    "(u - 1)^3", "sqrt(u)", "exp(-u)", "log(1 + u)", "(1+u)^1.5", "asin(u/2)", "acos(u/2)",
    "sinh(u)", "cosh(u)", "tanh(u)", "abs(u - .5)", "sign(u - .5)", "w sin(u) + (1-w) cos(20u)",
]  # fmt: skip


@pytest.mark.parametrize("text", FORMULAS)
def test_formulas(studio: Studio, text: str) -> None:
    found = on_gpu(studio, text, w=0.25)
    with np.errstate(all="ignore"):
        exact = parse(text, ("u", "w"))(u=U, w=0.25)
    usual = np.isfinite(exact)
    assert usual.sum() >= len(U) - 1
    assert np.abs(found[usual, 0] - exact[usual]).max() < CLOSE * max(
        1.0, np.abs(exact[usual]).max()
    )
    assert (found[:, 1] == U).all()


@pytest.mark.parametrize("name", NAMED)
def test_the_glsl_twin_of_each_change(studio: Studio, name: str) -> None:
    change = named_change(name)
    assert np.abs(on_gpu(studio, NAMED[name][0])[:, 0] - change.forward(U)).max() < CLOSE


def test_angles_far_from_zero(studio: Studio) -> None:
    at = np.linspace(-300.0, 300.0, 4001).astype(np.float32).astype(np.float64)
    found = on_gpu(studio, "cos(u)", "sin(u)", at=at)
    assert np.abs(found - np.stack([np.cos(at), np.sin(at)], -1)).max() < CLOSE


def traced(studio: Studio, net: np.ndarray, arc: ArcLength, at: np.ndarray) -> np.ndarray:
    studio.ctx.__enter__()  # current, should there be another
    studio.ctx.extra.use()
    table = arc.table() * [1.0, arc.length]
    buffer = studio.painter.evaluation.trace(net, table, at)
    points = np.frombuffer(buffer.read(), np.float32).reshape(-1, 4).astype(np.float64)
    buffer.release()
    return points[:, :3] / points[:, 3:]


def test_points_at_equal_lengths(studio: Studio) -> None:
    net = curve_net([[0, 0], [1, 2], [2, -2], [3, 1]], [1.0, 2.0, 0.5, 1.0])
    arc = ArcLength(lambda u: speed(net, u))
    at = np.linspace(0.0, 1.0, 101)
    exact = curve_points(net, arc.u(at * arc.length))
    assert np.abs(traced(studio, net, arc, at) - exact).max() < 1e-6


def test_a_curve_of_several_pieces(studio: Studio) -> None:
    arcs = np.stack([circular_arc(1.0, k * 1.5, k * 1.5 + 1.5) for k in range(4)])

    def speeds(u: np.ndarray) -> np.ndarray:
        piece = np.minimum(u.astype(int), 3)
        return np.choose(piece, [speed(net, u - piece) for net in arcs])

    arc = ArcLength(speeds, (0.0, 1.0, 2.0, 3.0, 4.0))
    assert abs(arc.length - 6.0) < 1e-14
    at = np.linspace(0.0, 1.0, 61)
    exact = np.stack([np.cos(6.0 * at), np.sin(6.0 * at), 0.0 * at], -1)
    assert (
        np.abs(traced(studio, arcs, arc, at) - exact).max() < 1e-6
    )  # no entry of the table falls on a joint
