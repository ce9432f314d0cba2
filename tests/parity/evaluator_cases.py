"""Cases of glMap1 and glMap2: glEvalCoord at lists of parameters, and glEvalMesh.

Compared with what the real one computed: points to 1e-6 of the largest coordinate (at least 1),
unit normals to 1e-5 away from singular points, colours and texture coordinates like points.
"""

from __future__ import annotations

import re
from itertools import permutations
from typing import TYPE_CHECKING, Any

import numpy as np
from evaluator_calls import (
    Called,
    call_maps,
    drifted,
    evaluated_at,
    evaluated_mesh,
    fields_of,
)
from evaluator_truth import (
    LIMIT_TOLERANCE,
    NORMAL_TOLERANCE,
    POINT_TOLERANCE,
    Array,
    Single,
    has_limit,
    normal_tolerances,
    padded,
    rounded_unit,
    sizes_of,
    true_normals,
    true_values,
    unit,
)
from numpy.typing import NDArray

from reparam.evaluators import Evaluated
from reparam.snapshot import Studio

if TYPE_CHECKING:
    from parity import Case, Row

NEAR = 8
WIDTHS = {"pos": 4, "normal": 3, "color": 4, "tex": 4}
FIELDS = {"pos": "position", "normal": "normal", "color": "colour", "tex": "texture"}


def compare_points(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """map1, map2: glEvalCoord at a list."""
    inputs, dimension = case["inputs"], int(case["kind"][3])
    called = call_maps(studio, inputs, dimension)
    given = np.array(inputs["u" if dimension == 1 else "uv"], np.float32).astype(float)
    parameters = np.zeros((len(given), 2))
    parameters[:, :dimension] = given.reshape(len(given), dimension)
    theirs = outputs_of(case)
    found = evaluated_at(called, parameters, evaluator)
    if nothing_on_either_side(row, found, theirs):
        return
    ours = fields_of(found[0])
    compare_truth(called, row, ours, set(theirs), parameters)
    theirs = corrected(called, theirs, parameters, wrong_fields(case))
    compare_fields(called, row, ours, theirs, parameters)


def compare_mesh(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """map1_mesh, map2_mesh: our mesh against float64 on the exact grid; its primitives, moved to
    the real one's drifted parameters, against the real one's, in any order and winding."""
    inputs, dimension = case["inputs"], int(case["kind"][3])
    called = call_maps(studio, inputs, dimension)
    theirs = outputs_of(case)
    found = evaluated_mesh(called, inputs, evaluator)
    if nothing_on_either_side(row, [one for one in found if len(one.primitives)], theirs):
        return
    (mesh,) = found
    compare_truth(called, row, fields_of(mesh), set(theirs), mesh.parameters)
    (moved,) = evaluated_at(called, drifted(inputs, dimension), evaluator)
    compare_primitives(called, row, mesh, moved, theirs, wrong_fields(case))


# What is expected ---------------------------------------------------------------------------


def outputs_of(case: Case) -> dict[str, Array]:
    """The fields, (k, 3) or (k, 4). Raises ValueError where they are not of one length."""
    found = {name: np.array(values, float) for name, values in case["outputs"].items()}
    lengths = {name: len(values) for name, values in found.items()}
    if len(set(lengths.values())) != 1 or "pos" not in lengths:
        raise ValueError(f"expected outputs with pos, of one length, found {lengths}")
    return {name: v.reshape(len(v), WIDTHS[name]) for name, v in found.items()}


def wrong_fields(case: Case) -> set[str]:
    """The fields in which the real one is known to be wrong: those named before the colon."""
    note = case.get("known_wrong") or ""
    named = set(re.findall(r"\w+", note.partition(":")[0])) & set(FIELDS)
    return named or (set(FIELDS) if note else set())


def nothing_on_either_side(row: Row, ours: list[Any], theirs: dict[str, Array]) -> bool:
    """Whether one of them makes no vertices, or no primitives; a complaint if only one does."""
    expected = len(theirs["pos"])
    if ours and expected:
        return False
    if ours or expected:
        row.complaint = f"expected {expected} vertices, found {'some' if ours else 'none'}"
    row.record("position", 0.0, POINT_TOLERANCE)
    row.rows += 1
    return True


def true_fields(called: Called, fields: set[str], parameters: Array) -> dict[str, Array]:
    """The fields asked for, as they should be."""
    found = {}
    for field in fields:
        if field == "normal" and called.auto_normal:
            surface = called.feeds["pos"]
            found[field] = true_normals(surface, unit(surface, parameters))
        else:
            map_, width = called.feeds[field], 3 if field == "normal" else 4
            found[field] = true_values(map_, unit(map_, parameters))[:, :width]
    return found


def corrected(
    called: Called, theirs: dict[str, Array], parameters: Array, wrong: set[str]
) -> dict[str, Array]:
    """Theirs, less what the real one's rounding of u and v to [0,1] makes of them, as it can be
    computed; float64 where they are known to be wrong."""
    found = true_fields(called, wrong & set(theirs), parameters)
    for field, values in theirs.items():
        if field in wrong:
            continue
        if field == "normal" and called.auto_normal:
            found[field] = values
            continue
        map_, width = called.feeds[field], values.shape[1]
        exact, rounded = (f(map_, parameters) for f in (unit, rounded_unit))
        moved = true_values(map_, exact) - true_values(map_, rounded)
        found[field] = values + moved[:, :width]
    return found


# Comparing ----------------------------------------------------------------------------------


def compare_truth(
    called: Called, row: Row, ours: dict[str, Single], fields: set[str], parameters: Array
) -> None:
    """Our vertices against float64, at singular points too."""
    truth = true_fields(called, fields, parameters)
    compare_fields(called, row, ours, truth, parameters)
    if "normal" in fields and called.auto_normal:
        off = np.linalg.norm(ours["normal"] - truth["normal"], axis=-1)
        surface = called.feeds["pos"]
        singular = tolerances_of(called, parameters) > LIMIT_TOLERANCE
        singular &= has_limit(surface, unit(surface, parameters))
        if not (off[singular] <= LIMIT_TOLERANCE).all():
            row.complaint = f"normals at singular points are off by {off[singular].max():.1e}"


def tolerances_of(called: Called, parameters: Array) -> Array:
    """Of the automatic normals."""
    surface = called.feeds["pos"]
    return normal_tolerances(padded(surface), unit(surface, parameters))


def compare_fields(
    called: Called, row: Row, ours: dict[str, Single], theirs: dict[str, Array], parameters: Array
) -> None:
    """Vertex by vertex: ours at the parameters, and what they should be."""
    for field, expected in theirs.items():
        found = ours[field]
        if len(found) != len(expected):
            row.complaint = f"expected {len(expected)} vertices, found {len(found)}"
            return
        if field == "normal" and called.auto_normal:
            compare_normals(row, found, expected, tolerances_of(called, parameters))
        else:
            off = np.abs(found[:, : expected.shape[1]] - expected).max(-1, initial=0.0)
            map_ = called.feeds.get(field)
            where = unit(map_, parameters) if map_ else (parameters[:, 0], parameters[:, 1])
            row.record(FIELDS[field], off, POINT_TOLERANCE * sizes_of(map_, expected, where))
    row.rows += len(parameters)


def compare_normals(row: Row, found: Single, expected: Array, tolerances: Array) -> None:
    """As far as float32 can tell them; at singular points theirs is (nearly) the zero vector, or
    rounding of length 1."""
    clear = tolerances <= LIMIT_TOLERANCE
    off = np.linalg.norm(found - expected, axis=-1)
    row.record("normal", off[clear], tolerances[clear])
    theirs = np.linalg.norm(expected[~clear], axis=-1)
    if not ((theirs == 0.0) | (np.abs(theirs - 1.0) < NORMAL_TOLERANCE)).all():
        row.complaint = "expected unit or zero normals in the case at singular points"


def compare_primitives(
    called: Called,
    row: Row,
    mesh: Evaluated,
    moved: Evaluated,
    theirs: dict[str, Array],
    wrong: set[str],
) -> None:
    """Each of their primitives is one of ours, with equal fields at each corner."""
    corners = mesh.primitives.shape[1]
    count = len(theirs["pos"])
    if count != mesh.primitives.size:
        row.complaint = f"expected {count // corners} primitives, found {len(mesh.primitives)}"
        return
    ours = {field: values[mesh.primitives] for field, values in fields_of(moved).items()}
    other = {f: v.reshape(len(mesh.primitives), corners, -1) for f, v in theirs.items()}
    limits = {"normal"} if called.auto_normal else set()  # ours has them where theirs has zero
    telling = [field for field in other if field not in wrong | limits] or ["pos"]
    scales = {field: max(1.0, float(np.abs(other[field]).max())) for field in telling}
    order = paired(
        np.concatenate([ours[f][..., : other[f].shape[-1]] / scales[f] for f in telling], -1),
        np.concatenate([other[f] / scales[f] for f in telling], -1),
    )
    parameters = moved.parameters[mesh.primitives][order].reshape(-1, 2)
    arranged = {field: values[order].reshape(count, -1) for field, values in ours.items()}
    expected = corrected(called, theirs, parameters, wrong)
    compare_fields(called, row, arranged, expected, parameters)


def paired(ours: Array, theirs: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """For each of their primitives (p, corners, d) one of ours, each used once, and its corners
    in their order: an index into ours."""
    used = np.zeros(len(ours), bool)
    which, chosen = np.empty(len(ours), np.intp), np.empty(ours.shape[:2], np.intp)
    orders, middles = np.array(list(permutations(range(ours.shape[1])))), ours.mean(1)
    for i, wanted in enumerate(theirs):
        away = np.where(used, np.inf, np.abs(middles - wanted.mean(0)).max(-1))
        near = np.argpartition(away, min(NEAR, len(away)) - 1)[:NEAR]  # some have one middle
        off = np.abs(ours[near][:, orders] - wanted).max((2, 3)) + away[near, None]
        best, order = np.unravel_index(np.argmin(off), off.shape)
        which[i], chosen[i] = near[best], orders[order]
        used[which[i]] = True
    return which[:, None], chosen
