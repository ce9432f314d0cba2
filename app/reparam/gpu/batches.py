"""Layers evaluated for the vertex path, a batch of patches at a time, and kept while they stay."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import grid_parameters
from .changes import within
from .evaluation import FLOATS, Evaluation
from .kept import Kept

Array = NDArray[np.float64]

BATCH_VERTICES = 1 << 18  # evaluated and drawn at a time
KEPT_BYTES = 1 << 29  # a layer that needs more is evaluated anew for each frame

grid = lru_cache(maxsize=16)(grid_parameters)


@dataclass(frozen=True)
class Batch:
    """Consecutive patches, evaluated: a buffer of vertices."""

    patches: range
    vertices: moderngl.Buffer


class Batches:
    """Evaluates nets on grids; after an edit only the patches that it changed."""

    def __init__(self, evaluation: Evaluation) -> None:
        self._evaluation = evaluation
        self._kept: Kept[list[Batch]] = Kept(_release)

    def evaluated(self, net: Array, level: int, count: int, normals: bool) -> Iterator[Batch]:
        """The net's batches: kept while the same net is drawn, or made one by one if too large."""
        if count * (level + 1) ** 2 * FLOATS[normals] * 4 <= KEPT_BYTES:

            def renew(batches: list[Batch], changed: list[range]) -> None:
                self._renew(batches, changed, net, level, normals)

            key = (level, count, normals)
            yield from self._kept.get(net, key, lambda: list(self._evaluate(net, *key)), renew)
            return
        for batch in self._evaluate(net, level, count, normals):
            yield batch
            batch.vertices.release()

    def _evaluate(self, net: Array, level: int, count: int, normals: bool) -> Iterator[Batch]:
        step = max(1, BATCH_VERTICES // (level + 1) ** 2)
        for first in range(0, count, step):
            patches = range(first, min(first + step, count))
            captured = self._evaluation.run(net, grid(level), patches, normals=normals)
            yield Batch(patches, captured)

    def _renew(
        self, batches: list[Batch], changed: list[range], net: Array, level: int, normals: bool
    ) -> None:
        for batch in batches:
            for run in changed:
                patches = within(run, batch.patches)
                if patches:
                    into = (batch.vertices, patches.start - batch.patches.start)
                    self._evaluation.run(net, grid(level), patches, normals=normals, into=into)

    def sweep(self) -> None:
        """End of a frame."""
        self._kept.sweep()

    def forget(self) -> None:
        """Drop what older shaders evaluated."""
        self._kept.clear()


def _release(batches: list[Batch]) -> None:
    for batch in batches:
        batch.vertices.release()
