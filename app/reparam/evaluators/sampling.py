"""How finely a NURBS is drawn, so that its sampling method's tolerance is kept, provably.

All pieces of one column take the same steps in u, all of one row the same in v, so that a
surface has no cracks:

         nu[0]  nu[1]
    v ^  |-----|--|          each piece (s, t) is a grid of nu[s] x nv[t] cells
      |  |     |  | nv[1]
      |  |-----|--|
      +->|_____|__| nv[0]    u

GLU_DOMAIN_DISTANCE takes at least the samples asked for, per unit of u and v. A curve is a
surface of no width.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.net import Array
from .criteria import Criterion, criterion
from .glu_constants import NAMES
from .glu_errors import GluInvalidValue
from .splines import Nurbs

Steps = NDArray[np.intp]

FINER = 4  # pieces are cut so for the bounds: rational ones are tight only when short
MANY_PIECES = 1024  # and left whole where there are so many that they are short already
MOST_VERTICES = 1 << 24


def steps(nurbs: Nurbs) -> tuple[Steps, Steps]:
    """Cells in u of each column of pieces (s,), and in v of each row (t,).

    Raises GluInvalidValue where the tolerance asks for more vertices than memory has.
    """
    asked = criterion(nurbs)
    if asked is None:
        found = domain_steps(nurbs)
    else:
        with np.errstate(over="ignore"):
            found = _least_steps(nurbs, asked)
    count = (found[0].astype(float) + 1).sum() * (found[1].astype(float) + 1).sum()
    if count > MOST_VERTICES:
        raise GluInvalidValue(
            f"{NAMES[nurbs.properties.sampling_method]}: expected a tolerance or steps that ask "
            f"for at most {MOST_VERTICES} vertices, found {count:.3g}"
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


def _least_steps(nurbs: Nurbs, asked: Criterion) -> tuple[Steps, Steps]:
    """From what each axis needs alone, both grow until all cells are good.

    Pieces without a bound, since the eye is too near, take U_STEP and V_STEP samples per unit.
    """
    pieces = nurbs.pieces("vertex")
    count = pieces.shape[0] * pieces.shape[1]
    finer = FINER if count <= MANY_PIECES else 1
    nets = nurbs.pieces("vertex", finer)
    parts = (finer, finer if len(nurbs.vertex.knots) == 2 else 1)

    def excess(a: Array, b: Array) -> Array:
        """Of cells a (s,) x b (t,) in the pieces' parameters: (s, t)."""
        cells = [np.repeat(x * part, part) for x, part in zip((a, b), parts, strict=True)]
        found = asked.excess(nets, cells[0][:, None], cells[1])
        shape = (len(a), parts[0], len(b), parts[1])
        return np.asarray(found.reshape(shape).max((1, 3)))

    one, none = [np.ones(n) for n in pieces.shape[:2]], [np.zeros(n) for n in pieces.shape[:2]]
    alone = (excess(one[0], none[1]), excess(none[0], one[1]))
    unbounded = ~(np.isfinite(alone[0]) & np.isfinite(alone[1]))
    found = []
    for axis, fallback in enumerate(domain_steps(nurbs)):
        across = np.where(unbounded, 0.0, alone[axis]).max(1 - axis)
        least = _ceil(across ** (1.0 / asked.power))
        found.append(np.where(unbounded.any(1 - axis), np.maximum(least, fallback), least))
    nu, nv = found
    while float(nu.sum()) * float(nv.sum()) <= MOST_VERTICES:
        over = np.where(unbounded, 0.0, excess(1.0 / nu, 1.0 / nv))
        if (over <= 1.0).all():
            break
        factor = np.maximum(over, 1.0) ** (1.0 / asked.power)
        nu, nv = _grown(nu, factor.max(1)), _grown(nv, factor.max(0))
    return nu, nv


def _grown(count: Steps, factor: Array) -> Steps:
    """Steps times factors, at least one more where a factor is above 1."""
    more = np.maximum(np.ceil(count * factor * (1.0 - 1e-9)), count + 1)
    return np.where(factor > 1.0, np.minimum(more, MOST_VERTICES), count).astype(np.intp)
