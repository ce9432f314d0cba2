"""Curves: libGLU hands out points without parameters; these are found, in float64."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from evaluator_truth import Array
from nurbs_outputs import Theirs

from reparam.evaluators.splines import Nurbs
from reparam.geometry.bernstein import bernstein, bernstein_derivative

if TYPE_CHECKING:
    from parity import Row


def located_curve(nurbs: Nurbs, theirs: Theirs, row: Row, size: float) -> tuple[Array, Array]:
    """Where libGLU's vertices lie, and the middle of the piece that each belongs to: (k, 2) each.

    A complaint unless each primitive goes on where the last one ended, or where the curve jumps.
    """
    ends = nurbs.ends(0)
    at, towards, reached = [], [], [float(ends[0])]
    for positions in (theirs.fields["pos"][run] for run in theirs.runs):
        t = parameters_along(nurbs, positions, reached[-1], size)
        at.append(t)
        towards.append(np.full(len(t), (t[0] + t[-1]) / 2.0))
        slack = 1e-5 * (ends[-1] - ends[0])
        if abs(t[0] - reached[-1]) > slack or (np.diff(t) < -slack).any():
            row.complaint = "expected primitives in order along the curve, without a gap"
        reached.append(float(t[-1]))
    missed = np.abs(ends[:, None] - np.array(reached)).min(1)
    if missed.max() > 1e-5 * (ends[-1] - ends[0]):
        row.complaint = f"expected primitives that meet at {ends.tolist()}, found {reached}"
    parameters, side = (
        np.column_stack([np.concatenate(x), 0.0 * np.concatenate(x)]) for x in (at, towards)
    )
    return parameters, side


def parameters_along(nurbs: Nurbs, positions: Array, start: float, size: float) -> Array:
    """Where on the curve points lie that follow each other from `start` on.

    Near equal steps to a later end of a piece if that fits, as libGLU walks in float32; else the
    nearest points of all.
    """
    ends, nets = nurbs.ends(0), nurbs.pieces("vertex")[:, 0, :, 0, : positions.shape[1]]
    for end in ends[ends > start + 1e-6]:
        piece = int(np.searchsorted(ends, (start + end) / 2.0)) - 1
        low, wide, net = ends[piece], ends[piece + 1] - ends[piece], nets[piece]
        t = (np.linspace(start, end, len(positions)) - low) / wide
        if np.abs(bernstein(len(net) - 1, t) @ net - positions).max() < 4e-6 * size:
            return np.asarray(low + wide * nearest(net, t, positions, 2)[0])
    found = []
    dense = np.linspace(0.0, 1.0, 257)
    for low, high, net in zip(ends, ends[1:], nets, strict=False):
        samples = bernstein(len(net) - 1, dense) @ net
        t = dense[np.linalg.norm(samples[None] - positions[:, None], axis=-1).argmin(1)]
        t, off = nearest(net, t, positions, 12)
        found.append((low + (high - low) * t, off))
    t, off = (np.stack(values) for values in zip(*found, strict=True))
    return np.asarray(t[off.argmin(0), np.arange(len(positions))])


def nearest(net: Array, t: Array, positions: Array, steps: int) -> tuple[Array, Array]:
    """Parameters near t of the points of a curve nearest to positions, and how far these are."""
    degree = len(net) - 1
    for _ in range(steps):
        speed = bernstein_derivative(degree, t) @ net
        square = (speed**2).sum(-1)
        along = ((bernstein(degree, t) @ net - positions) * speed).sum(-1)
        t = np.clip(t - along / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return t, np.linalg.norm(bernstein(degree, t) @ net - positions, axis=-1)
