"""Point inversion: which (u,v) a point comes from; the nearest point where it comes from none.

Newton's method on the squared distance, all points at once, from the local minima of a grid of
samples, as The NURBS Book, section 6.1, has it; the square's edges are held as bounds:

        gradient   x_u . r,             x_v . r                          r = x(u,v) - p
        Hessian    x_u . x_u + x_uu . r,   x_u . x_v + x_uv . r,   ...   equation (6.5)

On the patch r vanishes and the method is Newton's on x(u,v) = p. The Hessian's eigenvalues are
taken by their size, and a step that does not come nearer is damped, so it always goes down: a
corner with determinant 0, as r of the note's equation (13) has four, is reached too, halving
the distance each time.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import bernstein
from .evaluate import evaluate, project
from .net import raise_degree

Array = NDArray[np.float64]

STARTS = 4  # local minima of the samples that Newton's method begins at
SINGULAR = 1e-14  # least eigenvalue of the Hessian, in terms of the largest
INSET = 2e-3  # of the outermost starts
LONGEST = 0.1  # step: a longer one may leave the valley it began in
STEPS = 60  # at most; a regular point takes about six
ROUNDING = 4e-16
CHUNK = 1 << 22  # sampled distances held at a time
TOUCHES = 1e-9  # of the coordinates' size: a point this near is on the patch
FRONTMOST = 32  # patches looked at together


def invert(net: Array, points: ArrayLike) -> Array:
    """(u,v) in [0,1]^2, shape (..., 2), of the point of a patch that is nearest to each point.

    `net` is (m, n, 4), rational or not; `points` are (..., 2), then x and y alone are compared,
    or (..., 3). Of a point on the patch these are its parameters, to 1e-10 where the patch is
    regular; at a singular corner the image is that near, and the parameters to its square root.
    Where the distance has more than STARTS valleys (a surface much folded) one that is not the
    deepest may be found.
    """
    points = np.asarray(points, dtype=np.float64)
    flat = points.reshape(-1, points.shape[-1])
    side = _side(net)
    chunks = max(1, -(-len(flat) * side * side // CHUNK))
    found = [_nearest(net, part) for part in np.array_split(flat, chunks)]
    return np.concatenate(found).reshape(*points.shape[:-1], 2)


def distances(net: Array, points: Array, uv: Array) -> Array:
    """How far the points (..., 2 or 3) are from the patch at (u,v): shape (...)."""
    there = project(_pointwise(net, uv))[..., : points.shape[-1]]
    return np.asarray(np.linalg.norm(there - points, axis=-1))


def _nearest(net: Array, points: Array) -> Array:
    starts = _starts(net, points)
    ends = _descend(net, points[:, None], starts)
    best = np.argmin(distances(net, points[:, None], ends), axis=1)
    return np.asarray(ends[np.arange(len(points)), best])


# Starts -------------------------------------------------------------------------------------


def _side(net: Array) -> int:
    return 4 * max(4, int(net.shape[-3]), int(net.shape[-2]))


def _starts(net: Array, points: Array) -> Array:
    """(k, STARTS, 2): where samples of a patch are nearer than their four neighbours.

    They begin a little inside: at a singular corner the gradient may vanish by itself.
    """
    side = _side(net)
    t = np.linspace(0.0, 1.0, side)
    u, v = np.meshgrid(t, t, indexing="ij")
    samples = project(evaluate(net, u, v))[..., : points.shape[-1]]
    square = np.square(samples - points[:, None, None]).sum(-1)
    around = np.pad(square, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    before = np.minimum(around[:, :-2, 1:-1], around[:, 1:-1, :-2])  # of equals one is enough
    after = np.minimum(around[:, 2:, 1:-1], around[:, 1:-1, 2:])
    valley = (square < before) & (square <= after)
    valleys = np.where(valley, square, np.inf).reshape(len(points), -1)
    chosen = np.argpartition(valleys, STARTS - 1, axis=1)[:, :STARTS]
    depth = np.take_along_axis(valleys, chosen, 1)
    lowest = np.take_along_axis(chosen, depth.argmin(1)[:, None], 1)
    chosen = np.where(np.isfinite(depth), chosen, lowest)
    starts = np.stack([t[chosen // side], t[chosen % side]], -1)
    return np.clip(starts, INSET, 1.0 - INSET)


# Newton's method ----------------------------------------------------------------------------


@dataclass(frozen=True)
class _Distance:
    """Half the squared distance (...) with its gradient (..., 2) and Hessian (..., 2, 2)."""

    value: Array
    gradient: Array
    hessian: Array

    def where(self, better: NDArray[np.bool_], other: _Distance) -> _Distance:
        """The other one's numbers where it is better."""
        return _Distance(
            np.where(better, other.value, self.value),
            np.where(better[..., None], other.gradient, self.gradient),
            np.where(better[..., None, None], other.hessian, self.hessian),
        )

    def step(self, uv: Array, damping: Array) -> Array:
        """Newton's step; what would leave the square at once is held, and the rest goes on."""
        held = _outwards(uv, -self.gradient)
        held |= _outwards(uv, self._newton(held, damping))
        return self._newton(held, damping)

    def _newton(self, held: NDArray[np.bool_], damping: Array) -> Array:
        """Down by the eigenvalues' sizes: along a direction of negative curvature too."""
        free = ~held
        masked = self.hessian * (free[..., :, None] & free[..., None, :])
        sizes, directions = np.linalg.eigh(masked)
        sizes = np.abs(sizes)
        sizes += (SINGULAR + damping)[..., None] * sizes.max(-1, keepdims=True) + 1e-300
        along = np.einsum("...ij,...i->...j", directions, np.where(held, 0.0, self.gradient))
        step = -np.einsum("...ij,...j->...i", directions, along / sizes)
        length = np.linalg.norm(step, axis=-1, keepdims=True)
        return np.asarray(step * (LONGEST / np.maximum(length, LONGEST)))


def _outwards(uv: Array, way: Array) -> NDArray[np.bool_]:
    """Which of u and v stand at a bound that the way leads across."""
    return ((uv <= 0.0) & (way < 0.0)) | ((uv >= 1.0) & (way > 0.0))


def _descend(net: Array, points: Array, uv: Array) -> Array:
    """The local minima that Newton's method reaches from `uv` (..., 2), within the square.

    `net` (..., m, n, 4) and `points` (..., 2 or 3) broadcast against it.
    """
    net = raise_degree(net, 2, 2)
    here = _distance(net, points, uv)
    rounding = (ROUNDING * np.abs(points).max(initial=1e-300)) ** 2
    damping = np.zeros(uv.shape[:-1])
    done = np.zeros(uv.shape[:-1], dtype=bool)
    for _ in range(STEPS):
        step = np.where(done[..., None], 0.0, here.step(uv, damping))
        trial = np.clip(uv + step, 0.0, 1.0)
        gain = -(here.gradient * (trial - uv)).sum(-1)
        there = _distance(net, points, trial)
        better = there.value < here.value
        last = (np.abs(gain) <= ROUNDING * here.value) | (here.value <= rounding)
        take = (better | (last & (there.value <= here.value * (1.0 + 1e-12) + rounding))) & ~done
        uv = np.where(take[..., None], trial, uv)
        here = here.where(take, there)
        done |= last
        if done.all():
            break
        damping = np.where(take, damping * 0.1, np.maximum(damping * 10.0, 1e-3))
        damping[damping < 1e-5] = 0.0
    return uv


def _distance(net: Array, points: Array, uv: Array) -> _Distance:
    """Rational derivatives by The NURBS Book, eq. (4.20)."""
    size = points.shape[-1]
    along_u, along_v = _derived(net, -3), _derived(net, -2)
    nets = (net, along_u, along_v, _derived(along_u, -3), _derived(along_u, -2))
    homogeneous = [_pointwise(each, uv) for each in (*nets, _derived(along_v, -2))]
    w, wu, wv, wuu, wuv, wvv = (h[..., 3:] for h in homogeneous)
    a, au, av, auu, auv, avv = (h[..., :size] for h in homogeneous)
    x = a / w
    xu, xv = (au - wu * x) / w, (av - wv * x) / w
    xuu = (auu - 2.0 * wu * xu - wuu * x) / w
    xuv = (auv - wu * xv - wv * xu - wuv * x) / w
    xvv = (avv - 2.0 * wv * xv - wvv * x) / w
    r = x - points

    def dot(left: Array, right: Array) -> Array:
        return np.asarray((left * right).sum(-1))

    uu, mixed, vv = (
        dot(xu, xu) + dot(r, xuu),
        dot(xu, xv) + dot(r, xuv),
        dot(xv, xv) + dot(r, xvv),
    )
    hessian = np.stack([uu, mixed, mixed, vv], -1).reshape(*uu.shape, 2, 2)
    return _Distance(dot(r, r) / 2.0, np.stack([dot(r, xu), dot(r, xv)], -1), hessian)


def _derived(net: Array, axis: int) -> Array:
    """The net of a derivative: degree times the differences of neighbours."""
    return np.asarray((net.shape[axis] - 1) * np.diff(net, axis=axis))


def _pointwise(net: Array, uv: Array) -> Array:
    """Homogeneous points, each net (..., m, n, 4) at its own (u,v)."""
    m, n = net.shape[-3:-1]
    row, column = bernstein(m - 1, uv[..., 0]), bernstein(n - 1, uv[..., 1])
    rows = row[..., None, :] @ net.reshape(*net.shape[:-3], m, n * 4)
    return np.asarray((column[..., None, :] @ rows.reshape(*rows.shape[:-2], n, 4))[..., 0, :])


# Many patches, seen along z -----------------------------------------------------------------


@dataclass(frozen=True)
class Picker:
    """Patches (p, m, n, 4) seen along z from above: what lies under a point of the plane."""

    nets: Array

    @cached_property
    def _boxes(self) -> tuple[Array, Array]:
        """Smallest and largest coordinates (p, 3); a point without weight may be anywhere."""
        weights = self.nets[..., 3:]
        safe = np.where(weights > 0.0, weights, 1.0)
        points = self.nets[..., :3] / safe
        axes = (-3, -2)
        low = np.where(weights > 0.0, points, -np.inf).min(axes)
        return low, np.where(weights > 0.0, points, np.inf).max(axes)

    def pick(self, point: ArrayLike) -> tuple[int, float, float]:
        """(patch, u, v) of the topmost point over `point` (2,); where there is none, the nearest.

        The nearest is looked for among the patches whose control points' boxes are nearest.
        """
        target = np.asarray(point, dtype=np.float64)
        low, high = self._boxes
        beyond = np.maximum(low[:, :2] - target, target - high[:, :2]).max(-1)
        over = np.flatnonzero(beyond <= 0.0)
        over = over[np.argsort(-high[over, 2], kind="stable")]
        best: tuple[float, int, float, float] | None = None
        for begin in range(0, len(over), FRONTMOST):
            group = over[begin : begin + FRONTMOST]
            if best is not None and best[0] >= high[group[0], 2]:
                break
            for hit in self._hits(group, target):
                best = hit if best is None else max(best, hit)
        if best is not None:
            return best[1:]
        group = np.argsort(beyond, kind="stable")[:FRONTMOST]
        ends = self._ends(group, target)
        away = distances(self.nets[group][:, None], target, ends)
        index, start = np.unravel_index(np.argmin(away), away.shape)
        u, v = ends[index, start]
        return int(group[index]), float(u), float(v)

    def _ends(self, group: NDArray[np.intp], target: Array) -> Array:
        starts = np.concatenate([_starts(self.nets[i], target[None]) for i in group])
        return _descend(self.nets[group][:, None], target, starts)

    def _hits(
        self, group: NDArray[np.intp], target: Array
    ) -> list[tuple[float, int, float, float]]:
        ends = self._ends(group, target)
        there = project(_pointwise(self.nets[group][:, None], ends))
        away = np.linalg.norm(there[..., :2] - target, axis=-1)
        on = away <= TOUCHES * max(1e-300, float(np.abs(there).max()))
        return [
            (float(there[i, j, 2]), int(group[i]), float(ends[i, j, 0]), float(ends[i, j, 1]))
            for i, j in np.argwhere(on)
        ]
