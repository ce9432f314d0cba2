"""Orthographic cameras: where a box of space lands in a viewport."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MOST_ZOOM = 1e6
MARGIN = 1.08  # a framed box leaves 4 % of the viewport free on each side


@dataclass(frozen=True)
class View:
    """What a hand changes: zoom, pan (in model units of the view plane), and the orbit's angles."""

    zoom: float = 1.0
    pan: tuple[float, float] = (0.0, 0.0)
    azimuth: float = -60.0  # degrees about the z-axis; 0 looks along +y, from the front
    elevation: float = 30.0  # degrees above the plane z = 0


def check_view(view: View) -> View:
    """The view itself if a picture can be seen so, else ValueError."""
    numbers = np.array([view.zoom, *view.pan, view.azimuth, view.elevation])
    if len(view.pan) != 2 or not np.isfinite(numbers).all():
        raise ValueError(f"expected finite numbers and a pan of two, found {view}")
    if not 0.0 < view.zoom <= MOST_ZOOM or abs(view.elevation) > 90.0:
        raise ValueError(
            f"expected a zoom up to {MOST_ZOOM:g} and elevation within 90°, found {view}"
        )
    return view


@dataclass(frozen=True)
class Camera:
    """x, y, z of the viewer (right, up, towards the eye) from model coordinates.

    `rotation` (3, 3), `center` (3,) in model coordinates at the viewport's middle, `half_width`
    and `half_height` of the viewport and `half_depth` before and behind the centre, in model units.
    """

    rotation: Array
    center: Array
    half_width: float
    half_height: float
    half_depth: float

    def clip_from_model(self) -> Array:
        """The 4 x 4 matrix to clip coordinates, column vectors, near in front (z = -1)."""
        extent = np.array([self.half_width, self.half_height, -self.half_depth])
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation / extent[:, None]
        matrix[:3, 3] = -matrix[:3, :3] @ self.center
        return matrix

    def nearer(self, depth: float) -> Camera:
        """The same, all things closer to the eye by `depth` (in normalised depth)."""
        away = self.rotation[2] * (depth * self.half_depth)
        return replace(self, center=self.center - away)

    def pixels(self, points: Array, width: float, height: float) -> Array:
        """Pixel coordinates (..., 2), y up from the lower left, of model points (..., 3)."""
        matrix = self.clip_from_model()
        clip = points @ matrix[:2, :3].T + matrix[:2, 3]
        return np.asarray((clip + 1.0) / 2.0 * np.array([width, height]))

    def moved(self, point: Array, pixel: Array, width: float, height: float) -> Array:
        """The model point (3,) seen at `pixel`, in the plane through `point` across the view."""
        across = 2.0 * np.array([self.half_width / width, self.half_height / height])
        right, up = (pixel - self.pixels(point, width, height)) * across
        return np.asarray(point + right * self.rotation[0] + up * self.rotation[1])

    def in_view(self, pixel: Array, width: float, height: float) -> Array:
        """Coordinates (2,) to the right and up, `rotation[:2] @ point`, of what a pixel shows."""
        clip = 2.0 * pixel / np.array([width, height]) - 1.0
        half = np.array([self.half_width, self.half_height])
        return np.asarray(self.rotation[:2] @ self.center + clip * half)


def orbit_rotation(azimuth: float, elevation: float) -> Array:
    """Rows: right, up, towards the eye, for an eye at these angles (degrees), z up."""
    a, e = np.radians([azimuth, elevation])
    right = np.array([np.cos(a), np.sin(a), 0.0])
    eye = np.array([np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)])
    return np.stack([right, np.cross(eye, right), eye])


def frame(points: Array, width: int, height: int, view: View, spatial: bool) -> Camera:
    """The camera that shows all of `points` (k, 3), their box centred, whole in the viewport.

    In the plane z = 0 (not `spatial`) it looks straight from above, x right and y up.
    """
    rotation = orbit_rotation(view.azimuth, view.elevation) if spatial else np.eye(3)
    seen = points @ rotation.T
    low, high = seen.min(0), seen.max(0)
    center = rotation.T @ ((low + high) / 2.0)
    least = max(float(np.abs(seen).max()) * 1e-6, 1e-30)  # of a point, or nearly one
    half = np.maximum((high - low) / 2.0, least)
    scale = max(float(half[0]) / width, float(half[1]) / height) * MARGIN
    half_depth = float(np.linalg.norm(half)) * 2.0
    scale /= view.zoom
    center = center + rotation[0] * view.pan[0] + rotation[1] * view.pan[1]
    return Camera(rotation, center, scale * width, scale * height, half_depth)


def view_through(
    camera: Camera, points: Array, width: int, height: int, view: View, spatial: bool
) -> View:
    """The view by which `frame` shows other `points` as `camera` does: nothing moves on the screen.

    `view` is the one that made the camera; it comes back itself if it still does.
    """
    framed = frame(points, width, height, view, spatial)
    if framed.half_height == camera.half_height and np.array_equal(framed.center, camera.center):
        return view
    start = frame(points, width, height, replace(view, zoom=1.0, pan=(0.0, 0.0)), spatial)
    x, y, _ = camera.rotation @ (camera.center - start.center)
    return replace(view, zoom=start.half_height / camera.half_height, pan=(float(x), float(y)))
