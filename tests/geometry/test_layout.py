"""Texture maps from the mesh laid flat: true lengths, continuous in a face, the trade of ratios."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.distortion import sampled_distortions
from reparam.geometry.evaluate import evaluate
from reparam.geometry.layout import layout_nets
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array, control_net
from reparam.geometry.surface_spline import surface_spline

IDENTITY = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])


def stretches(nets: Array, maps: Array) -> tuple[Array, Array]:
    """By how much angles are off a right one, and areas."""
    found = sampled_distortions(nets, maps)
    return np.abs(found[..., 2]), np.exp2(found[..., 0])


def test_a_flat_grid_is_laid_out_as_it_is() -> None:
    found = MESHES["hill"]()
    flat = found.vertices * [1.0, 1.0, 0.0]
    for ratio in (0.2, 0.5, 0.8):
        spline = surface_spline(found.topology, ratio)
        angles, areas = stretches(spline.nets(flat), layout_nets(spline, flat))
        assert angles.max() <= 1e-9
        assert np.ptp(areas) <= 1e-12


@pytest.mark.parametrize("name", MESHES)
def test_every_mesh_has_a_layout_of_the_identitys_area(name: str) -> None:
    found = MESHES[name]()
    spline = surface_spline(found.topology, 0.3)
    maps = layout_nets(spline, found.vertices)
    assert maps.shape == (*spline.index.shape, 4)
    assert np.isfinite(maps).all()
    corners = maps[:, [0, -1, -1, 0], [0, 0, -1, -1], :2]
    after = np.roll(corners, -1, 1)
    area = np.sum(corners[..., 0] * after[..., 1] - corners[..., 1] * after[..., 0]) / 2
    assert area == pytest.approx(4.0 * len(maps))


def test_patches_of_one_face_continue_each_others_map() -> None:
    found = MESHES["three_handles"]()
    spline = surface_spline(found.topology, 0.3)
    nets, maps = spline.nets(found.vertices), layout_nets(spline, found.vertices)
    for face in (0, 30, 67):
        members = np.flatnonzero(spline.face == face)
        values: dict[tuple[float, ...], list[np.ndarray]] = {}
        for patch in members:
            for u, v in ((0, 0), (0, 1), (1, 0), (1, 1), (0.3, 0), (0.3, 1), (0, 0.3), (1, 0.3),
                         (0.7, 0), (0.7, 1), (0, 0.7), (1, 0.7)):  # fmt: skip
                at = tuple(np.round(evaluate(nets[patch], u, v)[:3], 9))
                values.setdefault(at, []).append(evaluate(maps[patch], u, v)[:2])
        shared = [found for found in values.values() if len(found) > 1]
        assert len(shared) > 3 * len(members)
        assert max(float(np.ptp(np.stack(found), axis=0).max()) for found in shared) <= 1e-12


def test_the_trade_between_right_angles_and_equal_size() -> None:
    found = MESHES["cube"]()
    by_identity, by_layout = [], []
    for ratio in (0.5, 0.25, 0.1):
        spline = surface_spline(found.topology, ratio)
        nets = spline.nets(found.vertices)
        for maps, into in (
            (IDENTITY, by_identity),
            (layout_nets(spline, found.vertices), by_layout),
        ):
            angles, areas = stretches(nets, maps)
            into.append((angles.mean(), areas.max() / areas.min()))
    sizes = [area for _, area in by_identity]
    assert sizes == sorted(sizes)
    assert sizes[-1] > 500.0
    assert max(area for _, area in by_layout) < 1.5
    assert by_identity[0][0] < by_layout[0][0] / 2  # the identity's angles are the better ones
