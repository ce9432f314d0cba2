"""Two values of a parameter in one picture: each half is the picture of its own value."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.compare import agree, default_comparison, sides
from reparam.errors import UsageError
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject

SIZE = (160, 120)


def compared(text: str, scene: str = "fig5", **values: object) -> Subject:
    subject = open_subject(scene).changed("compare", text)
    for name, value in values.items():
        subject = subject.changed(name, value)
    return subject


def plain(studio: Studio, subject: Subject) -> np.ndarray:
    return studio.draw(subject, SIZE, plain=True).astype(int)


@pytest.mark.parametrize("divider", [0.0, 0.3, 0.5, 1.0])
def test_each_half_is_the_picture_of_its_value(studio: Studio, divider: float) -> None:
    picture = plain(studio, compared("texture=identity|r", divider=divider))
    left, right = (plain(studio, compared("", texture=name)) for name in ("identity", "r"))
    line = round(divider * SIZE[0])
    assert np.array_equal(picture[:, :line], left[:, :line])
    assert np.array_equal(picture[:, line:], right[:, line:])
    assert not np.array_equal(left, right)


@pytest.mark.parametrize("blend", [0.0, 0.25, 1.0])
def test_other_values_fade(studio: Studio, blend: float) -> None:
    subject = compared("texture=identity|r", divider=1.0, blend=blend)
    left, right = (plain(studio, compared("", texture=name)) for name in ("identity", "r"))
    mixed = (1.0 - blend) * left + blend * right
    assert np.abs(plain(studio, subject) - mixed).max() <= 2.0


def test_numbers_and_points_have_values_between(studio: Studio) -> None:
    subject = compared("morph=0|1", divider=1.0, blend=0.4)
    assert np.abs(plain(studio, subject) - plain(studio, compared("", morph=0.4))).max() <= 1
    start = open_subject("fig5")
    moved = np.array(start.value("points"))
    moved[1, 1] = (0.5, 0.25)
    text = start.parameters()["points"].text
    both = f"points={text(start.value('points'))}|{text(moved)}"
    left, right, name = sides(compared(both, blend=0.5))
    assert name == "points"
    assert left.value("points")[1, 1].tolist() == [0.25, 0.125]
    assert right.value("points")[1, 1].tolist() == [0.5, 0.25]


def test_both_are_framed_alike_and_share_their_caption(studio: Studio) -> None:
    moved = "points=[[[-1,1],[0,2],[1,1]],[[-2,0],[0,0],[9,0]],[[-1,-1],[0,-2],[1,-1]]]"
    start = open_subject("fig5")
    figures = (start.figure(), start.assigned([moved]).figure())
    left, right = agree(*figures, (False, False))
    assert np.array_equal(left.spaces[0].bounds, right.spaces[0].bounds)
    assert left.spaces[0].bounds[:, 0].max() == 5.0
    assert left.caption == right.caption
    assert set(left.caption) < set(figures[0].caption)
    picture = studio.draw(compared(f"{moved}|{moved[7:]}"), SIZE)  # the same twice: one picture
    whole = studio.draw(start.assigned([moved]), SIZE)
    rows, columns = slice(20, 90), np.abs(np.arange(SIZE[0]) - SIZE[0] / 2) > 3
    assert np.array_equal(picture[rows, columns], whole[rows, columns])


@pytest.mark.parametrize("text", ["level=2|32", "wireframe=0|1", "net=0|1", "checks=4|16"])
def test_any_parameter(studio: Studio, text: str) -> None:
    picture = studio.draw(compared(text), SIZE)
    assert not np.array_equal(picture, studio.draw(open_subject("fig5"), SIZE))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("texture", "compare: expected NAME=LEFT|RIGHT, found 'texture'"),
        ("texture=r", "compare: expected NAME=LEFT|RIGHT, found 'texture=r'"),
        ("divider=0|1", "compare: expected NAME=LEFT|RIGHT, found 'divider=0|1'"),
        ("texture=r|q", "texture: expected identity or r, found 'q'"),
        ("textur=r|q", "expected one of texture"),
    ],
)
def test_bad_comparisons(studio: Studio, text: str, message: str) -> None:
    with pytest.raises(UsageError) as refused:
        studio.draw(compared(text), SIZE)
    assert message in str(refused.value)


def test_what_a_scene_compares_without_being_told() -> None:
    fig5 = open_subject("fig5")
    assert default_comparison(fig5) == "texture=identity|r"
    assert default_comparison(fig5.changed("texture", "r")) == "texture=identity|r"
    assert default_comparison(open_subject("fig4")) == "morph=0.0|1.0"
