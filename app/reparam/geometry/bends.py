"""How sharply the patches of a view bend on the screen, as their control points tell it.

Twin: shaders/lib/bends.glsl, same names. A patch is x/w with x = (x, y) and w polynomial in (u,v);
what is drawn in a triangle is the quotient of their linear interpolants, so it is x - q w, q being
the exact point x/w of a drawn one, whose second derivatives tell how far it is off (levels.py). Let
e be an edge in (u,v), x_i and w_i the control points, A_i and a_i those of x''[e, e] and w''[e, e],
raised to the degree of the net. With

    q_i = x_i / w_i      alpha_i = a_i / w_i      b_i = w_i B_i / w      (B_i: Bernstein's)

the b_i are positive and sum to 1 at each (u,v), so q and alpha = w''/w are means of the q_i and the
alpha_i, and there are two bounds:

    (x'' - q w'') / w  =  sum b_i (A_i / w_i - alpha_i q)
                       =  sum b_i (A_i - a_i q_i) / w_i  +  sum b_i (alpha_i - alpha) (q_i - q)

In the first line q may be anywhere in the patch: measured from its middle, at most half its extent
away. In the second each q_i is in its own place; the rest is a covariance, at most a quarter of how
far the alpha_i lie apart times how far the q_i do (G. Gruess, Mathematische Zeitschrift 39, 1935),
but q is the point at the same (u,v), and what it moves from there comes on top. The first is nearer
where weights are rough, the second where they are smooth: a torus takes a quarter fewer triangles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .derivative_bounds import hodograph
from .net import Array

TINY = 1e-30
STEEPEST = 64.0  # of the slopes that a bound is kept for; beyond it is interpolated


@dataclass(frozen=True)
class Bends:
    """The largest second derivatives of nets (...,) over w, in pixels, for edges (1, t) of any
    slope t.

    With A, B, C those of uu, uv, vv: |A|, |B|, |C|; at three slopes t |A +- t B|, |B +- t C| and
    |A +- 2 t B + t^2 C|; and of neighbouring slopes |A +- (s + t) B + s t C|: as quadratics in t,
    Bezier form bounds them in between. First those of edges that rise, then of such that fall.
    """

    uu: Array
    uv: Array
    vv: Array
    slopes: Array  # (..., 3)
    from_u: Array  # (..., 2, 3)
    from_v: Array  # (..., 2, 3)
    edge: Array  # (..., 2, 3)
    between: Array  # (..., 2, 2)
    spread: Array  # (..., 3): what covariance adds to uu, uv, vv
    weight: Array  # (..., 3): the largest |w_uu|, |w_uv|, |w_vv| over w
    growth: Array  # (..., 2): the largest |w_u|, |w_v| over w
    speed: Array  # (..., 2): the largest |q_u|, |q_v|; 0 where q may be anywhere
    ratio: Array  # of the largest w to the least; infinite where a weight is not positive
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


def likely_slope(uu: Array, vv: Array) -> Array:
    """Of edges (1, t) of triangles that bend as much along u as along v."""
    return np.clip(np.sqrt((uu + TINY) / (vv + TINY)), 1.0 / STEEPEST, STEEPEST)


def largest(bent: Array, reach: Array) -> Array:
    """The greatest length (...,) of control points (..., m, n, 3) of x and y, reach times the
    third added to both."""
    along = np.abs(bent[..., :2]) + reach * np.abs(bent[..., 2:])
    return np.asarray(np.hypot(along[..., 0], along[..., 1]).max((-2, -1)))


def both(a: Array, b: Array, reach: Array) -> Array:
    """Of a + b and of a - b, (..., 2)."""
    return np.stack([largest(a + b, reach), largest(a - b, reach)], -1)


def bends(nets: Array, scale: tuple[float, float]) -> Bends:
    """Of nets (..., m, n, 4) in clip coordinates, with `scale` the viewport's half width and
    height in pixels; by the nearer bound of the two, as uu and vv have it."""
    positive = np.asarray((nets[..., 3] > 0.0).all((-2, -1)))
    weights = np.where(positive[..., None, None], nets[..., 3], 1.0)[..., None]
    places = nets[..., :2] / weights * np.array(scale)
    low, high = places.min((-3, -2), keepdims=True), places.max((-3, -2), keepdims=True)
    middle, reach = (low + high) / 2.0, (high - low) / 2.0
    none = np.zeros_like(reach)
    extent = 2.0 * np.hypot(reach[..., 0, 0, 0], reach[..., 0, 0, 1])

    def relative(derivative: Array, about: Array) -> Array:
        over = derivative[..., [0, 1, 3]] / weights * np.array([*scale, 1.0])
        return np.concatenate([over[..., :2] - over[..., 2:] * about, over[..., 2:]], -1)

    derivatives = second_derivative(nets, -3), mixed_derivative(nets), second_derivative(nets, -2)
    whole = [relative(derivative, middle) for derivative in derivatives]
    owned = [relative(derivative, places) for derivative in derivatives]
    turns = np.stack([bent[..., 2] for bent in owned], -1)
    spread = extent[..., None] / 4.0 * np.ptp(turns, axis=(-3, -2))
    in_u, in_v = (largest(owned[k], none) + spread[..., k] + TINY for k in (0, 2))
    own = in_u * in_v <= (largest(whole[0], reach) + TINY) * (largest(whole[2], reach) + TINY)
    chosen = own[..., None, None, None]
    a, b, c = (np.where(chosen, one, other) for one, other in zip(owned, whole, strict=True))
    reach = np.where(chosen, none, reach)

    uu, uv, vv = (largest(bent, reach) for bent in (a, b, c))
    slopes = likely_slope(uu, vv)[..., None] * np.array([0.5, 1.0, 2.0])
    t = [slopes[..., k][..., None, None, None] for k in range(3)]
    first = [relative(hodograph(nets, axis), places) for axis in (-3, -2)]
    growth = np.stack([np.abs(bent[..., 2]).max((-2, -1)) for bent in first], -1)
    speed = np.stack([largest(bent, none) for bent in first], -1)
    speed += extent[..., None] / 2.0 * growth
    return Bends(
        uu, uv, vv, slopes,
        np.stack([both(a, t[k] * b, reach) for k in range(3)], -1),
        np.stack([both(b, t[k] * c, reach) for k in range(3)], -1),
        np.stack([both(a + t[k] ** 2 * c, 2.0 * t[k] * b, reach) for k in range(3)], -1),
        np.stack(
            [
                both(a + t[k] * t[k + 1] * c, (t[k] + t[k + 1]) * b, reach) for k in range(2)
            ],
            -1,
        ),
        np.where(own[..., None], spread, 0.0),
        np.abs(turns).max((-3, -2)),
        growth,
        np.where(own[..., None], speed, 0.0),
        np.where(positive, weights.max((-3, -2, -1)) / weights.min((-3, -2, -1)), np.inf),
        extent,
    )  # fmt: skip
