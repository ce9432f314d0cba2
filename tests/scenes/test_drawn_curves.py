"""Scenes of curves as pixels: dots where the formula puts them, lengths within a pixel."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest
from numpy.typing import NDArray
from seen import Seen

from reparam.geometry.nurbs import evaluate_curve
from reparam.scenes import palette
from reparam.scenes.figures.pythagorean import ENDS, interpolant
from reparam.scenes.figures.spline import KNOTS, POINTS
from reparam.scenes.layers import Color
from reparam.snapshot import Studio
from reparam.subject import open_subject

Array = NDArray[np.float64]

SIZE = (600, 400)
FIRST, SECOND = palette.PIECES[:2]
STEPS = np.linspace(0.0, 1.0, 11)


def check_dots(seen: Seen, at: Array, radius: float, color: Color) -> None:
    """Discs of that colour and radius (figure units) across a curve whose tangents are given by
    the neighbours: full a pixel and a half within the rim, gone as far beyond it."""
    way = np.gradient(at, axis=0)
    across = np.stack([-way[:, 1], way[:, 0]], -1) / np.hypot(*way.T)[:, None]
    inner, outer = (radius * seen.unit + k * seen.pixel for k in (-1.5, 1.5))
    for side in (-1.0, 1.0):
        assert seen.shows(at + side * inner * across, color).all()
        assert not seen.shows(at + side * outer * across, color).any()


def test_joins_on_the_diagonal(studio: Studio) -> None:
    """(7) and (8): ten steps of 1/30 each, then ten of 2/30; all of it is sqrt 2 long."""
    seen = Seen(studio, open_subject("joins"), SIZE, "physical")
    first, second = STEPS / 3.0, (1.0 + 2.0 * STEPS) / 3.0
    check_dots(seen, np.stack([first, first], -1)[:-1], 4.0, FIRST)
    check_dots(seen, np.stack([second, second], -1)[1:], 4.0, SECOND)
    ends = []
    for color, sign in ((FIRST, -1.0), (SECOND, 1.0)):
        at = seen.places(color)
        at = at[np.abs(at[:, 0] - at[:, 1]) < 4.0 * seen.unit]
        ends.append(float((sign * at.sum(-1)).max()) / np.sqrt(2.0) - 4.0 * seen.unit)
    assert sum(ends) == pytest.approx(np.sqrt(2.0), abs=2.0 * seen.pixel)


@pytest.mark.parametrize("space", ["corner", "straight"])
def test_cusp(studio: Studio, space: str) -> None:
    """(11): dots at (-1, 1) (1 - u)^2 and (1, 1) u^2; those of the sibling come from (-1, -1)."""
    seen = Seen(studio, open_subject("cusp").assigned(["u=2"]), SIZE, space)
    start = np.array([-1.0, 1.0 if space == "corner" else -1.0])
    arriving = ((1.0 - STEPS) ** 2)[:, None] * start
    leaving = (STEPS**2)[:, None] * np.ones(2)
    check_dots(seen, arriving[2:6], 3.6, FIRST)
    check_dots(seen, leaving[4:-1], 3.6, SECOND)


def test_pythagorean_dots(studio: Studio) -> None:
    """Seventeen dots at equal lengths by the closed form, found by bisection of its polynomial."""
    seen = Seen(studio, open_subject("pythagorean"), SIZE, "physical")
    curve = interpolant(ENDS)
    low, high = np.zeros(17), np.ones(17)
    wanted = np.linspace(0.0, curve.length, 17)
    for _ in range(50):
        middle = (low + high) / 2.0
        before = curve.arc_length(middle) < wanted
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    degree = len(curve.points) - 1
    basis = [comb(degree, i) * low**i * (1.0 - low) ** (degree - i) for i in range(degree + 1)]
    check_dots(seen, np.stack(basis, -1) @ curve.points, 4.0, palette.SAMPLES)


def test_the_spline_lies_where_its_basis_puts_it(studio: Studio) -> None:
    """De Boor's values at the middle of each span have that span's colour, and are 3 units wide."""
    seen = Seen(studio, open_subject("spline"), (600, 600), "physical")
    for k, (a, b) in enumerate(((0, 1), (1, 2), (2, 3), (3, 4))):
        t = np.linspace(a + 0.2, b - 0.2, 15)
        at = evaluate_curve(KNOTS, POINTS, 4, t)
        color = palette.PIECES[k % 3]
        assert seen.shows(at, color).mean() > 0.9  # a leg of the net may cross it
        way = np.gradient(at, axis=0)
        across = np.stack([-way[:, 1], way[:, 0]], -1) / np.hypot(*way.T)[:, None]
        beside = (1.5 * seen.unit + 1.5 * seen.pixel) * across
        assert not seen.shows(np.concatenate([at + beside, at - beside]), color).any()
