"""Cameras, orthographic or in perspective: where a box of space lands in a viewport.

eye  o---___           Everything is seen in the plane across the view through the pivot, a
     |      ---___     point that the eye faces. Zoom and pan enlarge and shift the picture
     |  plane  |  ---  there and leave the eye where it is, outside all that it sees; for an
     +-------pivot     orthographic picture the eye is infinitely far.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MOST_ZOOM = 1e6
MARGIN = 1.08  # a framed box leaves 4 % of the viewport free on each side
CLEAR = 1.05  # the eye is so much farther from the pivot than anything else
WIDEST = 120.0  # degrees, of a field of view


@dataclass(frozen=True)
class View:
    """What a hand changes: zoom, pan (in model units of the view plane), and the orbit's angles."""

    zoom: float = 1.0
    pan: tuple[float, float] = (0.0, 0.0)
    azimuth: float = -60.0  # degrees about the z-axis; 0 looks along +y, from the front
    elevation: float = 30.0  # degrees above the plane z = 0
    pivot: tuple[float, ...] = ()  # in perspective x, y, z and the eye's distance, if they are kept


def check_view(view: View) -> View:
    """The view itself if a picture can be seen so, else ValueError."""
    numbers = np.array([view.zoom, *view.pan, view.azimuth, view.elevation, *view.pivot])
    if len(view.pan) != 2 or len(view.pivot) not in (0, 4) or not np.isfinite(numbers).all():
        raise ValueError(f"expected finite numbers, a pan of two, a pivot of four, found {view}")
    if not 0.0 < view.zoom <= MOST_ZOOM or abs(view.elevation) > 90.0:
        raise ValueError(
            f"expected a zoom up to {MOST_ZOOM:g} and elevation within 90°, found {view}"
        )
    if view.pivot and view.pivot[3] <= 0.0:
        raise ValueError(f"expected an eye before the pivot, found {view}")
    return view


@dataclass(frozen=True)
class Camera:
    """x, y, z of the viewer (right, up, towards the eye) from model coordinates.

    `rotation` (3, 3), `center` (3,) in model coordinates at the viewport's middle, `half_width`
    and `half_height` of the viewport and `half_depth` before and behind the centre, in model units.
    The eye stands straight before `pivot` (3,), in the plane of `center`, at a `distance`.
    All depths are less by `bias`.
    """

    rotation: Array
    center: Array
    half_width: float
    half_height: float
    half_depth: float
    pivot: Array = field(default_factory=lambda: np.zeros(3))
    distance: float = np.inf
    bias: float = 0.0

    def _eye(self) -> Array:
        """(x, y, 1) / z of the eye from the centre, in the viewer's coordinates."""
        across = self.rotation[:2] @ (self.pivot - self.center)
        return np.array([*across, 1.0]) / self.distance

    def clip_from_model(self) -> Array:
        """The 4 x 4 matrix to clip coordinates, column vectors, near in front (z/w = -1).

        Seen from the eye (a, b, c), the centre being 0, the point (x, y, z) lands in the plane
        z = 0 at (x - a z/c, y - b z/c) / (1 - z/c); depth is -z / (half_depth (1 - z/c)).
        """
        a, b, inverse = self._eye()
        matrix = np.array(
            [
                [1.0 / self.half_width, 0.0, -a / self.half_width, 0.0],
                [0.0, 1.0 / self.half_height, -b / self.half_height, 0.0],
                [0.0, 0.0, self.bias * inverse - 1.0 / self.half_depth, -self.bias],
                [0.0, 0.0, -inverse, 1.0],
            ]
        )
        return matrix @ self._viewer_from_model()

    def _viewer_from_model(self) -> Array:
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation
        matrix[:3, 3] = -self.rotation @ self.center
        return matrix

    def plane_from_model(self) -> Array:
        """The 4 x 4 matrix to (x, y, z, w): at (x, y)/w in the view plane, as `in_view` has it, a
        point is seen, and z/w grows towards the eye. Zoom and pan do not change it."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation
        if np.isfinite(self.distance):
            foot = self.rotation @ self.pivot
            matrix[2, 3] = -foot[2]
            away = -matrix[2] / self.distance
            matrix[:2] += foot[:2, None] * away
            matrix[3] += away
        return matrix

    def nearer(self, depth: float) -> Camera:
        """The same, all things closer to the eye by `depth` (in normalised depth)."""
        return replace(self, bias=self.bias + depth)

    def enlargement(self, point: Array) -> Array:
        """How much larger than in the view plane points (..., 3) are seen, (...,)."""
        return np.asarray(1.0 / (1.0 - (point - self.center) @ self.rotation[2] / self.distance))

    def pixels(self, points: Array, width: float, height: float) -> Array:
        """Pixel coordinates (..., 2), y up from the lower left, of model points (..., 3)."""
        matrix = self.clip_from_model()
        clip = points @ matrix[:, :3].T + matrix[:, 3]
        return np.asarray((clip[..., :2] / clip[..., 3:] + 1.0) / 2.0 * np.array([width, height]))

    def moved(self, point: Array, pixel: Array, width: float, height: float) -> Array:
        """The model point (3,) seen at `pixel`, in the plane through `point` across the view."""
        across = 2.0 * np.array([self.half_width / width, self.half_height / height])
        shift = (pixel - self.pixels(point, width, height)) * across / self.enlargement(point)
        return np.asarray(point + shift[0] * self.rotation[0] + shift[1] * self.rotation[1])

    def in_view(self, pixel: Array, width: float, height: float) -> Array:
        """Coordinates (2,) to the right and up, `rotation[:2] @ point`, of what a pixel shows of
        the view plane."""
        clip = 2.0 * pixel / np.array([width, height]) - 1.0
        half = np.array([self.half_width, self.half_height])
        return np.asarray(self.rotation[:2] @ self.center + clip * half)

    def sight(self, region: tuple[int, int, int, int]) -> tuple[float, float, float, float]:
        """(a, b, c, d): in a viewport (left, bottom, width, height) the eye is seen from what is
        at pixel (x, y) in direction (a + c x, b + d y, 1), in the viewer's coordinates."""
        corner, size = np.array(region[:2]), np.array(region[2:])
        half = np.array([self.half_width, self.half_height])
        start = self._eye()[:2] + half * (1.0 + 2.0 * corner / size) / self.distance
        step = -2.0 * half / size / self.distance
        return float(start[0]), float(start[1]), float(step[0]), float(step[1])


def orbit_rotation(azimuth: float, elevation: float) -> Array:
    """Rows: right, up, towards the eye, for an eye at these angles (degrees), z up."""
    a, e = np.radians([azimuth, elevation])
    right = np.array([np.cos(a), np.sin(a), 0.0])
    eye = np.array([np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)])
    return np.stack([right, np.cross(eye, right), eye])


def frame(
    points: Array,
    width: int,
    height: int,
    view: View,
    spatial: bool,
    field_of_view: float = 0.0,
    others: Array | None = None,
) -> Camera:
    """The camera that shows all of `points` (k, 3), their box centred, whole in the viewport.

    In the plane z = 0 (not `spatial`) it looks straight from above, x right and y up. A spatial
    picture is in perspective if it has a field of view (degrees): the ball around the points'
    box fills it. `others` (k, 3) must lie before the eye too.
    """
    rotation = orbit_rotation(view.azimuth, view.elevation) if spatial else np.eye(3)
    if spatial and field_of_view:
        pivot, distance, farthest = _eye_place(points, view, field_of_view, others)
    else:
        pivot, distance, farthest = np.zeros(3), np.inf, 0.0
    from_pivot = (points - pivot) @ rotation.T
    seen = from_pivot / (1.0 - from_pivot[:, 2:] / distance)
    low, high = seen.min(0), seen.max(0)
    middle = (low + high) / 2.0
    least = max(float(np.abs(seen).max()) * 1e-6, 1e-30)  # of a point, or nearly one
    half = np.maximum((high - low) / 2.0, least)
    scale = max(float(half[0]) / width, float(half[1]) / height) * MARGIN
    half_depth = float(np.linalg.norm(half)) * 2.0
    if np.isfinite(distance):
        middle[2] = 0.0
        near = CLEAR * farthest * distance / (distance - farthest)  # before all that there is
        half_depth = max(2.0 * farthest, near)
    center = pivot + rotation.T @ middle
    scale /= view.zoom
    center = center + rotation[0] * view.pan[0] + rotation[1] * view.pan[1]
    return Camera(rotation, center, scale * width, scale * height, half_depth, pivot, distance)


def _eye_place(
    points: Array, view: View, field_of_view: float, others: Array | None
) -> tuple[Array, float, float]:
    """The pivot, the eye's distance from it, and how far from it anything else is at most."""
    low, high = points.min(0), points.max(0)
    pivot, radius = (low + high) / 2.0, float(np.linalg.norm(high - low)) / 2.0
    radius = max(radius, float(np.abs(points).max()) * 1e-6, 1e-30)
    distance = radius / float(np.sin(np.radians(field_of_view / 2.0)))
    if view.pivot:
        pivot, distance = np.array(view.pivot[:3]), view.pivot[3]
    everything = points if others is None else np.concatenate([points, others])
    farthest = max(radius, float(np.linalg.norm(everything - pivot, axis=-1).max()))
    return pivot, max(distance, CLEAR * farthest), farthest


def view_through(camera: Camera, view: View, framed: Callable[[View], Camera]) -> View:
    """The view by which other points, `framed` by a view, are seen as by `camera`: nothing moves
    on the screen.

    `view` is the one that made the camera; it comes back itself if it still does.
    """
    now = framed(view)
    if now.half_height == camera.half_height and all(
        np.array_equal(a, b) for a, b in ((now.center, camera.center), (now.pivot, camera.pivot))
    ):
        return view
    if np.isfinite(camera.distance):
        view = replace(view, pivot=(*map(float, camera.pivot), camera.distance))
    start = framed(replace(view, zoom=1.0, pan=(0.0, 0.0)))
    x, y, _ = camera.rotation @ (camera.center - start.center)
    return replace(view, zoom=start.half_height / camera.half_height, pan=(float(x), float(y)))
