"""The spline scene: what is drawn is the spline, what a hand does to knots, what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from seen import Seen

from reparam.errors import UsageError
from reparam.geometry.curve import curve_points
from reparam.scenes import palette
from reparam.scenes.figures.spline import KNOTS, POINTS, STRIP
from reparam.scenes.layers import Curves, Handles, Polylines
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject


def subject(*words: str, **values: Any) -> Subject:
    found = open_subject("spline").assigned(words)
    for name, value in values.items():
        found = found.changed(name, value)
    return found


def layers(shown: Subject, space: int, kind: type) -> list[Any]:
    return [layer for layer in shown.figure().spaces[space].layers if isinstance(layer, kind)]


def cox_de_boor(knots: np.ndarray, order: int, i: int, t: float) -> float:
    if order == 1:
        return float(knots[i] <= t < knots[i + 1])
    value, degree = 0.0, order - 1
    if knots[i + degree] > knots[i]:
        share = (t - knots[i]) / (knots[i + degree] - knots[i])
        value += share * cox_de_boor(knots, degree, i, t)
    if knots[i + order] > knots[i + 1]:
        share = (knots[i + order] - t) / (knots[i + order] - knots[i + 1])
        value += share * cox_de_boor(knots, degree, i + 1, t)
    return value


def test_the_pieces_are_the_spline() -> None:
    """Against the definition of the basis functions, with weights, on unclamped knots."""
    knots = np.array([0, 0.5, 1, 2, 3, 3, 4, 5, 6, 7, 7.5, 9])
    weights = np.array([1, 2, 0.5, 3, 1, 0.2, 1, 1])
    shown = subject(knots=knots, weights=weights)
    drawn = {k: layer.net for k, layer in enumerate(layers(shown, 0, Curves))}
    intervals = [(2.0, 3.0), (3.0, 4.0), (4.0, 5.0), (5.0, 6.0)]
    for k, (low, high) in enumerate(intervals):
        for t in (0.0, 0.3, 0.9):
            at = low + t * (high - low)
            basis = np.array([cox_de_boor(knots, 4, i, at) for i in range(8)]) * weights
            found = curve_points(drawn[k % 3][k // 3], t)[0]
            assert found[:2] == pytest.approx(basis @ POINTS / basis.sum(), abs=1e-13)


def test_pieces_have_their_colours_in_turn(studio: Studio) -> None:
    seen = Seen(studio, subject("times=0"), (400, 200))  # the strip is the last space
    for k, color in enumerate(palette.PIECES):
        x = seen.places(color)[:, 0] / STRIP * 4.0
        inside = (np.floor(x).astype(int) % 3 == k) | (np.abs(x - np.round(x)) < 0.05)
        assert len(x) > 20
        assert inside.all()


def test_insertion_shows_both_nets() -> None:
    once = subject("times=1", "insert=0.5")
    old, new = layers(once, 0, Polylines)
    assert (old.points[:, :2] == POINTS).all()
    assert len(new.points) == len(POINTS) + 1
    assert old.color == palette.GUIDE
    told = once.figure().caption[1]
    assert told.startswith("inserted once at 2: 9 control points, and the curve changes by ")
    assert float(told.split()[-1]) < 1e-14
    full = subject("times=3", "insert=0")
    assert full.figure().caption[1].startswith("no room for the knot: ")


def handles(shown: Subject, space: int) -> Handles:
    (found,) = layers(shown, space, Handles)
    return found


def test_knots_are_dragged_between_their_neighbours() -> None:
    shown = subject()
    strip = handles(shown, 1)

    def dragged(index: int, to: float) -> list[float]:
        point = np.array([to / 4.0 * STRIP, -5.0, 0.0])
        return list(strip.drag(shown.values, index, point)["knots"])

    assert dragged(5, 2.5)[5] == 2.5
    assert dragged(5, 2.96)[5] == 3.0  # near another knot it becomes equal to it
    assert dragged(5, 3.7)[5] == 3.0
    assert dragged(6, 2.5)[6:8] == [2.5, 3.0]  # of two the upper one goes left
    assert dragged(6, 3.5)[6:8] == [3.0, 3.0]
    assert dragged(7, 3.5)[6:8] == [3.0, 3.5]
    assert dragged(0, -1.0)[:4] == [-1.0, 0.0, 0.0, 0.0]
    assert dragged(11, 5.0)[8:] == [4.0, 4.0, 4.0, 5.0]


@pytest.mark.parametrize("weights", [(), (1, 2, 0.5, 3, 1, 0.2, 1, 1)])
def test_a_click_on_a_knot_inserts_it(weights: tuple[float, ...]) -> None:
    shown = subject(weights=np.array(weights))
    click = handles(shown, 1).click
    assert click is not None
    changes = click(shown.values, 4)
    assert changes["knots"].tolist() == [*KNOTS[:4], 1, *KNOTS[4:]]
    again = shown
    for name, value in changes.items():
        again = again.changed(name, value)
    assert len(again.value("weights")) == (9 if weights else 0)
    before, after = (np.concatenate([x.net for x in layers(s, 0, Curves)]) for s in (shown, again))
    assert before == pytest.approx(after, abs=1e-14)
    with pytest.raises(ValueError, match="a knot at most 4 times"):
        click(shown.values, 0)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("knots=[0,0,1,1]", "at least 10 knots for 8 control points, found 4"),
        ("knots=[0,0,0,0,2,1,3,3,4,4,4,4]", "knots that do not decrease, found 2, 1 at 4"),
        ("weights=[1,1]", "weights: expected 8 or none, found 2"),
        ("weights=[1,1,1,1,-1,1,1,1]", "a weight of at least 0"),
        ("points=[]", "points: expected at least two control points, found 0"),
    ],
)
def test_refused(words: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        subject(words).figure()


def test_any_order() -> None:
    assert (
        subject("points=[[0,0],[1,1]]", "knots=[0,0,1,1]")
        .figure()
        .caption[0]
        .startswith("order 2: 2 control points, 4 knots, 1 ")
    )
