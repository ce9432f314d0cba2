"""Cases of glMap1 and glMap2: glEvalCoord at lists of parameters, and glEvalMesh.

Compared with what the real one computed: points to 1e-6 of the largest coordinate (at least 1),
unit normals to 1e-5 away from singular points, colours and texture coordinates like points.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import permutations
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reparam import evaluators
from reparam.evaluators import GL_AUTO_NORMAL, GL_POINTS, Evaluated, Evaluators
from reparam.evaluators.maps import TARGETS, Map
from reparam.geometry.bernstein import bernstein
from reparam.geometry.evaluate import evaluate, evaluate_derivatives
from reparam.geometry.normal import projected_derivative, surface_normal
from reparam.snapshot import Studio

if TYPE_CHECKING:
    from parity import Case, Row

Array = NDArray[np.float64]
Single = NDArray[np.float32]

POINT_TOLERANCE, NORMAL_TOLERANCE = 1e-6, 1e-5
LIMIT_TOLERANCE = 2e-3  # of a normal at a singular point, a limit from float32
CLEAR = 0.05  # least sine between the tangents, and least ratio of their lengths, to judge a normal
FIELDS = {"pos": "position", "normal": "normal", "color": "colour", "tex": "texture"}
ATTRIBUTES = {"pos": "vertex", "normal": "normal", "color": "color", "tex": "texcoord"}


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
            points = gl.glGetMapdv(number, evaluators.GL_COEFF)
            points = points.reshape(orders[0], *orders[1:] if dimension == 2 else [1], -1)
            domain = gl.glGetMapdv(number, evaluators.GL_DOMAIN)
            domain = np.concatenate([domain, [0.0, 1.0]])[:4]
            for field, attribute in ATTRIBUTES.items():
                better = field not in found or target.name > found[field].target.name
                if attribute == target.attribute and better:
                    found[field] = Map(target, points, tuple(domain.tolist()))
    return found


# Truth in float64 ---------------------------------------------------------------------------


def padded(map_: Map) -> Array:
    net = np.zeros((*map_.points.shape[:2], 4))
    net[..., 3] = 1.0
    net[..., : map_.target.components] = map_.points
    return net


def unit(map_: Map, parameters: Array) -> tuple[Array, Array]:
    u1, u2, v1, v2 = map_.domain
    return (parameters[:, 0] - u1) / (u2 - u1), (parameters[:, 1] - v1) / (v2 - v1)


def true_values(map_: Map, parameters: Array) -> Array:
    """(k, 4) from the map's own float32 numbers, in float64."""
    return evaluate(padded(map_), *unit(map_, parameters))


def true_normals(map_: Map, parameters: Array) -> Array:
    """Unit normals (k, 3), d/du x d/dv in the user's own u and v."""
    u1, u2, v1, v2 = map_.domain
    return surface_normal(padded(map_), *unit(map_, parameters)) * np.sign((u2 - u1) * (v2 - v1))


def true_fields(called: Called, fields: set[str], parameters: Array) -> dict[str, Array]:
    """The fields asked for, as they should be."""
    found = {}
    for field in fields:
        if field == "normal" and called.auto_normal:
            found[field] = true_normals(called.feeds["pos"], parameters)
        else:
            width = 3 if field == "normal" else 4
            found[field] = true_values(called.feeds[field], parameters)[:, :width]
    return found


def regular(map_: Map, parameters: Array) -> NDArray[np.bool_]:
    """Where the tangents are long and open enough for float32 to tell the normal to 1e-5."""
    net, (u, v) = padded(map_), unit(map_, parameters)
    points = evaluate(net, u, v)
    tangents = [projected_derivative(points, d) for d in evaluate_derivatives(net, u, v)]
    lengths = np.linalg.norm(tangents, axis=-1)
    least = CLEAR * max(1.0, float(lengths.max(initial=0.0)))
    cross = np.linalg.norm(np.cross(*tangents), axis=-1)
    return np.asarray((lengths.min(0) > least) & (cross > CLEAR * lengths.prod(0)))


# Comparing ----------------------------------------------------------------------------------


def wrong_fields(case: Case) -> set[str]:
    """The fields in which the real one is known to be wrong: those named before the colon."""
    note = case.get("known_wrong") or ""
    named = set(re.findall(r"\w+", note.partition(":")[0])) & set(FIELDS)
    return named or (set(FIELDS) if note else set())


def fields_of(found: Evaluated) -> dict[str, Single]:
    arrays = (found.vertices, found.normals, found.colors, found.texcoords)
    return dict(zip(FIELDS, arrays, strict=True))


def sizes_of(called: Called, field: str, values: Array, parameters: Array) -> Array:
    """Of each vertex (k,): the largest coordinate of the field and of its control points; at
    least 1. Outside its domain a map is a difference of larger terms: then their sum. Rounding
    adds up with the order, that of the real one by Horner's scheme too: above 4 in proportion."""
    sizes = np.maximum(1.0, np.abs(values).max(-1, initial=0.0))
    if field in called.feeds:
        map_ = called.feeds[field]
        shape, where = map_.points.shape, unit(map_, parameters)
        row, column = (np.abs(bernstein(shape[k] - 1, where[k])) for k in (0, 1))
        terms = np.einsum("ki,kj,ijc->kc", row, column, np.abs(map_.points))
        sizes = np.maximum(sizes, np.maximum(np.abs(map_.points).max(), terms.max(-1)))
        sizes = sizes * max(1.0, max(shape[:2]) / 4.0)
    return np.asarray(sizes)


def compare_fields(
    called: Called, row: Row, ours: dict[str, Single], theirs: dict[str, Array], parameters: Array
) -> None:
    """Vertex by vertex: ours at the parameters, and what they should be."""
    for field, expected in theirs.items():
        found = ours[field]
        if len(found) != len(expected):
            row.complaint = f"expected {len(expected)} vertices, found {len(found)}"
            return
        off = np.abs(found[:, : expected.shape[1]] - expected).max(-1, initial=0.0)
        if field == "normal" and called.auto_normal:
            compare_normals(called, row, found, expected, parameters)
        else:
            sizes = sizes_of(called, field, expected, parameters)
            row.record(FIELDS[field], off, POINT_TOLERANCE * sizes)
    row.rows += len(parameters)


def compare_normals(
    called: Called, row: Row, found: Single, expected: Array, parameters: Array
) -> None:
    """Regular points against theirs; singular ones, where theirs is (nearly) the zero vector or
    rounding, against the limit."""
    surface = called.feeds["pos"]
    clear = regular(surface, parameters)
    off = np.linalg.norm(found - expected, axis=-1)
    row.record("normal", off[clear], NORMAL_TOLERANCE)
    limits = true_normals(surface, parameters)
    off = np.linalg.norm(found - limits, axis=-1)
    if not (off[~clear] <= LIMIT_TOLERANCE).all():
        row.complaint = f"normals at singular points are off by {off[~clear].max():.1e}"
    theirs = np.linalg.norm(expected[~clear], axis=-1)
    if not ((theirs == 0.0) | (np.abs(theirs - 1.0) < NORMAL_TOLERANCE)).all():
        row.complaint = "expected unit or zero normals in the case at singular points"


def expected_outputs(case: Case, called: Called, parameters: Array) -> dict[str, Array]:
    """The case's outputs; float64 where they are known to be wrong."""
    theirs = {field: np.array(values, float) for field, values in case["outputs"].items()}
    return theirs | true_fields(called, wrong_fields(case) & set(theirs), parameters)


def evaluated_at(called: Called, parameters: Array, evaluator: str) -> Evaluated:
    """One glEvalCoord for each of (u, v), shape (k, 2)."""
    gl = called.gl
    gl.glBegin(GL_POINTS)
    for u, v in parameters.tolist():
        if called.dimension == 1:
            gl.glEvalCoord1f(u)
        else:
            gl.glEvalCoord2f(u, v)
    gl.glEnd()
    (found,) = gl.read(evaluator=evaluator)
    return found


def compare_points(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """map1, map2: glEvalCoord at a list."""
    inputs, dimension = case["inputs"], int(case["kind"][3])
    called = call_maps(studio, inputs, dimension)
    given = np.array(inputs["u" if dimension == 1 else "uv"], np.float32).astype(float)
    parameters = np.zeros((len(given), 2))
    parameters[:, :dimension] = given.reshape(len(given), dimension)
    found = evaluated_at(called, parameters, evaluator)
    theirs = expected_outputs(case, called, parameters)
    compare_fields(called, row, fields_of(found), theirs, parameters)


# Meshes -------------------------------------------------------------------------------------


def drifted(segments: int, start: float, end: float, first: int, last: int) -> Array:
    """Where Mesa's glEvalMesh evaluates: it adds a step in float32, again and again."""
    step = np.float32((np.float32(end) - np.float32(start)) / np.float32(segments))
    values = [np.float32(start) + np.float32(first) * step]
    for _ in range(first, last):
        values.append(values[-1] + step)
    return np.array(values, np.float64)


def compare_mesh(studio: Studio, case: Case, evaluator: str, row: Row) -> None:
    """map1_mesh, map2_mesh: our mesh against float64 on the exact grid; its primitives, moved to
    the real one's drifted parameters, against the real one's, in any order and winding."""
    inputs, dimension = case["inputs"], int(case["kind"][3])
    called = call_maps(studio, inputs, dimension)
    gl, grid, mode = called.gl, inputs["grid"], getattr(evaluators, f"GL_{inputs['mode']}")
    if dimension == 1:
        ranges = [(inputs["i1"], inputs["i2"])]
        gl.glMapGrid1f(*grid)
        gl.glEvalMesh1(mode, *ranges[0])
    else:
        ranges = [tuple(inputs["rng"][:2]), tuple(inputs["rng"][2:])]
        gl.glMapGrid2f(*grid)
        gl.glEvalMesh2(mode, *ranges[0], *ranges[1])
    meshes = gl.read(evaluator=evaluator)
    theirs = {field: np.array(values, float) for field, values in case["outputs"].items()}
    if not meshes:
        row.complaint = f"expected {len(theirs['pos'])} vertices, found no mesh"
        return
    (mesh,) = meshes
    compare_exact_mesh(called, row, mesh, theirs)
    axes = [drifted(*grid[3 * d : 3 * d + 3], *ranges[d]) for d in range(dimension)]
    places = np.stack(np.meshgrid(*axes, *[[0.0]] * (2 - dimension), indexing="ij"), -1)
    moved = evaluated_at(called, places.reshape(-1, 2), evaluator)
    compare_primitives(called, row, mesh, moved, theirs, wrong_fields(case))


def compare_exact_mesh(called: Called, row: Row, mesh: Evaluated, theirs: dict[str, Array]) -> None:
    """Our vertices against float64 at the parameters handed back."""
    truth = true_fields(called, set(theirs), mesh.parameters)
    compare_fields(called, row, fields_of(mesh), truth, mesh.parameters)


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
    telling = [field for field in other if field not in wrong] or ["pos"]
    order = paired(
        np.concatenate([ours[f][..., : other[f].shape[-1]] for f in telling], -1),
        np.concatenate([other[f] for f in telling], -1),
    )
    parameters = moved.parameters[mesh.primitives][order].reshape(-1, 2)
    arranged = {field: values[order].reshape(count, -1) for field, values in ours.items()}
    expected = theirs | true_fields(called, set(theirs) & wrong, parameters)
    compare_fields(called, row, arranged, expected, parameters)


def paired(ours: Array, theirs: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """For each of their primitives (p, corners, d) one of ours, each used once, and its corners
    in their order: an index into ours."""
    used = np.zeros(len(ours), bool)
    which = np.empty(len(ours), np.intp)
    for i, wanted in enumerate(theirs.mean(1)):
        away = np.abs(ours.mean(1) - wanted).max(-1)
        which[i] = np.argmin(np.where(used, np.inf, away))
        used[which[i]] = True
    chosen = ours[which]
    orders = np.array(list(permutations(range(ours.shape[1]))))
    off = np.stack([np.abs(chosen[:, order] - theirs).max((1, 2)) for order in orders])
    return which[:, None], orders[np.argmin(off, 0)]
