"""The fields of the scene `domain`: what is refused, and what facets make of a map."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.exporting import parts_of
from reparam.geometry.distortion import distortions
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.planar_maps import R
from reparam.geometry.stretch import stretch
from reparam.scenes.cursor import numbers
from reparam.scenes.fields import attached_by_r, deviations, given, over_facets, over_spans, torsion
from reparam.scenes.layers import Handles, Label, Patches
from reparam.scenes.linked import linked
from reparam.scenes.shading import SQUARE, attached_by
from reparam.subject import Subject, open_subject

T = np.linspace(0.0, 1.0, 13)


def subject(*assignments: str) -> Subject:
    return open_subject("domain").assigned(assignments)


@pytest.mark.parametrize(
    ("assignments", "fault"),
    [
        (["field=given", "g=log(x)"], "g: expected finite values on Ω, found nan at (-0.9"),
        (["field=given", "attach=r", "g=1/x"], "g: expected finite values on Ω, found inf at (0, "),
        (["field=given", "g=x +"], "g: expected a formula in x, y, found 'x +'"),
        (["field=given", "g=u"], "g: expected a formula of x, y, numbers"),
        (["attach=r"], "attach: expected identity, since torsion is computed"),
    ],
)
def test_what_is_refused(assignments: list[str], fault: str) -> None:
    with pytest.raises(UsageError) as refused:
        subject(*assignments).figure()
    assert str(refused.value).startswith(fault)


def test_a_given_field_without_derivatives_can_still_be_attached() -> None:
    figure = subject("field=given", "g=abs(x)", "attach=r").figure()
    assert figure.caption == ("g(x, y) = abs(x)", "given, and attached by r")
    subject("field=given", "g=2", "attach=r").figure()  # and a constant has some range


def test_maps_at_parameters_of_the_square() -> None:
    field = over_spans(given("x − 2y"), 2, 3)
    x, y = (attached_by_r(given("x"), 5).map_at(T, T)[..., k] for k in (0, 1))
    assert field.values(field.map_at(T, T)) == pytest.approx(x - 2.0 * y)


def test_facets_agree_at_their_corners_alone() -> None:
    for field in (over_spans(torsion(), 2, 4), attached_by_r(given("x y"))):
        parted = over_facets(field, 4)
        assert parted.map_at(T[::3], T[::3]) == pytest.approx(field.map_at(T[::3], T[::3]))
        assert deviations(field, 4)[1] > 0.01
        middle = parted.map_at(np.array([0.125]), np.array([0.125]))[0, 0]
        corners = field.map_at(np.array([0.0, 0.25]), np.array([0.0, 0.25]))
        assert middle == pytest.approx(corners.mean((0, 1)))


def test_what_its_distortion_is_told_of() -> None:
    """Of r itself, where a computed field is attached by the identity; of nothing under r."""
    (patches,) = (
        layer for layer in subject().figure().subject.layers if isinstance(layer, Patches)
    )
    spans = 8
    piece = distortions(patches.net[11], attached_by(patches)[11], 0.5, 0.25)  # spans 1 and 3
    assert piece == pytest.approx(distortions(R, SQUARE, 1.5 / spans, 3.25 / spans))
    figure = subject("field=given", "attach=r").figure()
    (patches,) = (layer for layer in figure.subject.layers if isinstance(layer, Patches))
    assert attached_by(patches) is patches.net


def test_linked_and_exported() -> None:
    computed, by_r = subject().figure(), subject("field=given", "attach=r").figure()
    assert [space.name for space in linked(computed).spaces] == ["domain", "physical"]
    assert [space.name for space in linked(by_r).spaces] == ["domain", "texture", "physical"]
    (part,) = parts_of(computed)
    assert part.picture is not None
    assert part.picture.source == "ramp"
    assert parts_of(by_r)[0].picture is None


@pytest.mark.slow
def test_rates_as_plots() -> None:
    figure = subject("field=given", "g=x", "show=rates", "degree=1", "spans=4").figure()
    assert [space.name for space in figure.spaces] == ["plot 0", "plot 1", "physical"]
    for plot, rate in zip(figure.spaces[:2], (2.0, 1.0), strict=True):
        texts = [layer.text for layer in plot.layers if isinstance(layer, Label)]
        assert texts[-1] == "degree ≥ 2:  exact"
        assert texts[-2].startswith("degree 1:  ")
        assert float(texts[-2].split()[-1]) == pytest.approx(rate, abs=0.05)
    with pytest.raises(UsageError, match="show: expected field or facets, since torsion is"):
        subject("show=rates").figure()
    with pytest.raises(UsageError, match="g: expected a formula in x, y, found"):
        subject("g=sin(").figure()  # though the torsion is shown


def test_the_cursor_counts_by_the_square_not_by_its_pieces() -> None:
    spans, patch = 8, 3 * 8 + 5
    for assignments in ((), ("field=given", "attach=r")):
        cursor = f"cursor=0.25,0.5,{patch}"
        figure = subject(*assignments, "linked=1", cursor).figure()
        whole = stretch(R, (3 + 0.25) / spans, (5 + 0.5) / spans)
        for space in figure.spaces[1:]:
            notes = dict(space.notes)
            assert notes["det"] == numbers(whole.determinant)
            assert notes["stretch"] == numbers(*whole.factors)


EDITED = [
    [[-1, 1], [0, 1.7], [1.6, 1.3]],
    [[-1.2, 0], [0.5, 0.2], [2, 0]],
    [[-1, -1], [0, -2], [1, -1.4]],
]


def test_the_field_follows_r() -> None:
    edited = subject("field=given", "g=x").changed("points", np.array(EDITED))
    figure = edited.figure()
    assert "‖p − g‖ = " in figure.caption[1]
    assert float(figure.caption[1].split("‖p − g‖ = ")[1].split(",")[0]) < 1e-12
    (patches,) = (layer for layer in figure.subject.layers if isinstance(layer, Patches))
    corner = project(evaluate(patches.net[7], 0.0, 1.0))  # of the last piece in the first row
    assert corner == pytest.approx([1.6, 1.3, 0.0])
    (handles,) = (layer for layer in figure.subject.layers if isinstance(layer, Handles))
    changes = handles.drag(edited.values, 4, np.array([0.3, 0.1, 0.0]))
    assert changes["points"][1, 1].tolist() == [0.3, 0.1]
    assert (np.delete(changes["points"].reshape(9, 2), 4, 0) == np.delete(
        np.reshape(EDITED, (9, 2)), 4, 0)).all()  # fmt: skip


def test_a_map_that_folds_is_refused() -> None:
    folded = np.array(EDITED)
    folded[1, 1] = 6.0, 0.0
    with pytest.raises(UsageError, match=r"points: expected a map with det J > 0, found -.*folds"):
        subject().changed("points", folded).figure()
    subject("field=given", "attach=r").changed("points", folded).figure()  # r attaches still
