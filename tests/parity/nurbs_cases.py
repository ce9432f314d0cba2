"""Cases of GLU NURBS: what libGLU's callbacks were told, against our surfaces and curves there.

A surface's vertices come with (u, v): ours is evaluated there, in the piece that the primitive
lies in. A curve's come without: the parameter is found, in float64, and ours evaluated there;
they go along the curve in order and miss no joint. Trims: the same points stay. Errors are the
same codes, but where libGLU is silent ours may report and draw nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from evaluator_cases import LIMIT_TOLERANCE, NORMAL_TOLERANCE, POINT_TOLERANCE, regular
from numpy.typing import NDArray

from reparam import evaluators
from reparam.evaluators import Evaluators, glu
from reparam.evaluators.grids import primitive_indices
from reparam.evaluators.nurbs_parts import parts_at
from reparam.evaluators.splines import Nurbs
from reparam.evaluators.tessellations import (
    Read,
    Tessellation,
    evaluate_at,
    read_float64,
    tessellate,
)
from reparam.geometry.bernstein import bernstein, bernstein_derivative
from reparam.snapshot import Studio

if TYPE_CHECKING:
    from parity import Case, Row

Array = NDArray[np.float64]

COLUMNS = {"pos": "position", "normal": "normal", "color": "colour", "tex": "texture"}
SILENT = {
    100250 + n for n, error in glu.NURBS_ERRORS.items() if "GLU: silent" in str(error.__doc__)
}
AREA_TOLERANCE = 2e-6  # of the domain; libGLU's (u, v) are float32
LARGEST_SAGITTA = 0.05  # of the domain: how far libGLU's trims, polygons, may be from ours
SAMPLES = 1500


# Calling ours -------------------------------------------------------------------------------


def constant(name: object, prefix: str) -> int:
    """GL_MAP2_VERTEX_3 for "VERTEX_3"; GLU_MAP1_TRIM_2 for "MAP1_TRIM_2"; a number for itself."""
    for module, full in ((evaluators, f"{prefix}{name}"), (glu, f"GLU_{name}")):
        if hasattr(module, full):
            return int(getattr(module, full))
    return int(str(name))


def new_renderer(inputs: dict[str, Any]) -> tuple[glu.NurbsRenderer, list[int]]:
    """An object with a case's properties and matrices, and the list of its errors to come."""
    nurb, errors = glu.gluNewNurbsRenderer(), []
    nurb.gluNurbsCallback(glu.GLU_NURBS_ERROR, errors.append)
    view = inputs.get("view") or (np.eye(4), np.eye(4), (0, 0, 256, 256))
    nurb.gluNurbsProperty(glu.GLU_AUTO_LOAD_MATRIX, 0)
    nurb.gluLoadSamplingMatrices(*view)
    for name, value in (inputs.get("props") or {}).items():
        value = constant(value, "") if isinstance(value, str) else value
        nurb.gluNurbsProperty(constant(name, ""), value)
    return nurb, errors


def call_curve(inputs: dict[str, Any]) -> tuple[tuple[Nurbs, ...], list[int]]:
    nurb, errors = new_renderer(inputs)
    nurb.gluBeginCurve()
    own = (inputs.get("type", "VERTEX_3"), inputs["knots"], inputs["ctrl"], inputs["order"])
    for kind, knots, points, order in [*inputs.get("extra", ()), own]:
        points = np.array(points, np.float32)
        target = constant(kind, "GL_MAP1_")
        nurb.gluNurbsCurve(len(knots), knots, points.shape[-1], points, order, target)
    nurb.gluEndCurve()
    return nurb.take(), errors


def call_surface(inputs: dict[str, Any]) -> tuple[tuple[Nurbs, ...], list[int]]:
    nurb, errors = new_renderer(inputs)
    nurb.gluBeginSurface()
    own = (inputs.get("type", "VERTEX_3"), inputs["sknots"], inputs["tknots"], inputs["ctrl"],
           inputs["sorder"], inputs["torder"])  # fmt: skip
    maps = [*((extra, None) for extra in inputs.get("extra", ())), (own, inputs.get("strides"))]
    for (kind, u_knots, v_knots, points, *orders), strides in maps:
        points = np.array(points, np.float32)
        if strides is None:
            strides = (points.shape[1] * points.shape[2], points.shape[2])
        target = constant(kind, "GL_MAP2_")
        nurb.gluNurbsSurface(
            len(u_knots), u_knots, len(v_knots), v_knots, *strides, points, *orders, target
        )
    for loop in inputs.get("trims", ()):
        nurb.gluBeginTrim()
        for kind, *data in loop:
            width = len(data[0 if kind == "pwl" else 1][0])
            target = constant(f"MAP1_TRIM_{width}", "")
            if kind == "pwl":
                nurb.gluPwlCurve(len(data[0]), np.array(data[0]), width, target)
            else:
                knots, points, order = data
                nurb.gluNurbsCurve(len(knots), knots, width, np.array(points), order, target)
        nurb.gluEndTrim()
    nurb.gluEndSurface()
    return nurb.take(), errors


# Theirs -------------------------------------------------------------------------------------


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


# Comparing ----------------------------------------------------------------------------------


def compare_curve(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    compare(studio, case, evaluator, row, call_curve, compare_curve_points)


def compare_surface(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    compare(studio, case, evaluator, row, call_surface, compare_surface_points)


def compare(
    studio: Studio, case: Case, evaluator: str, row: Row, call: Any, compare_points: Any
) -> None:
    """Errors, whether there is anything, our own tessellation, and theirs."""
    mode = case["inputs"].get("mode", "tessellator")
    if mode != "tessellator":
        row.complaint = (
            f"expected a case of the tessellator, found mode {mode!r}: what GLU draws itself comes "
            "without parameters and is compared as a picture, in test_real_nurbs_pictures.py"
        )
        return
    recorded, errors = call(case["inputs"])
    outputs = case["outputs"]
    reported = [code for code in errors if code in SILENT]
    if errors != outputs["errors"] and not reported:
        row.complaint = f"expected errors {outputs['errors']}, found {errors}"
        return
    theirs = theirs_of(outputs)
    read = partial(Evaluators(studio.ctx).read, evaluator=evaluator)
    ours = [tessellate(nurbs, read) for nurbs in recorded]
    drawn = any(len(one.primitives) for one in ours)
    if not theirs.runs or reported:
        if drawn:
            row.complaint = "expected nothing to be drawn"
        row.record("position", 0.0, POINT_TOLERANCE)
        row.rows += 1
        return
    if not drawn:
        row.complaint = "expected something to be drawn"
        return
    (nurbs,), (mine,) = recorded, ours
    size = max(1.0, *(float(np.abs(x).max()) for x in (nurbs.vertex.points, mine.points)))
    compare_arrays(nurbs, row, mine, tessellate(nurbs, read_float64), size)
    if not case.get("known_wrong"):
        compare_points(nurbs, theirs, read, row, size)


def compare_arrays(
    nurbs: Nurbs, row: Row, found: Tessellation, truth: Tessellation, size: float
) -> None:
    """Ours from the GPU, and in float64."""
    row.rows += len(truth.points)
    row.record("position", np.abs(found.points - truth.points), POINT_TOLERANCE * size)
    for column, one, other in (
        ("colour", found.colors, truth.colors),
        ("texture", found.texcoords, truth.texcoords),
    ):
        if other is not None and one is not None:
            scale = max(1.0, float(np.abs(other).max()))
            row.record(column, np.abs(one - other), POINT_TOLERANCE * scale)
    if truth.normals is not None and found.normals is not None:
        parameters = truth.parameters
        clear = is_clear(nurbs, parameters, parameters)
        off = np.linalg.norm(found.normals - truth.normals, axis=-1)
        row.record("normal", off[clear], NORMAL_TOLERANCE)
        if not (off <= LIMIT_TOLERANCE).all():
            row.complaint = f"our normals at singular points are off by {off.max():.1e}"


def is_clear(nurbs: Nurbs, parameters: Array, towards: Array) -> NDArray[np.bool_]:
    """Where float32 can tell the normal; everywhere if there is a map of normals."""
    clear = np.ones(len(parameters), bool)
    if "normal" not in nurbs.by_attribute and len(nurbs.vertex.knots) == 2:
        for part, members in parts_at(nurbs, parameters, towards):
            surface = next(iter(part.item.maps.values())).by_attribute["vertex"]
            clear[members] = regular(surface, part.item.parameters)
    return clear


def compare_surface_points(nurbs: Nurbs, theirs: Theirs, read: Read, row: Row, size: float) -> None:
    uv = theirs.fields["uv"]
    towards = sides(nurbs, theirs, read)
    ours = evaluate_at(nurbs, uv, read, towards)
    compare_fields(theirs, ours, row, size, is_clear(nurbs, uv, towards))
    domain = np.array([nurbs.ends(axis)[[0, -1]] for axis in (0, 1)])
    whole = float(np.prod(np.diff(domain)))
    if len(theirs.lines):
        if (
            not any(on_ends(nurbs, uv[theirs.lines], axis).all() for axis in (0, 1))
            and not (
                on_ends(nurbs, uv[theirs.lines], 0) | on_ends(nurbs, uv[theirs.lines], 1)
            ).all()
            and nurbs.region is None
        ):
            row.complaint = "expected outlines along the borders of the pieces"
    elif nurbs.region is not None:
        compare_regions(nurbs, theirs, domain, row)
    elif not nurbs.properties.culling:
        found = float(np.abs(areas(uv, theirs.triangles).sum()))
        if abs(found - whole) > AREA_TOLERANCE * whole:
            row.complaint = f"expected primitives that cover {whole:g}, found {found:.7g}"


def sides(nurbs: Nurbs, theirs: Theirs, read: Read) -> Array:
    """A point of the piece that each vertex belongs to: the middle of its primitive. A primitive
    without extent on a border between pieces belongs to the side that it is nearer to."""
    uv = theirs.fields["uv"]
    middle = np.empty_like(uv)
    for run in theirs.runs:
        middle[run] = uv[run].mean(0)
    unsure = np.stack(
        [np.abs(middle[:, axis, None] - nurbs.ends(axis)).min(1) < 1e-6 for axis in (0, 1)], -1
    )
    which = np.flatnonzero(unsure.any(-1))
    best = np.full(len(which), np.inf)
    chosen = middle.copy()
    for side in ((-1, -1), (-1, 1), (1, -1), (1, 1)) if len(which) else ():
        towards = middle[which] + 1e-4 * unsure[which] * side
        found = evaluate_at(nurbs, uv[which], read, towards)
        off = np.abs(found.points - theirs.fields["pos"][which]).max(-1)
        if "normal" in theirs.fields and found.normals is not None:
            off += np.abs(found.normals - theirs.fields["normal"][which]).max(-1)
        chosen[which[off < best]] = towards[off < best]
        best = np.minimum(best, off)
    return chosen


def on_ends(nurbs: Nurbs, lines: Array, axis: int) -> NDArray[np.bool_]:
    """Which lines (p, 2, 2) run along a border between pieces."""
    t = lines[..., axis]
    nearest = np.abs(t[..., None] - nurbs.ends(axis)).min(-1)
    return np.asarray((nearest < 1e-6).all(-1) & (np.ptp(t, axis=-1) < 1e-6))


def compare_fields(
    theirs: Theirs, ours: Tessellation, row: Row, size: float, clear: NDArray[np.bool_]
) -> None:
    """Vertex by vertex."""
    expected = theirs.fields
    row.rows += len(expected["pos"])
    width = expected["pos"].shape[1]
    points = ours.points if width == 3 else ours.vertices
    scale = max(size, float(np.abs(expected["pos"]).max()))
    row.record("position", np.abs(points[:, :width] - expected["pos"]), POINT_TOLERANCE * scale)
    for name, found in (("color", ours.colors), ("tex", ours.texcoords), ("normal", ours.normals)):
        if name not in expected:
            continue
        if found is None or found.shape[1] != expected[name].shape[1]:
            row.complaint = f"expected {name} of {expected[name].shape[1]} numbers"
        elif name == "normal":
            off = np.linalg.norm(found - expected[name], axis=-1)
            row.record("normal", off[clear], NORMAL_TOLERANCE)
            length = np.linalg.norm(expected[name][~clear], axis=-1)
            if not ((length == 0.0) | (np.abs(length - 1.0) < NORMAL_TOLERANCE)).all():
                row.complaint = "expected unit or zero normals in the case at singular points"
        else:
            largest = max(1.0, float(np.abs(expected[name]).max()))
            off = np.abs(found - expected[name])
            row.record(COLUMNS[name], off, POINT_TOLERANCE * largest)


# Trims --------------------------------------------------------------------------------------


def compare_regions(nurbs: Nurbs, theirs: Theirs, domain: Array, row: Row) -> None:
    """Points farther from the trims than libGLU's polygons are stay in both or in neither."""
    assert nurbs.region is not None
    uv, size = theirs.fields["uv"], np.diff(domain).ravel()
    square = (uv - domain[:, 0]) / size
    edges = boundary_edges(square, theirs.triangles)
    points = np.concatenate([edges, edges.mean(1, keepdims=True)], 1).reshape(-1, 2)
    inner = points[((points > 1e-6) & (points < 1 - 1e-6)).all(-1)]
    away = np.abs(nurbs.region.signed_distance(*(domain[:, 0] + inner * size).T))
    sagitta = float(away.max(initial=0.0))
    if sagitta > LARGEST_SAGITTA:
        row.complaint = f"expected trims within {LARGEST_SAGITTA}, found them {sagitta:.2g} apart"
        return
    samples = np.random.default_rng(0).uniform(0.0, 1.0, (SAMPLES, 2))
    where = domain[:, 0] + samples * size
    distance = nurbs.region.signed_distance(*where.T)
    margin = 1.5 * sagitta + 1e-4  # a chord is not farthest off at its middle
    clear = np.abs(distance) > margin
    covered = covers(square, theirs.triangles, samples[clear])
    wrong = int((covered != (distance[clear] > 0.0)).sum())
    row.rows += int(clear.sum())
    if wrong:
        row.complaint = f"{wrong} of {clear.sum()} sample points lie on the other side of a trim"
    found = float(np.abs(areas(square, theirs.triangles).sum()))
    exact = nurbs.region.area() / float(size.prod())
    length = float(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=-1).sum())
    if abs(found - exact) > margin * length:
        row.complaint = f"expected an area of {exact:.6g}, found {found:.6g}"


def boundary_edges(points: Array, triangles: NDArray[np.intp]) -> Array:
    """Edges (p, 2, 2) that have no twin, and are not covered on both sides: libGLU's triangles
    have T-junctions."""
    keys = np.unique(points.round(6), axis=0, return_inverse=True)[1].reshape(-1)[triangles]
    edges = np.stack([keys, np.roll(keys, -1, 1)], -1).reshape(-1, 2)
    corners = np.stack([triangles, np.roll(triangles, -1, 1)], -1).reshape(-1, 2)
    proper = edges[:, 0] != edges[:, 1]
    edges, corners = edges[proper], corners[proper]
    _, which, counts = np.unique(np.sort(edges, 1), axis=0, return_inverse=True, return_counts=True)
    lonely = points[corners[counts[which.reshape(-1)] == 1]]
    along = lonely[:, 1] - lonely[:, 0]
    left = np.stack([-along[:, 1], along[:, 0]], -1) / np.linalg.norm(along, axis=-1)[:, None]
    sides = [covers(points, triangles, lonely.mean(1) + s * 1e-4 * left) for s in (1, -1)]
    return lonely[~(sides[0] & sides[1])]


def covers(points: Array, triangles: NDArray[np.intp], samples: Array) -> NDArray[np.bool_]:
    """Whether samples (k, 2) lie in one of the triangles."""
    corners = points[triangles]
    corners = corners[areas(points, triangles) != 0.0]
    inside = np.zeros(len(samples), bool)
    for some in np.array_split(np.arange(len(corners)), max(1, len(corners) // 200)):
        a = corners[some][:, None]
        to = samples[None, :, None] - a
        along = np.roll(a, -1, 2) - a
        side = along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0]
        inside |= ((side >= 0.0).all(-1) | (side <= 0.0).all(-1)).any(0)
    return inside


# Curves -------------------------------------------------------------------------------------


def compare_curve_points(nurbs: Nurbs, theirs: Theirs, read: Read, row: Row, size: float) -> None:
    """Each of libGLU's primitives goes on where the last one ended, or where the curve jumps."""
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
    parameters, side = (np.column_stack([np.concatenate(x), 0.0 * np.concatenate(x)])
                        for x in (at, towards))  # fmt: skip
    ours = evaluate_at(nurbs, parameters, read, side)
    compare_fields(theirs, ours, row, size, np.ones(len(parameters), bool))


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
