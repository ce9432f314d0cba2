"""The Red Book's NURBS programs: what a hand may do to the hole, and to the hill."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.evaluators.glu_constants import NAMES
from reparam.scenes import nurbs_programs
from reparam.scenes.figures import redbook_trim
from reparam.scenes.nurbs_programs import HILL, drag_hill, properties_caption, seen

CROSSED = np.array([(0.25, 0.5), (0.75, 0.75), (0.25, 0.75), (0.75, 0.5), (0.5, 0.8)])


def test_a_hole_that_crosses_itself_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^hole: GLU_NURBS_ERROR\d+: .* found") as caught:
        redbook_trim.redbook_trim.build(hole=CROSSED)
    assert "\n" not in str(caught.value)


def test_the_hand_moves_the_hole_but_not_across_itself() -> None:
    values = {"hole": redbook_trim.HOLE}
    moved = redbook_trim.drag(values, 4, np.array([0.45, 0.2, 0.0]))
    assert moved["hole"][4].tolist() == [0.45, 0.2]
    assert redbook_trim.HOLE[4].tolist() == [0.5, 0.25]
    assert redbook_trim.drag(values, 4, np.array([0.5, 0.9, 0.0])) == {}


def test_the_hand_moves_the_hill_where_it_is_seen() -> None:
    at = np.array([1.0, 2.0, 3.0])
    moved = drag_hill({"points": HILL}, 5, at @ seen(nurbs_programs.PROGRAM_TURN).T)
    np.testing.assert_allclose(moved["points"][1, 1], at, atol=1e-12)


def test_matrices_are_the_program_s() -> None:
    """The middle of the hill's floor, and a corner, in the window of surface.c."""
    surface = redbook_trim.trimmed_hill(redbook_trim.HOLE, "path-length", 25.0, "fill")
    where = np.array([[0, 0, 0, 1.0], [3, 3, -3, 1.0]])
    where[:, :3] = where[:, :3] @ seen(nurbs_programs.PROGRAM_TURN).T
    x, y, w = (where @ surface.view.pixels_from_object.T).T
    a = np.radians(330.0)
    height, depth = 1.5 * np.cos(a) + 1.5 * np.sin(a), 5.0 - (1.5 * np.sin(a) - 1.5 * np.cos(a))
    reach = 250.0 / np.tan(np.radians(22.5))
    np.testing.assert_allclose(x / w, [250.0, 250.0 + reach * 1.5 / depth])
    np.testing.assert_allclose(y / w, [250.0, 250.0 + reach * height / depth])


@pytest.mark.parametrize("method", nurbs_programs.METHODS)
@pytest.mark.parametrize("mode", nurbs_programs.MODES)
def test_captions_name_what_is_set(method: str, mode: str) -> None:
    caption = properties_caption(method, 25.0, mode)
    assert NAMES[nurbs_programs.METHODS[method]] in caption
    assert NAMES[nurbs_programs.MODES[mode]] in caption
    assert "25" in caption
