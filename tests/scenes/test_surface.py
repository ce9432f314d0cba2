"""A surface from a file, its control points moved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.scenes.figures.surface import edited, handles, sampled
from reparam.scenes.layers import Handles, Patches
from reparam.subject import Subject, open_subject

MIXED = Path(__file__).parents[1] / "data" / "mixed.bv"


@pytest.fixture
def mixed() -> Subject:
    return open_subject(str(MIXED))


def layer(subject: Subject, kind: type) -> object:
    layers = subject.figure().spaces[-1].layers
    return next(layer for layer in layers if isinstance(layer, kind))


def test_a_moved_point_takes_those_at_its_place_along(mixed: Subject) -> None:
    body, grips = mixed.data["body"], layer(mixed, Handles)
    assert isinstance(grips, Handles)
    places = np.round(grips.at, 12)
    _, first, count = np.unique(places, axis=0, return_index=True, return_counts=True)
    index = int(first[np.argmax(count)])
    together = (grips.at == grips.at[index]).all(-1)
    assert together.sum() > 2
    goal = np.array([0.5, -0.25, 3.0])
    changes = grips.drag(mixed.values, index, goal)
    after = mixed.changed("moved", changes["moved"])
    again = layer(after, Handles)
    assert isinstance(again, Handles)
    assert np.array_equal(again.at[~together], grips.at[~together])
    assert again.at[together] == pytest.approx(np.tile(goal, (together.sum(), 1)), abs=1e-15)
    second = after.changed("moved", again.drag(after.values, index, 2.0 * goal)["moved"])
    assert len(second.value("moved")) == len(after.value("moved")) == together.sum()
    patches = layer(second, Patches)
    assert isinstance(patches, Patches)
    assert np.array_equal(patches.net[..., 3], body.nets[..., 3])  # the weights stay


def test_what_did_not_change_is_the_same_object(mixed: Subject) -> None:
    body = mixed.data["body"]
    assert edited(body, mixed.value("moved")) is body.nets
    subject = mixed.changed("moved", [[0, 0, 0, 1, 2, 3]])
    before, after = (layer(s, Patches) for s in (subject, subject.changed("checks", 4)))
    assert isinstance(before, Patches)
    assert isinstance(after, Patches)
    assert before.net is after.net
    assert before.net is not body.nets
    assert handles(before.net) is handles(after.net)
    assert sampled(before.net) is sampled(after.net)
    fresh = layer(subject.changed("moved", [[0, 0, 0, 1, 2, 4]]), Patches)
    assert isinstance(fresh, Patches)
    assert fresh.net is not before.net


@pytest.mark.parametrize(
    "place",
    [[16, 0, 0], [0, -1, 0], [0, 0, 4], [0.5, 0, 0]],
    ids=["patch", "row", "column", "half"],
)
def test_a_place_that_is_none(mixed: Subject, place: list[float]) -> None:
    with pytest.raises(UsageError, match=r"moved\[1\]: expected a place among 16 x 4 x 4, found"):
        mixed.changed("moved", [[0, 0, 0, 1, 1, 1], [*place, 1, 1, 1]]).figure()
