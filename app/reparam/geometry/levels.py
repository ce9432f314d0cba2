"""How finely a patch must be tessellated so that no drawn point is off by more than so many pixels.

Twin: shaders/lib/levels.glsl, same names. The difference counts *at the same parameter*, so a
texture lies where it belongs (Y. Yeo, L. Bin, J. Peters, Efficient pixel-accurate rendering of
curved surfaces, I3D 2012). On a triangle with vertices v_i, barycentric coordinates l and edges e,
f differs from its linear interpolant at p by

    sum_(i<j) l_i l_j f''[e_ij, e_ij]  averaged over the triangle (p, v_i, v_j), halved

(S. Waldron, The error in linear interpolation at the vertices of a simplex, SIAM J. Numer. Anal.
35, 1998). f''[(x,y), (x,y)] = x^2 f_uu + 2 x y f_uv + y^2 f_vv is taken as one vector, with f_uu,
f_uv and f_vv raised to one degree, whose control points bound it: where they pull apart, as on a
saddle, they are not added up. (Adding them up is the bound of D. Filip, R. Magedson, R. Markot,
CAGD 3, 1986: here a third more triangles, and more where it hurts most.) It holds for all triangles
whose edges go no further than a step each way: tessellators make such ones, and lib/snap.glsl where
levels change. Of those edges that rise and those that fall, the ones may bend much less than the
others. Then it pays to cut all cells that way, as stitching.py does; at edges of other levels it
goes back by half a step at most.

With m_ij for the largest |f''[e_ij, e_ij]|, a triangle is off by half the largest sum l_i l_j m_ij,
for a base along u or v and two other sides. In two corners of a patch stitching.py may have one
without such a base, from (0, d) by (1, 0) to (1 - d', 1) in steps, d and d' at most 1/2. With S the
most of any side, Bezier form leaves P(2 d), P(2 d') and (1 - min(d, d'))^2 S for its sides, where
P(k) = base + (1 - (1 - k)^2) (S - base). That makes no larger a sum than sides S, S and the base if
the base is LEAST_BASE S or more, as it is taken to be.

Clip coordinates of a rational patch, under any camera, are polynomial in (u,v), and so are those
drawn in a triangle, X and W where the patch has x and w. With q = x/w at p, which is off by
(X - q W) / W, the above is for f = x - q w. At any other p' of the triangle

    |f''| / w  <=  what bends.py bounds  +  |q(p') - q| |w''| / w

Let h be a step each way, w' the largest w in the triangle, g = h . growth, k = h . weight . h / 8
with what bends.py has of w. Then W >= w' / r, r = 1 / (1 - g), and any linear interpolant of w is
off by w' k at most. Two averages over p' in (p, v_i, v_j) remain.

That of w. By interpolants it is at most W (1 + (n_i + n_j) / 3) + 4/3 w' k, where W (1 + n_i) is w
at v_i and so sum l_i n_i = 0. Now M(l) = sum l_i l_j m_ij at l_i (1 + n_i / 3), which sum to 1 too,
is sum l_i l_j m_ij (1 + (n_i + n_j) / 3 + n_i n_j / 9), and n_i n_j >= -(g r)^2 / 4: what is gained
where w is large is lost elsewhere, and the largest M grows by its (g r / 6)^2 at most.

That of |q(p') - q|. |p' - p| is a third of |v_i - p| + |v_j - p| on average, each way. This is no
more than a step; or, near the third vertex, than 2 l_k > 1 steps: then with l_i = s a, l_j = s b,
s = 1 - l_k, M is at most s (1-s) (a m_ik + b m_jk + 2 s a b m_ij), no more than where l_k = 1/2.

So, with F half of the largest M by bends.py,

    |X/W - q|  <=  F (1 + (g r / 6)^2 + 4/3 r k) + r k h . speed / 3

in which r may be the ratio of weights, the bracket r, and h . speed / 3 the patch's extent.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bends import TINY, Bends, likely_slope
from .net import Array

FINEST = 4096  # no level above
SLOPES = 9  # tried from the middle outwards
SHORT = 4096.0  # steps that tell what a slope needs in the limit
REFINED = 3  # times; what is estimated at too few steps is too many, and the other way round
GROWTHS = 160  # that lead from 1 to FINEST
TRIES = 6  # steps are made fewer so many times, one at a time
LEAST_BASE = 0.35  # of a side


def isosceles(base: Array, side: Array) -> Array:
    """The largest l1 l2 base + (l1 + l2) l3 side, where l1 + l2 + l3 = 1."""
    acute = base < 2.0 * side
    return np.where(acute, side**2 / np.where(acute, 4.0 * side - base, 1.0), base / 4.0)


def edge_bend(s: Bends, t: Array) -> Array:
    """The largest |f''[e, e]| of edges e = (x, y), |x| <= 1 and |y| <= t (...,): of those that rise
    and of those that fall, (..., 2)."""
    uu, vv, from_u, from_v, edge = _around(s, t)
    found = np.maximum(np.maximum(from_u, from_v), edge)
    return np.maximum(found, np.maximum(uu, vv))


def back_bend(s: Bends, t: Array) -> Array:
    """The same of edges half as long in one of both directions."""
    uu, vv, from_u, from_v, edge = _around(s, t)
    flat = np.maximum(_line(uu, from_u, 0.5), _parabola(uu, from_u, edge, 0.5))
    steep = np.maximum(_line(vv, from_v, 0.5), _parabola(vv, from_v, edge, 0.5))
    return np.maximum(np.maximum(flat, steep), np.maximum(uu, vv))


def _around(s: Bends, t: Array) -> tuple[Array, ...]:
    """Bezier form of what bends along (1, y), y from 0 to t, and along (x, t), x from 0 to 1: both
    first points, both middle ones, and the last of both, each (..., 2) or (..., 1)."""
    t, uu, uv, vv = (values[..., None] for values in (t, s.uu, s.uv, s.vv))
    slopes = s.slopes[..., None, :]
    low, high = slopes[..., 0], slopes[..., 2]
    upper = t > slopes[..., 1]
    first, last = (np.where(upper, slopes[..., k + 1], slopes[..., k]) for k in (0, 1))

    def pick(values: Array, k: int) -> Array:
        return np.where(upper, values[..., k + 1], values[..., k])

    middle = np.where(upper, s.between[..., 1], s.between[..., 0])
    share = np.clip((t - first) / (last - first), 0.0, 1.0)
    from_u = _line(pick(s.from_u, 0), pick(s.from_u, 1), share)
    from_v = t * _line(pick(s.from_v, 0), pick(s.from_v, 1), share)
    edge = _parabola(pick(s.edge, 0), middle, pick(s.edge, 1), share)

    share = np.minimum(t / low, 1.0)
    flat_u = _line(uu, s.from_u[..., 0], share)
    flat_v = t * _line(uv, s.from_v[..., 0], share)
    flat = _parabola(uu, s.from_u[..., 0], s.edge[..., 0], share)

    share = np.minimum(high / t, 1.0)
    steep_u = t * _line(uv, s.from_u[..., 2] / high, share)
    steep_v = t**2 * _line(vv, s.from_v[..., 2] / high, share)
    steep = t**2 * _parabola(vv, s.from_v[..., 2] / high, s.edge[..., 2] / high**2, share)

    def where(flat: Array, between: Array, steep: Array) -> Array:
        return np.where(t < low, flat, np.where(t > high, steep, between))

    return (
        uu,
        t**2 * vv,
        where(flat_u, from_u, steep_u),
        where(flat_v, from_v, steep_v),
        where(flat, edge, steep),
    )


def _line(a: Array, b: Array, t: Array | float) -> Array:
    return a + (b - a) * t


def _parabola(a: Array, b: Array, c: Array, t: Array | float) -> Array:
    return _line(_line(a, b, t), _line(b, c, t), t)


def shares_used(
    s: Bends, steps: Array, tolerance: float, scale: ArrayLike = 1.0, one_way: bool = False
) -> Array:
    """How much of the tolerance (in pixels) `steps` (..., 2) in u and v use up; 1 is all: (..., 1),
    or with `one_way` (..., 2).

    The one is for triangles whose edges may rise and fall. The two are for those of stitching.py
    from cells cut along diagonals that rise, and from such cut along diagonals that fall. Lengths
    are `scale` (...,) times as many pixels as `s` has. Infinite where a weight is not positive. The
    shares of a position and of its map add up.
    """
    h = 1.0 / np.asarray(steps, np.float64)
    squares = np.stack([h[..., 0] ** 2, 2.0 * h[..., 0] * h[..., 1], h[..., 1] ** 2], -1) / 8.0
    t = h[..., 1] / h[..., 0]
    base, side = np.maximum(s.uu, t**2 * s.vv)[..., None], edge_bend(s, t)
    if one_way:
        side = np.maximum(side, back_bend(s, t)[..., ::-1])
        base = np.maximum(base, LEAST_BASE * side)
    else:
        side = side.max(-1, keepdims=True)
    bend = isosceles(base, side) / 2.0 * h[..., :1] ** 2 + (s.spread * squares).sum(-1)[..., None]
    weight, growth = (s.weight * squares).sum(-1), (s.growth * h).sum(-1)
    clear = np.maximum(1.0 - growth, TINY)
    ratio = np.minimum(1.0 / clear, s.ratio)
    moved = np.minimum((s.speed * h).sum(-1) / 3.0, s.extent)
    with np.errstate(invalid="ignore"):
        uneven = np.minimum(ratio, 1.0 + (ratio * growth / 6.0) ** 2 + ratio * weight * 4.0 / 3.0)
        off = bend * uneven[..., None] + (ratio * weight * moved)[..., None]
    used = np.asarray(scale)[..., None] * off / tolerance
    return np.asarray(np.where(np.isfinite(s.ratio)[..., None], used, np.inf))


def share_used(s: Bends, steps: Array, tolerance: float, scale: ArrayLike = 1.0) -> Array:
    """The same of any triangles whose edges go no further than a step each way: (...,)."""
    return np.asarray(shares_used(s, steps, tolerance, scale)[..., 0])


def pixels_a_unit(clip: Array, maps: Array, half: tuple[float, float]) -> Array:
    """About how many pixels a unit of a texture map is long, (...,): the larger of along u and v.

    By the longest legs of both nets; what the map is off by shows on the screen so much larger.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        seen = clip[..., :2] / clip[..., 3:] * np.array(half)
        sought = maps[..., :2] / maps[..., 3:]
        ratios = [
            (seen.shape[axis] - 1) * _longest(np.diff(seen, axis=axis))
            / ((sought.shape[axis] - 1) * _longest(np.diff(sought, axis=axis)))
            for axis in (-3, -2)
        ]  # fmt: skip
    return np.asarray(np.nan_to_num(np.maximum(*ratios), nan=0.0, posinf=0.0))


def _longest(legs: Array) -> Array:
    return np.asarray(np.hypot(legs[..., 0], legs[..., 1]).max((-2, -1), initial=0.0))


def fewest_steps(
    seen: Bends, tolerance: float, sought: Bends | None = None, unit: Array | None = None
) -> NDArray[np.int64]:
    """The steps (..., 2) in u and v with about the fewest triangles that keep the tolerance.

    `sought` is a texture map of its own, (s, t) in pixels if `unit` (...,) times as large. The
    best slope is tried out; then, whole numbers, steps go up until they keep the tolerance, and
    down, one at a time or one for the other, as long as they do. What is smaller than the
    tolerance needs one step.
    """
    return _fewest(seen, tolerance, sought, unit, False)[0]


def fewest_one_way(
    seen: Bends, tolerance: float, sought: Bends | None = None, unit: Array | None = None
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The same for cells all cut along diagonals that rise or, where (...,) says so, that fall."""
    return _fewest(seen, tolerance, sought, unit, True)


def _fewest(
    seen: Bends, tolerance: float, sought: Bends | None, unit: Array | None, one_way: bool
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    def shares(steps: Array) -> Array:
        found = shares_used(seen, steps, tolerance, one_way=one_way)
        if sought is None or unit is None:
            return found
        return np.asarray(found + shares_used(sought, steps, tolerance, unit, one_way))

    def used(steps: Array) -> Array:
        return np.asarray(shares(steps).min(-1))

    def enough(steps: Array) -> Array:
        return np.asarray(np.maximum(steps * np.minimum(used(steps) ** 0.5, 1e9)[..., None], 1.0))

    uu, uv, vv = seen.uu, seen.uv, seen.vv
    if sought is not None and unit is not None:
        uu, uv, vv = uu + unit * sought.uu, uv + unit * sought.uv, vv + unit * sought.vv
    slope = likely_slope(uu + uv / 16.0, vv + uv / 16.0)
    steps, best = np.ones((*seen.uu.shape, 2)), np.full(seen.uu.shape, np.inf)
    for k in range(SLOPES):
        t = slope * 2.0 ** ((k + 1) // 2 * (-0.5 if k % 2 else 0.5))
        trial = enough(enough(SHORT * np.stack([np.ones_like(t), 1.0 / t], -1)))
        fewer = trial.prod(-1) < 0.999 * best
        steps, best = (
            np.where(fewer[..., None], trial, steps),
            np.where(fewer, trial.prod(-1), best),
        )
    for _ in range(REFINED):
        steps = enough(steps)
    steps = np.minimum(np.ceil(steps), FINEST)
    for _ in range(GROWTHS):
        more = used(steps) > 1.0
        if not more.any():
            break
        finer = np.minimum(steps + np.ceil(steps / 16.0), FINEST)
        steps = np.where(more[..., None], finer, steps)
    for _ in range(TRIES):
        now = steps
        for change in ((-1.0, 0.0), (0.0, -1.0), (1.0, -1.0), (-1.0, 1.0)):
            trial = np.maximum(now + np.array(change), 1.0)
            fewer = (trial.prod(-1) < steps.prod(-1)) & (used(trial) <= 1.0)
            steps = np.where(fewer[..., None], trial, steps)
    tiny = (seen.extent <= tolerance) & np.isfinite(seen.ratio)
    steps = np.where(tiny[..., None], 1.0, steps)
    ways = shares(steps)
    return steps.astype(np.int64), np.asarray(ways[..., -1] < ways[..., 0])


def out_of_view(clip: Array) -> NDArray[np.bool_]:
    """Whether all control points of nets (..., m, n, 4) lie beyond one side of the view volume.

    Then the patch does too: with positive weights it lies in their convex hull.
    """
    w = clip[..., 3:]
    beyond = np.concatenate([clip[..., :3] > w, clip[..., :3] < -w], -1)
    return np.asarray(beyond.all((-3, -2)).any(-1) & (w > 0.0).all((-3, -2, -1)))


def box_corners(net: Array) -> Array:
    """A box around nets (..., 4), as a net (2, 4, 4) of its corners for `out_of_view`; where a
    weight is not positive NaN, which is never out of view."""
    if not (net[..., 3] > 0.0).all():
        return np.full((2, 4, 4), np.nan)
    points = (net[..., :3] / net[..., 3:]).reshape(-1, 3)
    ends = np.stack([points.min(0), points.max(0)])
    corners = np.stack(np.meshgrid(*ends.T, [1.0], indexing="ij"), -1)
    return np.asarray(corners.reshape(2, 4, 4))
