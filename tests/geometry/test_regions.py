"""Counting regions in small masks drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.regions import Mask, count_regions, label_regions, region_centers

CORNER = """
####....
####....
####....
####....
....####
....####
....####
....####
"""
NECK = """
####...####
####...####
###########
####...####
####...####
"""
RING = """
#########
#########
#########
###...###
###...###
###...###
#########
#########
#########
"""
SIZES = """
###...#####.#
###...#####..
###...#####.#
......#####..
###...#####.#
"""


def mask(picture: str) -> Mask:
    return np.array([[c == "#" for c in row] for row in picture.split()])


def numbers(picture: str) -> int:
    labels = label_regions(mask(picture))
    assert ((labels >= 0) == mask(picture)).all()
    return len(np.unique(labels[labels >= 0]))


def test_touching_corners_do_not_join() -> None:
    assert numbers(CORNER) == 2
    assert count_regions(mask(CORNER)) == 2


def test_erosion_parts_a_corner_leak() -> None:
    leaking = mask(CORNER)
    leaking[4, 3] = True
    assert len(np.unique(label_regions(leaking))) == 2
    assert count_regions(leaking) == 2


def test_a_neck_of_one_pixel_is_cut() -> None:
    assert numbers(NECK) == 1
    assert count_regions(mask(NECK)) == 2


def test_a_ring_is_one_region_and_its_hole_another() -> None:
    assert numbers(RING) == 1
    assert count_regions(mask(RING)) == 1
    assert count_regions(~mask(RING)) == 1


@pytest.mark.parametrize(("smallest", "count"), [(0.0, 2), (1.0, 1), (2.5, 1), (9.0, 0)])
def test_small_regions_are_left_out(smallest: float, count: int) -> None:
    assert numbers(SIZES) == 6
    assert count_regions(mask(SIZES), smallest) == count


def test_the_border_is_outside() -> None:
    assert count_regions(np.ones((2, 9), dtype=bool)) == 0
    assert count_regions(np.ones((3, 3), dtype=bool)) == 1


def test_empty() -> None:
    assert count_regions(np.zeros((5, 5), dtype=bool)) == 0
    assert (label_regions(np.zeros((2, 3), dtype=bool)) == -1).all()


@pytest.mark.parametrize("cells", [1, 2, 5, 8])
def test_checkerboard(cells: int) -> None:
    row, column = np.indices((8 * cells, 8 * cells)) // 8
    bright = (row + column) % 2 == 1
    assert count_regions(bright, 3.0) + count_regions(~bright, 3.0) == cells * cells


def test_a_long_winding_region_is_one() -> None:
    snake = np.zeros((41, 41), dtype=bool)
    snake[::2] = True
    snake[1::4, -1] = snake[3::4, 0] = True
    assert len(np.unique(label_regions(snake))) == 2
    snake[21] = False
    assert len(np.unique(label_regions(snake))) == 3


def test_centers() -> None:
    seen = np.zeros((9, 12), bool)
    seen[1:4, 2:5] = True
    seen[6, 7:11] = True
    assert region_centers(seen).tolist() == [[2.5, 3.5], [6.5, 9.0]]
