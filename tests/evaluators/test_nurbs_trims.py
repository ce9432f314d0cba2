"""Trimmed surfaces as triangles, and what is wrong with trims: errors where libGLU has none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import pytest

from reparam.evaluators.constants import GL_LINE_STRIP, GL_MAP2_VERTEX_3, GL_TRIANGLES
from reparam.evaluators.glu_constants import (
    GLU_DISPLAY_MODE,
    GLU_DOMAIN_DISTANCE,
    GLU_MAP1_TRIM_2,
    GLU_MAP1_TRIM_3,
    GLU_NURBS_ERROR,
    GLU_OBJECT_PATH_LENGTH,
    GLU_OUTLINE_PATCH,
    GLU_OUTLINE_POLYGON,
    GLU_SAMPLING_METHOD,
    GLU_SAMPLING_TOLERANCE,
    GLU_U_STEP,
    GLU_V_STEP,
)
from reparam.evaluators.glu_errors import NURBS_ERRORS, GluInvalidValue, NurbsError
from reparam.evaluators.nurbs_parts import recording
from reparam.evaluators.nurbs_renderer import NurbsRenderer
from reparam.evaluators.splines import Nurbs
from reparam.evaluators.tessellations import Tessellation, read_float64, tessellate
from reparam.geometry.net import Array

KNOTS = [0.0, 0.0, 0.0, 0.25, 0.5, 1.0, 1.0, 1.0]
S2 = np.sqrt(0.5)
CIRCLE = np.array([(1, 0, 1), (S2, S2, S2), (0, 1, 1), (-S2, S2, S2), (-1, 0, 1),
                   (-S2, -S2, S2), (0, -1, 1), (S2, -S2, S2), (1, 0, 1)])  # fmt: skip
CIRCLE_KNOTS = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]

Loop = Sequence[object]


def rectangle(u0: float, v0: float, u1: float, v1: float) -> list[list[float]]:
    """Counter-clockwise, closed."""
    return [[u0, v0], [u1, v0], [u1, v1], [u0, v1], [u0, v0]]


def circle(u: float, v: float, radius: float) -> Array:
    """Homogeneous control points over CIRCLE_KNOTS, counter-clockwise."""
    return CIRCLE * [radius, radius, 1.0] + np.outer(CIRCLE[:, 2], [u, v, 0.0])


BORDER = rectangle(0, 0, 1, 1)


def begun(*loops: object, **properties: float) -> NurbsRenderer:
    """A surface of 3 x 3 pieces with trims, a polyline or a circle each, that has not ended."""
    nurb = NurbsRenderer()
    names = {"method": GLU_SAMPLING_METHOD, "display": GLU_DISPLAY_MODE, "u": GLU_U_STEP,
             "v": GLU_V_STEP, "tolerance": GLU_SAMPLING_TOLERANCE}  # fmt: skip
    for name, value in {"method": GLU_DOMAIN_DISTANCE, "u": 8, "v": 12, **properties}.items():
        nurb.gluNurbsProperty(names[name], value)
    nurb.gluBeginSurface()
    points = [[(i, j, np.sin(i * j)) for j in range(5)] for i in range(5)]
    nurb.gluNurbsSurface(KNOTS, KNOTS, points, GL_MAP2_VERTEX_3)
    for loop in loops:
        nurb.gluBeginTrim()
        if np.shape(loop)[1] == 2:
            nurb.gluPwlCurve(loop, GLU_MAP1_TRIM_2)
        else:
            nurb.gluNurbsCurve(CIRCLE_KNOTS, loop, GLU_MAP1_TRIM_3)
        nurb.gluEndTrim()
    return nurb


def trimmed(*loops: object, **properties: float) -> Nurbs:
    nurb = begun(*loops, **properties)
    nurb.gluEndSurface()
    (nurbs,) = nurb.take()
    return nurbs


def areas(found: Tessellation) -> Array:
    a, b = np.moveaxis(np.diff(found.parameters[found.primitives], axis=1), 1, 0)
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0


REGIONS = {
    "border": ([BORDER], 1.0),
    "circle": ([circle(0.5, 0.5, 0.3)], np.pi * 0.09),
    "hole": ([BORDER, circle(0.5, 0.5, 0.3)[::-1]], 1 - np.pi * 0.09),
    "island": (
        [BORDER, rectangle(0.2, 0.2, 0.8, 0.8)[::-1], rectangle(0.4, 0.4, 0.6, 0.6)],
        1 - 0.36 + 0.04,
    ),
    "two": ([rectangle(0.1, 0.1, 0.4, 0.9), circle(0.7, 0.5, 0.15)], 0.24 + np.pi * 0.0225),
    "beyond the domain": ([rectangle(-1, -1, 2, 2)], 1.0),
    "half beyond": ([rectangle(0.5, -1, 2, 0.5)], 0.25),
}


@pytest.mark.parametrize("name", REGIONS)
def test_what_stays(name: str) -> None:
    loops, area = REGIONS[name]
    nurbs = trimmed(*loops)
    found = tessellate(nurbs, read_float64)
    assert areas(found).min() >= 0.0
    assert areas(found).sum() == pytest.approx(area, abs=1e-3)
    inside = found.parameters[found.primitives].mean(1)[areas(found) > 1e-5]
    assert (nurbs.region.signed_distance(*inside.T) > -2e-3).all()
    assert {strip.mode for strip in found.strips} == {GL_TRIANGLES}


@pytest.mark.parametrize("name", ["hole", "two", "half beyond"])
def test_no_cracks(name: str) -> None:
    """Each edge inside the region has its twin; those without one lie on the trims or the border,
    corner by corner; and no triangle is larger than a cell."""
    nurbs = trimmed(*REGIONS[name][0])
    found = tessellate(nurbs, read_float64)
    corners = found.parameters[found.primitives]
    extent = np.ptp(corners, axis=1).max(0)
    assert extent[0] <= 1 / 8 + 1e-12
    assert extent[1] <= 1 / 12 + 1e-12
    corners = corners[areas(found) > 0.0]
    edges = Counter(
        (tuple(a), tuple(b))
        for triangle in corners.tolist()
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True)
    )
    assert set(edges.values()) == {1}
    lonely = np.array([point for a, b in edges if (b, a) not in edges for point in (a, b)])
    on_border = ((lonely == 0.0) | (lonely == 1.0)).any(-1)
    off = np.abs(nurbs.region.signed_distance(*lonely[~on_border].T))
    assert off.max() < 0.02 / 8
    assert np.median(off) < 1e-3


def test_points_that_pieces_share_are_the_same() -> None:
    found = tessellate(trimmed(*REGIONS["hole"][0]), read_float64)
    places: dict[tuple[float, ...], set[tuple[float, ...]]] = {}
    for where, point in zip(found.parameters.tolist(), found.points.tolist(), strict=True):
        places.setdefault(tuple(where), set()).add(tuple(point))
    several = sum(len(points) > 1 for points in places.values())
    assert several <= 0.02 * len(places)
    assert max(np.ptp(list(points), axis=0).max() for points in places.values()) < 1e-6


def test_path_length_holds_for_trimmed_triangles() -> None:
    properties = {"method": GLU_OBJECT_PATH_LENGTH, "tolerance": 0.5}
    found = tessellate(trimmed(*REGIONS["hole"][0], **properties), read_float64)
    corners = found.points.astype(float)[found.primitives]
    edges = np.linalg.norm(corners - np.roll(corners, 1, 1), axis=-1)
    assert 0.3 < edges.max() <= 0.5 * (1 + 1e-6)


def test_outlines() -> None:
    loops = REGIONS["hole"][0]
    outline = tessellate(trimmed(*loops, display=GLU_OUTLINE_PATCH), read_float64)
    assert {strip.mode for strip in outline.strips} == {GL_LINE_STRIP}
    assert len(outline.strips) < 40
    lines = outline.parameters[outline.primitives]
    length = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=-1).sum()
    chords = sum(2 * np.sqrt(0.09 - (t - 0.5) ** 2) for t in (0.25, 0.5) for _ in "uv")
    assert length == pytest.approx(4 + 2 * np.pi * 0.3 + 4 - chords, abs=5e-3)
    polygons = tessellate(trimmed(*loops, display=GLU_OUTLINE_POLYGON), read_float64)
    keys = {
        tuple(sorted(map(tuple, line)))
        for line in polygons.parameters[polygons.primitives].tolist()
    }
    assert len(keys) > 0.9 * len(polygons.primitives)


def test_trims_of_several_curves() -> None:
    """The Red Book's trim: a cubic and a polyline make one clockwise loop."""
    nurb = begun(BORDER)
    nurb.gluBeginTrim()
    cubic = [[0.25, 0.5], [0.25, 0.75], [0.75, 0.75], [0.75, 0.5]]
    nurb.gluNurbsCurve([0, 0, 0, 0, 1, 1, 1, 1], cubic, GLU_MAP1_TRIM_2)
    nurb.gluPwlCurve([[0.75, 0.5], [0.5, 0.25], [0.25, 0.5]], GLU_MAP1_TRIM_2)
    nurb.gluEndTrim()
    nurb.gluEndSurface()
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    assert nurbs.region.area() == pytest.approx(0.8625)
    assert areas(found).sum() == pytest.approx(0.8625, abs=1e-3)


def gap(width: float) -> list[list[float]]:
    return [*BORDER[:-1], [0.0, width]]


EIGHT = [[0.1, 0.1], [0.9, 0.9], [0.9, 0.1], [0.1, 0.9], [0.1, 0.1]]
BAD = [
    (28, [rectangle(0.1, 0.1, 0.9, 0.9), rectangle(0.2, 0.2, 0.8, 0.8)], "alternate"),
    (28, [circle(0.5, 0.5, 0.3)[::-1]], "outermost loop that runs counter-clockwise"),
    (29, [EIGHT], "do not cross"),
    (29, [BORDER, circle(0.5, 0.5, 0.3)[::-1], circle(0.7, 0.5, 0.2)[::-1]], "do not cross"),
    (31, [BORDER[:-1]], "gap of 1 of the domain"),
    (31, [gap(1e-5)], "gap of 1e-05 of the domain"),
    (18, [[[0.5, 0.5], [0.6, 0.5], [0.5, 0.5]]], "no area"),
]  # fmt: skip


@pytest.mark.parametrize(("number", "loops", "message"), BAD)
def test_bad_trims(number: int, loops: list[object], message: str) -> None:
    """libGLU draws nothing and says nothing, or crashes (an open polyline)."""
    with pytest.raises(NurbsError, match=message) as caught:
        begun(*loops).gluEndSurface()
    assert type(caught.value) is NURBS_ERRORS[number]
    nurb, codes = begun(*loops), []
    nurb.gluNurbsCallback(GLU_NURBS_ERROR, codes.append)
    nurb.gluEndSurface()
    assert codes == [100250 + number]
    assert nurb.take() == ()


def test_small_gaps_are_joined() -> None:
    assert areas(tessellate(trimmed(gap(1e-6)), read_float64)).sum() == pytest.approx(1.0, abs=1e-5)


def test_bad_weights() -> None:
    points = circle(0.5, 0.5, 0.3)
    points[3, 2] = -1.0
    with pytest.raises(GluInvalidValue, match="weights above 0"):
        begun(points).gluEndSurface()


def test_curved_trims_in_large_knots() -> None:
    """libGLU draws nothing: its curves no longer join to 5e-6."""
    low, high = 922.2892, 1224.9081
    knots = [low, low, high, high]
    middle, radius = (low + high) / 2.0, 0.3 * (high - low)
    square = [[(0.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [(1.0, 0.0, 0.0), (1.0, 1.0, 0.0)]]
    nurb = NurbsRenderer()
    nurb.gluBeginSurface()
    nurb.gluNurbsSurface(knots, knots, square, GL_MAP2_VERTEX_3)
    nurb.gluBeginTrim()
    nurb.gluNurbsCurve(CIRCLE_KNOTS, circle(middle, middle, radius), GLU_MAP1_TRIM_3)
    nurb.gluEndTrim()
    nurb.gluEndSurface()
    (surface,) = nurb.take()
    assert surface.region is not None
    assert surface.region.area() == pytest.approx(np.pi * radius**2, rel=1e-6)


def test_chords_are_made_when_they_are_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not for a picture by the built-in program, which needs none."""
    surface = trimmed(circle(0.5, 0.5, 0.3))
    monkeypatch.setattr("reparam.evaluators.trimmed.MOST_CELLS", 3)
    drawn = recording(surface)
    assert drawn.drawn
    with pytest.raises(GluInvalidValue, match="at most 3 cells of a trimmed surface"):
        _ = drawn.items
