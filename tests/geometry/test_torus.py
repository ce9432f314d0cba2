"""Pieces of tori lie on them, and stay smooth when their net is edited."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.conics import circle_net
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.net import Array
from reparam.geometry.patch_joins import joins
from reparam.geometry.torus import (
    A,
    B,
    RingNet,
    revolved,
    torus,
    torus_distance,
    two_halves,
)

GRID = np.meshgrid(np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 9), indexing="ij")


def points(ring: RingNet) -> Array:
    return project(evaluate(ring.patches(), *GRID))


@pytest.mark.parametrize("pieces", [3, 4, 6])
def test_a_torus(pieces: int) -> None:
    ring = torus(3.0, 1.0, pieces)
    assert np.abs(torus_distance(points(ring), 3.0, 1.0, 0.0)).max() <= 1e-14
    report = joins(ring.patches().reshape(-1, 3, 3, 4))
    assert len(report.patches) == 2 * pieces**2
    assert report.orders.min() == 3
    assert report.gaps.max() <= 1e-15


def test_unequal_pieces_of_both_circles() -> None:
    profile = circle_net(np.pi * np.array([0.2, 0.35, 0.15, 0.3]), 0.7, (2.0, 0.5), start=0.4)
    circle = circle_net(np.pi * np.array([0.3, 0.3, 0.4]), start=1.0)
    ring = revolved(profile, circle)
    found = points(ring) - [0.0, 0.0, 0.5]
    assert np.abs(torus_distance(found, 2.0, 0.7, 0.0)).max() <= 1e-14
    assert joins(ring.patches().reshape(-1, 3, 3, 4)).orders.min() == 3


def test_any_net_and_weights_stay_smooth() -> None:
    random = np.random.default_rng(3)
    ring = torus(3.0, 1.0, 5)
    net = ring.points + random.normal(0.0, 0.15, ring.points.shape) * [1, 1, 1, 0.3]
    moved = RingNet(net, ring.along_u, ring.along_v)
    report = joins(moved.patches().reshape(-1, 3, 3, 4), highest=1)
    assert len(report.patches) == 50
    assert report.angles.max() <= 1e-10
    assert report.gaps.max() <= 1e-15


def test_two_halves_keep_24_patches_and_an_edit_changes_nine() -> None:
    ring = two_halves()
    on = [(np.abs(torus_distance(points(ring), *t)).max((2, 3)) <= 1e-14) for t in (A, B)]
    assert [np.flatnonzero(which.all(1)).tolist() for which in on] == [[1, 2], [7, 8]]
    assert [int(which.sum()) for which in on] == [12, 12]
    moved = ring.moved((4, 2), np.array([0.0, 0.5, 0.9]))
    changed = (moved.patches() != ring.patches()).any((2, 3, 4))
    assert np.argwhere(changed).tolist() == [[i, j] for i in (3, 4, 5) for j in (1, 2, 3)]
