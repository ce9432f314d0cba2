"""How finely the patches of a layer are drawn: what is asked for, and what was planned.

Apart from adaptive.py, which plans: a picture of one level needs none of that.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..scenes.layers import Patches
from .evaluation import patch_count
from .programs import Program
from .tiles import HARDWARE_LEVEL

Ints = NDArray[np.int64]
SetCommon = Callable[[Program], None]


@dataclass(frozen=True)
class Tolerance:
    """How far off a drawn point may be, in pixels of a viewport.

    Layers that stand `beside` may share edges: they are planned together.
    """

    pixels: float
    viewport: tuple[int, int]
    beside: tuple[Patches, ...] = ()


@dataclass(frozen=True)
class Plan:
    """The patches in view (k,), their levels (k, 2), those of their edges (k, 4), and in how many
    tiles (k, 2) each is drawn.

    An edge has as many steps as the patch along it or, for tessellation, fewer; or, for the vertex
    evaluator, more. That one cuts cells along diagonals that rise, or fall where it says so (k,).
    """

    patches: Ints
    inner: Ints
    edges: Ints
    tiles: Ints
    falling: NDArray[np.bool_]

    def take(self, index: Ints) -> Plan:
        """Some of the patches."""
        return Plan(**{name: column[index] for name, column in vars(self).items()})

    def triangles(self) -> int:
        """How many they make, those counted that have no area."""
        more = self.edges - self.inner[:, [1, 0, 1, 0]]
        return int(2 * self.inner.prod(-1).sum() + np.maximum(more, 0).sum())


def uniform_plan(layer: Patches, level: int) -> Plan:
    """One level for all patches and edges."""
    count = patch_count(layer.net)
    levels, tiles = np.full((count, 2), level), np.full((count, 2), -(-level // HARDWARE_LEVEL))
    return Plan(np.arange(count), levels, levels[:, [1, 0, 1, 0]], tiles, np.zeros(count, bool))
