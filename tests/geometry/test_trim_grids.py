"""What a packed region is made from: windings and shares of whole grids, graphs and their parts."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.net import Array
from reparam.geometry.trimming import TrimRegion, trim_region
from reparam.geometry.trimming.cells import PLACES, cells_met, corners_of, grid_windings
from reparam.geometry.trimming.cutting import cut_to_boxes
from reparam.geometry.trimming.graphs import FIT, Graphs, graphs_of, horner, moved
from reparam.geometry.trimming.lookup import pixel_coverage, winding_number
from reparam.geometry.trimming.pieces import on_border
from reparam.geometry.trimming.shares import cell_shares, corner_shares
from trim_cases import CASES, SQUARE, Loop, bezier, region_of, reverse

SIDE = 32
ON_LINES: list[Loop] = [
    [np.array([(0.25, 0.25), (0.25, 0.75), (0.5, 0.75), (0.75, 0.5), (0.75, 0.25), (0.25, 0.25)])],
    [np.array([(0.875, 0.125), (0.875, 0.5), (1.25, 0.5), (1.25, 0.125), (0.875, 0.125)])],
]


def region_named(name: str) -> TrimRegion:
    return trim_region(ON_LINES) if name == "on lines" else region_of(name)


def parts(region: TrimRegion) -> tuple[Graphs, Array]:
    return graphs_of(region.pieces), region.pieces.ends[on_border(region.pieces.ends)]


@pytest.mark.parametrize("name", [*CASES, "on lines"])
def test_windings_of_a_grid_are_those_of_its_points(name: str) -> None:
    region = region_named(name)
    points = corners_of(np.zeros((1, 2)), 1.0, SIDE) + PLACES[0] / SIDE
    found, expected = grid_windings(*parts(region), SIDE), region.index.winding(points)
    near = np.abs(region.signed_distance(*points[found != expected].T))
    assert (near < 2.0 * FIT).all()
    assert len(near) <= 1


@pytest.mark.parametrize("name", ["red book", "cusps", "blobs", "over the border", "on lines"])
def test_shares_of_cells_against_many_samples(name: str) -> None:
    region = region_named(name)
    shares = cell_shares(*parts(region), SIDE)
    t = (np.arange(SIDE * 16) + 0.5) / (SIDE * 16)
    samples = region.inside(*np.meshgrid(t, t)).reshape(SIDE, 16, SIDE, 16).mean((1, 3))
    assert np.abs(shares - samples).max() < 0.04
    assert shares.mean() == pytest.approx(region.area(), abs=2e-7)


def test_curves_that_run_along_grid_lines() -> None:
    region = trim_region(ON_LINES)
    points = np.random.default_rng(3).uniform(0.0, 1.0, (4000, 2))
    assert (winding_number(region.pack(), points) == region.inside(*points.T)).all()
    step = np.tile([1.0 / 256.0, 0.0], (3, 1))
    at = np.array([[0.25, 0.4], [0.25, 0.25], [0.875, 0.3]])
    found = pixel_coverage(region.pack(), at, step, step[:, ::-1])
    assert found.tolist() == pytest.approx([0.5, 0.75, 0.5], abs=1e-3)


def test_shares_of_corners() -> None:
    told = corner_shares(np.array([[0.0, 1.0], [0.2, 0.4]]))
    assert told[1, 1].tolist() == [0, 255, 51, 102]
    assert told[0, 2].tolist() == [255] * 4


def test_where_a_graph_takes_a_value() -> None:
    graphs = graphs_of(region_of("blobs").pieces)
    number = np.flatnonzero(graphs.y[:, 0] != graphs.y[:, 1])
    for share in (0.01, 0.4, 0.98):
        y = graphs.y[number, 0] + share * (graphs.y[number, 1] - graphs.y[number, 0])
        x = graphs.solve(number, y)
        assert np.abs(graphs.values(number, x) - y).max() < 1e-12
        assert ((x > graphs.x[number].min(1)) & (x < graphs.x[number].max(1))).all()


def test_polynomials_from_another_start() -> None:
    random = np.random.default_rng(5)
    powers, s = random.normal(size=(10, 7)), random.uniform(0.0, 1.0, 7)
    start, length = random.uniform(0.0, 0.5, (2, 7))
    expected = horner(powers, start + s * length)
    assert horner(moved(powers, start, length), s) == pytest.approx(expected, abs=1e-12)


def test_stretches_follow_their_graphs() -> None:
    """One that bends so much that its numbers do not fit is halved."""
    hook = [bezier((0.5, 0.5), (0.503, 0.5), (0.503, 0.503)), bezier((0.503, 0.503), (0.5, 0.5))]
    region = trim_region([SQUARE, reverse(hook)])
    graphs = graphs_of(region.pieces)
    for side in (8, 256):
        low, step = corners_of(np.zeros((1, 2)), 1.0, side), 1.0 / side / 2**15
        number, cell = cells_met(graphs, side, 0.25)
        margin = 0.25 / side
        cut = cut_to_boxes(graphs, number, cell, low - margin, low + 1.0 / side + margin, step)
        x = cut.graphs.x.mean(1)
        points = np.stack([x, cut.graphs.values(np.arange(len(x)), x)], -1)
        points = np.where(cut.graphs.axis[:, None] == 1, points[:, ::-1], points)
        off = np.abs(region.signed_distance(*points[((points > 0) & (points < 1)).all(1)].T))
        assert off.max() < FIT + max(FIT, 0.3 * step)
        assert np.abs(cut.graphs.bump).max() <= 2.0**14 * step
