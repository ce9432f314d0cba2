"""Winding numbers of closed loops of monotone pieces, in float64, and the distance to them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .pieces import Array, Indices, Pieces

PAIRS = 1 << 21  # of a point and a piece, looked at in one go
ROWS_PER_PIECE = 0.5
MOST_ROWS = 4096


class WindingIndex:
    """Counts how often loops go round points: the pieces by horizontal bands."""

    def __init__(self, pieces: Pieces) -> None:
        self.pieces = pieces
        self._low, self._high = pieces.ends.min(1), pieces.ends.max(1)
        v = pieces.ends[..., 1]
        self._bottom = float(v.min(initial=0.0))
        height = float(v.max(initial=1.0)) - self._bottom
        self._rows = int(np.clip(ROWS_PER_PIECE * len(pieces), 1, MOST_ROWS))
        self._scale = self._rows / height if height > 0.0 else 0.0
        first, last = self._row(self._low[:, 1]), self._row(self._high[:, 1])
        number, row = expand(first, last - first + 1)
        by_row = np.argsort(row, kind="stable")
        self._members = number[by_row]
        self._begin = np.searchsorted(row[by_row], np.arange(self._rows + 1))

    def _row(self, v: Array) -> Indices:
        return np.clip((v - self._bottom) * self._scale, 0, self._rows - 1).astype(np.intp)

    def winding(self, points: Array) -> NDArray[np.intp]:
        """How often the loops go round points (k, 2), counter-clockwise positive: (k,).

        The pieces that cross the horizontal ray to the right, +1 where upwards. A piece takes
        its lower end and not its upper one; on the curve itself either side may be answered.
        """
        result = np.zeros(len(points), dtype=np.intp)
        row = self._row(points[:, 1])
        counts = self._begin[row + 1] - self._begin[row]
        done = 0
        for stop in _portions(counts, PAIRS):
            share = slice(done, stop)
            number, place = expand(self._begin[row[share]], counts[share])
            crossed = self._crossed(points[share][number], self._members[place])
            result[share] = np.bincount(number, crossed, stop - done).round()
            done = stop
        return result

    def _crossed(self, points: Array, piece: Indices) -> NDArray[np.intp]:
        """+1 or -1 where the ray from a point to the right crosses the piece, else 0."""
        u, v = points.T
        start, end = self.pieces.ends[piece, 0, 1], self.pieces.ends[piece, 1, 1]
        met = ((start <= v) != (end <= v)) & (u < self._high[piece, 0])
        beside = np.flatnonzero(met & (u >= self._low[piece, 0]))
        t = self.pieces.solve(piece[beside], 1, v[beside])
        met[beside] = self.pieces.points(piece[beside], t)[:, 0] > u[beside]
        return np.where(met, np.where(end > start, 1, -1), 0)

    def distance(self, points: Array) -> Array:
        """From each of the points (k, 2) to the nearest curve: (k,). Meant for few points.

        On a monotone piece the square of the distance may have several minima: the best of 17
        samples is refined, eight times.
        """
        best = np.full(len(points), np.inf)
        step = max(1, PAIRS // (32 * max(len(self.pieces), 1)))
        for first in range(0, len(points), step):
            best[first : first + step] = self._distance(points[first : first + step])
        return best

    def _distance(self, points: Array) -> Array:
        count = len(self.pieces)
        if count == 0:
            return np.full(len(points), np.inf)
        gap = np.maximum(self._low - points[:, None], points[:, None] - self._high).clip(0.0)
        far = np.maximum(*np.moveaxis(np.abs(self.pieces.ends[:, 0] - points[:, None]), -1, 0))
        near = np.hypot(gap[..., 0], gap[..., 1]) <= 1.5 * far.min(1, keepdims=True)
        point, piece = np.nonzero(near)
        low, high = self.pieces.span[piece].T.copy()
        least = np.full(len(point), np.inf)
        for _ in range(8):
            t = low + (high - low) * np.linspace(0.0, 1.0, 17)[:, None]
            at = self.pieces.points(np.tile(piece, 17), t.ravel()).reshape(17, -1, 2)
            lengths = np.hypot(*np.moveaxis(at - points[point], -1, 0))
            choice = lengths.argmin(0)
            least = np.minimum(least, lengths.min(0))
            here, width = t[choice, np.arange(len(point))], (high - low) / 16.0
            low, high = np.maximum(here - width, low), np.minimum(here + width, high)
        result = np.full(len(points), np.inf)
        np.minimum.at(result, point, least)
        return result


def expand(begin: Indices, counts: Indices) -> tuple[Indices, Indices]:
    """For ranges begin .. begin+count: which range, and its members, one after another."""
    number = np.repeat(np.arange(len(counts)), counts)
    offset = np.arange(len(number)) - np.repeat(np.cumsum(counts) - counts, counts)
    return number, begin[number] + offset


def _portions(counts: Indices, most: int) -> list[int]:
    """Where to stop so that each portion sums to about `most`."""
    if len(counts) == 0:
        return []
    portion = np.cumsum(counts) // most
    stops = np.flatnonzero(np.diff(portion)) + 1
    return [*stops.tolist(), len(counts)]


def area_integrals(pieces: Pieces) -> Array:
    """Integrals of u dv along each piece (n,): along closed loops, what they enclose (Green).

    Gauss-Legendre: exact for polynomial curves, else with at least 24 nodes a piece.
    """
    start, end = pieces.ends[:, 0], pieces.ends[:, 1]
    result = np.asarray((start[:, 0] + end[:, 0]) / 2.0 * (end[:, 1] - start[:, 1]))
    for number, curves in enumerate(pieces.curves):
        index = np.flatnonzero(pieces.table == number)
        result[index] = 0.0
        nodes, weights = np.polynomial.legendre.leggauss(max(24, curves.shape[1]))
        low, width = pieces.span[index, 0], np.diff(pieces.span[index], axis=1)[:, 0]
        for node, weight in zip((nodes + 1.0) / 2.0, weights / 2.0, strict=True):
            t = low + node * width
            u, slope = pieces.points(index, t)[:, 0], pieces.velocities(index, t)[:, 1]
            result[index] += weight * u * slope * width
    return result
