"""Exact outlines against closed forms: sphere, torus, r; distances against brute force."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.camera import View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import Array, control_net
from reparam.geometry.planar_maps import R
from reparam.geometry.silhouette import distances, outline

SIZE = np.array([512.0, 512.0])


def sphere() -> Array:
    """Eight octants of the unit sphere, rational biquadratic, (8, 3, 3, 4)."""
    arc = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])
    x, y = arc[:, None, 0] * arc[:, 0], arc[:, None, 0] * arc[:, 1]
    z, w = arc[:, None, 1] * arc[:, 2], arc[:, None, 2] * arc[:, 2]
    octant = np.stack([x, y, z, w], -1)
    signs = np.stack(np.meshgrid([1, -1], [1, -1], [1, -1]), -1).reshape(8, 1, 1, 3)
    return np.asarray(octant * np.concatenate([signs, np.ones((8, 1, 1, 1))], -1))


def seen(nets: Array, view: View, field_of_view: float = 0.0, spatial: bool = True) -> Array:
    """In homogeneous pixels."""
    size = int(SIZE[0]), int(SIZE[1])
    camera = frame(sample_surface(nets), *size, view, spatial, field_of_view)
    clip = nets @ camera.clip_from_model().T
    pixels = (clip[..., :2] + clip[..., 3:]) / 2.0 * SIZE
    return np.concatenate([pixels, clip[..., 3:]], -1)


@pytest.mark.parametrize("view", [View(), View(azimuth=17.0, elevation=81.0)])
def test_a_sphere_s_outline_is_a_circle(view: View) -> None:
    nets = sphere()
    pieces = outline(nets, seen(nets, view), np.full(8, 64))
    radius = 512 / 2.16
    away = np.linalg.norm(pieces - 256.0, axis=-1)
    assert np.abs(away - radius).max() < 0.02  # the poles' collapsed edges lie inside
    angles = np.sort(np.arctan2(*(pieces[:, 0] - 256.0).T))
    assert np.diff(angles).max() < 0.08  # all around


def test_in_perspective_it_is_the_cone_s() -> None:
    """Seen upon the ball's middle from 1/sin(20) radii away the outline is a circle again."""
    nets = sphere()
    pieces = outline(nets, seen(nets, View(), 40.0), np.full(8, 64))
    away = np.linalg.norm(pieces - 256.0, axis=-1)
    assert np.ptp(away) < 0.05
    assert away.mean() == pytest.approx(512 / 2.16, abs=0.5)


def test_a_patch_in_the_plane_has_its_border() -> None:
    pieces = outline(R[None], seen(R[None], View(), spatial=False), np.array([64]))
    half = 512 / (3 * 1.08) * 1.5
    right = pieces[np.abs(pieces[..., 0] - 256.0).max(-1) > 0.99 * half]
    assert len(right)
    lengths = np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=-1)
    assert lengths.sum() == pytest.approx(9.18234860 * 512 / (3 * 1.08), rel=1e-3)


def test_what_neighbours_share_is_no_border() -> None:
    flat = control_net([[[(0, 0), (0, 1)], [(1, 0), (1, 1)]], [[(1, 0), (1, 1)], [(2, 0), (2, 1)]]])
    pixels = seen(flat, View(), spatial=False)
    pieces = outline(flat, pixels, np.array([8, 8]))
    assert len(pieces) == 6 * 8
    assert np.abs(pieces[..., 0].mean(-1) - 256.0).min() > 10.0
    assert len(outline(flat, pixels, np.array([8, 0]))) == 3 * 8  # 0: left out


def test_distances_against_brute_force() -> None:
    random = np.random.default_rng(1)
    start = random.uniform(0, 300, (200, 2))
    pieces = np.stack([start, start + random.normal(size=(200, 2)) * 9.0], 1)
    points = np.concatenate([random.uniform(0, 300, (500, 2)), [[5000.0, -900.0]]])
    way = pieces[:, 1] - pieces[:, 0]
    from_start = points[:, None] - pieces[:, 0]
    share = np.clip((from_start * way).sum(-1) / (way * way).sum(-1), 0.0, 1.0)
    expected = np.linalg.norm(from_start - share[..., None] * way, axis=-1).min(1)
    np.testing.assert_allclose(distances(points, pieces), expected, rtol=1e-12)
    assert np.isinf(distances(points, np.zeros((0, 2, 2)))).all()
