"""What maps do to small squares: closed forms, singular values, and where they have none."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.distortion import FARTHEST, distortions, sampled_distortions
from reparam.geometry.evaluate import evaluate
from reparam.geometry.net import Array, control_net
from reparam.geometry.planar_maps import ALIGNED_IDENTITY, R
from reparam.geometry.stretch import stretch

SQUARE = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])


def test_a_shear() -> None:
    sheared = control_net([[(0, 0, 0), (0, 3, 0)], [(2, 1, 0), (2, 4, 0)]])  # area 6
    area, longest, angle = np.moveaxis(sampled_distortions(sheared[None], SQUARE), -1, 0)
    assert np.exp2(area) == pytest.approx(6.0)
    ways = np.linalg.svd([[2.0, 0.0], [1.0, 3.0]], compute_uv=False)
    assert np.exp2(longest) == pytest.approx(ways[0] / ways[1])
    assert angle == pytest.approx(np.degrees(np.arccos(1 / 5**0.5)) - 90.0)


def test_nothing_happens_under_the_patchs_own_map() -> None:
    assert np.abs(sampled_distortions(R[None], R)).max() < 1e-6


def test_r_in_closed_form() -> None:
    u, v = np.array([0.5, 0.2, 0.9]), np.array([0.5, 0.7, 0.35])
    U, V = 2.0 * u - 1.0, 2.0 * v - 1.0
    area = 0.75 * (3.0 - U * U - V * V - U * U * V * V)  # det d(x,y)/d(V,-U)
    assert np.exp2(distortions(R, ALIGNED_IDENTITY, u, v)[:, 0]) == pytest.approx(area)


def test_against_the_singular_values_of_rational_maps_in_space() -> None:
    random = np.random.default_rng(1)

    def rational(order: int) -> Array:
        t = np.linspace(0.0, 1.0, order)
        x, y = np.meshgrid(t, t, indexing="ij")
        points = np.stack([x, y, 0.0 * x, 1.0 + 0.0 * x], -1)
        points[..., :3] += random.uniform(-0.2, 0.2, (order, order, 3)) / order
        return points * random.uniform(0.7, 1.4, (order, order, 1))

    net, maps = rational(4), rational(3)
    maps[..., 2] = 0.0
    for u, v in ((0.3, 0.6), (0.0, 1.0)):
        ours = distortions(net, maps, u, v)
        carried = stretch(net, u, v).after(stretch(maps, u, v))
        assert carried is not None
        largest, least = carried.factors
        assert ours[:2] == pytest.approx(np.log2([largest * least, largest / least]))
        a, b = carried.jacobian.T
        cosine = a @ b / np.linalg.norm(a) / np.linalg.norm(b)
        assert ours[2] == pytest.approx(np.degrees(np.arccos(cosine)) - 90.0)


def test_where_there_is_no_derivative() -> None:
    flat = np.zeros((2, 2, 4))
    flat[..., 3] = 1.0
    assert np.isnan(distortions(R, flat, 0.5, 0.5)[:2]).all()
    area, longest, angle = distortions(R, SQUARE, 0.0, 0.0)  # a corner, where det is 0
    assert (area, longest) == (-FARTHEST, FARTHEST)
    assert abs(angle) == pytest.approx(90.0)
    assert evaluate(R, 0.0, 0.0)[3] == 1.0
