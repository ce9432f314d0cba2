"""Free sections between conic arcs that join them with continuous curvature.

A section is drawn as the control polygon of a clamped uniform cubic B-spline, whose inner joints
are C2 already. Its first and last Bezier piece are then mended so that the curvature at the
outer end is the neighbour's, while the inner end keeps the curvature it has:

* by weights where the polygon bends the way the curvature wants (a rational cubic), which is
  possible in exactly one way;
* else, an inflection being wanted, by moving two points of the piece raised to degree 5.

Both leave the tangents alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .extraction import curve_to_bezier
from .jets import End, rational_jet
from .net import raise_degree
from .nurbs import clamped_knots

Array = NDArray[np.float64]

MOST = 16.0  # a weight, or its inverse: beyond, the curve would hug its polygon


def end_curvatures(net: Array) -> tuple[float, float]:
    """Signed curvature (left turns positive) at both ends of a planar curve, net (n, 4).

    (d-1)/d w_0 w_2 / w_1^2 cross(b_1 - b_0, b_2 - b_1) / |b_1 - b_0|^3 at the start.
    """
    found = []
    ends: tuple[End, End] = (0, 1)
    for end in ends:
        _, first, second = rational_jet(net[:, [0, 1, 3]], end, 2).derivatives
        found.append(float(cross(first, second) / np.hypot(*first) ** 3))
    return found[0], found[1]


def cross(a: Array, b: Array) -> Array:
    """a_x b_y - a_y b_x of vectors (..., 2 or more)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def spline_pieces(polygon: ArrayLike) -> Array:
    """The Bezier nets (k - 3, 4, 4) of the clamped uniform cubic B-spline of k >= 4 points (k, 2).

    Raises ValueError for fewer points.
    """
    points = np.asarray(polygon, dtype=np.float64)
    if points.ndim != 2 or len(points) < 4:
        raise ValueError(f"expected a polygon of at least 4 points, found shape {points.shape}")
    pieces = curve_to_bezier(clamped_knots(len(points), 4), points, 4).nets
    nets = np.zeros((len(pieces), 4, 4))
    nets[..., :2], nets[..., 3] = pieces, 1.0
    return nets


def curved_section(polygon: ArrayLike, start: float, end: float) -> list[Array]:
    """The section of a control polygon (k, 2) with the curvatures `start` and `end` at its ends.

    Nets (4, 4) or, where a piece had to be raised, (6, 4). Tangents at the ends are the first
    and last legs of the polygon; the inner joints have continuous curvature. Raises ValueError
    for fewer than 4 points or an outer leg of no length.
    """
    pieces = list(spline_pieces(polygon))
    legs = np.diff([piece[:, :2] for piece in pieces], axis=1)[:, [0, 2]]
    if not np.hypot(legs[..., 0], legs[..., 1]).all():
        raise ValueError("expected a polygon whose spline moves on, found points that coincide")
    inner = [end_curvatures(piece) for piece in pieces]
    last = len(pieces) - 1
    for i in {0, last}:
        wanted = (start if i == 0 else inner[i][0], end if i == last else inner[i][1])
        pieces[i] = with_end_curvatures(pieces[i], *wanted)
    return pieces


def with_end_curvatures(piece: Array, start: float, end: float) -> Array:
    """A cubic Bezier piece (4, 4) without weights, mended to have these end curvatures.

    With a, the curvature that the polygon has by itself over the one wanted at the start, and
    c, the same at the end: rational with weights 1, (a^2 c)^(1/3), (c^2 a)^(1/3), 1, where a and
    c are positive and the weights within MOST of 1; else of degree 5.
    """
    points = piece[:, :2]
    legs = np.diff(points, axis=0)
    lengths = np.hypot(*legs.T)
    first = 2.0 / 3.0 * cross(legs[0], legs[1]) / lengths[0] ** 3
    last = 2.0 / 3.0 * cross(legs[1], legs[2]) / lengths[2] ** 3
    if first * start > 0.0 and last * end > 0.0:
        a, c = first / start, last / end
        weights = np.cbrt([a * a * c, c * c * a])
        if weights.max() <= MOST and weights.min() >= 1.0 / MOST:
            mended = piece.copy()
            mended[1:3] *= weights[:, None]
            return mended
    raised = raise_degree(piece[None], 0, 5)[0]
    b = raised[:, :2].copy()
    raised[2, :2] = _bent(b[0], b[1], b[2], start)
    raised[3, :2] = _bent(b[5], b[4], b[3], -end)  # read backwards, curvature changes its sign
    return np.asarray(raised)


def _bent(b0: Array, b1: Array, b2: Array, curvature: float) -> Array:
    """b2 moved across the tangent so that a polynomial of degree 5 starts with this curvature."""
    leg = b1 - b0
    length = float(np.hypot(*leg))
    normal = np.array([-leg[1], leg[0]]) / length
    return np.asarray(b2 + (1.25 * curvature * length**2 - (b2 - b1) @ normal) * normal)
