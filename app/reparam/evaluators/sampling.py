"""How finely a NURBS is drawn: the sampling methods, so that the tolerance is kept, provably.

All pieces of one column take the same steps in u, all of one row the same in v, so that a
surface has no cracks:

         nu[0]  nu[1]
    v ^  |-----|--|          each piece (s, t) is a grid of nu[s] x nv[t] cells
      |  |     |  | nv[1]
      |  |-----|--|
      +->|_____|__| nv[0]    u

GLU_PATH_LENGTH: no edge of a triangle, diagonals included, is longer than the tolerance.
GLU_PARAMETRIC_ERROR: no point is farther from its triangle than the tolerance, in space (D.
Filip, R. Magedson, R. Markot, Surface algorithms using bounds on derivatives, CAGD 3 (1986),
295-311: (M_uu / nu^2 + 2 M_uv / (nu nv) + M_vv / nv^2) / 8). GLU_DOMAIN_DISTANCE: at least the
samples asked for, per unit of u and v. A curve is a surface of no width.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.derivative_bounds import bounds, directional_bound
from ..geometry.net import Array
from .glu_constants import (
    GLU_DOMAIN_DISTANCE,
    GLU_OBJECT_PATH_LENGTH,
    GLU_PARAMETRIC_ERROR,
    GLU_PATH_LENGTH,
    NAMES,
)
from .glu_errors import GluInvalidValue
from .nurbs_properties import View
from .splines import Nurbs

Steps = NDArray[np.intp]

FINER = 4  # pieces are cut so for the bounds: rational ones are tight only when short
MANY_PIECES = 1024  # and left whole where there are so many that they are short already
MOST_VERTICES = 1 << 24
NEAREST = 1e-3  # of the largest depth


def steps(nurbs: Nurbs) -> tuple[Steps, Steps]:
    """Cells in u of each column of pieces (s,), and in v of each row (t,).

    Raises GluInvalidValue where the tolerance asks for more vertices than memory has.
    """
    method = nurbs.properties.sampling_method
    if method == GLU_DOMAIN_DISTANCE:
        found = domain_steps(nurbs)
    else:
        with np.errstate(over="ignore"):
            found = _steps_within(nurbs, method)
    count = (found[0].astype(float) + 1).sum() * (found[1].astype(float) + 1).sum()
    if count > MOST_VERTICES:
        raise GluInvalidValue(
            f"{NAMES[method]}: expected a tolerance or steps that ask for at most "
            f"{MOST_VERTICES} vertices, found {count:.3g}"
        )
    return found


def domain_steps(nurbs: Nurbs) -> tuple[Steps, Steps]:
    """U_STEP and V_STEP samples per unit, rounded up: .3 to .7 at 10 takes 4."""
    density = (nurbs.properties.u_step, nurbs.properties.v_step)
    found = [
        _ceil(np.diff(nurbs.ends(axis)) * density[axis]) for axis in range(len(nurbs.vertex.knots))
    ]
    return found[0], found[1] if len(found) == 2 else np.ones(1, np.intp)


def _ceil(number: Array) -> Steps:
    """Rounded up, but for what float32 knots may have added; at least 1."""
    nearest = np.round(number)
    close = np.abs(number - nearest) <= 1e-5 * np.maximum(nearest, 1.0)
    whole = np.where(close, nearest, np.ceil(number))
    return np.clip(whole, 1, MOST_VERTICES).astype(np.intp)


def _steps_within(nurbs: Nurbs, method: int) -> tuple[Steps, Steps]:
    whole = nurbs.pieces("vertex")
    finer = FINER if whole.shape[0] * whole.shape[1] <= MANY_PIECES else 1
    nets = nurbs.pieces("vertex", finer)
    parts = (finer, finer if len(nurbs.vertex.knots) == 2 else 1)
    on_screen = method in (GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR)
    near = _eye_within_reach(nets, nurbs.view) if on_screen else np.zeros(nets.shape[:2], bool)
    if method in (GLU_PATH_LENGTH, GLU_OBJECT_PATH_LENGTH):
        tolerance, power = nurbs.properties.sampling_tolerance, 1
        seen = nets @ nurbs.view.pixels_from_object.T if on_screen else nets

        def longest(a: ArrayLike, b: ArrayLike) -> Array:
            return _largest(np.where(near, np.inf, directional_bound(seen, a, b)), parts)

        def reach(nu: Steps, nv: Steps) -> Array:
            a, b = np.repeat(1.0 / nu, parts[0])[:, None], np.repeat(1.0 / nv, parts[1])
            return np.maximum(longest(a, b), longest(a, -b))

        alone = (longest(1.0, 0.0), longest(0.0, 1.0))
    else:
        tolerance, power = nurbs.properties.parametric_tolerance, 2
        scale = pixels_per_unit(nets, nurbs.view) if on_screen else 1.0
        found = bounds(nets)
        uu, uv, vv = (
            _largest(np.where(near, np.inf, bound * scale), parts, 2) / 8.0
            for bound in (found.uu, found.uv, found.vv)
        )
        alone = (uu, vv)

        def reach(nu: Steps, nv: Steps) -> Array:
            a, b = 1.0 / nu[:, None], 1.0 / nv
            return np.asarray(uu * a * a + 2.0 * uv * a * b + vv * b * b)

    return _least_steps(alone, reach, tolerance, power, domain_steps(nurbs))


def _eye_within_reach(nets: Array, view: View) -> NDArray[np.bool_]:
    """Whether nets (..., m, n, 4) come so close to the plane of the eye that sizes in pixels mean
    nothing: U_STEP and V_STEP samples per unit stand in there."""
    depth = (nets @ view.pixels_from_object[2]) / np.where(nets[..., 3] > 0.0, nets[..., 3], 1.0)
    return np.asarray(depth.min((-2, -1)) <= NEAREST * np.abs(depth).max((-2, -1)))


def _least_steps(
    alone: tuple[Array, Array],
    reach: Callable[[Steps, Steps], Array],
    tolerance: float,
    power: int,
    fallback: tuple[Steps, Steps],
) -> tuple[Steps, Steps]:
    """Steps for which reach(nu, nv) <= tolerance on all pieces, started from each axis alone.

    Where there is no bound the fallback's stand in.
    """
    unbounded = ~(np.isfinite(alone[0]) & np.isfinite(alone[1]))
    found = []
    for axis in (0, 1):
        across = np.where(unbounded, 0.0, alone[axis]).max(1 - axis)
        count = _ceil((across / tolerance) ** (1.0 / power))
        lost = unbounded.any(1 - axis)
        found.append(np.where(lost, np.maximum(count, fallback[axis]), count))
    nu, nv = found
    while float(nu.sum()) * float(nv.sum()) <= MOST_VERTICES:
        excess = np.where(unbounded, 0.0, reach(nu, nv)) / tolerance
        if (excess <= 1.0).all():
            break
        factor = np.maximum(excess, 1.0) ** (1.0 / power)
        nu, nv = _grown(nu, factor.max(1)), _grown(nv, factor.max(0))
    return nu, nv


def _grown(count: Steps, factor: Array) -> Steps:
    more = np.maximum(np.ceil(count * factor * (1.0 - 1e-9)), count + 1)
    return np.where(factor > 1.0, np.minimum(more, MOST_VERTICES), count).astype(np.intp)


def _largest(bound: Array, parts: tuple[int, int], power: int = 1) -> Array:
    """The largest over each piece's parts, for derivatives by the piece's own parameter: (s, t)."""
    a, b = parts
    of_parts = bound.reshape(bound.shape[0] // a, a, bound.shape[1] // b, b)
    return np.asarray(of_parts.max((1, 3)) * float(a) ** power)


def pixels_per_unit(nets: Array, view: View) -> Array:
    """How many pixels a step of length 1 can be, anywhere in each net's hull and in any direction.

    Nets (..., m, n, 4) in front of the eye. Depth counts as much as width: a hill seen from above
    keeps its shape.
    """
    matrix = view.pixels_from_object
    seen = nets @ matrix.T
    depth = seen[..., 2] / np.where(nets[..., 3] > 0.0, nets[..., 3], 1.0)
    pixels = seen[..., :2] / np.where(seen[..., 2:] > 0.0, seen[..., 2:], 1.0)
    box = np.stack([pixels.min((-3, -2)), pixels.max((-3, -2))])
    x, y = box[[0, 0, 1, 1], ..., 0], box[[0, 1, 0, 1], ..., 1]
    # d(pixel)/d(point), times the depth: linear in the pixel, so the largest is at a corner.
    jacobians = matrix[:2, :3] - np.stack([x, y], -1)[..., None] * matrix[2, :3]
    largest = np.linalg.norm(jacobians, ord=2, axis=(-2, -1)).max(0)
    nearest = depth.min((-2, -1))
    return np.asarray(largest / np.where(nearest > 0.0, nearest, 1.0))
