"""Arc length of a curve, and its inverse: the parameter at a given length (equations (5), (6)).

The length (5) is the integral of the speed |x'(u)|. Gauss and Legendre's rule with 8 nodes is
taken on panels that are halved until nothing changes any more, so a cusp, where the speed has a
kink, costs thirty more of them and no digits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Speed = Callable[[Array], Array]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
PANELS = 8  # at first, between two breaks
HALVINGS = 40  # of a panel, at most
AGREEMENT = 1e-15  # of the whole length, between a panel and its halves
ROUNDING = 1e-14  # of a panel's own length: more digits than that a speed may not have
NEWTON_STEPS = 80
TABLE = 1024  # entries of the table that the GPU traces with


def integrate(speed: Speed, start: ArrayLike, end: ArrayLike) -> Array:
    """The integral of the speed from `start` to `end`, (k,), by one panel each."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    half = (end - start) / 2.0
    at = (start + end)[..., None] / 2.0 + half[..., None] * NODES
    return np.asarray(half * (speed(at.ravel()).reshape(at.shape) @ WEIGHTS))


class ArcLength:
    """s(u) and u(s) of a curve given by its speed, a function of arrays (k,).

    `breaks` are the ends of the parameter and the places between where the curve is pieced
    together. `edges` are the panels' ends, `sums` the lengths up to there.
    """

    def __init__(self, speed: Speed, breaks: Sequence[float] = (0.0, 1.0)) -> None:
        self.speed = speed
        ends = np.asarray(breaks, float)
        if len(ends) < 2 or not np.all(np.diff(ends) > 0.0):
            raise ValueError(f"expected increasing breaks, found {breaks}")
        fractions = np.arange(PANELS) / PANELS
        starts = ends[:-1, None] + np.diff(ends)[:, None] * fractions
        self.edges = self._halved(np.append(starts.ravel(), ends[-1]))
        pieces = integrate(speed, self.edges[:-1], self.edges[1:])
        self.sums = np.concatenate([[0.0], np.cumsum(pieces)])
        self.length = float(self.sums[-1])

    def _halved(self, edges: Array) -> Array:
        """Panels on which the rule agrees with itself on both halves."""
        settled: list[Array] = []
        start, end = edges[:-1], edges[1:]
        whole = integrate(self.speed, start, end)
        if not np.isfinite(whole).all():
            raise ValueError("expected a curve of finite speed, found one that is not")
        total = float(whole.sum())
        for _ in range(HALVINGS):
            middle = (start + end) / 2.0
            first = integrate(self.speed, start, middle)
            second = integrate(self.speed, middle, end)
            off = np.abs(first + second - whole)
            bad = off > np.maximum(AGREEMENT * total, ROUNDING * np.abs(whole))
            settled.append(start[~bad])
            if not bad.any():
                break
            start = np.concatenate([start[bad], middle[bad]])
            end = np.concatenate([middle[bad], end[bad]])
            whole = np.concatenate([first[bad], second[bad]])
        else:
            settled.append(start)
        return np.append(np.sort(np.concatenate(settled)), edges[-1])

    def s(self, u: ArrayLike) -> Array:
        """The length from the start to the parameters u."""
        u = np.clip(np.asarray(u, float), self.edges[0], self.edges[-1])
        i = np.clip(np.searchsorted(self.edges, u, "right") - 1, 0, len(self.edges) - 2)
        return np.asarray(self.sums[i] + integrate(self.speed, self.edges[i], u))

    def u(self, s: ArrayLike) -> Array:
        """The parameters at the lengths s: Newton's method, kept within the panel by bisection."""
        s = np.clip(np.asarray(s, float), 0.0, self.length)
        i = np.clip(np.searchsorted(self.sums, s, "right") - 1, 0, len(self.edges) - 2)
        start, low, high = self.edges[i], self.edges[i].copy(), self.edges[i + 1].copy()
        wanted = s - self.sums[i]
        share = self.sums[i + 1] - self.sums[i]
        u = low + (high - low) * np.divide(wanted, share, out=np.zeros_like(s), where=share > 0.0)
        for _ in range(NEWTON_STEPS):
            missing = integrate(self.speed, start, u) - wanted
            if np.all(np.abs(missing) <= 1e-15 * self.length):
                break
            low, high = np.where(missing < 0.0, u, low), np.where(missing < 0.0, high, u)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = u - missing / self.speed(u)
            inside = (step > low) & (step < high)
            following = np.where(inside, step, (low + high) / 2.0)
            if np.array_equal(following, u):
                break
            u = following
        return np.asarray(u)

    def spaced(self, count: int) -> Array:
        """`count` parameters at equal lengths, both ends among them (one end if it is one)."""
        return self.u(np.linspace(0.0, self.length, count))

    def table(self, entries: int = TABLE) -> Array:
        """(u, du/ds) at equally many lengths, (entries, 2): what the GPU interpolates.

        Where the speed vanishes du/ds is infinite; the slope of the neighbours stands in.
        """
        lengths = np.linspace(0.0, self.length, entries)
        u = self.u(lengths)
        with np.errstate(divide="ignore"):
            slope = 1.0 / self.speed(u)
        chord = np.gradient(u, lengths) if self.length > 0.0 else np.zeros(entries)
        steep = ~(slope <= 3.0 * np.abs(chord))
        return np.stack([u, np.where(steep, chord, slope)], -1)


def polygon_length(points: Array) -> Array:
    """The sum (6) of the lengths of the chords of points (..., k, 3 or 2)."""
    return np.asarray(np.linalg.norm(np.diff(points, axis=-2), axis=-1).sum(-1))
