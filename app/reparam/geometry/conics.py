"""Modelling with conic pieces: a partition of the circle, its control net, and edits of the net.

Jorg Peters, "Change of variables" (2012), figure 3. Piece i of the closed curve is the rational
quadratic with control points J_{i-1}, P_i, J_i and weights 1, w_i, 1; the joint J_i lies on the
leg from P_i to P_{i+1} at a ratio that stays what the circle made it:

            P_i ___ J_i ____ P_{i+1}
           .'    '        '    '.
        J_{i-1}                  J_{i+1}        J_i = (1 - ratio_i) P_i + ratio_i P_{i+1}

So tangents agree at every joint however the net is edited, and a piece whose three points
P_{i-1}, P_i, P_{i+1} were not touched keeps every bit: it stays on the circle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ConicNet:
    """A closed control net of conic pieces, counter-clockwise.

    `points` (n, 2), `weights` (n,) positive, `ratios` (n,) in (0, 1): of the joint between piece
    i and piece i + 1. Raises ValueError for other shapes or values, and for neighbours that
    coincide, since the leg between them is the tangent of their joint.
    """

    points: Array
    weights: Array
    ratios: Array

    def __post_init__(self) -> None:
        n = len(self.points)
        shapes = self.points.shape, self.weights.shape, self.ratios.shape
        if n < 3 or shapes != ((n, 2), (n,), (n,)):
            raise ValueError(f"expected points (n, 2), weights (n,), ratios (n,), found {shapes}")
        finite = np.asarray(np.isfinite(self.points).all(-1))
        _refuse(~finite, self.points, "a finite control point")
        _refuse(~(np.isfinite(self.weights) & (self.weights > 0.0)), self.weights, "a weight > 0")
        _refuse(~((self.ratios > 0.0) & (self.ratios < 1.0)), self.ratios, "a ratio in (0, 1)")
        together = np.asarray((self.points == np.roll(self.points, -1, 0)).all(-1))
        _refuse(together, self.points, "a control point that differs from the next")

    def moved(self, index: int, point: ArrayLike) -> ConicNet:
        """The net with control point `index` at `point` (2,); weights and ratios stay."""
        points = self.points.copy()
        points[index] = np.asarray(point, dtype=np.float64)[:2]
        return replace(self, points=points)

    def weighted(self, index: int, weight: float) -> ConicNet:
        """The net with another weight at control point `index`."""
        weights = self.weights.copy()
        weights[index] = weight
        return replace(self, weights=weights)

    def joints(self) -> Array:
        """The joints J_i between piece i and piece i + 1: (n, 2)."""
        ratios = self.ratios[:, None]
        return np.asarray((1.0 - ratios) * self.points + ratios * np.roll(self.points, -1, 0))

    def pieces(self) -> Array:
        """The pieces as rational quadratic Bezier curves: nets (n, 3, 4), premultiplied."""
        after = self.joints()
        nets = np.zeros((len(self.points), 3, 4))
        nets[:, 0, :2], nets[:, 1, :2], nets[:, 2, :2] = np.roll(after, 1, 0), self.points, after
        nets[..., 3] = 1.0
        nets[:, 1] *= self.weights[:, None]
        return nets


def circle_net(
    half_angles: ArrayLike,
    radius: float = 1.0,
    center: tuple[float, float] = (0.0, 0.0),
    start: float = 0.0,
) -> ConicNet:
    """The control net of a circle cut into pieces of these half angles (radians), from `start` on.

    P_i = center + radius / cos(h_i) (cos m_i, sin m_i), m_i the middle of the piece;
    w_i = cos h_i; ratio_i = tan h_i / (tan h_i + tan h_{i+1}). Raises ValueError unless each
    half angle is in (0, pi/2) and they sum to pi.
    """
    half = np.asarray(half_angles, dtype=np.float64)
    if half.ndim != 1 or len(half) < 3:
        raise ValueError(f"expected at least three half angles, found shape {half.shape}")
    _refuse(~((half > 0.0) & (half < np.pi / 2.0)), half, "a half angle in (0, pi/2)")
    if abs(half.sum() - np.pi) > 1e-9:
        raise ValueError(f"expected half angles that sum to pi, found {half.sum():.12g}")
    middle = start + np.concatenate([[0.0], np.cumsum(2.0 * half)[:-1]]) + half
    directions = np.stack([np.cos(middle), np.sin(middle)], -1)
    points = np.asarray(center) + directions * (radius / np.cos(half))[:, None]
    here, following = np.tan(half), np.tan(np.roll(half, -1))
    return ConicNet(points, np.cos(half), here / (here + following))


def _refuse(bad: NDArray[np.bool_], values: Array, expected: str) -> None:
    if bad.any():
        index = int(np.flatnonzero(bad)[0])
        raise ValueError(f"conic net[{index}]: expected {expected}, found {values[index]}")
