"""What is said to face away does so at every point, and in every cell of any grid."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.camera import View, frame
from reparam.geometry.evaluate import evaluate, sample_surface
from reparam.geometry.facing import faces_away
from reparam.geometry.net import Array

TRIANGLES = 60


def patches(count: int, bent: float) -> Array:
    """Rational bicubic patches, more or less bent, turned in all directions."""
    random = np.random.default_rng(3)
    t = np.arange(4) / 3.0 - 0.5
    x, y = np.meshgrid(t, t, indexing="ij")
    a, b, c = random.uniform(-bent, bent, (3, count, 1, 1))
    z = a * x * x + b * x * y + c * y * y
    points = np.stack([np.broadcast_to(x, z.shape), np.broadcast_to(y, z.shape), z], -1)
    turns = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    points = np.einsum("pab,pijb->pija", turns, points)
    weights = random.uniform(0.95, 1.05, (count, 4, 4, 1))
    return np.concatenate([points * weights, weights], -1)


def clip(nets: Array, field_of_view: float) -> Array:
    camera = frame(sample_surface(nets), 300, 200, View(), True, field_of_view)
    return np.asarray(nets @ camera.clip_from_model().T)


@pytest.mark.parametrize("field_of_view", [0.0, 60.0])
@pytest.mark.parametrize("bent", [0.0, 0.3, 2.0])
def test_no_triangle_shows_its_front(field_of_view: float, bent: float) -> None:
    nets = clip(patches(60, bent), field_of_view)
    away = faces_away(nets)
    random, fronts = np.random.default_rng(4), np.zeros(60, bool)
    for _ in range(TRIANGLES):
        (u0, u1), (v0, v1) = np.sort(random.uniform(size=(2, 2)))
        for u, v in (([u0, u1, u1], [v0, v0, v1]), ([u0, u1, u0], [v0, v1, v1])):
            corners = evaluate(nets, np.array(u), np.array(v))[..., [0, 1, 3]]
            fronts |= np.linalg.det(corners) > 0.0
    assert not (away & fronts).any()
    assert bent > 1.0 or away.sum() > 0.3 * (~fronts).sum()


def test_what_cannot_be_told_is_kept() -> None:
    nets = clip(patches(20, 0.0), 0.0)
    assert 3 <= faces_away(nets).sum() <= 17
    assert (faces_away(nets) != faces_away(nets.swapaxes(1, 2))).all()
    assert not faces_away(nets * -1.0).any()
    assert not faces_away(nets * [1.0, 1.0, 1.0, 0.0]).any()
