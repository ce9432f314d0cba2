"""The Pythagorean scene: equal lengths between dots, what is told, what a hand changes."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.scenes.figures.pythagorean import told
from reparam.scenes.layers import Curves, Dots, Handles
from reparam.subject import Subject, open_subject


def subject(*words: str) -> Subject:
    return open_subject("pythagorean").assigned(words)


@pytest.mark.parametrize("curve", ["quintic", "cubic"])
def test_dots_stand_at_equal_lengths(curve: str) -> None:
    """Chords of a fine polygon, summed between neighbouring dots."""
    shown = subject(f"curve={curve}", "dots=9")
    layers = shown.figure().spaces[0].layers
    at = [layer.at for layer in layers if isinstance(layer, Dots)][-1]
    (net,) = (layer.net for layer in layers if isinstance(layer, Curves))
    t = np.linspace(0.0, 1.0, 200001)
    power = np.polynomial.polynomial.polyfit(
        np.linspace(0.0, 1.0, len(net)), _values(net), len(net) - 1
    )
    line = np.polynomial.polynomial.polyval(t, power).T
    walked = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    nearest = [int(np.argmin(np.hypot(*(line - dot[:2]).T))) for dot in at]
    lengths = np.diff(walked[nearest])
    assert len(at) == 9
    assert lengths == pytest.approx(walked[-1] / 8, rel=1e-4)
    told_length = float(shown.figure().caption[0].split()[-1])
    assert told_length == pytest.approx(walked[-1], rel=1e-9)


def _values(net: np.ndarray) -> np.ndarray:
    """Points of the polynomial at as many even parameters as it has coefficients."""
    from math import comb

    d, t = len(net) - 1, np.linspace(0.0, 1.0, len(net))
    basis = np.stack([comb(d, i) * t**i * (1.0 - t) ** (d - i) for i in range(d + 1)], -1)
    return np.asarray(basis @ net[:, :2])


def test_what_is_told() -> None:
    caption = subject("curve=average").figure().caption
    assert caption[0].endswith("11.25 u⁴ − 30 u³ + 2.5 u² + 50 u + 31.25")
    assert caption[1].startswith("it is square-free")
    assert told([]) == ""
    assert (
        len([x for x in subject("four=1").figure().spaces[0].layers if isinstance(x, Curves)]) == 4
    )


@pytest.mark.parametrize(("curve", "name", "count"), [("quintic", "ends", 4), ("cubic", "legs", 3)])
def test_dragging(curve: str, name: str, count: int) -> None:
    shown = subject(f"curve={curve}")
    (layer,) = (x for x in shown.figure().spaces[0].layers if isinstance(x, Handles))
    assert len(layer.at) == count
    changes = layer.drag(shown.values, 1, np.array([0.1, 0.9, 0.0]))
    shown = shown.changed(name, changes[name])
    (layer,) = (x for x in shown.figure().spaces[0].layers if isinstance(x, Handles))
    assert layer.at[1].tolist() == [0.1, 0.9, 0.0]
    same = layer.drag(shown.values, 1, layer.at[0])
    with pytest.raises(UsageError, match=r"found (two )?equal points"):
        shown.changed(name, same[name]).figure()
