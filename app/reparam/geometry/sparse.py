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
        place, counts = first.entries(self.columns)
        return sparse(
            np.repeat(self.rows, counts),
            first.columns[place],
            np.repeat(self.values, counts) * first.values[place],
            (self.shape[0], first.shape[1]),
        )

    def take(self, rows: Indices) -> Sparse:
        """These rows alone; applied, they give the same bits as in the whole."""
        place, counts = self.entries(rows)
        new = np.repeat(np.arange(len(rows)), counts)
        return Sparse(new, self.columns[place], self.values[place], (len(rows), self.shape[1]))

    def rows_with(self, columns: Indices) -> Indices:
        """The rows that depend on any of these columns, each once."""
        order, starts = self._by_column
        ranges = [order[starts[column] : starts[column + 1]] for column in columns]
        return np.unique(self.rows[np.concatenate(ranges)])

    def entries(self, rows: Indices) -> tuple[Indices, Indices]:
        """Where the entries of these rows stand, row after row, and how many each has."""
        counts = (self._starts[1:] - self._starts[:-1])[rows]
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        return np.repeat(self._starts[rows], counts) + within, counts

    @cached_property
    def _starts(self) -> Indices:
        return np.searchsorted(self.rows, np.arange(self.shape[0] + 1))

    @cached_property
    def _by_column(self) -> tuple[Indices, Indices]:
        """The entries column after column, and where each column begins."""
        order = np.argsort(self.columns, kind="stable")
        starts = np.searchsorted(self.columns[order], np.arange(self.shape[1] + 1))
        return order, starts


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
