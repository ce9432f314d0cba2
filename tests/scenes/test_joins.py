"""The scenes of joints: what they tell, what a hand changes, what they refuse."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.geometry.curve import curve_points
from reparam.scenes.figures.cusp import pieces
from reparam.scenes.figures.joins import PRESETS
from reparam.scenes.layers import Curves, Handles
from reparam.subject import Subject, open_subject


def subject(*words: str) -> Subject:
    return open_subject("joins").assigned(words)


def told(*words: str) -> tuple[str, ...]:
    return subject(*words).figure().caption


def test_what_is_told() -> None:
    first, second = told()
    assert first == "the derivatives disagree: |f′(1)| = 0.4714, |g′(0)| = 0.9428"
    assert second == "joined G5 at least: r′, r″, … = 0.5, 0, 0, 0, 0"
    assert told("speed=0.5")[0].startswith("the derivatives agree")
    # a rational change of variables: r = u / (s - (s - 1) u) backwards has r'' too
    assert told("speed=2")[1].startswith("joined G5 at least: r′, r″, … = 0.25, 0.125, ")
    assert told("pieces=arch")[1] == "joined G5 at least: r′, r″, … = 0.5, 0, 0, 0, 0"
    assert told("pieces=bend")[1].startswith("joined G1: r′, r″, … = 0.8; order 2 fails, by ")
    assert told("pieces=corner")[1] == "joined G0; the direction turns by 68.1986 degrees"
    assert told("first=[[0,0],[1,1]]")[1] == "the pieces do not meet: the ends are 0.943 apart"
    back = ("first=[[0,0],[1,0]]", "second=[[1,0],[0,0]]")
    assert told(*back)[1] == "joined G0; the tangents are opposed: a cusp"
    stops = ("first=[[0,0],[1,0],[1,0]]", "second=[[1,0],[3,0]]")
    assert told(*stops)[1] == "the image is G5 at least"


@pytest.mark.parametrize("pieces", PRESETS)
def test_the_speed_leaves_the_image(pieces: str) -> None:
    """Each point of the faster piece is a point of the other, where u -> s u / (1 - u + s u)."""

    def nets(speed: str) -> list[np.ndarray]:
        layers = subject(f"pieces={pieces}", speed).figure().spaces[0].layers
        return [layer.net for layer in layers if isinstance(layer, Curves)]

    (f, g), (same, faster) = nets("speed=1"), nets("speed=3")
    t = np.linspace(0.0, 1.0, 21)
    assert (f == same).all()
    there = 3.0 * t / (1.0 - t + 3.0 * t)
    assert curve_points(faster, t) == pytest.approx(curve_points(g, there), abs=1e-14)


def test_dragging() -> None:
    shown = subject()
    layer = next(x for x in shown.figure().spaces[0].layers if isinstance(x, Handles))
    assert layer.names == ("f0", "f1", "g0", "g1")
    changes = layer.drag(shown.values, 2, np.array([0.5, 0.2, 0.0]))  # the joint goes whole
    assert changes["first"].tolist()[1] == changes["second"].tolist()[0] == [0.5, 0.2]
    for name, value in changes.items():
        shown = shown.changed(name, value)
    assert shown.figure().caption[1].startswith("joined G0; the direction turns by 36.")
    layer = next(x for x in shown.figure().spaces[0].layers if isinstance(x, Handles))
    assert layer.at[:, :2].tolist() == [[0, 0], [0.5, 0.2], [0.5, 0.2], [1, 1]]


def test_one_point_is_refused() -> None:
    with pytest.raises(UsageError, match="at least two control points of each piece, found one"):
        told("first=[[0,0]]")


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0, 180.0])
def test_cusp(turn: float) -> None:
    figure = open_subject("cusp").changed("turn", turn).figure()
    expected = {
        0.0: "first: the image is G5 at least;",
        180.0: "first: the image is G0; the tangents are opposed: a cusp;",
    }.get(turn, f"first: the image is G0; the direction turns by {turn:g} degrees;")
    assert figure.caption[1] == f"{expected}  its sibling: the image is G5 at least"


def test_the_curve_that_turns_comes_from_one_side() -> None:
    """From (-1, -1) straight on to (-1, 1) at a right angle and to (1, 1) and back."""
    for degrees, start in ((0.0, (-1, -1)), (90.0, (-1, 1)), (180.0, (1, 1))):
        for near in (degrees, min(degrees + 1e-9, 180.0), max(degrees - 1e-9, 0.0)):
            assert pieces(near)[0][0, :2] == pytest.approx(start, abs=1e-8)


@pytest.mark.parametrize("u", [0.0, 1.0, 2.0])
def test_the_point_that_moves_may_stand_still(u: float) -> None:
    assert open_subject("cusp").changed("u", u).figure().spaces
