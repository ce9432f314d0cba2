"""`reparam joins` for curves: how the pieces of a curve, or two curves, join."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from .geometry.continuity import Joint, join_curves
from .geometry.net import Array
from .geometry.paths import Path

ORDER = 5  # up to which is asked
CLOSED = 1e-9  # of the extent: ends so near meet


def within(path: Path, tolerance: float) -> list[dict[str, Any]]:
    """The joints between a curve's pieces, and from its end to its start if they meet."""
    pieces = list(zip(path.nets, path.intervals, strict=True))
    pairs = list(pairwise(pieces))
    first, last = path.nets[0, 0], path.nets[-1, -1]
    gap = np.abs(first[:3] / first[3] - last[:3] / last[3]).max()
    if gap <= CLOSED * float(np.ptp(path.nets[..., :3] / path.nets[..., 3:], axis=(0, 1)).max()):
        pairs.append((pieces[-1], pieces[0]))
    return [_row(*before, *after, tolerance) for before, after in pairs]


def between(first: Path, second: Path, tolerance: float) -> list[dict[str, Any]]:
    """The joint from the end of one curve to the start of another."""
    before = first.nets[-1], first.intervals[-1]
    after = second.nets[0], second.intervals[0]
    return [_row(*before, *after, tolerance)]


def _row(f: Array, fs: Array, g: Array, gs: Array, tolerance: float) -> dict[str, Any]:
    widths = float(fs[1] - fs[0]), float(gs[1] - gs[0])
    found: Joint = join_curves(f, g, ORDER, tolerance, widths)
    return {
        "at": float(fs[1]),
        "point": (f[-1, :3] / f[-1, 3]).tolist(),
        "parametric": found.parametric if found.regular and found.order >= 0 else None,
        "order": found.order,
        "r": [float(x) for x in found.derivatives],
        "turn": found.turn,
        "exponents": list(found.exponents),
        "reason": found.reason,
    }


def table(name: str, rows: list[dict[str, Any]]) -> Iterator[str]:
    """The joints as lines."""
    count = f"{len(rows)} joint" + "s" * (len(rows) != 1)
    yield f"{name}: {count}, looked at up to order {ORDER}"
    if rows:
        yield ""
        yield "          at  C^k  G^k  r', r'', ..                  what ends it"
    for row in rows:
        smooth = "-" if row["parametric"] is None else str(row["parametric"])
        slopes = ", ".join(f"{round(x, 9) + 0.0:.4g}" for x in row["r"]) or "-"
        order = str(row["order"]) if row["order"] >= 0 else "-"
        yield f"{row['at']:12.6g}  {smooth:>3}  {order:>3}  {slopes:28}  {row['reason']}".rstrip()
