"""Patches that are one: how many, the same surface, and what neighbours call their edges."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate
from reparam.geometry.extraction import restricted
from reparam.geometry.layout import layout_nets
from reparam.geometry.merging import CENTRES, merging
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array
from reparam.geometry.surface_spline import surface_spline

QUARTERS = np.array([[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]])


def parts_again(merged: Array) -> Array:
    """Each merged net cut in four at 1/2: (M, 4, m, m, 4)."""
    return np.stack([restricted(net, QUARTERS, QUARTERS + 0.5) for net in merged])


@pytest.mark.parametrize(
    ("name", "count"), [("three_handles", 704), ("torus", 192), ("cube", 96), ("prism9", None)]
)
@pytest.mark.parametrize("ratio", [0.5, 0.2])
def test_how_many_there_are(name: str, count: int | None, ratio: float) -> None:
    found = MESHES[name]()
    spline = surface_spline(found.topology, ratio)
    both = merging(spline)
    assert count in (None, len(both))
    assert len(both.kept) + 4 * len(both.parts) == len(spline.facet)
    assert (spline.facet[both.parts] == 4).all()


@pytest.mark.parametrize("name", ["three_handles", "torus", "hill", "open_cube"])
@pytest.mark.parametrize("texture", [False, True])
def test_the_parts_are_what_they_were(name: str, texture: bool) -> None:
    found = MESHES[name]()
    random = np.random.default_rng(1)
    ratios = random.uniform(0.1, 0.9, len(found.topology.ends))
    vertices = found.vertices + random.normal(0.0, 0.02, found.vertices.shape)
    spline = surface_spline(found.topology, ratios)
    nets = layout_nets(spline, vertices) if texture else spline.nets(vertices)
    both = merging(spline)
    assert len(both.parts) > 0
    merged = both.nets(nets)
    assert (merged[: len(both.kept)] == nets[both.kept]).all()
    size = np.ptp(nets[..., :3])
    for k, (parts, turns) in enumerate(zip(both.parts, both.turns, strict=True)):
        again = restricted(merged[len(both.kept) + k], QUARTERS, QUARTERS + 0.5)
        for i in range(4):
            was = np.rot90(nets[parts[i]], turns[i])
            assert np.abs(again[i] - was).max() <= 1e-15 * size


def test_the_centre_is_where_it_is_said_to_be() -> None:
    found = MESHES["torus"]()
    spline = surface_spline(found.topology)
    both = merging(spline)
    nets = spline.nets(found.vertices)
    for parts, turns in zip(both.parts[:20], both.turns[:20], strict=True):
        corners = [np.rot90(nets[p], t)[at] for p, t, at in zip(parts, turns, CENTRES, strict=True)]
        assert np.ptp(corners, axis=0).max() == 0.0


def test_neighbours_name_their_edges_alike() -> None:
    found = MESHES["torus"]()
    spline = surface_spline(found.topology)
    both = merging(spline)
    index, nets = both.index(spline.index), both.nets(spline.nets(found.vertices))
    sides = np.concatenate([index[:, 0], index[:, -1], index[:, :, 0], index[:, :, -1]])
    assert (sides >= 0).all()
    sides = np.where(sides[:, :1] > sides[:, -1:], sides[:, ::-1], sides)
    assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()  # closed, all merged
    middle = evaluate(nets[:1], 0.0, 0.5)[0]
    again = parts_again(nets[:1])[0]
    assert again[0][0, -1] == pytest.approx(middle)


def test_nothing_merges_where_a_facet_is_near_or_a_cut_is_no_half() -> None:
    for name in ("cube", "tetrahedron", "icosahedron"):
        spline = surface_spline(MESHES[name]().topology)
        both = merging(spline)
        assert len(both) == len(spline.facet)
        assert (both.nets(spline.nets(MESHES[name]().vertices)).shape[0]) == len(spline.facet)
