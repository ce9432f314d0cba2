"""Rational biquadratic pieces of tori, and closed nets of such pieces that stay smooth when edited.

A periodic net of points N_ij (w x, w y, w z, w) and, for each direction, ratios at which the joints
lie between them: piece (i, j) has N_ij in its middle and joints around it,

        J(i-1,j) ---- b --------  J(i,j)        b = alpha_i N_ij + beta_i N_(i+1,j),
           |                        |           alpha_i = (1 - ratio_i)/w_i,
           b        N_ij            b           beta_i = ratio_i/w_(i+1),
           |                        |
        J(i-1,j-1) -- b ------ J(i,j-1)         corners: both combinations, one after the other

The combinations are the same all along an edge, so three rows of coefficients across it stay
linearly dependent: every edge is G1 whatever the net. A piece whose 3 x 3 points were not touched
keeps every bit (Fig. 7; for curves Fig. 3, conics.py).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .conics import ConicNet, circle_net
from .net import Array

PIECES = 6  # of each circle: 60 degrees


@dataclass(frozen=True, eq=False)
class RingNet:
    """A net (n, m, 4), periodic both ways; (alpha, beta) of the joints along u (2, n), v (2, m)."""

    points: Array
    along_u: Array
    along_v: Array

    def patches(self) -> Array:
        """The pieces (n, m, 3, 3, 4)."""
        n, m = self.points.shape[:2]
        alpha, beta = self.along_u[:, :, None, None]
        after_u = alpha * self.points + beta * np.roll(self.points, -1, 0)
        alpha, beta = self.along_v[:, None, :, None]
        net = np.empty((n, m, 3, 3, 4))
        for row, line in ((1, self.points), (2, after_u)):
            net[:, :, row, 1] = line
            net[:, :, row, 2] = alpha * line + beta * np.roll(line, -1, 1)
            net[:, :, row, 0] = np.roll(net[:, :, row, 2], 1, 1)
        net[:, :, 0] = np.roll(net[:, :, 2], 1, 0)
        return net

    def moved(self, index: tuple[int, int], by: Array) -> RingNet:
        """The net with one point moved by (dx, dy, dz); its weight stays."""
        points = self.points.copy()
        points[index][:3] += points[index][3] * by
        return RingNet(points, self.along_u, self.along_v)


def joint_factors(net: ConicNet) -> Array:
    """(alpha, beta) of the joints of a closed conic net, (2, n), for premultiplied points."""
    after = np.roll(net.weights, -1)
    return np.stack([(1.0 - net.ratios) / net.weights, net.ratios / after])


def revolved(profile: ConicNet, circle: ConicNet) -> RingNet:
    """The profile (distance from the axis, height) turned about the z-axis along a unit circle."""
    w, c = circle.weights, circle.weights[:, None] * circle.points
    W, P = profile.weights, profile.weights[:, None] * profile.points
    points = np.stack(
        [
            c[:, :1] * P[:, 0],
            c[:, 1:] * P[:, 0],
            w[:, None] * P[:, 1],
            w[:, None] * W,
        ],
        -1,
    )
    return RingNet(points, joint_factors(circle), joint_factors(profile))


def torus(big: float, small: float, pieces: int = PIECES) -> RingNet:
    """A torus about the z-axis, `pieces` x `pieces` equal ones, the first index round the axis."""
    half = np.full(pieces, np.pi / pieces)
    return revolved(circle_net(half, small, (big, 0.0)), circle_net(half))


def two_halves() -> RingNet:
    """Fig. 7: two torus halves of different size joined to a closed ring of 12 x 6 pieces.

    Columns 0-3 have the net of A, 6-9 that of B; 4, 5 and 10, 11 lead from one to the other, their
    points interpolated, their weights kept.
    """
    a, b = (at(t, x) for t, x in ((torus(*A[:2]), A[2]), (torus(*B[:2]), B[2])))
    first, second = a[[1, 2, 3, 4]], b[[4, 5, 0, 1]]
    columns = [*first, *_between(first[-1], second[0]), *second, *_between(second[-1], first[0])]
    pieces = torus(*A[:2])
    return RingNet(np.stack(columns), np.tile(pieces.along_u, 2), pieces.along_v)


A = (3.0, 1.0, -4.0)  # radii, and x of the centre
B = (2.4, 0.8, 4.0)
FREE = (4, 5, 10, 11)  # the columns that are on neither torus


def at(ring: RingNet, x: float) -> Array:
    """The net's points moved along the x-axis."""
    points = ring.points.copy()
    points[..., 0] += x * points[..., 3]
    return points


def _between(start: Array, end: Array) -> list[Array]:
    """Two columns on the way: points at 1/3 and 2/3, the weights those of the start."""
    w = start[:, 3:]
    p, q = start[:, :3] / w, end[:, :3] / end[:, 3:]
    return [np.concatenate([w * ((1 - t) * p + t * q), w], -1) for t in (1 / 3, 2 / 3)]


def torus_distance(points: Array, big: float, small: float, x: float) -> Array:
    """Signed distance (...) of points (..., 3) from a torus whose centre is (x, 0, 0)."""
    from_axis = np.hypot(points[..., 0] - x, points[..., 1])
    return np.asarray(np.hypot(from_axis - big, points[..., 2]) - small)
