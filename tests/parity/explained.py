"""Which parameters explain a vertex best, within what float32 leaves open.

libGLU hands out (u, v) as float32, and has evaluated a unit in the last place beside. What
it handed out with them says where.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from evaluator_truth import Array

from reparam.evaluators.maps import Attribute
from reparam.evaluators.nurbs_parts import parts_at
from reparam.evaluators.splines import Nurbs
from reparam.geometry.evaluate import evaluate, evaluate_derivatives
from reparam.geometry.normal import projected_derivative

MAPPED: dict[str, Attribute] = {"pos": "vertex", "color": "color", "tex": "texcoord"}


def explained(
    nurbs: Nurbs, fields: Mapping[str, Array], parameters: Array, towards: Array, reach: Array
) -> Array:
    """Parameters (k, 2), none moved by more than `reach`, nearest to all that the maps feed: a step
    of Gauss-Newton, each field counted by its size."""
    found = parameters.copy()
    names = [name for name in MAPPED if name in fields]
    for part, members in parts_at(nurbs, parameters, towards):
        maps = next(iter(part.item.maps.values())).by_attribute
        off, slopes = [], []
        for name in names:
            if MAPPED[name] not in maps:
                raise ValueError(f"expected a map of what the case has: {name}")
            expected = fields[name][members]
            value, slope = _linear(maps[MAPPED[name]].net, part.item.parameters, expected.shape[1])
            size = max(1.0, float(np.abs(expected).max()))
            off.append((expected - value) / size)
            slopes.append(slope / size)
        size = np.where(part.size > 0.0, part.size, 1.0)
        wide = reach[members] / size
        slope = np.concatenate(slopes, 1) * wide[:, None, :]
        found[members] += reach[members] * _bounded_steps(slope, np.concatenate(off, 1))
    return found


def _bounded_steps(slopes: Array, off: Array) -> Array:
    """s in [-1,1]^2 (k, 2) that makes |off - slopes s| small: of both unknowns, of one, or none."""
    square = np.einsum("kfi,kfj->kij", slopes, slopes)
    along = np.einsum("kfi,kf->ki", slopes, off)
    least = 1e-30 + 1e-9 * np.trace(square, axis1=1, axis2=2)
    both = np.linalg.solve(square + least[:, None, None] * np.eye(2), along[..., None])[..., 0]
    alone = along / (np.einsum("kii->ki", square) + least[:, None])
    choices = np.clip(np.stack([both, alone * [1, 0], alone * [0, 1], 0.0 * both]), -1.0, 1.0)
    left = np.abs(off - np.einsum("kfi,cki->ckf", slopes, choices)).max(-1)
    return np.asarray(choices[left.argmin(0), np.arange(len(off))])


def _linear(net: Array, where: Array, width: int) -> tuple[Array, Array]:
    """Values (k, width) and their derivatives (k, width, 2); three numbers are x/w, y/w, z/w."""
    values = evaluate(net, *where.T)
    tangents = evaluate_derivatives(net, *where.T)
    if width == 3:
        weights = np.where(values[:, 3:] == 0.0, 1.0, values[:, 3:])
        slopes = [projected_derivative(values, d) / weights for d in tangents]
        return values[:, :3] / weights, np.stack(slopes, -1)
    return values[:, :width], np.stack([d[:, :width] for d in tangents], -1)
