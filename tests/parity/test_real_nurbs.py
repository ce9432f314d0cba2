"""Random NURBS through the real libGLU and through ours, in one process, compared as cases are.

Eighty on both paths are slow; a few of each sort are quick. Companion maps share the vertex
map's knots, since libGLU fails else (tests/evaluators/test_nurbs_tessellations.py has those).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import real_glu

import parity
from reparam.evaluators.glu import GLU_NURBS_ERROR, gluNewNurbsRenderer
from reparam.snapshot import Studio

GLU = real_glu.library()
pytestmark = pytest.mark.skipif(GLU is None, reason="no libGLU here to compare with")

Random = np.random.Generator
S2 = np.sqrt(0.5)
CIRCLE = np.array([(1, 0, 1), (S2, S2, S2), (0, 1, 1), (-S2, S2, S2), (-1, 0, 1),
                   (-S2, -S2, S2), (0, -1, 1), (S2, -S2, S2), (1, 0, 1)])  # fmt: skip
CIRCLE_KNOTS = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]
METHODS = ("DOMAIN_DISTANCE", "PATH_LENGTH", "PARAMETRIC_ERROR", "OBJECT_PATH_LENGTH")


def rounded(values: Any) -> Any:
    """As float32 has them."""
    return np.asarray(values, np.float32).astype(float)


def random_knots(random: Random, order: int, spans: int) -> list[float]:
    """Clamped or not, with knots inside of any multiplicity up to the order."""
    ends = np.cumsum(np.append(random.uniform(-1, 1), random.uniform(0.2, 1, spans)))
    inner = np.repeat(ends[1:-1], random.integers(1, order + 1, spans - 1))
    if random.random() < 0.7:
        outer = [np.repeat(ends[0], order - 1), np.repeat(ends[-1], order - 1)]
    else:
        outer = [ends[0] - np.sort(random.uniform(0, 1, order - 1))[::-1],
                 ends[-1] + np.sort(random.uniform(0, 1, order - 1))]  # fmt: skip
    return list(rounded(np.concatenate([outer[0], ends[:1], inner, ends[-1:], outer[1]])))


def random_points(random: Random, shape: tuple[int, ...], kind: str) -> Any:
    points = random.uniform(-2, 2, (*shape, real_glu.WIDTHS[kind]))
    if kind == "VERTEX_4":
        points[..., 3] = random.uniform(0.5, 2, shape)
        points[..., :3] *= points[..., 3:]
    return rounded(points)


def random_properties(random: Random) -> dict[str, Any]:
    return {
        "SAMPLING_METHOD": METHODS[random.integers(len(METHODS))],
        "SAMPLING_TOLERANCE": float(random.uniform(20, 60)),
        "PARAMETRIC_TOLERANCE": float(random.uniform(2, 6)),
        "U_STEP": float(random.integers(3, 12)),
        "V_STEP": float(random.integers(3, 12)),
    }


COMPANIONS = ("TEXTURE_COORD_2", "TEXTURE_COORD_4", "COLOR_4", "NORMAL")


def random_curve(random: Random) -> dict[str, Any]:
    order = int(random.integers(2, 11))
    knots = random_knots(random, order, int(random.integers(1, 5)))
    count, kind = len(knots) - order, ("VERTEX_3", "VERTEX_4")[random.integers(2)]
    extra = [
        (name, knots, random_points(random, (count,), name), order)
        for name in COMPANIONS
        if random.random() < 0.3 and name != "TEXTURE_COORD_4"
    ]
    properties = random_properties(random) | {"SAMPLING_METHOD": METHODS[random.integers(2)]}
    points = random_points(random, (count,), kind)
    return {"knots": knots, "ctrl": points, "order": order, "type": kind, "extra": extra,
            "props": properties}  # fmt: skip


def random_surface(random: Random, most: int = 8) -> dict[str, Any]:
    orders = [int(order) for order in random.integers(2, most, 2)]
    knots = [random_knots(random, order, int(random.integers(1, 4))) for order in orders]
    shape = tuple(len(k) - order for k, order in zip(knots, orders, strict=True))
    kind = ("VERTEX_3", "VERTEX_4")[random.integers(2)]
    names = [name for name in COMPANIONS if random.random() < 0.25]
    if len([name for name in names if name[:3] == "TEX"]) == 2:
        names.remove("TEXTURE_COORD_2")
    extra = [(name, *knots, random_points(random, shape, name), *orders) for name in names]
    # Small on the screen: libGLU makes 10,000 triangles of these where 100 would do.
    view = (np.diag([0.2, 0.2, 0.2, 1.0]), np.eye(4), (0, 0, 128, 128))
    return {"sknots": knots[0], "tknots": knots[1], "ctrl": random_points(random, shape, kind),
            "sorder": orders[0], "torder": orders[1], "type": kind, "extra": extra,
            "view": view, "props": random_properties(random)}  # fmt: skip


def random_trims(random: Random) -> dict[str, Any]:
    """A star around the middle, or the whole border, with circles cut out."""
    inputs = random_surface(random, 5)
    inputs["extra"] = []
    ends = [(k[order - 1], k[-order]) for k, order in (
        (inputs["sknots"], inputs["sorder"]), (inputs["tknots"], inputs["torder"]))]  # fmt: skip
    low, size = np.array(ends)[:, 0], np.diff(np.array(ends)).ravel()
    outer = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], float)
    if random.random() < 0.5:
        angles = np.linspace(0, 2 * np.pi, int(random.integers(5, 12)))
        radii = random.uniform(0.36, 0.49, len(angles))
        radii[-1] = radii[0]
        outer = 0.5 + radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], -1)
        outer[-1] = outer[0]
    trims: list[Any] = [[("pwl", rounded(low + size * outer))]]
    for u, v in ((0.4, 0.4), (0.6, 0.6))[: random.integers(1, 3)]:
        radius = random.uniform(0.05, 0.12)
        points = CIRCLE[::-1] * [radius * size[0], radius * size[1], 1.0]
        points += np.outer(CIRCLE[:, 2], [*(low + size * [u, v]), 0.0])
        trims.append([("nurbs", CIRCLE_KNOTS, rounded(points), 3)])
    inputs["trims"] = trims
    return inputs


SORTS = {
    "nurbs_curve": [random_curve],
    "nurbs_surface": [random_surface, random_trims],
}


def compare(studio: Studio, kind: str, make: Any, seed: int, evaluators: Any) -> None:
    inputs = make(np.random.default_rng(seed))
    outputs = real_glu.run_real(GLU, kind, inputs)
    while studio.ctx.error != "GL_NO_ERROR":
        pass  # libGLU calls glPushAttrib and the like, which the context has no longer
    assert outputs["prims"], "libGLU draws nothing"
    case = {"kind": kind, "inputs": inputs, "outputs": outputs}
    for evaluator in evaluators:
        row = parity.run_case(studio, f"{make.__name__} {seed}", case, evaluator)
        assert row.ok, row.line()


@pytest.mark.parametrize("seed", range(8))
def test_curves(studio: Studio, seed: int) -> None:
    compare(studio, "nurbs_curve", random_curve, seed, ["vertex"])


@pytest.mark.parametrize("seed", range(8))
def test_surfaces(studio: Studio, seed: int) -> None:
    compare(studio, "nurbs_surface", random_surface, seed, ["vertex"])


@pytest.mark.parametrize("seed", range(3))
def test_trims(studio: Studio, seed: int) -> None:
    compare(studio, "nurbs_surface", random_trims, seed, ["vertex"])


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 130))
def test_many(studio: Studio, seed: int) -> None:
    """Thirty of each sort."""
    for kind, sorts in SORTS.items():
        for make in sorts:
            compare(studio, kind, make, seed, studio.painter.capabilities.evaluators)


KNOTS = [0.0, 0.0, 1.0, 1.0]
LINE = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
SQUARE = [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]
BORDER = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
CURVE = ("gluNurbsCurve", 4, KNOTS, 3, LINE, 2, 0x0D97)
SURFACE = ("gluNurbsSurface", 4, KNOTS, 4, KNOTS, 6, 3, SQUARE, 2, 2, 0x0DB7)
PWL = ("gluPwlCurve", 5, BORDER, 2, 100210)
HOLE = ("gluPwlCurve", 4, [[0.2, 0.2], [0.2, 0.8], [0.8, 0.2], [0.2, 0.2]], 2, 100210)
TRIM = ("gluNurbsCurve", 4, KNOTS, 2, [[0.0, 0.0], [1.0, 0.0]], 2, 100210)


def knots_of(values: list[float], order: int) -> tuple[Any, ...]:
    return ("gluNurbsCurve", len(values), values, 3, np.zeros((40, 3)), order, 0x0D97)


@pytest.mark.parametrize(
    "calls",
    [
        [knots_of([0, 1], 0)],
        [knots_of([0.0] * 25 + [1.0] * 25, 25)],
        [knots_of([0, 0, 0, 1, 1, 1], 4)],
        [("gluBeginCurve",), knots_of([1, 1, 1, 1], 2), ("gluEndCurve",)],
        [("gluBeginCurve",), knots_of([0, 0, 1, 0.5, 2, 2], 2), ("gluEndCurve",)],
        [knots_of([0, 0, 0, 0, 0, 1, 1, 1, 1], 4), CURVE],
        [("gluBeginCurve",), CURVE, ("gluBeginCurve",), CURVE, ("gluEndCurve",)],
        [("gluEndCurve",), ("gluEndSurface",), ("gluEndTrim",), PWL],
        [("gluBeginCurve",), ("gluEndCurve",)],
        [("gluBeginCurve",), PWL, ("gluEndCurve",)],
        [("gluBeginSurface",), SURFACE, ("gluBeginTrim",), PWL, ("gluEndSurface",)],
        [("gluBeginSurface",), SURFACE, ("gluBeginTrim",), ("gluEndTrim",), ("gluEndSurface",)],
        [("gluBeginSurface",), SURFACE, ("gluBeginTrim",), PWL, ("gluBeginTrim",), HOLE,
         ("gluEndTrim",), ("gluEndSurface",)],
        [("gluBeginSurface",), SURFACE, ("gluBeginSurface",), SURFACE, ("gluEndSurface",)],
        [("gluBeginSurface",), SURFACE, ("gluBeginTrim",), ("gluBeginCurve",), TRIM, PWL],
        [("gluBeginSurface",), SURFACE, ("gluBeginTrim",), ("gluBeginCurve",), PWL, TRIM],
        [("gluPwlCurve", -1, BORDER, 2, 100210)],
        [("gluPwlCurve", 5, BORDER, -2, 100210)],
        [("gluPwlCurve", 5, BORDER, 2, 0x0D97)],
        [("gluPwlCurve", 5, BORDER, 2, 4242)],
        [("gluNurbsCurve", 4, KNOTS, -3, LINE, 2, 0x0D97)],
        [("gluNurbsCurve", 4, KNOTS, 3, LINE, 2, 4242)],
        [("gluNurbsCurve", 4, KNOTS, 3, None, 2, 0x0D97)],
        [("gluNurbsSurface", 4, KNOTS, 4, KNOTS, -6, 3, SQUARE, 2, 2, 0x0DB7)],
        [("gluNurbsSurface", 4, KNOTS, 2, KNOTS, 6, 3, SQUARE, 2, 2, 0x0DB7)],
        [("gluNurbsProperty", 4242, 1.0), ("gluNurbsProperty", 100205, 7.0),
         ("gluNurbsProperty", 100204, 7.0), ("gluNurbsProperty", 100160, 7.0)],
    ],
)  # fmt: skip
def test_errors_are_the_same(calls: list[tuple[Any, ...]]) -> None:
    real, ours, codes = real_glu.RealNurbs(GLU), gluNewNurbsRenderer(), []
    ours.gluNurbsCallback(GLU_NURBS_ERROR, codes.append)
    for name, *arguments in calls:
        real.call(name, *arguments)
        getattr(ours, name)(*arguments)
    real.close()
    assert codes == real.errors
    assert codes
