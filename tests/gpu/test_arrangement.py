"""Where spaces stand: columns, spaces below others, and that nothing overlaps or is left over."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.gpu.arrangement import regions
from reparam.gpu.region import Region
from reparam.scenes.layers import Space, plane

BOX = plane(0.0, 0.0, 1.0, 1.0)
FIRST = Space("first", BOX, (), width=2.0, height=3.0)
STRIP = Space("strip", BOX, (), below=True)
SECOND = Space("second", BOX, ())


def test_columns_and_what_stands_below() -> None:
    found = regions([FIRST, STRIP, SECOND], 300, 200, 40)
    assert found == [Region(0, 90, 200, 150), Region(0, 40, 200, 50), Region(200, 40, 100, 200)]


def test_an_upright_picture_has_rows() -> None:
    found = regions([FIRST, STRIP, SECOND], 200, 300, 40)
    assert found == [Region(0, 190, 200, 150), Region(0, 140, 200, 50), Region(0, 40, 200, 100)]


@pytest.mark.parametrize("size", [(301, 199), (97, 211), (64, 64)])
def test_every_pixel_belongs_to_one_space(size: tuple[int, int]) -> None:
    count = np.zeros(size, int)
    for r in regions([FIRST, STRIP, SECOND, STRIP, STRIP], *size, 0):
        count[r.left : r.left + r.width, r.bottom : r.bottom + r.height] += 1
    assert (count == 1).all()
