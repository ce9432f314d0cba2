"""Cases of GLU NURBS: what libGLU's callbacks were told, against our surfaces and curves there.

A surface's vertices come with (u, v): ours is evaluated there, in the piece that the primitive
lies in. A curve's come without (curve_cases.py), and so does what libGLU drew by itself
(drawn_cases.py). Trims: the same points stay (trimmed_cases.py). Errors are the same codes, but
where libGLU is silent ours may report and draw nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from curve_cases import located_curve
from drawn_cases import drawn_curve, drawn_surface
from evaluator_cases import compare_normals
from evaluator_truth import (
    LIMIT_TOLERANCE,
    NORMAL_TOLERANCE,
    POINT_TOLERANCE,
    Array,
    normal_tolerances,
    padded,
    rounding_of,
)
from explained import explained
from numpy.typing import NDArray
from nurbs_calls import call_curve, call_surface
from nurbs_outputs import COLUMNS, Theirs, areas, theirs_of
from trimmed_cases import compare_regions

from reparam.evaluators import Evaluators, glu
from reparam.evaluators.nurbs_parts import parts_at
from reparam.evaluators.splines import Nurbs
from reparam.evaluators.tessellations import (
    Read,
    Tessellation,
    evaluate_at,
    read_float64,
    tessellate,
)
from reparam.geometry.evaluate import evaluate
from reparam.snapshot import Studio

if TYPE_CHECKING:
    from parity import Case, Row

SILENT = {
    100250 + n for n, error in glu.NURBS_ERRORS.items() if "GLU: silent" in str(error.__doc__)
}
AREA_TOLERANCE = 2e-6  # of the domain; libGLU's (u, v) are float32
CELLS = 8  # of each piece, for our own arrays: how libGLU's method samples is not compared


def compare_curve(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """nurbs_curve."""
    compare(studio, case, evaluator, row, call_curve, compare_curve_points)


def compare_surface(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """nurbs_surface."""
    compare(studio, case, evaluator, row, call_surface, compare_surface_points)


def compare(
    studio: Studio,
    case: Case,
    evaluator: str,
    row: Row,
    call: Callable[[dict[str, Any]], tuple[tuple[Nurbs, ...], list[int]]],
    compare_points: Callable[[Nurbs, dict[str, Any], Read, Row, float], None],
) -> None:
    """Errors, whether there is anything, our own tessellation, and theirs."""
    recorded, errors = call(case["inputs"])
    outputs, wrong = case["outputs"], bool(case.get("known_wrong"))
    reported = [code for code in errors if code in SILENT]
    if errors != outputs["errors"] and not reported:
        row.complaint = f"expected errors {outputs['errors']}, found {errors}"
        return
    read = partial(Evaluators(studio.ctx).read, evaluator=evaluator)
    found = [(nurbs, tessellate(evenly(nurbs), read)) for nurbs in recorded]
    drawn = any(len(ours.primitives) for _, ours in found)
    expected = any(len(one["pos"]) for one in primitives_of(outputs)) or (wrong and drawn)
    if drawn != (expected and not reported):
        row.complaint = f"expected {'something' if expected else 'nothing'} to be drawn"
        return
    if not drawn:
        row.record("position", 0.0, POINT_TOLERANCE)
        row.rows += 1
        return
    if len(found) != 1:
        raise ValueError(f"expected one curve or surface, found {len(found)}")
    ((nurbs, mine),) = found
    size = max(1.0, *(float(np.abs(x).max()) for x in (nurbs.vertex.points, mine.points)))
    compare_arrays(nurbs, row, mine, tessellate(evenly(nurbs), read_float64), size)
    if not wrong:
        compare_points(nurbs, outputs, read, row, size)


def primitives_of(outputs: dict[str, Any]) -> list[dict[str, Any]]:
    """What has vertices: the callbacks' primitives, or what was drawn."""
    drawn = outputs.get("verts") or outputs.get("lines")
    return [drawn] if drawn else list(outputs["prims"])


def evenly(nurbs: Nurbs) -> Nurbs:
    """The same in few cells, lest a case's tolerance ask for a million."""
    (u0, u1), (v0, v1) = (nurbs.ends(axis)[[0, -1]] for axis in (0, len(nurbs.vertex.knots) - 1))
    return replace(
        nurbs,
        properties=replace(
            nurbs.properties,
            sampling_method=glu.GLU_DOMAIN_DISTANCE,
            u_step=CELLS / (u1 - u0),
            v_step=CELLS / (v1 - v0),
        ),
    )


def compare_arrays(
    nurbs: Nurbs, row: Row, found: Tessellation, truth: Tessellation, size: float
) -> None:
    """Ours from the GPU, and in float64."""
    row.rows += len(truth.points)
    rounding = POINT_TOLERANCE * rounding_of(nurbs.vertex.orders)
    row.record("position", np.abs(found.points - truth.points), rounding * size)
    for column, one, other in (
        ("colour", found.colors, truth.colors),
        ("texture", found.texcoords, truth.texcoords),
    ):
        if other is not None and one is not None:
            scale = max(1.0, float(np.abs(other).max(initial=0.0)))
            row.record(column, np.abs(one - other), rounding * scale)
    if truth.normals is not None and found.normals is not None:
        tolerances = tolerances_of(nurbs, truth.parameters, truth.parameters)
        off = np.linalg.norm(found.normals - truth.normals, axis=-1)
        clear = tolerances <= LIMIT_TOLERANCE
        row.record("normal", off[clear], tolerances[clear])
        if not (off <= LIMIT_TOLERANCE).all():
            row.complaint = f"our normals at singular points are off by {off.max():.1e}"


def tolerances_of(nurbs: Nurbs, parameters: Array, towards: Array) -> Array:
    """Of the normals, (k,): as far as float32 can tell them; those of a map like points."""
    if "normal" in nurbs.by_attribute or len(nurbs.vertex.knots) == 1:
        return np.full(len(parameters), NORMAL_TOLERANCE)
    found = np.empty(len(parameters))
    for part, members in parts_at(nurbs, parameters, towards):
        surface = next(iter(part.item.maps.values())).by_attribute["vertex"]
        found[members] = normal_tolerances(padded(surface), tuple(part.item.parameters.T))
    return found


# Curves -------------------------------------------------------------------------------------


def compare_curve_points(
    nurbs: Nurbs, outputs: dict[str, Any], read: Read, row: Row, size: float
) -> None:
    """At the parameters that their points lie at."""
    if "lines" in outputs:
        outputs = drawn_curve(nurbs, outputs)
    theirs = theirs_of(outputs)
    parameters, towards = located_curve(nurbs, theirs, row, size)
    reach = np.full(parameters.shape, 1e-5 * np.ptp(nurbs.ends(0))) * [1.0, 0.0]
    parameters = explained(nurbs, theirs.fields, parameters, towards, reach)
    compare_fields(nurbs, theirs, parameters, towards, read, row, size)


# Surfaces -----------------------------------------------------------------------------------


def compare_surface_points(
    nurbs: Nurbs, outputs: dict[str, Any], read: Read, row: Row, size: float
) -> None:
    """At the parameters that they come with."""
    if "verts" in outputs:
        outputs = drawn_surface(nurbs, outputs)
    theirs = theirs_of(outputs)
    uv = theirs.fields["uv"]
    towards = sides(nurbs, theirs, read)
    parameters = before_rounding(nurbs, theirs, towards)
    compare_fields(nurbs, theirs, parameters, towards, read, row, size)
    domain = np.array([nurbs.ends(axis)[[0, -1]] for axis in (0, 1)])
    whole = float(np.prod(np.diff(domain)))
    if len(theirs.lines):
        outlines = on_ends(nurbs, uv[theirs.lines], 0) | on_ends(nurbs, uv[theirs.lines], 1)
        if not outlines.all() and nurbs.region is None:
            row.complaint = "expected outlines along the borders of the pieces"
    elif nurbs.region is not None:
        compare_regions(nurbs, theirs, domain, row)
    elif not nurbs.properties.culling:
        found = float(np.abs(areas(uv, theirs.triangles).sum()))
        if abs(found - whole) > AREA_TOLERANCE * whole:
            row.complaint = f"expected primitives that cover {whole:g}, found {found:.7g}"


def resolution(nurbs: Nurbs, axis: int) -> float:
    """What parameters in float32 can be off by: of the domain and where it lies."""
    return 1e-6 * float(max(np.ptp(nurbs.ends(axis)), np.abs(nurbs.ends(axis)).max()))


def sides(nurbs: Nurbs, theirs: Theirs, read: Read) -> Array:
    """A point of the piece that each vertex belongs to: the middle of its primitive. A primitive
    without extent on a border between pieces belongs to the side that it is nearer to."""
    uv = theirs.fields["uv"]
    middle = np.empty_like(uv)
    for run in theirs.runs:
        middle[run] = uv[run].mean(0)
    near = np.array([resolution(nurbs, axis) for axis in (0, 1)])
    unsure = np.stack(
        [np.abs(middle[:, axis, None] - nurbs.ends(axis)).min(1) < near[axis] for axis in (0, 1)],
        -1,
    )
    which = np.flatnonzero(unsure.any(-1))
    best = np.full(len(which), np.inf)
    chosen = middle.copy()
    for side in ((-1, -1), (-1, 1), (1, -1), (1, 1)) if len(which) else ():
        towards = middle[which] + 100.0 * near * unsure[which] * side
        found = evaluate_at(nurbs, uv[which], read, towards)
        pos = theirs.fields["pos"][which]
        points = found.points if pos.shape[1] == 3 else found.vertices
        off = np.abs(points - pos).max(-1)
        if "normal" in theirs.fields and found.normals is not None:
            off += np.abs(found.normals - theirs.fields["normal"][which]).max(-1)
        chosen[which[off < best]] = towards[off < best]
        best = np.minimum(best, off)
    return chosen


def before_rounding(nurbs: Nurbs, theirs: Theirs, towards: Array) -> Array:
    """Of the (u, v) that round to those handed out, the ones that explain the vertices: (k, 2)."""
    uv = theirs.fields["uv"]
    size = np.array([np.ptp(nurbs.ends(axis)) for axis in (0, 1)])
    last = np.spacing(np.maximum(np.abs(uv), size).astype(np.float32)).astype(float)
    return explained(nurbs, theirs.fields, uv, towards, last)


def on_ends(nurbs: Nurbs, lines: Array, axis: int) -> NDArray[np.bool_]:
    """Which lines (p, 2, 2) run along a border between pieces."""
    t, near = lines[..., axis], resolution(nurbs, axis)
    nearest = np.abs(t[..., None] - nurbs.ends(axis)).min(-1)
    return np.asarray((nearest < near).all(-1) & (np.ptp(t, axis=-1) < near))


def projected_sizes(nurbs: Nurbs, parameters: Array, towards: Array) -> Array:
    """The largest control number of the vertex's piece, over its weight; at least 1: (k,)."""
    found = np.ones(len(parameters))
    for part, members in parts_at(nurbs, parameters, towards):
        net = next(iter(part.item.maps.values())).by_attribute["vertex"].net
        weights = np.abs(evaluate(net, *part.item.parameters.T)[:, 3])
        largest = float(np.abs(net).max())
        found[members] = largest / np.where(weights > 0.0, weights, 1.0)
    return np.maximum(1.0, found)


# Vertex by vertex ---------------------------------------------------------------------------


def compare_fields(
    nurbs: Nurbs,
    theirs: Theirs,
    parameters: Array,
    towards: Array,
    read: Read,
    row: Row,
    size: float,
) -> None:
    """Ours at the parameters, and theirs."""
    ours, expected = evaluate_at(nurbs, parameters, read, towards), theirs.fields
    row.rows += len(expected["pos"])
    width = expected["pos"].shape[1]
    points = ours.points if width == 3 else ours.vertices
    scale = max(size, float(np.abs(expected["pos"]).max()))
    rounding = POINT_TOLERANCE * rounding_of(nurbs.vertex.orders)
    off = np.abs(points[:, :width] - expected["pos"]).max(-1)
    sizes = np.minimum(scale, projected_sizes(nurbs, parameters, towards))
    row.record("position", off, rounding * (sizes if width == 3 else scale))
    for name, found in (("color", ours.colors), ("tex", ours.texcoords), ("normal", ours.normals)):
        if name not in expected:
            continue
        if found is None or found.shape[1] != expected[name].shape[1]:
            row.complaint = f"expected {name} of {expected[name].shape[1]} numbers"
        elif name == "normal":
            tolerances = tolerances_of(nurbs, parameters, towards)
            compare_normals(row, found, expected[name], tolerances)
        else:
            largest = max(1.0, float(np.abs(expected[name]).max()))
            off = np.abs(found - expected[name])
            row.record(COLUMNS[name], off, rounding * largest)
