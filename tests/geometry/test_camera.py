"""Cameras: what is framed is seen whole, hands move it as they should, pixels and clip agree."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.camera import MARGIN, Array, Camera, View, frame, orbit_rotation

random = np.random.default_rng(7)
POINTS = random.uniform(-1.0, 1.0, (40, 3)) * [3.0, 1.0, 2.0] + [10.0, -4.0, 1.0]
SIZES = [(512, 512), (800, 300), (200, 640), (1, 1)]
ANGLES = [(-60.0, 30.0), (0.0, 0.0), (90.0, 90.0), (200.0, -45.0), (17.0, -90.0)]


def clip(camera: Camera, points: Array) -> Array:
    matrix = camera.clip_from_model()
    assert (matrix[3] == [0.0, 0.0, 0.0, 1.0]).all()
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("angles", ANGLES)
@pytest.mark.parametrize("spatial", [False, True])
def test_framed_points_fill_the_viewport_but_for_the_margin(
    size: tuple[int, int], angles: tuple[float, float], spatial: bool
) -> None:
    view = View(azimuth=angles[0], elevation=angles[1])
    seen = clip(frame(POINTS, *size, view, spatial), POINTS)
    low, high = seen[:, :2].min(0), seen[:, :2].max(0)
    np.testing.assert_allclose(low, -high, atol=1e-12)
    assert high.max() == pytest.approx(1.0 / MARGIN)
    assert np.abs(seen[:, 2]).max() < 1.0


@pytest.mark.parametrize("size", SIZES)
def test_pixels_are_square(size: tuple[int, int]) -> None:
    camera = frame(POINTS, *size, View(), True)
    assert camera.half_width / size[0] == pytest.approx(camera.half_height / size[1])


def test_plane_is_seen_from_above_y_up() -> None:
    camera = frame(np.array([[0.0, 0.0, 0.0], [2.0, 2.0, 0.0]]), 108, 108, View(), False)
    corners = camera.pixels(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 2.0, 0.0]]), 108, 108)
    np.testing.assert_allclose(corners, [[4, 4], [104, 4], [54, 104]], atol=1e-12)


@pytest.mark.parametrize("size", SIZES)
def test_pixels_agree_with_clip_coordinates(size: tuple[int, int]) -> None:
    camera = frame(POINTS, *size, View(zoom=1.7, pan=(0.2, -0.1)), True)
    expected = (clip(camera, POINTS)[:, :2] + 1.0) / 2.0 * size
    np.testing.assert_allclose(camera.pixels(POINTS, *size), expected, atol=1e-9)
    assert camera.pixels(POINTS.reshape(8, 5, 3), *size).shape == (8, 5, 2)


@pytest.mark.parametrize("spatial", [False, True])
def test_zoom_enlarges_about_the_middle(spatial: bool) -> None:
    one, two = (frame(POINTS, 300, 200, View(zoom=zoom), spatial) for zoom in (1.0, 2.0))
    np.testing.assert_allclose(clip(two, POINTS)[:, :2], 2.0 * clip(one, POINTS)[:, :2], atol=1e-12)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("zoom", [1.0, 3.0])
def test_pan_moves_the_eye_in_model_units(spatial: bool, zoom: float) -> None:
    still = frame(POINTS, 300, 200, View(zoom), spatial)
    moved = frame(POINTS, 300, 200, View(zoom, pan=(0.5, -0.25)), spatial)
    difference = moved.pixels(POINTS, 300, 200) - still.pixels(POINTS, 300, 200)
    pixels_per_unit = 150.0 / still.half_width
    expected = np.array([-0.5, 0.25]) * pixels_per_unit
    np.testing.assert_allclose(difference, np.broadcast_to(expected, (40, 2)), atol=1e-9)
    np.testing.assert_allclose(clip(moved, POINTS)[:, 2], clip(still, POINTS)[:, 2], atol=1e-12)


@pytest.mark.parametrize("angles", [*ANGLES, *random.uniform(-360.0, 360.0, (20, 2)).tolist()])
def test_orbit_rotation_is_a_rotation_with_a_level_horizon(angles: tuple[float, float]) -> None:
    rotation = orbit_rotation(*angles)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert rotation[0, 2] == 0.0


def test_orbit_angles() -> None:
    front, above = orbit_rotation(0.0, 0.0), orbit_rotation(0.0, 90.0)
    np.testing.assert_allclose(front, [[1, 0, 0], [0, 0, 1], [0, -1, 0]], atol=1e-15)
    np.testing.assert_allclose(above, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(orbit_rotation(90.0, 0.0)[2], [1, 0, 0], atol=1e-15)


def test_nearer_things_have_smaller_depth() -> None:
    camera = frame(POINTS, 300, 200, View(), True)
    towards_eye = POINTS + camera.rotation[2]
    assert (clip(camera, towards_eye)[:, 2] < clip(camera, POINTS)[:, 2]).all()
    moved = clip(camera.nearer(0.01), POINTS) - clip(camera, POINTS)
    np.testing.assert_allclose(moved, np.broadcast_to([0.0, 0.0, -0.01], moved.shape), atol=1e-12)


@pytest.mark.parametrize(
    "points",
    [
        [[1.0, 2.0, 3.0]],
        [[1.0, 2.0, 3.0], [1.0 + 2e-16, 2.0, 3.0 - 4e-16]],
        [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]],
        [[0.0, 1.0, 0.0], [0.0, 7.0, 0.0]],
        [[-1e18, -1e18, -1e18], [1e18, 1e18, 1e18]],
        [[0.0, 0.0, 0.0], [1e-18, 1e-18, 1e-18]],
    ],
)
@pytest.mark.parametrize("spatial", [False, True])
def test_degenerate_extents_are_seen(points: list[list[float]], spatial: bool) -> None:
    camera = frame(np.array(points), 300, 200, View(), spatial)
    seen = clip(camera, np.array(points))
    assert np.isfinite(seen).all()
    assert np.abs(seen).max() < 1.0
