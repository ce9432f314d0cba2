"""Surface splines: smooth everywhere, the known spline where it is regular, local and linear."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.mesh import Mesh, mesh
from reparam.geometry.meshes import MESHES, bipyramid, prism
from reparam.geometry.net import Array
from reparam.geometry.partials import partials
from reparam.geometry.patch_joins import fold, joins
from reparam.geometry.surface_spline import edge_ratios, surface_spline

CUBE = MESHES["cube"]()
GRID = np.meshgrid(np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 5), indexing="ij")


def ratios_of(found: Mesh, ratio: float | str) -> Array | float:
    if isinstance(ratio, float):
        return ratio
    return np.random.default_rng(5).uniform(0.1, 0.9, len(found.topology.ends))


def surface_points(nets: Array) -> Array:
    return project(evaluate(nets, *GRID)).reshape(-1, 3)


def distance(points: Array, to: object) -> float:
    return float(np.linalg.norm(points - np.asarray(to), axis=-1).min())


def volume(nets: Array) -> float:
    """(1/3) of the flux of x, exact: Gauss-Legendre with 6 x 6 nodes."""
    nodes, weights = np.polynomial.legendre.leggauss(6)
    u, v = np.meshgrid((nodes + 1) / 2, (nodes + 1) / 2, indexing="ij")
    p = partials(nets, u, v, 1)
    flux = (p[0, 0] * np.cross(p[1, 0], p[0, 1])).sum(-1)
    return float(np.einsum("i,j,pij->", weights / 2, weights / 2, flux) / 3.0)


LARGE = ("three_handles", "torus", "hexagon_torus", "t_mesh", "prism6")  # mixed ratios suffice
CASES = [(name, r) for name in MESHES for r in (0.1, 0.5, 0.9, "mixed")[3 * (name in LARGE) :]]


@pytest.mark.parametrize(("name", "ratio"), CASES)
def test_one_tangent_plane_along_every_edge(name: str, ratio: float | str) -> None:
    found = MESHES[name]()
    nets = surface_spline(found.topology, ratios_of(found, ratio)).nets(found.vertices)
    report = joins(nets, highest=1)
    assert report.angles.max() <= 1e-8
    assert report.gaps.max() <= 1e-14
    assert report.beta.min() > 0.0
    assert not report.opposed.any()
    rim = 4 * np.count_nonzero(found.topology.twin < 0)
    assert len(report.free) == rim
    assert 2 * len(report.patches) + rim == 4 * len(nets)


@pytest.mark.parametrize("name", ["cube", "icosahedron", "three_handles", "prism7", "hill"])
def test_nothing_folds_at_moderate_ratios(name: str) -> None:
    found = MESHES[name]()
    for ratio in (0.1, 0.8):
        nets = surface_spline(found.topology, ratio).nets(found.vertices)
        assert fold(nets, 8).min() > 0.5


def test_disturbed_bodies_stay_smooth() -> None:
    random = np.random.default_rng(2)
    for found in (prism(6), bipyramid(8), MESHES["hexagon_torus"](), MESHES["t_mesh"]()):
        moved = found.vertices + random.normal(0.0, 0.1, found.vertices.shape)
        nets = surface_spline(found.topology, ratios_of(found, "mixed")).nets(moved)
        assert joins(nets, highest=1, samples=9).angles.max() <= 1e-8


def test_halves_on_a_grid_are_the_uniform_biquadratic_spline() -> None:
    random = np.random.default_rng(8)
    height = random.normal(size=(7, 6))
    x, y = np.meshgrid(np.arange(7.0), np.arange(6.0), indexing="ij")
    points = np.stack([x, y, height], -1)
    number = np.arange(42).reshape(7, 6)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1)
    found = mesh(points.reshape(-1, 3), quads.reshape(-1, 4).tolist())
    nets = surface_spline(found.topology, 0.5).nets(found.vertices)
    checked = 0
    for place in surface_points(nets):
        # x of the uniform quadratic spline with coefficients 0, 1, 2 ... is its parameter
        i, j = (int(np.floor(t + 0.5)) for t in place[:2])
        if 1 <= i <= 5 and 1 <= j <= 4:
            row, column = (_quadratic(t + 0.5 - k) for t, k in zip(place[:2], (i, j), strict=True))
            expected = row @ height[i - 1 : i + 2, j - 1 : j + 2] @ column
            assert abs(place[2] - expected) <= 1e-13
            checked += 1
    assert checked > 1000


def _quadratic(t: float) -> Array:
    return np.array([(1 - t) ** 2, 1 + 2 * t - 2 * t * t, t * t]) / 2


@pytest.mark.parametrize("ratio", [0.1, 0.5, 0.9])
def test_the_rounded_cube_in_closed_form(ratio: float) -> None:
    nets = surface_spline(CUBE.topology, ratio).nets(CUBE.vertices)
    points = surface_points(nets)
    corner, edge = 1.0 - 2.0 * ratio / 3.0, 1.0 - ratio / 2.0
    for expected in ([corner] * 3, [edge, edge, 0.0], [1.0, 0.0, 0.0]):
        assert distance(points, expected) <= 1e-14
    known = {0.1: 7.693601953, 0.5: 4.994457582, 0.9: 2.005323275}
    assert volume(nets) == pytest.approx(known[ratio], abs=1e-9)


def test_the_surface_tends_to_the_mesh_as_edges_sharpen() -> None:
    gaps = []
    for ratio in (0.4, 0.2, 0.1, 0.05):
        gaps.append(8.0 - volume(surface_spline(CUBE.topology, ratio).nets(CUBE.vertices)))
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[-1] < 0.11


def test_one_edge_sharpens_alone() -> None:
    t = CUBE.topology
    top = [tuple(ends) for ends in t.ends if (CUBE.vertices[ends][:, 2] > 0.0).all()]
    creases = [(a, b, 0.1) for a, b in top]
    nets = surface_spline(t, edge_ratios(t, 0.6, creases)).nets(CUBE.vertices)
    points = surface_points(nets)
    assert distance(points, [1, 0, 1]) == pytest.approx(0.1 / 2**0.5)
    assert distance(points, [1, 0, -1]) == pytest.approx(0.6 / 2**0.5)


def test_the_boundary_is_kept() -> None:
    found = MESHES["hill"]()
    points = surface_points(surface_spline(found.topology, 0.3).nets(found.vertices))
    t = found.topology
    for v in np.flatnonzero(t.valence == 1):
        assert distance(points, found.vertices[v]) <= 1e-14
    rim = np.flatnonzero(t.twin < 0)
    for a, b in zip(t.origin[rim], t.target[rim], strict=True):
        assert distance(points, found.vertices[[a, b]].mean(0)) <= 1e-14


@pytest.mark.parametrize("name", ["cube", "prism8", "hill", "parasol", "hexagon_torus"])
def test_stencils_are_affine_local_and_what_the_stages_do(name: str) -> None:
    found = MESHES[name]()
    spline = surface_spline(found.topology, ratios_of(found, "mixed"))
    stencils = spline.stencils
    ones = np.ones((len(found.vertices), 1))
    assert np.abs(stencils @ ones - 1.0).max() <= 1e-14
    points = found.vertices
    for stage in spline.stages if spline.raised is None else (*spline.stages, spline.raised):
        points = stage @ points
    assert np.abs(points - stencils @ found.vertices).max() <= 1e-14
    moved = found.vertices.copy()
    moved[3] += [0.1, -0.2, 0.3]
    before = spline.points(found.vertices)
    after = spline.points(moved)
    assert (spline.points_after(before, moved, np.array([3])) == after).all()
    rows = stencils.rows_with(np.array([3]))
    assert np.isin(np.flatnonzero((before != after).any(1)), rows).all()
    if name == "hexagon_torus":
        assert len(rows) < len(points) / 3


def test_own_nets_are_the_common_ones_before_raising() -> None:
    found = MESHES["prism6"]()
    spline = surface_spline(found.topology, 0.3)
    own, nets = spline.own_nets(found.vertices), spline.nets(found.vertices)
    assert [net.shape[0] for net in own] == [3 if size == 4 else 4 for size in spline.facet]
    assert np.bincount(spline.facet).tolist()[3:7] == [3 * 12, 96, 0, 2 * 6]
    for net, raised in zip(own, nets, strict=True):
        both = [evaluate(x, *GRID) for x in (net, raised)]
        assert np.abs(both[0] - both[1]).max() <= 1e-14


def test_patches_meet_in_the_same_bits() -> None:
    found = MESHES["three_handles"]()
    nets = surface_spline(found.topology, 0.3).nets(found.vertices)
    rims = np.concatenate([nets[:, 0], nets[:, -1], nets[:, :, 0], nets[:, :, -1]])
    both = np.concatenate([rims, rims[:, ::-1]])
    _, times = np.unique(both.reshape(len(both), -1), axis=0, return_counts=True)
    assert (times == 2).all()


def test_bad_ratios_name_their_edge() -> None:
    t = CUBE.topology
    for bad in (0.0, 1.0, -0.5, np.nan):
        ratios = np.full(12, 0.5)
        ratios[4] = bad
        a, b = t.ends[4]
        words = f"edge {a}-{b}: expected a ratio between 0 and 1, found {bad:g}"
        with pytest.raises(ValueError, match=words):
            surface_spline(t, ratios)
        with pytest.raises(ValueError, match=words):
            edge_ratios(t, 0.5, [(b, a, bad)])
    with pytest.raises(ValueError, match="expected an edge of the mesh, found 0-0"):
        edge_ratios(t, 0.5, [(0, 0, 0.5)])
