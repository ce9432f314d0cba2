"""What an edit touches is made anew, bit for bit as everything would be."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.layout import layout_nets
from reparam.geometry.meshes import MESHES, torus
from reparam.geometry.surface_spline import surface_spline
from reparam.scenes import spline_nets
from reparam.scenes.layers import Picture
from reparam.scenes.spline_nets import maps_of, nets_of, scaled


@pytest.mark.parametrize("name", ["torus", "open_cube", "three_handles"])
def test_edits_leave_what_is_made_anew(name: str) -> None:
    mesh = torus(12, 9) if name == "torus" else MESHES[name]()
    spline, vertices = surface_spline(mesh.topology, 0.3), mesh.vertices
    random = np.random.default_rng(1)
    nets, maps = nets_of(spline, vertices), maps_of(spline, vertices)
    for _ in range(8):
        vertices = vertices.copy()
        vertices[random.integers(len(vertices))] += random.normal(scale=0.1, size=3)
        before, before_maps = nets, maps
        nets, maps = nets_of(spline, vertices), maps_of(spline, vertices)
        for few, all_before in ((nets, before), (maps, before_maps)):
            share = (few != all_before).any((1, 2, 3)).mean()
            assert 0.0 < share < (0.5 if name == "torus" else 1.0)
        spline_nets._nets.forget()
        spline_nets._maps.forget()
        assert (nets == nets_of(spline, vertices.copy())).all()
        assert (maps == maps_of(spline, vertices.copy())).all()


def test_the_picture_has_the_identity_s_size() -> None:
    mesh = MESHES["three_handles"]()
    spline = surface_spline(mesh.topology, 0.3)
    maps = maps_of(spline, mesh.vertices)
    picture = scaled(Picture(scale=0.25), maps)
    seen = maps[..., :2] * picture.scale
    np.testing.assert_allclose(
        seen, layout_nets(spline, mesh.vertices)[..., :2] * 0.25, rtol=0, atol=1e-12
    )
