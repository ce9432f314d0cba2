"""Tessellations against splines evaluated in float64: all maps, joints, outlines, callbacks.

What libGLU 9.0.2 does otherwise is said where it is tested; it was measured.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from reparam.evaluators import Evaluators
from reparam.evaluators.constants import (
    GL_MAP1_COLOR_4,
    GL_MAP1_TEXTURE_COORD_2,
    GL_MAP1_VERTEX_3,
    GL_MAP2_COLOR_4,
    GL_MAP2_NORMAL,
    GL_MAP2_TEXTURE_COORD_1,
    GL_MAP2_TEXTURE_COORD_3,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    GL_QUAD_STRIP,
)
from reparam.evaluators.glu_constants import (
    GLU_CULLING,
    GLU_DISPLAY_MODE,
    GLU_DOMAIN_DISTANCE,
    GLU_NURBS_MODE,
    GLU_NURBS_TESSELLATOR,
    GLU_OUTLINE_PATCH,
    GLU_OUTLINE_POLYGON,
    GLU_SAMPLING_METHOD,
    GLU_U_STEP,
    GLU_V_STEP,
)
from reparam.evaluators.nurbs_renderer import NurbsRenderer
from reparam.evaluators.splines import Nurbs
from reparam.evaluators.tessellations import evaluate_at, read_float64, tessellate
from reparam.geometry.net import Array
from reparam.geometry.nurbs import evaluate_curve, evaluate_surface
from reparam.snapshot import Studio

random = np.random.default_rng(11)
CUBIC = [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]
QUADRATIC = [0.0, 0.0, 0.0, 0.25, 0.25, 0.75, 1.0, 1.0, 1.0]
LINEAR = [-1.0, 0.0, 0.125, 1.0, 1.0]
ARC = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])  # a quarter: x, y, w
BEZIER = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]


def renderer(u_step: float = 8.0, v_step: float = 4.0) -> NurbsRenderer:
    nurb = NurbsRenderer()
    nurb.gluNurbsProperty(GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE)
    nurb.gluNurbsProperty(GLU_U_STEP, u_step)
    nurb.gluNurbsProperty(GLU_V_STEP, v_step)
    return nurb


def many_maps(nurb: NurbsRenderer) -> dict[str, tuple[tuple[Array, Array], Array]]:
    """A surface of four maps, none of whose knots agree."""
    shapes = {
        "vertex": (GL_MAP2_VERTEX_4, CUBIC, QUADRATIC, 4),
        "color": (GL_MAP2_COLOR_4, QUADRATIC, LINEAR, 4),
        "texcoord": (GL_MAP2_TEXTURE_COORD_3, LINEAR, CUBIC, 3),
        "unused": (GL_MAP2_TEXTURE_COORD_1, CUBIC, LINEAR, 1),
    }
    orders = {id(CUBIC): 4, id(QUADRATIC): 3, id(LINEAR): 2}
    maps = {}
    nurb.gluBeginSurface()
    for name, (kind, u_knots, v_knots, components) in shapes.items():
        shape = (len(u_knots) - orders[id(u_knots)], len(v_knots) - orders[id(v_knots)])
        points = random.uniform(0.5, 2.0, (*shape, components)).astype(np.float32).astype(float)
        nurb.gluNurbsSurface(u_knots, v_knots, points, kind)
        maps[name] = ((np.array(u_knots), np.array(v_knots)), points)
    nurb.gluEndSurface()
    return maps


def expected(knots: tuple[Array, Array], points: Array, where: Array) -> Array:
    orders = tuple(len(k) - n for k, n in zip(knots, points.shape, strict=False))
    return evaluate_surface(knots, points, (orders[0], orders[1]), where[:, 0], where[:, 1])


def test_maps_with_knots_of_their_own() -> None:
    """libGLU gives halves of the surface each other's steps, and draws half of a curve."""
    nurb = renderer()
    maps = many_maps(nurb)
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    assert nurbs.ends(0).tolist() == [0.0, 0.125, 0.25, 0.5, 0.75, 1.0]
    assert nurbs.ends(1).tolist() == [0.0, 0.125, 0.25, 0.5, 0.75, 1.0]
    for name, values in (("vertex", found.vertices), ("color", found.colors),
                         ("texcoord", found.texcoords)):  # fmt: skip
        np.testing.assert_allclose(values, expected(*maps[name], found.parameters), atol=4e-7)
    corners = found.parameters[found.primitives]
    a, b = (corners[:, i] - corners[:, 0] for i in (1, 2))
    areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0
    assert (areas > 0.0).all()
    assert areas.sum() == pytest.approx(1.0)


def test_the_gpu_agrees(studio: Studio) -> None:
    gl = Evaluators(studio.ctx)
    nurb = renderer()
    many_maps(nurb)
    (nurbs,) = nurb.take()
    exact = tessellate(nurbs, read_float64)
    for evaluator in studio.painter.capabilities.evaluators:
        found = tessellate(nurbs, lambda recording, e=evaluator: gl.read(recording, evaluator=e))
        assert (found.parameters == exact.parameters).all()
        assert (found.primitives == exact.primitives).all()
        for one, other in ((found.points, exact.points), (found.colors, exact.colors),
                           (found.texcoords, exact.texcoords)):  # fmt: skip
            np.testing.assert_allclose(one, other, atol=1.5e-6)
        np.testing.assert_allclose(found.normals, exact.normals, atol=1e-5)


def test_curves_with_maps_of_their_own() -> None:
    nurb = renderer(20)
    vertices = random.normal(size=(5, 3)).astype(np.float32).astype(float)
    colors = random.uniform(size=(6, 4)).astype(np.float32).astype(float)
    nurb.gluBeginCurve()
    nurb.gluNurbsCurve(CUBIC, vertices, GL_MAP1_VERTEX_3)
    nurb.gluNurbsCurve(QUADRATIC, colors, GL_MAP1_COLOR_4)
    nurb.gluEndCurve()
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    t = found.parameters[:, 0]
    assert found.normals is None
    np.testing.assert_allclose(
        found.points, evaluate_curve(np.array(CUBIC), vertices, 4, t), atol=3e-7
    )
    np.testing.assert_allclose(
        found.colors, evaluate_curve(np.array(QUADRATIC), colors, 3, t), atol=3e-7
    )
    assert [t[strip.vertices[[0, -1]]].tolist() for strip in found.strips] == [
        [0.0, 0.25], [0.25, 0.5], [0.5, 0.75], [0.75, 1.0]
    ]  # fmt: skip
    for one, two in pairwise(found.strips):
        assert (found.points[one.vertices[-1]] == found.points[two.vertices[0]]).all()


def test_a_map_over_another_range_is_extrapolated() -> None:
    nurb = renderer()
    nurb.gluBeginCurve()
    nurb.gluNurbsCurve([0, 0, 2, 2], [[0, 0, 0], [2, 0, 0]], GL_MAP1_VERTEX_3)
    nurb.gluNurbsCurve([0, 0, 1, 1], [[0, 0], [1, 3]], GL_MAP1_TEXTURE_COORD_2)
    nurb.gluEndCurve()
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    np.testing.assert_allclose(found.texcoords[:, 1], 3.0 * found.points[:, 0], atol=1e-6)
    assert found.points[-1, 0] == 2.0


def test_where_a_curve_jumps() -> None:
    nurb = renderer()
    points = [[0, 0, 0], [1, 0, 0], [1, 5, 0], [2, 5, 0]]
    nurb.gluNurbsCurve([0, 0, 0.5, 0.5, 1, 1], points, GL_MAP1_VERTEX_3)
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    assert [found.points[s.vertices[[0, -1]]].tolist() for s in found.strips] == [
        points[:2],
        points[2:],
    ]
    middle = np.array([[0.5, 0.0]] * 2)
    sides = evaluate_at(nurbs, middle, read_float64, np.array([[0.4, 0.0], [0.6, 0.0]]))
    assert sides.points.tolist() == points[1:3]
    assert evaluate_at(nurbs, middle, read_float64).points.tolist() == [points[2]] * 2


def sphere_octant() -> Array:
    """Pole at v = 1."""
    x, y = ARC[:, None, 0] * ARC[:, 0], ARC[:, None, 1] * ARC[:, 0]
    return np.stack([x, y, ARC[:, None, 2] * ARC[:, 1], ARC[:, None, 2] * ARC[:, 2]], -1)


def test_the_pole_of_a_sphere() -> None:
    """libGLU: a normal wrong by 26.6 degrees, and v = .999."""
    nurb = renderer(4, 4)
    nurb.gluNurbsSurface(BEZIER, BEZIER, sphere_octant(), GL_MAP2_VERTEX_4)
    (nurbs,) = nurb.take()
    found = tessellate(nurbs, read_float64)
    pole = found.parameters[:, 1] == 1.0
    assert pole.sum() == 5
    np.testing.assert_allclose(found.points[pole], [[0, 0, 1]] * 5, atol=1e-6)
    np.testing.assert_allclose(found.normals[pole], [[0, 0, 1]] * 5, atol=2e-3)
    np.testing.assert_allclose(found.normals[~pole], found.points[~pole], atol=1e-6)


def test_a_normal_map_is_taken_as_it_is() -> None:
    nurb = renderer()
    nurb.gluBeginSurface()
    nurb.gluNurbsSurface(BEZIER, BEZIER, sphere_octant(), GL_MAP2_VERTEX_4)
    nurb.gluNurbsSurface([0, 1], [0, 1], [[[0, 3, 4]]], GL_MAP2_NORMAL)
    nurb.gluEndSurface()
    (nurbs,) = nurb.take()
    assert (tessellate(nurbs, read_float64).normals == [0, 3, 4]).all()


def square(**properties: float) -> Nurbs:
    """(u, v, 0) in 2 x 2 pieces, of 2 x 1 cells each."""
    nurb = renderer(4, 2)
    names = {"culling": GLU_CULLING, "display": GLU_DISPLAY_MODE, "mode": GLU_NURBS_MODE}
    for name, value in properties.items():
        nurb.gluNurbsProperty(names[name], value)
    nurb.gluLoadSamplingMatrices(np.eye(4), np.eye(4), (0, 0, 256, 256))
    steps = [0.0, 0.0, 0.5, 1.0, 1.0]
    points = [[(x, y, 0) for y in (0, 0.5, 1)] for x in (0.625, 1.125, 1.625)]
    nurb.gluNurbsSurface(steps, steps, points, GL_MAP2_VERTEX_3)
    (nurbs,) = nurb.take()
    return nurbs


def test_display_modes() -> None:
    fill = tessellate(square(), read_float64)
    assert (len(fill.strips), fill.primitives.shape) == (4, (16, 3))
    assert {strip.mode for strip in fill.strips} == {GL_QUAD_STRIP}
    polygon = tessellate(square(display=GLU_OUTLINE_POLYGON), read_float64)
    assert polygon.primitives.shape == (4 * (2 * 2 + 3), 2)
    strips = tessellate(
        square(display=GLU_OUTLINE_POLYGON, mode=GLU_NURBS_TESSELLATOR), read_float64
    )
    assert (strips.primitives == fill.primitives).all(), "as libGLU's"
    patch = tessellate(square(display=GLU_OUTLINE_PATCH), read_float64)
    lines = np.sort(patch.parameters[patch.primitives], 1).reshape(-1, 4).tolist()
    assert len({tuple(line) for line in lines}) == len(lines) == 3 * 4 + 3 * 2
    for u0, v0, u1, v1 in lines:
        assert (u0 == u1 and u0 in (0, 0.5, 1)) or (v0 == v1 and v0 in (0, 0.5, 1))


def test_strips_wind_counter_clockwise() -> None:
    found = tessellate(square(), read_float64)
    for strip in found.strips:
        quads = found.parameters[strip.vertices].reshape(-1, 2, 2)
        for (a, b), (d, c) in pairwise(quads.tolist()):
            for p, q, r in ((a, b, c), (a, c, d)):
                assert (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0


def test_culling() -> None:
    """The view volume ends at x = 1; the right half lies beyond."""
    assert tessellate(square(), read_float64).parameters[:, 0].max() == 1.0
    kept = tessellate(square(culling=1), read_float64)
    assert kept.parameters[:, 0].max() == 0.5
    assert len(kept.primitives) == 8
    whole = evaluate_at(square(culling=1), np.array([[0.75, 0.5]]), read_float64)
    np.testing.assert_allclose(whole.points, [[1.375, 0.5, 0.0]])
