"""What control points say of how patches bend, against float64 surfaces looked at everywhere."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.bends import Bends, bends, mixed_derivative, second_derivative
from reparam.geometry.camera import View, frame
from reparam.geometry.derivative_bounds import hodograph
from reparam.geometry.evaluate import evaluate, sample_surface
from reparam.geometry.levels import edge_bend
from reparam.geometry.net import Array, control_net
from reparam.geometry.planar_maps import R
from reparam.geometry.torus import two_halves

SCALE = (256.0, 200.0)
RULED = control_net([[(-1, 1), (0.2, 1)], [(-0.3, 0), (0.4, 0.1)], [(-1, -1), (1, -1)]])
DENSE = np.meshgrid(np.linspace(0.0, 1.0, 25), np.linspace(0.0, 1.0, 25), indexing="ij")
SLOPES = np.geomspace(1e-3, 1e3, 25)


def random_net(seed: int, perspective: bool = False) -> Array:
    """Of degrees up to 5, the largest weight up to a hundred times the least."""
    random = np.random.default_rng(seed)
    m, n = random.integers(2, 6, 2)
    net = np.ones((m, n, 4))
    net[..., :3] = random.uniform(-1.0, 1.0, (m, n, 3))
    net *= 10.0 ** random.uniform(-0.9, 0.9, (m, n, 1)) ** random.integers(1, 4)
    if not perspective:
        return net
    camera = frame(sample_surface(net), 512, 400, View(azimuth=20.0, elevation=50.0), True, 60.0)
    return np.asarray(net @ camera.clip_from_model().T)


def sphere_octant() -> Array:
    """Of the unit sphere, by quarters (1 - t^2, 2 t) / (1 + t^2)."""
    arc = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 2.0, 2.0]])
    x, y = arc[:, None, 0] * arc[:, 0], arc[:, None, 0] * arc[:, 1]
    return np.stack([x, y, arc[:, None, 1] * arc[:, 2], arc[:, None, 2] * arc[:, 2]], -1)


def bent(net: Array, q: Array | None = None) -> list[Array]:
    """(x'' - q w'') / w in pixels and w'' / w of uu, uv and vv, at DENSE parameters; q is the point
    at the same parameters if not given."""
    point = evaluate(net, *DENSE)
    weight = point[..., 3:]
    q = point[..., :2] / weight if q is None else q
    found = []
    for derivative in (
        second_derivative(net, -3),
        mixed_derivative(net),
        second_derivative(net, -2),
    ):
        over = evaluate(derivative, *DENSE) / weight
        found.append(
            np.concatenate([(over[..., :2] - q * over[..., 3:]) * SCALE, over[..., 3:]], -1)
        )
    return found


def longest(a: Array, b: Array, c: Array, edge: tuple[float, float]) -> float:
    """Of second derivatives along an edge."""
    x, y = edge
    along = x * x * a + 2.0 * x * y * b + y * y * c
    return float(np.hypot(along[..., 0], along[..., 1]).max())


def edges(t: float) -> list[tuple[float, float]]:
    return [(1.0, t), (1.0, -t), (1.0, 0.3 * t), (-0.7, t), (1.0, 0.0), (0.0, t)]


def bound(s: Bends, t: float) -> float:
    return float(edge_bend(s, np.array(t)).max() + s.spread @ [1.0, 2.0 * t, t * t]) * (1.0 + 1e-9)


@pytest.mark.parametrize("perspective", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_no_edge_bends_more(seed: int, perspective: bool) -> None:
    """And measured from the middle wherever q is in the patch."""
    net = random_net(seed, perspective)
    s, point = bends(net, SCALE), evaluate(net, *DENSE)
    places = (point[..., :2] / point[..., 3:])[::12, ::12].reshape(-1, 2)
    found = [bent(net)] if s.speed.any() else [bent(net, q) for q in places]
    for t in SLOPES:
        most = max(longest(a, b, c, edge) for a, b, c in found for edge in edges(t))
        assert most <= bound(s, t)
    turn = np.abs(np.stack(found[0])[..., 2]).max((1, 2))
    assert (turn <= s.weight * (1.0 + 1e-9)).all()


def test_rough_weights_are_measured_from_the_middle_smooth_ones_are_not() -> None:
    rough = [bool(bends(random_net(seed), SCALE).speed.any()) for seed in range(8)]
    assert 0 < sum(rough) < 8
    assert bends(two_halves().patches().reshape(-1, 3, 3, 4), SCALE).speed.all()


@pytest.mark.parametrize("net", [R, RULED, *(random_net(seed, seed % 2 > 0) for seed in range(8))])
def test_first_derivatives_are_bounded(net: Array) -> None:
    s, point = bends(net, SCALE), evaluate(net, *DENSE)
    for k, axis in enumerate((-3, -2)):
        slope = evaluate(hodograph(net, axis), *DENSE) / point[..., 3:]
        assert np.abs(slope[..., 3]).max() <= s.growth[k] * (1.0 + 1e-9)
        moved = (slope[..., :2] - point[..., :2] / point[..., 3:] * slope[..., 3:]) * SCALE
        if s.speed.any():
            assert np.hypot(moved[..., 0], moved[..., 1]).max() <= s.speed[k] * (1.0 + 1e-9)
    assert np.ptp(np.log(point[..., 3])) <= np.log(s.ratio) + 1e-9
    places = (point[..., :2] / point[..., 3:] * SCALE).reshape(-1, 2)
    assert np.hypot(*np.ptp(places, axis=0)) <= s.extent * (1.0 + 1e-9)


@pytest.mark.parametrize("net", [R, RULED, random_net(10) * [1, 1, 1, 0] + [0, 0, 0, 1]])
def test_of_polynomials_nothing_varies(net: Array) -> None:
    """What holds for edges of any slope holds for the control points, of which there is no more."""
    s = bends(net, SCALE)
    for varying in (s.spread, s.weight, s.growth):
        assert not varying.any()
    assert s.ratio == 1.0
    nets = second_derivative(net, -3), mixed_derivative(net), second_derivative(net, -2)
    a, b, c = (derivative[..., :2] * SCALE for derivative in nets)
    for t in SLOPES:
        assert max(longest(a, b, c, edge) for edge in edges(t)) <= bound(s, t)


def test_a_sphere_is_bounded_by_at_most_twice_what_it_bends() -> None:
    """Each control point has its own weight, though they go from 1 to 4."""
    net = sphere_octant()
    s, found = bends(net, SCALE), bent(net)
    for t in (0.01, 0.5, 1.0, 2.0):
        exact = max(longest(*found, edge) for edge in edges(t))
        assert exact <= bound(s, t) <= 2.1 * exact


def test_bends_do_not_depend_on_where_a_patch_is() -> None:
    net = random_net(3)
    moved = net + net[..., 3:] * np.array([7.0, -5.0, 0.0, 0.0])
    for name, value in vars(bends(net, SCALE)).items():
        np.testing.assert_allclose(
            getattr(bends(moved, SCALE), name), value, rtol=1e-9, err_msg=name
        )


def test_a_weight_that_is_not_positive_is_told() -> None:
    net = R.copy()
    net[1, 1, 3] = 0.0
    assert np.isinf(bends(net, SCALE).ratio)


@pytest.mark.parametrize("net", [R, RULED, random_net(5)])
def test_derivatives_are_those_of_the_surface(net: Array) -> None:
    t = np.linspace(0.05, 0.95, 5)
    u, v = np.meshgrid(t, t, indexing="ij")
    h = 1e-3

    def at(du: float, dv: float) -> Array:
        return evaluate(net, u + du * h, v + dv * h)

    expected = {
        -3: at(1, 0) - 2.0 * at(0, 0) + at(-1, 0),
        -2: at(0, 1) - 2.0 * at(0, 0) + at(0, -1),
        0: (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / 4.0,
    }
    for axis, difference in expected.items():
        found = second_derivative(net, axis) if axis else mixed_derivative(net)
        np.testing.assert_allclose(evaluate(found, u, v), difference / h**2, atol=2e-3)
