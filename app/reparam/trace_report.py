"""Equally spaced points of the user's curve, with tangents: what `reparam trace` writes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .errors import UsageError
from .geometry.paths import Path

Array = NDArray[np.float64]

MOST = 10_000_000
COLUMNS = ("s", "u", "x", "y", "z", "tx", "ty", "tz")


def lengths(path: Path, step: float | None, count: int | None) -> Array:
    """Where the points are, by arc length: each `step`, or `count` of them with both ends.

    Raises UsageError for a step or a count that cannot be.
    """
    total = path.arc.length
    if count is not None:
        if not 2 <= count <= MOST:
            raise UsageError(f"--count: expected a whole number from 2 to {MOST}, found {count}")
        return np.linspace(0.0, total, count)
    assert step is not None
    if not (step > 0.0 and np.isfinite(step) and total / step < MOST):
        least = total / MOST
        raise UsageError(
            f"--step: expected a length from {least:.3g} up (the curve's is {total:g}), "
            f"found {step:g}"
        )
    # A last point that only rounding keeps from being there is there.
    many = int(total / step * (1.0 + 1e-12)) + 1
    return np.asarray(np.minimum(np.arange(many) * step, total))


def rows(path: Path, s: Array) -> Array:
    """(k, 8): COLUMNS at the lengths s, u being the parameter of the file."""
    u = path.arc.u(s)
    columns = [s[:, None], path.parameters(u)[:, None], path.points(u), path.tangents(u)]
    return np.concatenate(columns, -1)


def table(values: Array) -> str:
    """Rows as comma-separated text, each number in the digits that give it back."""
    lines = [",".join(COLUMNS), *(",".join(map(repr, row)) for row in values.tolist())]
    return "\n".join(lines) + "\n"
