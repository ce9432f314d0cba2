"""What glEvalMesh2 filled, measured: against the same triangles of a layer of patches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_LINE,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    GL_TRIANGLES,
    Recorder,
    Recording,
)
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.curve import restrict
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import Array
from reparam.gpu.accuracy import Drawn, deviations, silhouette
from reparam.gpu.plans import uniform_plan
from reparam.gpu.recorded_meshes import recorded_meshes
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

SIZE = (160, 120)
LEVEL = 5
NET = np.random.default_rng(8).uniform(-1.0, 1.0, (4, 3, 4))
NET[..., 3] = np.random.default_rng(9).uniform(0.5, 2.0, (4, 3))
POLYNOMIAL = np.where(np.arange(4) == 3, 1.0, NET)


def recorded(make: Callable[[Recorder], object]) -> Recording:
    gl = Recorder()
    make(gl)
    return gl.take()


def mesh(gl: Recorder, net: Array, *, auto: bool = False, domain: tuple[float, float] = (0, 1),
         grid: tuple[float, float] = (0, 1), mode: int = GL_FILL) -> None:  # fmt: skip
    rational = bool((net[..., 3] != 1.0).any())
    target = GL_MAP2_VERTEX_4 if rational else GL_MAP2_VERTEX_3
    gl.glMap2f(target, *domain, *domain, net if rational else net[..., :3])
    gl.glEnable(target)
    (gl.glEnable if auto else gl.glDisable)(GL_AUTO_NORMAL)
    gl.glMapGrid2f(LEVEL, *grid, LEVEL, *grid)
    gl.glEvalMesh2(mode, 0, LEVEL, 0, LEVEL)


def camera(net: Array, field_of_view: float = 40.0) -> Camera:
    view = View(azimuth=20.0, elevation=50.0)
    return frame(sample_surface(net), *SIZE, view, True, field_of_view)


def both(studio: Studio, recording: Recording, nets: Array) -> tuple[Array, Array, Array]:
    """Of meshes, and of the same patches: pixels off of each fragment, outlines.

    The diagonals of glEvalMesh2 run the other way: those of patches turned over run as they do.
    """
    seen, layer = camera(nets), Patches(nets[:, ::-1].copy())
    (meshes,) = recorded_meshes(studio.painter, recording, seen, SIZE)
    drawn = Drawn(studio.painter, layer, seen, "vertex", uniform_plan(layer, LEVEL), SIZE)
    np.testing.assert_allclose(meshes.nets, nets, atol=1e-6)
    assert meshes.triangles == drawn.plan.triangles()
    assert meshes.steps.tolist() == drawn.steps.tolist()
    return deviations(meshes), deviations(drawn), np.array([silhouette(meshes), silhouette(drawn)])


@pytest.mark.parametrize("auto", [False, True])
@pytest.mark.parametrize("net", [NET, POLYNOMIAL], ids=["rational", "polynomial"])
@pytest.mark.parametrize("domain", [(0.0, 1.0), (-2.0, 3.0)])
def test_a_mesh_is_off_as_a_patch_is(
    studio: Studio, net: Array, auto: bool, domain: tuple[float, float]
) -> None:
    recording = recorded(lambda gl: mesh(gl, net, auto=auto, domain=domain, grid=domain))
    ours, patches, outlines = both(studio, recording, net[None])
    assert len(ours) > 3000
    assert abs(len(ours) - len(patches)) <= 3
    assert np.quantile(patches, 0.9) > 1.0
    for share in (0.1, 0.5, 0.9, 0.99):
        assert np.quantile(ours, share) == pytest.approx(np.quantile(patches, share), rel=0.01)
    assert outlines[0] == pytest.approx(outlines[1], rel=0.01)


def test_meshes_of_one_shape_and_parts_of_maps(studio: Studio) -> None:
    """Two patches, of each what a grid over [0.25, 0.75] covers."""
    nets = np.stack([NET, NET + NET[..., 3:] * [2.5, 0.0, 0.0, 0.0]])

    def make(gl: Recorder) -> None:
        for net in nets:
            mesh(gl, net, grid=(0.25, 0.75))

    inner = restrict(restrict(nets, 0.25, 0.75).swapaxes(1, 2), 0.25, 0.75).swapaxes(1, 2)
    ours, patches, outlines = both(studio, recorded(make), inner)
    assert np.mean(ours) == pytest.approx(np.mean(patches), rel=0.01)
    assert outlines[0] == pytest.approx(outlines[1], rel=0.01)


def test_a_wrong_vertex_is_seen(studio: Studio) -> None:
    seen, recording = camera(NET[None]), recorded(lambda gl: mesh(gl, NET))
    (meshes,) = recorded_meshes(studio.painter, recording, seen, SIZE)
    points = meshes.points.copy()
    points[0, 14, 0] += 0.5 * points[0, 14, 3]
    moved = deviations(replace(meshes, points=points)).max()
    assert moved > deviations(meshes).max() + 5.0


def test_lines_and_single_vertices_are_left_out(studio: Studio) -> None:
    def make(gl: Recorder) -> None:
        mesh(gl, NET, mode=GL_LINE)
        gl.glBegin(GL_TRIANGLES)
        for u, v in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)):
            gl.glEvalCoord2f(u, v)
        gl.glEnd()

    assert not list(recorded_meshes(studio.painter, recorded(make), camera(NET[None]), SIZE))
