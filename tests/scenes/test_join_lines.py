"""Edges in the colours of their joins, over any scene that shows patches."""

from __future__ import annotations

import pytest

from reparam.scenes.layers import Figure, Label, Polylines
from reparam.subject import open_subject


def figures(name: str, *assignments: str) -> tuple[Figure, Figure]:
    """Without and with the joins."""
    subject = open_subject(name).assigned(assignments)
    return subject.figure(), subject.changed("joins", True).figure()


@pytest.mark.parametrize(
    ("name", "assignments", "words"),
    [
        ("fig9", (), ["G1 96", "G2 96"]),
        ("fig9", ("step=all", "merged=1"), ["G1 96", "G2 96"]),
        ("fig9", ("step=mesh",), ["kink 12"]),
        ("fig7", (), ["G1 79", "G2 3", "G3 62"]),
        ("domain", ("spans=2",), ["no neighbour 8", "G3 4"]),
        ("fig1", (), None),
    ],
)
def test_a_strip_and_lines(
    name: str, assignments: tuple[str, ...], words: list[str] | None
) -> None:
    plain, joined = figures(name, *assignments)
    if words is None:
        assert [space.name for space in joined.spaces] == [space.name for space in plain.spaces]
        return
    strip, subject = joined.spaces[-2:]
    assert [layer.text for layer in strip.layers if isinstance(layer, Label)] == words
    assert len(subject.layers) == len(plain.spaces[-1].layers) + len(words)
    lines = [layer for layer in subject.layers[-len(words) :] if isinstance(layer, Polylines)]
    counts = [int(text.split()[-1]) for text in words]
    assert [len(layer.points) for layer in lines] == counts
    assert all(layer.lift == 1 for layer in lines)  # over the outlines
    names = [space.name for space in plain.spaces]
    assert [space.name for space in joined.spaces] == [*names[:-1], "joins", names[-1]]


def test_where_notes_leave_no_room_the_caption_tells() -> None:
    plain, joined = figures("fig6")
    assert "edges: no neighbour 4" in joined.caption
    assert len(joined.caption) == len(plain.caption) + 1
    assert len(joined.spaces) == len(plain.spaces)
