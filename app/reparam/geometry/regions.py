"""Counting the regions of a picture: what can be said of it without a stored image."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


def label_regions(mask: Mask) -> NDArray[np.int64]:
    """The 4-connected components of a mask: one number a component, -1 outside the mask.

    Each pixel takes the smallest number among its neighbours, and then that of the pixel so
    numbered (pointer jumping), until nothing changes.
    """
    size = mask.size
    labels = np.where(mask, np.arange(size).reshape(mask.shape), size)
    while True:
        padded = np.pad(labels, 1, constant_values=size)
        smallest = np.minimum.reduce(
            [labels, padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
        )
        smallest = np.where(mask, smallest, size)
        lookup = np.append(smallest.ravel(), size)
        smallest = lookup[lookup[smallest]]
        if np.array_equal(smallest, labels):
            return np.where(mask, labels, -1)
        labels = smallest


def count_regions(mask: Mask, smallest: float = 0.0) -> int:
    """How many components of more than `smallest` pixels the mask has, after one erosion.

    The erosion parts regions that touch at a corner only.
    """
    core = np.pad(mask, 1)
    core = core[1:-1, 1:-1] & core[:-2, 1:-1] & core[2:, 1:-1] & core[1:-1, :-2] & core[1:-1, 2:]
    labels = label_regions(core)
    _, sizes = np.unique(labels[labels >= 0], return_counts=True)
    return int(np.count_nonzero(sizes > smallest))


def region_centers(mask: Mask) -> NDArray[np.float64]:
    """The mean (row, column) of each component's pixel centres, shape (components, 2)."""
    labels = label_regions(mask)
    rows, columns = np.nonzero(labels >= 0)
    _, which = np.unique(labels[rows, columns], return_inverse=True)
    sizes = np.bincount(which)
    sums = [np.bincount(which, at + 0.5) for at in (rows, columns)]
    return np.stack(sums, -1) / sizes[:, None]
