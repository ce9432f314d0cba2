"""Sparse linear maps: stencils that make points out of few other points.

Coordinates sorted by row in three numpy arrays. Only what stencils need: apply, compose, and one
column, so that an edit touches no more than it must.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Sparse:
    """A matrix of `shape`: `values` at (`rows`, `columns`), each place once, in row-major order."""

    rows: Indices
    columns: Indices
    values: Array
    shape: tuple[int, int]

    def __matmul__(self, points: Array) -> Array:
        """The map applied to points (columns, d): (rows, d)."""
        products = [self.values * coordinate[self.columns] for coordinate in points.T]
        sums = [np.bincount(self.rows, terms, self.shape[0]) for terms in products]
        return np.stack(sums, -1)

    def after(self, first: Sparse) -> Sparse:
        """The map that applies `first` and then this one: the product self first."""
        counts = (first._starts[1:] - first._starts[:-1])[self.columns]
        ends = np.cumsum(counts)
        within = np.arange(ends[-1]) - np.repeat(ends - counts, counts)
        place = np.repeat(first._starts[self.columns], counts) + within
        return sparse(
            np.repeat(self.rows, counts),
            first.columns[place],
            np.repeat(self.values, counts) * first.values[place],
            (self.shape[0], first.shape[1]),
        )

    def take(self, rows: Indices) -> Sparse:
        """These rows alone, each once and in increasing order."""
        kept = np.isin(self.rows, rows)
        place = np.searchsorted(rows, self.rows[kept])
        return Sparse(place, self.columns[kept], self.values[kept], (len(rows), self.shape[1]))

    def column(self, index: int) -> tuple[Indices, Array]:
        """The rows in which a column occurs, and its factors there."""
        low, high = np.searchsorted(self.columns[self._by_column], [index, index + 1])
        place = self._by_column[low:high]
        return self.rows[place], self.values[place]

    @cached_property
    def _starts(self) -> Indices:
        return np.searchsorted(self.rows, np.arange(self.shape[0] + 1))

    @cached_property
    def _by_column(self) -> Indices:
        return np.argsort(self.columns, kind="stable")


def sparse(rows: Indices, columns: Indices, values: Array, shape: tuple[int, int]) -> Sparse:
    """The matrix of these entries in any order; entries of one place are added."""
    places, entry = np.unique(rows * shape[1] + columns, return_inverse=True)
    sums = np.asarray(np.bincount(entry, values, len(places)), dtype=np.float64)
    return Sparse(places // shape[1], places % shape[1], sums, shape)


def chain(stages: Iterable[Sparse]) -> Sparse:
    """The map that applies these in turn, the first one first."""
    return reduce(lambda first, stage: stage.after(first), stages)


class Stencils:
    """Collects entries of a sparse matrix, block by block."""

    def __init__(self) -> None:
        self._parts: list[tuple[Indices, Indices, Array]] = []

    def add(self, rows: object, columns: object, values: object) -> None:
        """Entries whose row, column and value are broadcast against each other."""
        r, c, x = np.broadcast_arrays(np.asarray(rows), np.asarray(columns), np.asarray(values))
        self._parts.append((r.ravel().astype(np.intp), c.ravel().astype(np.intp), x.ravel() * 1.0))

    def matrix(self, shape: tuple[int, int]) -> Sparse:
        """What was collected."""
        rows, columns, values = (np.concatenate(part) for part in zip(*self._parts, strict=True))
        return sparse(rows, columns, values, shape)
