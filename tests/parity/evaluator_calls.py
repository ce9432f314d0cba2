"""A case's maps called on ours: glMap, glEnable, glEvalCoord, glEvalMesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from evaluator_truth import ATTRIBUTES, Array, Single

from reparam import evaluators
from reparam.evaluators import GL_AUTO_NORMAL, GL_POINTS, Evaluated, Evaluators
from reparam.evaluators.maps import TARGETS, Map
from reparam.snapshot import Studio


@dataclass(frozen=True)
class Called:
    """A session with a case's maps, and the maps that feed each field."""

    gl: Evaluators
    dimension: int
    feeds: dict[str, Map]
    auto_normal: bool


def call_maps(studio: Studio, inputs: dict[str, Any], dimension: int) -> Called:
    """glMap and glEnable for all maps of a case, straight out of its flat buffers."""
    gl = Evaluators(painter=studio.painter)
    for name, given in inputs["maps"].items():
        target = getattr(evaluators, f"GL_MAP{dimension}_{name}")
        points, offset = np.array(given["points"], np.float32), given["offset"]
        if dimension == 1:
            layout = (given["stride"], given["order"])
            gl.glMap1f(target, *given["domain"], *layout, points, offset=offset)
        else:
            (u1, u2), (v1, v2) = given["udomain"], given["vdomain"]
            along_u = (u1, u2, given["ustride"], given["uorder"])
            along_v = (v1, v2, given["vstride"], given["vorder"])
            gl.glMap2f(target, *along_u, *along_v, points, offset=offset)
        gl.glEnable(target)
    auto = bool(inputs.get("auto_normal", False))
    if auto:
        gl.glEnable(GL_AUTO_NORMAL)
    return Called(gl, dimension, maps_in_force(gl, dimension), auto)


def maps_in_force(gl: Evaluators, dimension: int) -> dict[str, Map]:
    """By field, from what glGetMap answers: the highest of the enabled targets."""
    found: dict[str, Map] = {}
    for number, target in TARGETS.items():
        if target.dimension == dimension and gl.glIsEnabled(number):
            orders = gl.glGetMapiv(number, evaluators.GL_ORDER)
            points = gl.glGetMapfv(number, evaluators.GL_COEFF)
            points = points.reshape(orders[0], *orders[1:] if dimension == 2 else [1], -1)
            domain = gl.glGetMapdv(number, evaluators.GL_DOMAIN)
            domain = np.concatenate([domain, [0.0, 1.0]])[:4]
            for field, attribute in ATTRIBUTES.items():
                better = field not in found or target.name > found[field].target.name
                if attribute == target.attribute and better:
                    found[field] = Map(target, points, tuple(domain.tolist()))
    return found


def fields_of(found: Evaluated) -> dict[str, Single]:
    """What was read back, by a case's words."""
    arrays = (found.vertices, found.normals, found.colors, found.texcoords)
    return dict(zip(ATTRIBUTES, arrays, strict=True))


def evaluated_at(called: Called, parameters: Array, evaluator: str) -> list[Evaluated]:
    """One glEvalCoord for each of (u, v), shape (k, 2); nothing without a vertex map."""
    gl = called.gl
    gl.glBegin(GL_POINTS)
    for u, v in parameters.tolist():
        if called.dimension == 1:
            gl.glEvalCoord1f(u)
        else:
            gl.glEvalCoord2f(u, v)
    gl.glEnd()
    return gl.read(evaluator=evaluator)


def evaluated_mesh(called: Called, inputs: dict[str, Any], evaluator: str) -> list[Evaluated]:
    """glMapGrid and glEvalMesh of a case."""
    gl, mode = called.gl, getattr(evaluators, f"GL_{inputs['mode']}")
    if called.dimension == 1:
        gl.glMapGrid1f(*inputs["grid"])
        gl.glEvalMesh1(mode, inputs["i1"], inputs["i2"])
    else:
        gl.glMapGrid2f(*inputs["grid"])
        gl.glEvalMesh2(mode, *inputs["rng"])
    return gl.read(evaluator=evaluator)


def drifted(inputs: dict[str, Any], dimension: int) -> Array:
    """Where Mesa's glEvalMesh evaluates, (k, 2), u slowest: it adds a step in float32, again and
    again."""
    grid = inputs["grid"]
    ranges = inputs["rng"] if dimension == 2 else [inputs["i1"], inputs["i2"]]
    axes = []
    for axis in range(dimension):
        segments, start, end = grid[3 * axis : 3 * axis + 3]
        first, last = ranges[2 * axis : 2 * axis + 2]
        step = np.float32((np.float32(end) - np.float32(start)) / np.float32(segments))
        values = [np.float32(start) + np.float32(first) * step]
        for _ in range(first, last):
            values.append(values[-1] + step)
        axes.append(np.array(values, np.float64))
    axes += [np.zeros(1)] * (2 - dimension)
    return np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)
