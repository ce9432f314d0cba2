"""The sampling methods keep their tolerance, in pixels and in object units, and waste little.

What libGLU 9.0.2 does otherwise is said where it is tested; it was measured.
"""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from reparam.evaluators.constants import GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4
from reparam.evaluators.criteria import pixels_per_unit
from reparam.evaluators.glu import (
    GLU_DOMAIN_DISTANCE,
    GLU_OBJECT_PARAMETRIC_ERROR,
    GLU_OBJECT_PATH_LENGTH,
    GLU_PARAMETRIC_ERROR,
    GLU_PARAMETRIC_TOLERANCE,
    GLU_PATH_LENGTH,
    GLU_SAMPLING_METHOD,
    GLU_SAMPLING_TOLERANCE,
    GLU_U_STEP,
    GLU_V_STEP,
    GluInvalidValue,
    gluNewNurbsRenderer,
)
from reparam.evaluators.nurbs_properties import View
from reparam.evaluators.sampling import steps
from reparam.evaluators.splines import Nurbs
from reparam.evaluators.tessellations import Tessellation, evaluate_at, read_float64, tessellate
from reparam.geometry.extraction import restricted
from reparam.geometry.net import Array

UNIT = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
HILL = [[(2 * u - 3, 2 * v - 3, 3 if u in (1, 2) and v in (1, 2) else -3) for v in range(4)]
        for u in range(4)]  # fmt: skip
WAVE = [(-4.0, -4.0, 0.0), (-2.0, 4.0, 0.0), (2.0, -4.0, 0.0), (4.0, 4.0, 0.0)]
VIEWPORT = (0, 0, 256, 256)
FROM_ABOVE = np.diag([0.25, 0.25, 0.25, 1.0])
# From (0, 0, 12), towards the origin: x / (12 - z), as 16 numbers column after column.
PERSPECTIVE = np.array([[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, -1.2, -1], [0, 0, -2.2, 0]], float)
AWAY = np.array([[1, 0, 0, 0], [0, 0.8, 0.6, 0], [0, -0.6, 0.8, 0], [0, 0, -12, 1]], float)

Properties = dict[int, float]


def surface(
    properties: Properties, view: tuple[Array, Array], points: object = HILL, knots: object = UNIT
) -> Nurbs:
    nurb = gluNewNurbsRenderer()
    for name, value in properties.items():
        nurb.gluNurbsProperty(name, value)
    nurb.gluLoadSamplingMatrices(*view, VIEWPORT)
    kind = GL_MAP2_VERTEX_3 if np.shape(points)[-1] == 3 else GL_MAP2_VERTEX_4
    nurb.gluNurbsSurface(knots, knots, points, kind)
    (found,) = nurb.take()
    return found


def curve(properties: Properties, view: tuple[Array, Array], knots: object = UNIT) -> Nurbs:
    nurb = gluNewNurbsRenderer()
    for name, value in properties.items():
        nurb.gluNurbsProperty(name, value)
    nurb.gluLoadSamplingMatrices(*view, VIEWPORT)
    nurb.gluNurbsCurve(knots, WAVE, GL_MAP1_VERTEX_3)
    (found,) = nurb.take()
    return found


def random_points(rational: bool) -> Array:
    random = np.random.default_rng(5)
    points = np.array(HILL + HILL[-1:], float)
    points = np.concatenate([points, points[:, -1:]], 1)  # 5 x 5
    points[4, :, 0] += 2.0
    points[:, 4, 1] += 2.0
    points += random.uniform(-0.5, 0.5, points.shape)
    if not rational:
        return points
    weights = random.uniform(0.5, 2.0, (5, 5, 1))
    return np.concatenate([points * weights, weights], -1)


SURFACES = {
    "hill": (HILL, UNIT),
    "five": (random_points(False), [0, 0, 0, 0, 0.4, 1, 1, 1, 1]),
    "rational": (random_points(True), [-0.3, -0.1, 0, 0, 0.4, 1, 1.2, 1.7, 2]),
}
VIEWS = {"above": (FROM_ABOVE, np.eye(4)), "perspective": (AWAY, PERSPECTIVE)}
METHODS = {
    GLU_PATH_LENGTH: 25.0,
    GLU_OBJECT_PATH_LENGTH: 1.5,
    GLU_PARAMETRIC_ERROR: 1.0,
    GLU_OBJECT_PARAMETRIC_ERROR: 0.06,
}


def pixels(view: View, points: Array) -> Array:
    seen = np.concatenate([points, np.ones((*points.shape[:-1], 1))], -1)
    seen = seen @ view.pixels_from_object.T
    return np.asarray(seen[..., :2] / seen[..., 2:])


def longest_edge(found: Tessellation, view: View | None) -> float:
    points = found.points.astype(float)
    points = points if view is None else pixels(view, points)
    corners = points[found.primitives]
    if found.primitives.shape[1] == 2:
        return float(np.linalg.norm(corners[:, 1] - corners[:, 0], axis=-1).max())
    return float(np.linalg.norm(corners - np.roll(corners, 1, 1), axis=-1).max())


def farthest(nurbs: Nurbs, found: Tessellation, view: View | None) -> float:
    """The largest distance of a point inside a primitive from the point on the surface there."""
    corners = found.primitives.shape[1]
    shares = np.random.default_rng(3).dirichlet(np.ones(corners), 25)
    flat = np.einsum("sc,pcd->psd", shares, found.points.astype(float)[found.primitives])
    where = np.einsum("sc,pcd->psd", shares, found.parameters[found.primitives])
    true = evaluate_at(nurbs, where.reshape(-1, 2), read_float64).points.reshape(flat.shape)
    if view is not None:
        flat, true = pixels(view, flat), pixels(view, true.astype(float))
    return float(np.linalg.norm(flat - true, axis=-1).max())


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("method", METHODS)
def test_tolerance_is_kept(method: int, name: str, view: str) -> None:
    tolerance = METHODS[method]
    properties = {GLU_SAMPLING_METHOD: method, GLU_U_STEP: 2.0, GLU_V_STEP: 2.0}
    properties |= {GLU_SAMPLING_TOLERANCE: tolerance, GLU_PARAMETRIC_TOLERANCE: tolerance}
    nurbs = surface(properties, VIEWS[view], *SURFACES[name])
    found = tessellate(nurbs, read_float64)
    seen = nurbs.view if method in (GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR) else None
    if method in (GLU_PATH_LENGTH, GLU_OBJECT_PATH_LENGTH):
        reached = longest_edge(found, seen)
    elif seen is None:
        reached = farthest(nurbs, found, None)
    else:  # depth counts as much as width
        assert farthest(nurbs, found, seen) <= tolerance * (1 + 1e-6)
        scale = pixels_per_unit(nurbs.pieces("vertex", 4), nurbs.view).max()
        reached = farthest(nurbs, found, None) * scale
    assert 0.3 * tolerance < reached <= tolerance * (1 + 1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_tolerance_of_curves_is_kept(method: int) -> None:
    """libGLU: PARAMETRIC_ERROR takes SAMPLING_TOLERANCE, OBJECT_ methods are not known, and
    PATH_LENGTH is cut short by U_STEP (12 px chords for 1 px at U_STEP 10)."""
    tolerance = METHODS[method] / 25.0
    path = method in (GLU_PATH_LENGTH, GLU_OBJECT_PATH_LENGTH)
    own = GLU_SAMPLING_TOLERANCE if path else GLU_PARAMETRIC_TOLERANCE
    nurbs = curve({GLU_SAMPLING_METHOD: method, own: tolerance, GLU_U_STEP: 10}, VIEWS["above"])
    found = tessellate(nurbs, read_float64)
    seen = nurbs.view if method in (GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR) else None
    reached = longest_edge(found, seen) if path else farthest(nurbs, found, seen)
    assert 0.9 * tolerance < reached <= tolerance * (1 + 1e-6)


def test_hill_from_above_is_a_hill() -> None:
    """libGLU counts only x and y on the screen: 6 triangles, at any tolerance."""
    properties = {GLU_SAMPLING_METHOD: GLU_PARAMETRIC_ERROR, GLU_PARAMETRIC_TOLERANCE: 0.5}
    nurbs = surface(properties, VIEWS["above"])
    found = tessellate(nurbs, read_float64)
    pixel = 0.25 * 128
    assert 0.3 < farthest(nurbs, found, None) * pixel <= 0.5


def test_domain_distance_takes_the_steps_asked_for() -> None:
    """libGLU: 3 from .3 to .7 at 10 on a surface, 21 on a curve of 20, 1 for short spans."""
    properties = {GLU_SAMPLING_METHOD: GLU_DOMAIN_DISTANCE, GLU_U_STEP: 10, GLU_V_STEP: 5}
    nurbs = surface(
        properties, VIEWS["above"], np.zeros((6, 6, 3)), [0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1]
    )
    assert [count.tolist() for count in steps(nurbs)] == [[3, 4, 3], [2, 2, 2]]
    strokes = curve({**properties, GLU_U_STEP: 20}, VIEWS["above"])
    assert steps(strokes)[0].tolist() == [20]
    found = tessellate(strokes, read_float64)
    np.testing.assert_allclose(found.parameters[:, 0], np.arange(21) / 20)


def test_domain_distance_does_not_stick() -> None:
    """libGLU draws untrimmed surfaces by U_STEP and V_STEP ever after."""
    nurb = gluNewNurbsRenderer()
    nurb.gluNurbsProperty(GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE)
    nurb.gluNurbsProperty(GLU_SAMPLING_METHOD, GLU_PATH_LENGTH)
    nurb.gluLoadSamplingMatrices(FROM_ABOVE, np.eye(4), VIEWPORT)
    nurb.gluNurbsSurface(UNIT, UNIT, HILL, GL_MAP2_VERTEX_3)
    (nurbs,) = nurb.take()
    fresh = surface({}, VIEWS["above"])
    assert [c.tolist() for c in steps(nurbs)] == [c.tolist() for c in steps(fresh)]


def test_eye_within_reach() -> None:
    """No bound there: U_STEP and V_STEP samples stand in."""
    near = np.array(HILL, float)
    near[..., 2] += 12.0
    straight = np.eye(4)
    straight[3, 2] = -12.0
    nurbs = surface({GLU_U_STEP: 7, GLU_V_STEP: 9}, (straight, PERSPECTIVE), near)
    assert [count.tolist() for count in steps(nurbs)] == [[7], [9]]


def test_too_many_vertices() -> None:
    nurbs = surface({GLU_SAMPLING_TOLERANCE: 1e-9}, VIEWS["above"])
    with pytest.raises(GluInvalidValue, match="at most 16777216 vertices"):
        steps(nurbs)


@pytest.mark.parametrize("method", [GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR])
@pytest.mark.parametrize("name", SURFACES)
def test_surfaces_have_no_cracks(name: str, method: int) -> None:
    """An inner edge stands in two triangles, in both directions, between the same points."""
    properties = {GLU_SAMPLING_METHOD: method, GLU_SAMPLING_TOLERANCE: 15.0}
    nurbs = surface({**properties, GLU_PARAMETRIC_TOLERANCE: 2.0}, VIEWS["above"], *SURFACES[name])
    found = tessellate(nurbs, read_float64)
    corners = np.concatenate([found.parameters, found.points], -1)[found.primitives]
    edges = Counter(
        (tuple(a), tuple(b))
        for triangle in corners.tolist()
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True)
    )
    assert set(edges.values()) == {1}
    ends = [(nurbs.ends(axis)[0], nurbs.ends(axis)[-1]) for axis in (0, 1)]
    for a, b in edges:
        on_border = any(a[i] == b[i] and a[i] in ends[i] for i in (0, 1))
        assert on_border != ((b, a) in edges)


def border(nurbs: Nurbs) -> list[list[float]]:
    """The points on v = first, in the order of u, rounded."""
    found = tessellate(nurbs, read_float64)
    on = found.parameters[:, 1] == nurbs.ends(1)[0]
    order = np.argsort(found.parameters[on, 0])
    points = found.points[on][order].round(5) + 0.0
    fresh = np.append(True, (np.diff(points, axis=0) != 0.0).any(1))
    return points[fresh].tolist()


@pytest.mark.parametrize("method", METHODS)
def test_neighbours_meet(method: int) -> None:
    """libGLU: 29 points against 28 once a patch is cut, 11 against 21 in other knots: cracks."""
    tolerance = METHODS[method] / 4.0
    properties = {GLU_SAMPLING_METHOD: method, GLU_SAMPLING_TOLERANCE: tolerance,
                  GLU_PARAMETRIC_TOLERANCE: tolerance}  # fmt: skip

    def made(points: Array, knots: object = UNIT) -> Nurbs:
        nurb = gluNewNurbsRenderer()
        for name, value in properties.items():
            nurb.gluNurbsProperty(name, value)
        nurb.gluLoadSamplingMatrices(*VIEWS["above"], VIEWPORT)
        nurb.gluNurbsSurface(knots, UNIT, points, GL_MAP2_VERTEX_3)
        (found,) = nurb.take()
        return found

    hill = np.array(HILL, float)
    hill[:, 0] += [[0, 1, 2], [1, 0, 1], [0, -2, 1], [-1, 1, 0]]
    other = hill.copy()
    other[:, 1:] = hill[:, 1:] * 0.3 + [0, -9, 5]
    expected = border(made(hill))
    assert len(expected) > 8
    assert border(made(other)) == expected
    assert border(made(hill[::-1])) == expected[::-1]
    assert border(made(hill, [3, 3, 3, 3, 9, 9, 9, 9])) == expected
    halves = restricted(hill, [[0, 0], [0.5, 0]], [[0.5, 1], [1, 1]])
    first, second = (border(made(half)) for half in halves)
    assert [*first, *second[1:]] == expected
