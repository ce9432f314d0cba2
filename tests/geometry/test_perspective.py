"""The camera in perspective: rays from one eye, outside all that is seen; zoom and pan are the
picture's."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from reparam.geometry.camera import MARGIN, WIDEST, Array, Camera, View, frame, view_through
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.inverse import Picker
from reparam.geometry.planar_maps import R

random = np.random.default_rng(7)
POINTS = random.uniform(-1.0, 1.0, (40, 3)) * [3.0, 1.0, 2.0] + [10.0, -4.0, 1.0]
SIZE = (300, 200)
FIELDS = [1.0, 40.0, 90.0, WIDEST]
SEEN = View(2.5, (0.3, -0.2), 17.0, 35.0)


def clip(camera: Camera, points: Array) -> Array:
    matrix = camera.clip_from_model()
    return np.asarray(points @ matrix[:, :3].T + matrix[:, 3])


def eye_of(camera: Camera) -> Array:
    return np.asarray(camera.pivot + camera.distance * camera.rotation[2])


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("angles", [(-60.0, 30.0), (0.0, 0.0), (200.0, -90.0)])
def test_framed_points_fill_the_viewport_before_the_eye(
    field: float, angles: tuple[float, float]
) -> None:
    view = View(azimuth=angles[0], elevation=angles[1])
    seen = clip(frame(POINTS, *SIZE, view, True, field), POINTS)
    assert seen[:, 3].min() > 0.0
    seen = seen[:, :3] / seen[:, 3:]
    low, high = seen[:, :2].min(0), seen[:, :2].max(0)
    np.testing.assert_allclose(low, -high, atol=1e-12)
    assert high.max() == pytest.approx(1.0 / MARGIN)
    assert np.abs(seen[:, 2]).max() < 1.0


@pytest.mark.parametrize("field", FIELDS)
def test_the_ball_around_the_box_fills_the_field_of_view(field: float) -> None:
    camera = frame(POINTS, *SIZE, View(), True, field)
    radius = np.linalg.norm(np.ptp(POINTS, axis=0)) / 2.0
    if field < WIDEST:
        assert np.degrees(np.arcsin(radius / camera.distance)) == pytest.approx(field / 2.0)


@pytest.mark.parametrize("field", FIELDS)
def test_a_pixel_shows_what_lies_on_its_ray(field: float) -> None:
    """The ray from the eye through a point meets the view plane where the pixel says."""
    camera = frame(POINTS, *SIZE, SEEN, True, field)
    eye, away = eye_of(camera), camera.rotation[2]
    for point in POINTS:
        along = point - eye
        hit = eye + along * ((camera.pivot - eye) @ away) / (along @ away)
        at = camera.in_view(camera.pixels(point, *SIZE), *SIZE)
        np.testing.assert_allclose(at, camera.rotation[:2] @ hit, atol=1e-9)
        seen = camera.plane_from_model() @ [*point, 1.0]
        np.testing.assert_allclose(seen[:2] / seen[3], at, atol=1e-9)
        nearer = camera.plane_from_model() @ [*(0.9 * point + 0.1 * eye), 1.0]
        np.testing.assert_allclose(nearer[:2] / nearer[3], at, atol=1e-9)
        assert nearer[2] / nearer[3] > seen[2] / seen[3]


@pytest.mark.parametrize("field", FIELDS)
def test_zoom_and_pan_enlarge_and_shift_the_picture(field: float) -> None:
    still, seen = (frame(POINTS, *SIZE, replaced, True, field) for replaced in (
        View(azimuth=SEEN.azimuth, elevation=SEEN.elevation), SEEN))  # fmt: skip
    a, b = still.pixels(POINTS, *SIZE), seen.pixels(POINTS, *SIZE)
    unit = SIZE[0] / 2.0 / still.half_width
    expected = SEEN.zoom * (a - np.array(SIZE) / 2.0 - unit * np.array(SEEN.pan))
    np.testing.assert_allclose(b - np.array(SIZE) / 2.0, expected, atol=1e-9)
    np.testing.assert_allclose(eye_of(still), eye_of(seen), atol=1e-12)
    assert np.allclose(still.plane_from_model(), seen.plane_from_model(), atol=1e-12)


def test_the_narrowest_field_is_orthographic() -> None:
    narrow, flat = (frame(POINTS, *SIZE, SEEN, True, field) for field in (1e-6, 0.0))
    np.testing.assert_allclose(narrow.pixels(POINTS, *SIZE), flat.pixels(POINTS, *SIZE), atol=1e-5)
    assert frame(POINTS, *SIZE, SEEN, False, 40.0).distance == np.inf


@pytest.mark.parametrize("field", FIELDS)
def test_nearer_changes_depth_alone(field: float) -> None:
    camera = frame(POINTS, *SIZE, SEEN, True, field)
    one, two = (clip(each, POINTS) for each in (camera, camera.nearer(0.01)))
    difference = two / two[:, 3:] - one / one[:, 3:]
    np.testing.assert_allclose(difference, [[0.0, 0.0, -0.01, 0.0]] * 40, atol=1e-12)
    closer = clip(camera, POINTS + 0.1 * camera.rotation[2])
    assert (closer[:, 2] / closer[:, 3] < one[:, 2] / one[:, 3]).all()


def test_a_moved_point_stays_at_its_depth_under_the_pixel() -> None:
    camera = frame(POINTS, *SIZE, SEEN, True, 70.0)
    for point in POINTS[:5]:
        pixel = camera.pixels(point, *SIZE) + np.array([13.0, -7.0])
        moved = camera.moved(point, pixel, *SIZE)
        assert camera.pixels(moved, *SIZE) == pytest.approx(pixel, abs=1e-9)
        assert (moved - point) @ camera.rotation[2] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("field", FIELDS)
def test_whatever_is_there_is_before_the_eye(field: float) -> None:
    others = np.array([[10.0, -4.0, 500.0], [-90.0, 0.0, 0.0]])
    camera = frame(POINTS, *SIZE, SEEN, True, field, others)
    seen = clip(camera, np.concatenate([POINTS, others]))
    assert seen[:, 3].min() > 0.0
    assert (seen[:, 2] / seen[:, 3]).min() > -1.0  # not cut off by the near plane either


def test_sight_goes_to_the_eye() -> None:
    camera = frame(POINTS, *SIZE, SEEN, True, 80.0)
    corner = np.array([30, 50])
    a, b, c, d = camera.sight((30, 50, *SIZE))
    for point in POINTS:
        x, y = camera.pixels(point, *SIZE) + corner
        found = np.array([a + c * x, b + d * y, 1.0])
        expected = camera.rotation @ (eye_of(camera) - point)
        np.testing.assert_allclose(
            found / np.linalg.norm(found), expected / np.linalg.norm(expected), atol=1e-12
        )
    flat = frame(POINTS, *SIZE, SEEN, True)
    assert flat.sight((30, 50, *SIZE)) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("field", [0.0, 60.0])
def test_a_view_keeps_the_picture_where_it_is(field: float) -> None:
    """While points are dragged, which changes what is to be seen and where the eye would be."""
    camera = frame(POINTS, *SIZE, SEEN, True, field)
    moved = POINTS * 1.1 + 0.3

    def framed(view: View, points: Array) -> Camera:
        return frame(points, *SIZE, view, True, field)

    kept = view_through(camera, SEEN, partial(framed, points=moved))
    np.testing.assert_allclose(
        framed(kept, moved).pixels(POINTS, *SIZE), camera.pixels(POINTS, *SIZE), atol=1e-9
    )
    assert view_through(camera, SEEN, partial(framed, points=POINTS)) is SEEN


def test_what_lies_under_a_pixel_is_found() -> None:
    """Of two patches, one behind the other along the ray but not along the view, the nearer."""
    front = R.copy()
    front[..., 2] = 1.5 * front[..., 3]
    nets = np.stack([R, front])
    points = project(nets).reshape(-1, 3)
    camera = frame(points, *SIZE, View(elevation=70.0), True, 60.0)
    picker = Picker(nets @ camera.plane_from_model().T)
    for u, v in ((0.5, 0.5), (0.2, 0.7), (0.9, 0.4)):
        at = camera.in_view(camera.pixels(project(evaluate(front, u, v)), *SIZE), *SIZE)
        assert picker.pick(at) == (1, pytest.approx(u), pytest.approx(v))
