"""A designer's circle: what is kept stays on it, whatever is done to the free points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.bernstein import bernstein
from reparam.geometry.continuity import angle, join_curves
from reparam.geometry.jets import rational_jet
from reparam.geometry.partition import Smooth, partition
from reparam.geometry.sections import end_curvatures

random = np.random.default_rng(5)
CUTS = [-60.0, 70.0, 160.0, 200.0]


def off_circle(net: NDArray[np.float64]) -> float:
    x, y, _, w = (bernstein(len(net) - 1, np.linspace(0.0, 1.0, 101)) @ net).T
    return float(np.abs(np.hypot(x / w, y / w) - 1.0).max())


def test_sections() -> None:
    found = partition(CUTS, [True, False, True, False])
    assert [list(section.pieces) for section in found.sections] == [
        [0, 1],  # 130 degrees are too long for one piece
        [2, 3, 4],
        [5],
        [6, 7, 8],
    ]
    assert found.free == [3, 7]
    assert partition(CUTS, [True, False, True, False], 5).free == [3, 4, 5, 9, 10, 11]
    ends = np.degrees(np.arctan2(*found.circle.joints()[[8, 1, 4, 5], ::-1].T)) % 360.0
    assert ends == pytest.approx([300.0, 70.0, 160.0, 200.0])


@pytest.mark.parametrize("smooth", ["G1", "G2"])
@pytest.mark.parametrize("parts", [3, 5])
@pytest.mark.parametrize("kept", ["KMKM", "KMMK", "MMMM", "MKKM"])
def test_edits(kept: str, parts: int, smooth: Smooth) -> None:
    part = partition(CUTS, [letter == "K" for letter in kept], parts)
    before = part.pieces(part.circle, smooth)
    for scale in (0.02, 0.3):
        net = part.edited(scale * random.normal(size=(len(part.free), 2)))
        after = part.pieces(net, smooth)
        for section, old, new in zip(part.sections, before, after, strict=True):
            if section.kept:
                assert all((a == b).all() for a, b in zip(old, new, strict=True))
                assert max(map(off_circle, new)) <= 1e-15
            else:
                assert max(map(off_circle, new)) > scale * 1e-2
        pieces = [piece for section in after for piece in section]
        for f, g in pairwise([*pieces, pieces[0]]):
            arrival = rational_jet(f, 1, 1).derivatives[1]
            assert angle(arrival, rational_jet(g, 0, 1).derivatives[1]) < 1e-10
            assert join_curves(f, g, 2).order >= (1 if smooth == "G1" else 2)
            if smooth == "G2":
                jump = end_curvatures(f)[1] - end_curvatures(g)[0]
                assert abs(jump) < 1e-10 * max(1.0, abs(end_curvatures(f)[1]))


@pytest.mark.parametrize(
    ("cuts", "kept", "parts", "message"),
    [
        ([0.0], [True], 3, "at least two cuts, found 1"),
        ([0.0, 90.0], [True], 3, "2 sections for as many cuts, found 1"),
        ([0.0, 90.0, 45.0], [True] * 3, 3, "once around, 1 apart, found 0, 90, 45"),
        ([0.0, 400.0], [True] * 2, 3, "once around"),
        ([0.0, np.nan], [True] * 2, 3, "once around"),
        ([0.0, 90.0], [True, False], 2, "at least 3 parts of a modified section, found 2"),
    ],
)
def test_refused(cuts: list[float], kept: list[bool], parts: int, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        partition(cuts, kept, parts)
