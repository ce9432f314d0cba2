"""How finely a patch must be tessellated so that no drawn point is off by more than so many pixels.

Twin: shaders/lib/levels.glsl, same names. The difference counts *at the same parameter*, so a
texture lies where it belongs (Y. Yeo, L. Bin, J. Peters, Efficient pixel-accurate rendering of
curved surfaces, I3D 2012). On a triangle with barycentric coordinates l and edges e, f differs from
its linear interpolant by at most

    1/2 sum_(i<j) l_i l_j max |f''[e_ij, e_ij]|

(S. Waldron, The error in linear interpolation at the vertices of a simplex, SIAM J. Numer. Anal.
35, 1998). f''[(x,y), (x,y)] = x^2 f_uu + 2 x y f_uv + y^2 f_vv is taken as one vector, with f_uu,
f_uv and f_vv raised to one degree, whose control points bound it: where they pull apart, as on a
saddle, they are not added up. (Adding them up is the bound of D. Filip, R. Magedson, R. Markot,
CAGD 3, 1986: here a third more triangles, and more where it hurts most.) It holds for all triangles
whose edges go no further than a step each way: stitching.py makes such ones where levels change.

Clip coordinates of a rational patch, under any camera, are polynomial in (u,v), and so are those
drawn in a triangle; the bound is for their quotient.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .net import Array

FINEST = 4096  # no level above
TINY = 1e-30
STEEPEST = 64.0  # of the slopes that a bound is kept for; beyond it is interpolated
SLOPES = 9  # tried from the middle outwards
GROWTHS = 160  # that lead from 1 to FINEST
TRIES = 6  # steps are made fewer so many times, one at a time


@dataclass(frozen=True)
class Bends:
    """The largest second derivatives of nets (...,), in pixels, for edges (1, t) of any slope t.

    With A, B, C the control points of f_uu, f_uv, f_vv: |A|, |B|, |C|; at three slopes t
    |A +- t B|, |B +- t C| and |A +- 2 t B + t^2 C|; and of neighbouring slopes
    |A +- (s + t) B + s t C|: as quadratics in t, Bezier form bounds them in between.
    """

    uu: Array
    uv: Array
    vv: Array
    slopes: Array  # (..., 3)
    from_u: Array  # (..., 3)
    from_v: Array  # (..., 3)
    edge: Array  # (..., 3)
    between: Array  # (..., 2)
    weight: Array  # (..., 3): the largest second derivatives of w
    least: Array  # the smallest w
    extent: Array  # pixels across all control points


def second_derivative(nets: Array, axis: int) -> Array:
    """The control points of d2/du2 (axis -3) or d2/dv2 (-2), raised to the degree of the net."""
    points = np.moveaxis(nets, axis, -2)
    degree = points.shape[-2] - 1
    raised = np.zeros_like(points)
    for i in range(degree + 1 if degree > 1 else 0):
        weights = (i * (i - 1), 2 * i * (degree - i), (degree - i) * (degree - i - 1))
        for k, weight in zip((i - 2, i - 1, i), weights, strict=True):
            if weight:
                a, b, c = (points[..., k + step, :] for step in range(3))
                raised[..., i, :] += weight * ((a - b) - (b - c))
    return np.moveaxis(raised, -2, axis)


def mixed_derivative(nets: Array) -> Array:
    """The control points of d2/dudv, raised to the degree of the net."""

    def derivative(nets: Array, axis: int) -> Array:
        points = np.moveaxis(nets, axis, -2)
        degree = points.shape[-2] - 1
        raised, legs = np.zeros_like(points), np.diff(points, axis=-2)
        i = np.arange(degree)[:, None]
        raised[..., 1:, :] += (i + 1) * legs
        raised[..., :-1, :] += (degree - i) * legs
        return np.moveaxis(raised, -2, axis)

    return derivative(derivative(nets, -3), -2)


def bends(nets: Array, scale: tuple[float, float]) -> Bends:
    """Of nets (..., m, n, 4) in clip coordinates, with `scale` the viewport's half width and
    height in pixels.

    With x measured from the patch's own middle and the deviations E of x, y and w, x/w is off by
    at most (E_x + |x/w| E_w) / (w - E_w), and |x/w| is at most the patch's half extent.
    """
    safe = np.where(nets[..., 3:] > 0.0, nets[..., 3:], 1.0)
    places = nets[..., :2] / safe
    low, high = places.min((-3, -2)), places.max((-3, -2))
    centred = nets.copy()
    centred[..., :2] -= ((low + high) / 2.0)[..., None, None, :] * nets[..., 3:]
    centred[..., :2] *= np.array(scale)
    reach = ((high - low) * np.array(scale) / 2.0)[..., None, None, :]
    a, c = second_derivative(centred, -3), second_derivative(centred, -2)
    b = mixed_derivative(centred)

    def largest(derivative: Array) -> Array:
        size = np.abs(derivative)
        along = size[..., :2] + reach * size[..., 3:]
        return np.asarray(np.hypot(along[..., 0], along[..., 1]).max((-2, -1)))

    def either(x: Array, y: Array, z: Array | None = None) -> Array:
        rest = x if z is None else x + z
        return np.maximum(largest(rest + y), largest(rest - y))

    uu, uv, vv = largest(a), largest(b), largest(c)
    slope = np.clip(np.sqrt((uu + TINY) / (vv + TINY)), 1.0 / STEEPEST, STEEPEST)
    slopes = slope[..., None] * np.array([0.5, 1.0, 2.0])
    t = [slopes[..., k][..., None, None, None] for k in range(3)]
    return Bends(
        uu, uv, vv, slopes,
        np.stack([either(a, t[k] * b) for k in range(3)], -1),
        np.stack([either(b, t[k] * c) for k in range(3)], -1),
        np.stack([either(a, 2.0 * t[k] * b, t[k] ** 2 * c) for k in range(3)], -1),
        np.stack(
            [either(a, (t[k] + t[k + 1]) * b, t[k] * t[k + 1] * c) for k in range(2)], -1
        ),
        np.stack([np.abs(d[..., 3]).max((-2, -1)) for d in (a, b, c)], -1),
        least_weight(nets[..., 3]),
        2.0 * np.hypot(reach[..., 0, 0, 0], reach[..., 0, 0, 1]),
    )  # fmt: skip


def least_weight(weights: Array) -> Array:
    """A bound (...,) from below of w over patches with weights (..., m, n), not positive if one of
    them is not: the least weight when the degrees are raised by one, which is nearer to the truth.
    """

    def raised(values: Array) -> Array:
        padded = np.concatenate([values[..., :1], values, values[..., -1:]], -1)
        share = np.arange(values.shape[-1] + 1) / values.shape[-1]
        return np.asarray(share * padded[..., :-1] + (1.0 - share) * padded[..., 1:])

    least = weights.min((-2, -1))
    both = raised(raised(weights).swapaxes(-1, -2))
    return np.asarray(np.where(least > 0.0, both.min((-2, -1)), least))


def isosceles(base: Array, side: Array) -> Array:
    """The largest l1 l2 base + (l1 + l2) l3 side, where l1 + l2 + l3 = 1."""
    acute = base < 2.0 * side
    return np.where(acute, side**2 / np.where(acute, 4.0 * side - base, 1.0), base / 4.0)


def edge_bend(s: Bends, t: Array) -> Array:
    """The largest |f''[e, e]| of edges e = (x, y), |x| <= 1 and |y| <= t (...,)."""
    low, high = s.slopes[..., 0], s.slopes[..., 2]
    upper = t > s.slopes[..., 1]
    first, last = (np.where(upper, s.slopes[..., k + 1], s.slopes[..., k]) for k in (0, 1))

    def pick(values: Array, k: int) -> Array:
        return np.where(upper, values[..., k + 1], values[..., k])

    middle = np.where(upper, s.between[..., 1], s.between[..., 0])
    share = np.clip((t - first) / (last - first), 0.0, 1.0)
    from_u = _line(pick(s.from_u, 0), pick(s.from_u, 1), share)
    from_v = t * _line(pick(s.from_v, 0), pick(s.from_v, 1), share)
    edge = _parabola(pick(s.edge, 0), middle, pick(s.edge, 1), share)

    share = np.minimum(t / low, 1.0)
    flat_u = _line(s.uu, s.from_u[..., 0], share)
    flat_v = t * _line(s.uv, s.from_v[..., 0], share)
    flat = _parabola(s.uu, s.from_u[..., 0], s.edge[..., 0], share)

    share = np.minimum(high / t, 1.0)
    steep_u = t * _line(s.uv, s.from_u[..., 2] / high, share)
    steep_v = t**2 * _line(s.vv, s.from_v[..., 2] / high, share)
    steep = t**2 * _parabola(s.vv, s.from_v[..., 2] / high, s.edge[..., 2] / high**2, share)

    found = np.maximum(np.maximum(from_u, from_v), edge)
    found = np.where(t < low, np.maximum(np.maximum(flat_u, flat_v), flat), found)
    found = np.where(t > high, np.maximum(np.maximum(steep_u, steep_v), steep), found)
    return np.maximum(found, np.maximum(s.uu, t**2 * s.vv))


def _line(a: Array, b: Array, t: Array) -> Array:
    return a + (b - a) * t


def _parabola(a: Array, b: Array, c: Array, t: Array) -> Array:
    return _line(_line(a, b, t), _line(b, c, t), t)


def share_used(s: Bends, steps: Array, tolerance: float, scale: ArrayLike = 1.0) -> Array:
    """How much of the tolerance (in pixels) `steps` (..., 2) in u and v use up; 1 is all.

    Lengths are `scale` (...,) times as many pixels as `s` has. Infinite where w <= 0. The shares
    of a position and of its map add up.
    """
    nu, nv = np.moveaxis(np.asarray(steps, np.float64), -1, 0)
    t = nu / nv
    base = np.maximum(s.uu, t**2 * s.vv)
    off = isosceles(base, edge_bend(s, t)) / 2.0 / nu**2
    weight = (
        s.weight[..., 0] / nu**2 + 2.0 * s.weight[..., 1] / (nu * nv) + s.weight[..., 2] / nv**2
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        used = (scale * off + tolerance * weight / 8.0) / (tolerance * s.least)
    return np.asarray(np.where(s.least > 0.0, used, np.inf))


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

    def used(steps: Array) -> Array:
        share = share_used(seen, steps, tolerance)
        if sought is None or unit is None:
            return share
        return np.asarray(share + share_used(sought, steps, tolerance, unit))

    steps, best = np.ones((*seen.uu.shape, 2)), np.full(seen.uu.shape, np.inf)
    for k in range(SLOPES):
        t = seen.slopes[..., 1] * 2.0 ** ((k + 1) // 2 * (-0.5 if k % 2 else 0.5))
        along = np.minimum(used(np.stack([np.ones_like(t), 1.0 / t], -1)) ** 0.5, 1e9)
        trial = np.maximum(np.stack([along, along / t], -1), 1.0)
        fewer = trial.prod(-1) < 0.999 * best
        steps, best = (
            np.where(fewer[..., None], trial, steps),
            np.where(fewer, trial.prod(-1), best),
        )
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
    tiny = (seen.extent <= tolerance) & (seen.least > 0.0)
    return np.asarray(np.where(tiny[..., None], 1.0, steps).astype(np.int64))


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
