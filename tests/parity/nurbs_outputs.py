"""What libGLU handed out: vertices by field, and how its primitives join them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from evaluator_truth import Array
from numpy.typing import NDArray

from reparam import evaluators
from reparam.evaluators.grids import primitive_indices

COLUMNS = {"pos": "position", "normal": "normal", "color": "colour", "tex": "texture"}


@dataclass(frozen=True)
class Theirs:
    """All vertices that libGLU handed out, and how its primitives join them."""

    fields: dict[str, Array]  # pos (k, 3 or 4), and of uv, normal, color, tex those it has
    runs: list[NDArray[np.intp]]  # the vertices of each primitive
    triangles: NDArray[np.intp]
    lines: NDArray[np.intp]


def theirs_of(outputs: dict[str, Any]) -> Theirs:
    primitives = [p for p in outputs["prims"] if len(p["pos"])]
    fields = {}
    for name in ("pos", "uv", *list(COLUMNS)[1:]):
        if any(len(p.get(name, ())) for p in primitives):
            if any(len(p.get(name, ())) != len(p["pos"]) for p in primitives):
                raise ValueError(f"expected as many of {name} as of pos in each primitive")
            fields[name] = np.concatenate([np.array(p[name], float) for p in primitives])
    runs, found = [], {2: [np.zeros((0, 2), np.intp)], 3: [np.zeros((0, 3), np.intp)]}
    start = 0
    for primitive in primitives:
        count = len(primitive["pos"])
        runs.append(np.arange(start, start + count))
        _, indices = primitive_indices(getattr(evaluators, f"GL_{primitive['mode']}"), count)
        if indices.shape[1] > 1:
            found[indices.shape[1]].append(indices + start)
        start += count
    return Theirs(fields, runs, np.concatenate(found[3]), np.concatenate(found[2]))


def areas(uv: Array, triangles: NDArray[np.intp]) -> Array:
    a, b = (uv[triangles[:, i]] - uv[triangles[:, 0]] for i in (1, 2))
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0
