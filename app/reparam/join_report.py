"""`reparam joins`: how the patches of a file or a scene meet, as rows for JSON and as a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .errors import UsageError
from .geometry.body import Patch, body
from .geometry.net import Array
from .geometry.patch_joins import SIDES, Joins, fold, joins
from .scenes.layers import Figure, Patches

SHOWN = 20  # rows of the table, unless all are asked for
FOLDED = 179.9  # degrees between the tangent planes


def patches_of(*figures: Figure) -> Array:
    """All patches that the figures' subjects show, of one degree: (P, m, m, 4)."""
    shown = [layer for figure in figures for layer in figure.spaces[-1].layers]
    layers = [layer for layer in shown if isinstance(layer, Patches)]
    nets = [net for layer in layers for net in layer.net.reshape(-1, *layer.net.shape[-3:])]
    if not nets:
        raise UsageError("joins: expected a subject that shows patches, found none")
    return body([Patch(net) for net in nets]).nets


def report(nets: Array, tolerance: float) -> dict[str, Any]:
    """What is measured: the worst of all, and every join, with r's derivatives along the edge.

    Lengths are in units of the body's size, angles in degrees.
    """
    found = joins(nets, tolerance)
    return {
        "patches": len(nets),
        "joins": [_row(found, index) for index in range(len(found.patches))],
        "free_edges": [[int(patch), SIDES[side]] for patch, side in found.free],
        "edges_that_are_points": found.points,
        "size": found.size,
        "tolerance": tolerance,
        "largest_gap": _number(found.gaps.max(initial=0.0)),
        "largest_angle": _number(np.nanmax(found.angles, initial=0.0)),
        "least_fold_cosine": _number(fold(nets, 16).min()),
    }


def _row(found: Joins, index: int) -> dict[str, Any]:
    """One join. What presumes that the lower orders agree is None where they do not."""
    order = int(found.orders[index])
    folded = bool(found.angles[index] > FOLDED)
    smooth = order >= 1 or folded
    return {
        "patches": found.patches[index].tolist(),
        "sides": [SIDES[side] for side in found.sides[index]],
        "spans": found.spans[index].tolist(),
        "reversed": bool(found.reversed[index]),
        "opposed": bool(found.opposed[index]),
        "gap": _number(found.gaps[index]),
        "angle": _number(found.angles[index]),
        "curvature_jump": _number(found.jumps[index, 1]) if order >= 1 else None,
        "third_jump": _number(found.jumps[index, 2]) if order >= 2 else None,
        "beta": _range(found.beta[index]) if smooth else None,
        "alpha": _range(found.alpha[index]) if smooth else None,
        "folded": folded,
        "order": order,
        "r": [_plain(derivative) for derivative in found.r[index, : max(order, folded)]],
    }


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _range(values: Array) -> list[float]:
    return [float(np.nanmin(values)), float(np.nanmax(values))]


def _plain(values: Array) -> list[list[float | None]]:
    return [[_number(value) for value in pair] for pair in values]


def table(name: str, found: dict[str, Any], every: bool) -> Iterator[str]:
    """The report as lines, the worst joins first."""
    rows = sorted(found["joins"], key=lambda row: (row["order"], -(row["angle"] or 0.0)))
    free, points = len(found["free_edges"]), found["edges_that_are_points"]
    yield (
        f"{name}: {found['patches']} patches, {len(rows)} joins, "
        f"{free} free edges, {points} edges that are points"
    )
    yield (
        f"largest gap {found['largest_gap']:.1e} of the size, largest normal jump "
        f"{found['largest_angle']:.2e} degrees, least cosine of neighbouring normals "
        f"{found['least_fold_cosine']:.3f}"
    )
    orders = np.bincount([row["order"] for row in rows], minlength=4)
    yield f"at tolerance {found['tolerance']:g}: " + ", ".join(
        f"{count} of order {k}" for k, count in enumerate(orders)
    )
    if not rows:
        return
    yield ""
    yield (
        "  patch side  patch side       gap  jump/deg  curvature              beta"
        "             alpha  G^k"
    )
    shown = rows if every else rows[:SHOWN]
    for row in shown:
        (one, other), (side, across) = row["patches"], row["sides"]
        jump, bend = (_short(row[key]) for key in ("angle", "curvature_jump"))
        low, high = row["spans"][1]
        mark = "folded" if row["folded"] else "opposed" if row["opposed"] else ""
        mark = f"{mark} on {low:g}..{high:g}".strip() if high - low < 1.0 else mark
        yield (
            f"{one:7} {side}  {other:5} {across}  {row['gap']:8.1e}  {jump:>8}  {bend:>9}"
            f"  {_span(row['beta']):>16}  {_span(row['alpha']):>16}  {row['order']:3} {mark}"
        ).rstrip()
    if len(shown) < len(rows):
        yield f"  and {len(rows) - len(shown)} more; --all shows them"


def _short(value: float | None) -> str:
    return "-" if value is None else f"{value:.1e}"


def _span(values: list[float] | None) -> str:
    return "-" if values is None else " .. ".join(f"{round(x, 9) + 0.0:.4g}" for x in values)
