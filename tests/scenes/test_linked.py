"""The linked view and its cursor as data: spaces, maps, marks and numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.planar_maps import ALIGNED_IDENTITY, DOMAIN, R
from reparam.scenes.cursor import Cursor, is_cursor, marked, numbers, parse, within
from reparam.scenes.layers import Dots, Figure, IsoLines, Patches, Picture, Space, Texture, plane
from reparam.scenes.linked import can_link, linked
from reparam.subject import open_subject

MIXED = str(Path(__file__).parents[1] / "data" / "mixed.bv")
BARE = Figure((Space("plot", plane(0, 0, 1, 1), ()),))


def drawn(name: str, *assignments: str) -> Figure:
    return open_subject(name).assigned(assignments).figure()


def named(figure: Figure) -> list[str]:
    return [space.name for space in figure.spaces]


def notes(figure: Figure, space: str) -> dict[str, str]:
    (found,) = (each for each in figure.spaces if each.name == space)
    return {name: value.replace("\u2007", "") for name, value in found.notes if name}


@pytest.mark.parametrize("scene", ["fig6", "fig5", "fig4"])
def test_three_spaces_and_the_maps_between_them(scene: str) -> None:
    figure = drawn(scene, "linked=1")
    maps = [space.map for space in figure.spaces]
    assert maps[0] is DOMAIN
    assert maps[-1] is R
    if scene == "fig4":  # which has no texture
        assert named(figure) == ["domain", "physical"]
    else:
        assert named(figure) == ["domain", "texture", "physical"]
        assert maps[1] is ALIGNED_IDENTITY
        assert drawn(scene, "linked=1", "texture=r").spaces[1].map is R


def test_fig6_is_the_linked_view_by_itself() -> None:
    assert named(drawn("fig6")) == ["domain", "texture", "physical"]
    assert named(drawn("fig5")) == ["physical"]


def test_a_file_is_linked_patch_by_patch() -> None:
    figure = drawn(MIXED, "linked=1", "cursor=0.25,0.5,3")
    nets = figure.spaces[-1].map
    assert nets is not None
    assert notes(figure, "domain") == {"(u, v)": "0.2500, 0.5000", "patch": f"3 (of {len(nets)})"}
    x, y, z = project(evaluate(nets[3], 0.25, 0.5))
    assert notes(figure, "physical")["(x, y, z)"] == numbers(x, y, z).replace("\u2007", "")


def test_what_has_no_patch_stays_as_it_is() -> None:
    assert not can_link(BARE)
    assert linked(BARE) is BARE
    assert marked(BARE, Cursor(0.5, 0.5)) is BARE
    plain = drawn("fig5")
    assert marked(plain, None) is plain


def test_numbers_under_r_and_the_identity() -> None:
    u, v = 0.8, 0.35
    a, b = 2 * u - 1, 2 * v - 1
    x, y = b * (3 - a * a) / 2, -a * (3 - b * b) / 2
    determinant = 3 * (3 - a * a - b * b - a * a * b * b)
    at = f"cursor={u},{v}"
    figure = drawn("fig6", at)
    assert notes(figure, "domain") == {"(u, v)": "0.8000, 0.3500"}
    texture, physical = notes(figure, "texture"), notes(figure, "physical")
    assert texture == {
        "(s, t)": f"−{-b:.4f}, −{a:.4f}", "det": "4.0000", "stretch": "2.0000, 2.0000"
    }  # fmt: skip
    assert physical["(x, y)"] == f"−{-x:.4f}, −{-y:.4f}"
    assert physical["det"] == f"{determinant:.4f}"
    large, small = (float(text) for text in physical["stretch"].split(","))
    assert large * small == pytest.approx(determinant, rel=1e-4)
    assert f"det {determinant / 4:.4f}" in figure.caption[-1]
    figure = drawn("fig6", at, "texture=r")
    assert notes(figure, "texture")["(s, t)"] == physical["(x, y)"]
    assert "det 1.0000, stretch 1.0000, 1.0000" in figure.caption[-1]
    assert "singular" in drawn("fig6", "cursor=0,1", "texture=r").caption[-1]


def test_the_little_square_is_cut_at_the_edge_and_drawn_by_the_map() -> None:
    figure = drawn("fig6", "cursor=0.02,0.5")
    for space in figure.spaces:
        sides = [layer for layer in space.layers if isinstance(layer, IsoLines)][-2:]
        assert all(line.net is space.map for line in sides)
        assert sides[0].v == pytest.approx((0.45, 0.55))
        assert sides[0].span == pytest.approx((0.0, 0.07))
        assert sides[1].u == pytest.approx((0.0, 0.07))
        (dot,) = (layer for layer in space.layers[-1:] if isinstance(layer, Dots))
        assert space.map is not None
        assert dot.at[0] == pytest.approx(project(evaluate(space.map, 0.02, 0.5)))


def test_a_scene_alone_takes_a_cursor_too() -> None:
    figure = drawn("fig5", "cursor=0.5,0.5")
    assert notes(figure, "physical") == {
        "(x, y)": "0.0000, 0.0000", "det": "9.0000", "stretch": "3.0000, 3.0000"
    }  # fmt: skip
    assert figure.plain().spaces[0].notes == ()
    assert all(isinstance(layer, Patches) for layer in figure.plain().spaces[0].layers)


@pytest.mark.parametrize(
    "text", ["0.1", "0.1,2", "-0.1,0", "u,v", "0.1,0.2,0.5", "nan,0", "0,0,-1"]
)
def test_what_is_no_cursor_is_refused(text: str) -> None:
    assert not is_cursor(text)
    with pytest.raises(UsageError, match=r"^cursor: expected u,v from 0 to 1, .* found '"):
        open_subject("fig6").assigned([f"cursor={text}"])


def test_a_patch_that_is_not_there_is_refused_and_a_hand_gets_the_last() -> None:
    with pytest.raises(UsageError, match="expected a patch from 0 to 0, found 7"):
        drawn("fig6", "cursor=0.1,0.2,7")
    assert within(drawn("fig6"), Cursor(0.1, 0.2, 7)) == Cursor(0.1, 0.2)


def test_the_text_of_a_cursor_is_exact() -> None:
    for u, v in np.random.default_rng(0).random((20, 2)):
        for patch in (0, 12):
            cursor = Cursor(float(u), float(v), patch)
            assert parse(cursor.text) == cursor


def test_numbers_stand_in_columns() -> None:
    assert numbers(-1.0, 0.25) == "−1.0000, \u20070.2500"
    assert numbers(-1e-9) == "\u20070.0000"
    assert numbers(123456.0) == "\u20071.235e+05"


def test_layers_of_patches_count_as_one_and_other_spaces_go() -> None:
    figure = drawn("fig7", "linked=1")
    assert named(figure) == ["domain", "body"]
    body = figure.spaces[-1]
    layers = [layer.net for layer in body.layers if isinstance(layer, Patches)]
    assert body.map is not None
    assert len(layers) > 1
    assert len(body.map) == sum(len(net) for net in layers)
    assert (body.width, body.height, body.below) == (1.0, 1.0, False)
    second = project(evaluate(layers[1][2], 0.3, 0.8))
    there = project(evaluate(body.map[len(layers[0]) + 2], 0.3, 0.8))
    assert there == pytest.approx(second, abs=1e-14)


def test_patches_of_two_degrees_and_one_texture_map_for_all() -> None:
    texture = Texture(ALIGNED_IDENTITY, Picture())
    many = Patches(np.stack([DOMAIN, DOMAIN + np.array([2.0, 0.0, 0.0, 0.0])]), texture)
    one = Patches(R, texture)
    space = Space("physical", plane(-2, -2, 3, 2), (many, one))
    domain, plate, body = linked(Figure((space,))).spaces
    assert body.map is not None
    assert plate.map is not None
    assert body.map.shape == (len(plate.map), 3, 3, 4)
    assert project(evaluate(body.map[1], 0.2, 0.6))[:2] == pytest.approx([2.6, 0.8])
    for net in plate.map:
        assert project(evaluate(net, 0.2, 0.6))[:2] == pytest.approx([0.2, 0.6])
    mixed = linked(Figure((Space("physical", plane(-2, -2, 3, 2), (many, Patches(R))),)))
    assert named(mixed) == ["domain", "physical"]
    assert domain.map is DOMAIN


def test_a_surface_of_many_patches_is_shown_in_its_own_parameters() -> None:
    domains = np.array([[0.0, 1.0, 2.0, 4.0], [1.0, 4.0, 2.0, 4.0]])
    nets = np.stack([DOMAIN, DOMAIN + np.array([0.0, -1.0, 0.0, 0.0])])
    space = Space("physical", plane(0, -1, 1, 1), (Patches(nets, domains=domains),))
    figure = marked(linked(Figure((space,))), Cursor(0.5, 0.25, 1))
    first = figure.spaces[0]
    assert first.map is not None
    assert notes(figure, "domain") == {"(u, v)": "2.5000, 2.5000", "patch": "1 (of 2)"}
    corners = [
        project(evaluate(first.map[k], u, v))[:2] for k in (0, 1) for u, v in ((0, 0), (1, 1))
    ]
    assert np.array(corners) == pytest.approx(
        np.array([[0.0, 1.0], [1.0, 0.75], [0.0, 0.75], [1.0, 0.0]])
    )
