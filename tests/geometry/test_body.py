"""Bodies: degrees made equal, triangles as degenerate patches, faces of polyhedra."""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import numpy as np
import pytest

from reparam.geometry.body import (
    MAX_POINTS,
    SQUARE_DOMAIN,
    TRIANGLE_DOMAIN,
    Patch,
    body,
    face_patches,
    homogeneous,
    triangle_to_tensor,
)
from reparam.geometry.evaluate import evaluate, evaluate_derivatives
from reparam.geometry.net import Array

random = np.random.default_rng(5)
U, V = np.meshgrid(np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 9), indexing="ij")

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
ARROW = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [3, 1, 0]]
LETTER_L = [[0, 0, 0], [3, 0, 0], [3, 1, 0], [1, 1, 0], [1, 3, 0], [0, 3, 0]]
COMB = [[0, 0, 0], [7, 0, 0], [7, 4, 0], [6, 1, 0], [5, 4, 0], [4, 1, 0], [3, 4, 0], [0, 1, 0]]
SPLIT_SQUARE = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]


def faces(corners: object, tilt: Array | None = None) -> list[Patch]:
    points = np.array(corners, dtype=np.float64) @ (np.eye(3) if tilt is None else tilt)
    return face_patches(points, [list(range(len(points)))])


def direct(points: Array, degree: int, u: Fraction, v: Fraction) -> list[Fraction]:
    """The triangular patch by its definition, at the barycentric point (1-u-v, u, v)."""
    total, index = [Fraction(0)] * 3, 0
    for k in range(degree + 1):
        for j in range(degree - k + 1):
            i = degree - j - k
            count = factorial(degree) // (factorial(i) * factorial(j) * factorial(k))
            factor = count * (1 - u - v) ** i * u**j * v**k
            total = [t + factor * Fraction(x) for t, x in zip(total, points[index], strict=True)]
            index += 1
    return total


@pytest.mark.parametrize("degree", range(7))
def test_triangle_is_the_same_surface(degree: int) -> None:
    points = random.normal(size=((degree + 1) * (degree + 2) // 2, 3))
    net = triangle_to_tensor(points, degree)
    assert net.shape == (degree + 1, degree + 1, 4)
    for a in range(5):
        for b in range(5):
            big_u, big_v = Fraction(a, 4), Fraction(b, 4)
            expected = direct(points, degree, big_u * (1 - big_v), big_u * big_v)
            found = evaluate(net, a / 4, b / 4)
            np.testing.assert_allclose(found[:3], np.array(expected, float), atol=1e-14)


def test_triangle_keeps_the_bits_of_its_edges() -> None:
    points = random.normal(size=(10, 3))
    net = triangle_to_tensor(points, 3)[..., :3]
    assert (net[0] == points[0]).all()
    assert (net[:, 0] == points[[0, 1, 2, 3]]).all()
    assert (net[:, 3] == points[[0, 4, 7, 9]]).all()
    assert (net[3] == points[[3, 6, 8, 9]]).all()


def test_triangle_keeps_orientation_and_parameters() -> None:
    a, b, c = random.normal(size=(3, 3))
    net = triangle_to_tensor(np.stack([a, b, c]), 1)
    along_u, along_v = evaluate_derivatives(net, U[1:], V[1:])
    normal = np.cross(along_u[..., :3], along_v[..., :3])
    assert (normal @ np.cross(b - a, c - a) > 0.0).all()
    own = evaluate(homogeneous(np.pad(TRIANGLE_DOMAIN, ((0, 0), (0, 0), (0, 1)))), U, V)
    np.testing.assert_allclose(own[..., 0], U * (1 - V), atol=1e-15)
    np.testing.assert_allclose(own[..., 1], U * V, atol=1e-15)


def test_triangles_come_in_stacks_and_are_counted() -> None:
    points = random.normal(size=(4, 6, 3))
    assert (triangle_to_tensor(points, 2)[2] == triangle_to_tensor(points[2], 2)).all()
    with pytest.raises(ValueError, match=r"expected points \(..., 10, 3\), found \(6, 3\)"):
        triangle_to_tensor(points[0], 3)


def test_body_raises_asymmetric_nets_to_one_degree() -> None:
    nets = [random.uniform(1.0, 2.0, (m, n, 4)) for m, n in [(2, 4), (1, 3), (5, 1), (2, 4)]]
    result = body([Patch(net, group=name) for net, name in zip(nets, "abca", strict=True)])
    assert result.nets.shape == (4, 5, 5, 4)
    assert result.names == ("a", "b", "c")
    assert result.groups.tolist() == [0, 1, 2, 0]
    assert (result.domains == SQUARE_DOMAIN).all()
    for net, raised in zip(nets, result.nets, strict=True):
        np.testing.assert_allclose(evaluate(raised, U, V), evaluate(net, U, V), rtol=1e-14)


def test_one_edge_is_the_same_bits_in_u_and_in_v() -> None:
    first = random.normal(size=(200, 3, 2, 3))
    second = random.normal(size=(200, 4, 3, 3))
    second[:, 0] = first[:, ::-1, 1]  # the edge v = 1 of the first, turned round
    high = Patch(np.ones((8, 8, 4)))
    patches = [Patch(net) for net in homogeneous(first)] + [Patch(n) for n in homogeneous(second)]
    nets = body([*patches, high]).nets
    assert (nets[:200, ::-1, -1] == nets[200:400, 0]).all()
    assert (nets[:200, 0, 0, :3] == first[:, 0, 0]).all()


def test_body_refuses() -> None:
    good, bad = np.ones((2, 3, 4)), np.ones((2, 3, 4))
    bad[1, 2, 3] = -1.0
    with pytest.raises(ValueError, match="at least one patch"):
        body([])
    with pytest.raises(ValueError, match=r"patch 2: control net\[1, 2\]: expected a weight"):
        body([Patch(good), Patch(np.ones((4, 4, 4))), Patch(bad)])
    with pytest.raises(ValueError, match=r"net \(m, n, 4\).*found \(3, 4\)"):
        Patch(np.ones((3, 4)))
    many = [Patch(np.ones((32, 1, 4)))] * (MAX_POINTS // 32**2 + 1)
    with pytest.raises(ValueError, match=f"at most {MAX_POINTS} control points"):
        body(many)


@pytest.mark.parametrize("start", range(4))
def test_convex_quad_is_one_bilinear_patch(start: int) -> None:
    corners = np.roll(SQUARE, start, 0).astype(float)
    corners[0, 2] = 0.3  # faces need not be flat
    (patch,) = faces(corners)
    assert (patch.net[[0, 1, 1, 0], [0, 0, 1, 1], :3] == corners).all()
    assert (patch.domain == SQUARE_DOMAIN).all()
    along_u, along_v = evaluate_derivatives(patch.net, U, V)
    assert (np.cross(along_u[..., :3], along_v[..., :3])[..., 2] > 0.0).all()


def test_triangular_face_is_a_degenerate_patch() -> None:
    (patch,) = faces(SQUARE[:3])
    assert (patch.net == triangle_to_tensor(np.array(SQUARE[:3], float), 1)).all()
    assert (patch.domain == TRIANGLE_DOMAIN).all()


def corner_triangles(patches: list[Patch]) -> Array:
    """(T, 3, 3): the corners A, B, C of degenerate bilinear patches."""
    nets = np.stack([patch.net for patch in patches])
    assert (nets[:, 0, 0] == nets[:, 0, 1]).all()
    return nets[:, [0, 1, 1], [0, 0, 1], :3]


def areas(triangles: Array) -> Array:
    a, b, c = np.moveaxis(triangles, 1, 0)
    return np.asarray(np.cross(b - a, c - a) / 2.0)


@pytest.mark.parametrize(
    ("corners", "area"),
    [(ARROW, 4.0), (LETTER_L, 5.0), (COMB, 17.5), (SPLIT_SQUARE, 4.0)],
    ids=["arrow", "L", "comb", "split square"],
)
@pytest.mark.parametrize("start", [0, 1, 3])
@pytest.mark.parametrize("turned", [False, True])
def test_polygon_is_covered_once(
    corners: list[list[int]], area: float, start: int, turned: bool
) -> None:
    polygon = np.roll(corners, start, 0)[:: -1 if turned else 1]
    triangles = corner_triangles(faces(polygon))
    signed = areas(triangles)[:, 2] * (-1.0 if turned else 1.0)
    assert len(triangles) == len(corners) - 2
    assert (signed >= 0.0).all()
    assert signed.sum() == pytest.approx(area)
    points = random.uniform(0.0, 7.0, (2000, 1, 2))
    towards = triangles[None, :, :, :2] - points[:, None]
    after = np.roll(towards, -1, 2)
    turn = towards[..., 0] * after[..., 1] - towards[..., 1] * after[..., 0]
    inside = (turn > 0.0).all(-1) | (turn < 0.0).all(-1)
    assert inside.sum(1).max() == 1


@pytest.mark.parametrize("start", range(5))
def test_every_corner_on_a_straight_line_stays(start: int) -> None:
    triangles = corner_triangles(faces(np.roll(SPLIT_SQUARE, start, 0)))
    sides = {tuple(map(tuple, t[[i, (i + 1) % 3], :2])) for t in triangles for i in range(3)}
    assert {((0, 0), (1, 0)), ((1, 0), (2, 0))} <= sides


def test_one_texture_covers_a_polygon_upright() -> None:
    wall = np.array(LETTER_L)[:, [0, 2, 1]] * [1.0, 1.0, 1.0]  # x to the right, z up
    for patch in faces(wall):
        point, domain = patch.net[..., :3], patch.domain
        np.testing.assert_allclose(domain[..., 1], point[..., 0] / 3.0, atol=1e-15)
        np.testing.assert_allclose(domain[..., 0], 1.0 - point[..., 2] / 3.0, atol=1e-15)


def test_tilted_polygon_keeps_its_orientation_and_shape() -> None:
    tilt = np.linalg.qr(random.normal(size=(3, 3)))[0]
    patches = faces(LETTER_L, tilt)
    assert (areas(corner_triangles(patches)) @ (np.linalg.det(tilt) * tilt[2]) > 0.0).all()
    domain = np.stack([patch.domain for patch in patches])
    assert domain.min() == pytest.approx(0.0)
    assert domain.max() == pytest.approx(1.0)


@pytest.mark.parametrize("count", [3, 4, 5, 9])
@pytest.mark.parametrize("step", [0.0, 1e-300, 5e16])
def test_faces_without_area_are_drawn_flat(count: int, step: float) -> None:
    line = np.outer(np.arange(count), [step, 2 * step, 0.0])
    patches = faces(line)
    assert np.isfinite(body(patches).domains).all()
    assert {tuple(p) for patch in patches for p in patch.net[..., :3].reshape(-1, 3)} == {
        tuple(p) for p in line
    }


def test_self_intersecting_polygon_does_no_harm() -> None:
    assert np.isfinite(body(faces(random.normal(size=(300, 3)))).nets).all()


def test_faces_keep_their_order() -> None:
    points = np.array([*LETTER_L, [9, 9, 0]], dtype=np.float64)
    patches = face_patches(points, [[0, 1, 2, 3], [0, 1, 6], [0, 1, 2, 3, 4, 5], [2, 1, 6]], "g")
    assert [patch.group for patch in patches] == ["g"] * 7
    assert (patches[-1].net[0, 0, :3] == points[2]).all()
    assert (patches[1].net[1, 1, :3] == points[6]).all()
