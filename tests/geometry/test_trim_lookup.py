"""Packed regions, looked up in float64 as the GPU does: sides, shares of pixels, and limits."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.net import Array
from reparam.geometry.trimming import TrimRegion, packing, trim_region
from reparam.geometry.trimming.cells import MANY
from reparam.geometry.trimming.graphs import FIT, graphs_of
from reparam.geometry.trimming.lookup import (
    counts_and_windings,
    find_leaf,
    pixel_coverage,
    winding_number,
)
from reparam.geometry.trimming.pieces import on_border
from trim_cases import CASES, SQUARE, Loop, circle, cusps, discs, petals, region_of, reverse, star

TINY: list[Loop] = [star(np.array([0.3, 0.7]) + 0.002 * k, 9e-4, 9) for k in range(12)]


@pytest.mark.parametrize("name", [*CASES, "tiny"])
def test_the_packed_region_is_the_region(name: str) -> None:
    region = trim_region(TINY) if name == "tiny" else region_of(name)
    packed = region.pack()
    assert region.pack() is packed
    points = np.random.default_rng(1).uniform(0.0, 1.0, (3000, 2))
    if name == "tiny":
        points = points * 0.03 + [0.295, 0.695]
    wrong = winding_number(packed, points) != region.inside(*points.T)
    assert (np.abs(region.signed_distance(*points[wrong].T)) < 1e-7).all()
    assert wrong.sum() <= 1
    assert packed.shares[0].mean() == pytest.approx(region.area(), abs=2e-7)


def test_graphs_are_near_their_curves() -> None:
    for name in ("blobs", "cusps", "slivers"):
        region = region_of(name)
        graphs = graphs_of(region.pieces)
        number = np.arange(len(graphs))
        x = graphs.x
        for share in (0.02, 0.4, 0.9):
            at = x[:, 0] + share * (x[:, 1] - x[:, 0])
            points = np.stack([at, graphs.values(number, at)], -1)
            points = np.where((graphs.axis == 1)[:, None], points[:, ::-1], points)
            within = ((points > 0.0) & (points < 1.0)).all(1)
            off = np.abs(region.signed_distance(*points[within].T))
            assert off.max() < 1.2 * FIT


def supersampled(
    region: TrimRegion, middles: Array, across: Array, up: Array, side: int = 40
) -> Array:
    """The share of pixels that stays, from side x side samples of each."""
    t = (np.arange(side) + 0.5) / side - 0.5
    x, y = (a.reshape(-1, 1) for a in np.meshgrid(t, t))
    places = middles[:, None] + x * across + y * up
    return region.inside(*np.moveaxis(places.clip(1e-9, 1.0 - 1e-9), -1, 0)).mean(1)


@pytest.mark.parametrize("name", ["red book", "cusps", "slivers", "blobs", "over the border"])
@pytest.mark.parametrize("turn", [0.5, -2.3])
def test_coverage_is_what_many_samples_say(name: str, turn: float) -> None:
    region = region_of(name)
    size, mirror = 1.0 / 300.0, -1.0 if turn < 0.0 else 1.0
    across = size * np.array([np.cos(turn), np.sin(turn)])
    up = size * mirror * np.array([-np.sin(turn), np.cos(turn)])
    pieces = region.pieces.take(~on_border(region.pieces.ends))
    random = np.random.default_rng(2)
    piece = random.integers(0, len(pieces), 50)
    low, high = pieces.span[piece].T
    points = pieces.points(piece, random.uniform(low, high)) + random.normal(0.0, size / 3, (50, 2))
    points = points[((points > 0.01) & (points < 0.99)).all(1)]
    shape = (len(points), 1)
    found = pixel_coverage(region.pack(), points, np.tile(across, shape), np.tile(up, shape))
    off = np.abs(found - supersampled(region, points, across, up))
    assert 255.0 * off.max() < 8.0  # where curves bend within a pixel
    assert 255.0 * off.mean() < 1.2


def test_coverage_where_curves_pass_through_pixel_middles() -> None:
    """Right where a comparison with 0 may go either way."""
    loops: list[Loop] = [
        [
            np.array(
                [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.5, 0.5), (0.25, 0.75), (0.25, 0.25)]
            )
        ]
    ]
    region = trim_region(loops)
    t = np.arange(8, 25) / 32.0
    middles = np.stack(np.meshgrid(t, t), -1).reshape(-1, 2)
    step = np.array([1.0 / 32.0, 0.0])
    steps = np.tile(step, (len(middles), 1))
    found = pixel_coverage(region.pack(), middles, steps, steps[:, ::-1])
    expected = supersampled(region, middles, step, step[::-1])
    assert np.abs(found - expected).max() < 0.02


def test_pixels_larger_than_cells_take_shares() -> None:
    region = trim_region([SQUARE, reverse(circle())])
    size = np.array([[0.2, 0.0]] * 2)
    found = pixel_coverage(region.pack(), np.array([[0.5, 0.5], [0.1, 0.1]]), size, size[:, ::-1])
    assert found.tolist() == [0.0, 1.0]


@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_large_pixels_against_many_samples(turn: float) -> None:
    """In cells of the first grid; a hole is 3.2 of them wide."""
    region = region_of("sixty-four")
    middles = np.random.default_rng(6).uniform(0.1, 0.9, (60, 2))
    for width in (0.7, 1.4, 1.9, 11.0):
        across = width / region.pack().sides[-1] * np.array([np.cos(turn), np.sin(turn)])
        up = np.array([-across[1], across[0]])
        steps = (np.tile(step, (60, 1)) for step in (across, up))
        off = pixel_coverage(region.pack(), middles, *steps)
        off = off - supersampled(region, middles, across, up, 16)
        assert np.sqrt((off**2).mean()) < 0.1
        assert abs(off.mean()) < 0.03


def test_more_pieces_in_one_place_than_a_node_can_tell_of(monkeypatch: pytest.MonkeyPatch) -> None:
    region = trim_region(TINY)
    monkeypatch.setattr(packing, "DEPTH", 1)
    assert packing.pack(region.pieces, region.index).nodes[:, 1].max() > 0
    monkeypatch.setattr(packing, "MOST", 4)
    with pytest.raises(ValueError, match="expected up to 4 pieces in one place, found"):
        packing.pack(region.pieces, region.index)


def test_a_thousand_pieces_in_one_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cell that is too full to be divided, or the fullest of which are."""
    region = trim_region(petals(130, 0.3))
    points = np.random.default_rng(9).uniform(0.3, 0.7, (2000, 2))
    monkeypatch.setattr(packing, "sides_of_grids", lambda _: [4])
    for most in (0, 500):
        monkeypatch.setattr(packing, "MOST_DIVIDED", most)
        packed = packing.pack(region.pieces, region.index)
        counts, _ = counts_and_windings(packed, np.arange(len(packed.nodes)))
        assert counts.max() > 260
        assert packed.divided == (most > 0)
        wrong = winding_number(packed, points) != region.inside(*points.T)
        assert (np.abs(region.signed_distance(*points[wrong].T)) < 1e-5).all()


def test_crowded_cells_are_divided() -> None:
    packed = trim_region(TINY).pack()
    finest = packed.sides[0] ** 2
    chosen = np.concatenate([np.arange(finest), np.arange(packed.cells, len(packed.nodes))])
    counts = counts_and_windings(packed, chosen)[0]
    assert len(packed.nodes) > packed.cells
    assert counts[packed.divisions[chosen] == 0].max() <= MANY
    middle = np.array([[0.3, 0.7]])
    sizes = [find_leaf(packed, middle, np.array([[r, r]])).size[0] for r in (1e-6, 2e-3, 1.0)]
    assert sizes[0] < 1.0 / packed.sides[0] < sizes[1] < sizes[2] == 1.0 / packed.sides[-1]


def test_cusps_take_few_graphs() -> None:
    assert len(graphs_of(trim_region(cusps()).pieces)) < 120
    assert len(graphs_of(trim_region([circle(radius=0.1)]).pieces)) == 8
    assert len(trim_region(discs(8)).pack().pieces) < 25000
