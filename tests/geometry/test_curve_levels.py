"""The bound for curves against what chords are off in float64, in any view."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.bernstein import bernstein
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.curve import curve_net, curve_points, evaluate_curve, restrict
from reparam.geometry.curve_levels import FINEST, curve_bends, iso_bends
from reparam.geometry.net import Array

SIZE = (512, 400)
TOLERANCE = 0.5
WITHIN = 16  # points of a chord


def off(net: Array, camera: Camera, segments: int) -> float:
    """Most pixels between a curve (n, 4) and its chords, at the same parameter, as a rasteriser
    interpolates: in homogeneous coordinates."""
    t = np.linspace(0.0, 1.0, segments * WITHIN + 1)
    clip = evaluate_curve(net, t) @ camera.clip_from_model().T
    share = np.arange(WITHIN)[:, None] / WITHIN
    ends = clip[::WITHIN, None]
    chords = (ends[:-1] * (1.0 - share) + ends[1:] * share).reshape(-1, 4)
    half = np.array(SIZE) / 2.0
    pixels = [points[:, :2] / points[:, 3:] * half for points in (clip[:-1], chords)]
    return float(np.linalg.norm(pixels[0] - pixels[1], axis=-1).max())


def steps_of(nets: Array, camera: Camera) -> NDArray[np.int64]:
    return curve_bends(nets).steps(camera, SIZE[0] / (2.0 * camera.half_width), TOLERANCE)


@pytest.mark.parametrize("field_of_view", [0.0, 40.0, 100.0])
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@pytest.mark.parametrize("rational", [False, True])
def test_no_chord_is_off_by_more(field_of_view: float, degree: int, rational: bool) -> None:
    random = np.random.default_rng(degree)
    sizes = random.uniform(0.05, 1.0, (80, 1, 1))
    points = random.uniform(-1, 1, (80, degree + 1, 3)) * sizes + random.uniform(-2, 2, (80, 1, 3))
    nets = curve_net(points, random.uniform(0.3, 3.0, (80, degree + 1)) if rational else None)
    seen = curve_points(nets, np.linspace(0.0, 1.0, 65)).reshape(-1, 3)
    camera = frame(seen, *SIZE, View(), True, field_of_view)
    found = steps_of(nets, camera)
    errors = [off(net, camera, int(n)) for net, n in zip(nets, found, strict=True)]
    assert max(errors) <= TOLERANCE
    if degree == 1:
        assert rational or (found == 1).all()
    else:
        assert np.median(errors) > TOLERANCE / 20.0
        assert len(np.unique(found)) > 3


def test_a_point_at_infinity_is_halved_away() -> None:
    half_circle = np.array([[[1.0, 0, 0, 1], [0, 1.0, 0, 0], [-1.0, 0, 0, 1]]])
    camera = frame(np.array([[-1.0, 0, 0], [1.0, 1, 0]]), *SIZE, View(), False)
    (found,) = steps_of(half_circle, camera)
    assert off(half_circle[0], camera, int(found)) <= TOLERANCE
    assert found <= 128
    hopeless = half_circle * [1.0, 1.0, 1.0, -1.0]
    assert steps_of(hopeless, camera) == [FINEST]


def test_iso_curves_and_spans() -> None:
    random = np.random.default_rng(3)
    nets = np.concatenate([random.uniform(-1, 1, (2, 4, 3, 3)), np.ones((2, 4, 3, 1))], -1)
    span, camera = (-0.2, 0.7), frame(nets[..., :3].reshape(-1, 3), *SIZE, View(), True)
    found = iso_bends(nets, (0.3, 1.1), (0.5,), span).steps(camera, 100.0, TOLERANCE)
    rows = np.einsum("ki,pijc->kpjc", bernstein(3, [0.3, 1.1]), nets).reshape(-1, 3, 4)
    columns = np.einsum("kj,pijc->kpic", bernstein(2, [0.5]), nets).reshape(-1, 4, 4)
    expected = [
        curve_bends(restrict(curves, *span)).steps(camera, 100.0, TOLERANCE)
        for curves in (rows, columns)
    ]
    assert found.tolist() == np.concatenate(expected).tolist()
    assert iso_bends(nets, (), (), span).steps(camera, 100.0, TOLERANCE).shape == (0,)
