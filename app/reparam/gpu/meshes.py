"""Triangles of evaluated grids."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError


def triangle_indices(level: int, patches: int) -> NDArray[np.int32]:
    """Vertex numbers (patches, level, level, 6) of the grid's triangles."""
    stride = (level + 1) ** 2
    if patches * stride >= 1 << 31:
        raise GraphicsError(f"expected fewer than 2^31 vertices, found {patches * stride}")
    corner = np.arange(stride, dtype=np.int32).reshape(level + 1, level + 1)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    cells = np.stack([a, b, c, a, c, d], -1)
    return cells + (np.arange(patches, dtype=np.int32) * stride)[:, None, None, None]
