"""A B-spline curve as gluNurbsCurve takes it: knots and control points, both for a hand to drag.

The knot strip beneath has the basis functions and the knots, equal ones one above another. Each
span between knots is one Bezier piece in its own colour. A knot that is inserted leaves the curve
and changes the net: some control points give way to one more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Annotated, Any

import numpy as np

from ...geometry.curve import curve_net
from ...geometry.extraction import curve_to_bezier
from ...geometry.jets import spline_jet
from ...geometry.nurbs import (
    KnotError,
    basis_functions,
    check_knots,
    domain,
    evaluate_curve,
    insert_knot,
)
from .. import palette
from ..claims import Claim
from ..drawing import in_space, polygon, words
from ..layers import Array, Curves, Dots, Figure, Handles, Layer, Polylines, Space, plane
from ..parameters import Points, Range
from ..registry import scene

POINTS = np.array(
    [[0.0, 0.2], [0.3, 1.5], [1.4, 1.9], [1.7, 0.6], [2.7, 0.0], [3.5, 0.9], [3.2, 2.0], [4.3, 1.6]]
)
KNOTS = np.array([0, 0, 0, 0, 1, 2, 3, 3, 4, 4, 4, 4], dtype=np.float64)
NONE = np.zeros(0)
OFTEN = ("", "once", "twice", "three times")
STRIP = 10.0  # width of the knot strip in units of its own
BASIS = 1.3  # height of 1 on it
STACK = 0.26  # from one equal knot to the next
SNAP = 0.015  # of the strip: a dragged knot so near another becomes equal to it


@scene(
    "A spline, its knots and its control points",
    animates="insert",
    plates=((), ("times=1",)),
)
def spline(
    points: Annotated[Array, Points((None, 2), "control points")] = POINTS,
    knots: Annotated[Array, Points((None,), "knots, as many as points and order")] = KNOTS,
    weights: Annotated[Array, Points((None,), "of the control points; all 1 if empty")] = NONE,
    times: Annotated[int, Range(0, 3), "how often a knot is inserted"] = 0,
    insert: Annotated[float, Range(0, 1, 0.05), "where, from the first to the last"] = 0.35,
) -> Figure:
    order = checked_order(points, knots, weights)
    net = homogeneous(points, weights)
    pieces = curve_to_bezier(knots, net, order)
    low, high = domain(knots, order)
    at = low + insert * (high - low)
    caption = [
        f"order {order}: {len(points)} control points, {len(knots)} knots, "
        f"{len(pieces.nets)} polynomial pieces"
    ]
    layers: list[Layer] = [handles(points)]
    before = palette.GUIDE if times else palette.CONTROL_NET
    layers += polygon(points, before, 1.0, 3.0)
    if times:
        try:
            finer, refined = insert_knot(knots, net, order, at, times)
        except KnotError as fault:
            caption.append(f"no room for the knot: {fault}")
        else:
            layers += polygon(refined[:, :3] / refined[:, 3:], palette.CONTROL_NET, 1.2, 3.0)
            change = difference((knots, net), (finer, refined), order)
            caption.append(
                f"inserted {OFTEN[times]} at {at:.4g}: {len(refined)} control points, "
                f"and the curve changes by {change:.1g}"
            )
    layers += drawn(pieces.nets)
    ends = np.stack([*pieces.nets[:, 0], pieces.nets[-1, -1]])
    layers.append(Dots(ends[:, :3] / ends[:, 3:], palette.INK, 2.6))
    if times:
        here = evaluate_curve(knots, net, order, np.array([at]))
        layers.append(Dots(here[:, :3] / here[:, 3:], palette.MOVING, 4.5))
    bounds = in_space(points)
    spaces = (
        Space("physical", bounds, tuple(layers), height=2.2),
        Space("knots", *strip(knots, order, at if times else None), below=True),
    )
    return Figure(spaces, tuple(caption))


def checked_order(points: Array, knots: Array, weights: Array) -> int:
    """The order that these numbers of points and knots make. Raises ValueError."""
    if len(points) < 2:
        raise ValueError(f"points: expected at least two control points, found {len(points)}")
    order = len(knots) - len(points)
    if order < 2:
        expected = f"at least {len(points) + 2} knots for {len(points)} control points"
        raise ValueError(f"knots: expected {expected}, found {len(knots)}")
    check_knots(knots, order, len(points))
    if len(weights) not in (0, len(points)):
        raise ValueError(f"weights: expected {len(points)} or none, found {len(weights)}")
    return order


def homogeneous(points: Array, weights: Array) -> Array:
    """The control points as (n, 4), premultiplied. Raises ValueError for a weight not positive."""
    return curve_net(points, weights if len(weights) else None)


def difference(one: tuple[Array, Array], other: tuple[Array, Array], order: int) -> float:
    """The largest distance of two splines, knots and points (n, 4) each, at equal parameters."""
    t = np.linspace(*domain(one[0], order), 201)
    first, second = (evaluate_curve(knots, points, order, t) for knots, points in (one, other))
    return float(np.abs(first[:, :3] / first[:, 3:] - second[:, :3] / second[:, 3:]).max())


def drawn(nets: Array) -> Iterator[Layer]:
    """The pieces, three colours in turn."""
    for color, own in zip(palette.PIECES, (nets[k::3] for k in range(3)), strict=True):
        if len(own):
            yield Curves(np.ascontiguousarray(own), color, 3.0)


def strip(knots: Array, order: int, inserted: float | None) -> tuple[Array, tuple[Layer, ...]]:
    """The knots beneath the axis, coloured as the pieces between them, and the basis above it."""
    first, last = float(knots[0]), float(knots[-1])

    def place(t: Array, y: Array | float = 0.0) -> Array:
        x = STRIP * (np.asarray(t) - first) / (last - first)
        return in_space(np.stack([x, np.broadcast_to(y, x.shape)], -1))

    stacked = np.array([np.count_nonzero(knots[:i] == t) for i, t in enumerate(knots)])
    at = place(knots, -STACK * (stacked + 1.2))
    layers: list[Layer] = [strip_handles(knots, at, first, last)]
    low, high = domain(knots, order)
    t = np.unique(np.concatenate([np.linspace(low, high, 401), knots]))
    t = t[(t >= low) & (t <= high)]
    spans, values = basis_functions(knots, order, t)
    basis = np.zeros((len(t), len(knots) - order))
    columns = spans[:, None] + np.arange(1 - order, 1)
    np.put_along_axis(basis, columns, values, 1)
    for i, column in enumerate(basis.T):
        support = (t >= knots[i]) & (t <= knots[i + order])
        if support.any():
            layers.append(Polylines(place(t[support], BASIS * column[support]), palette.GUIDE, 1.3))
    layers.append(Polylines(place(np.array([first, last])), palette.INK, 1.0))
    inside = np.unique(knots[(knots >= low) & (knots <= high)])
    for i in range(len(inside) - 1):
        layers.append(Polylines(place(inside[i : i + 2]), palette.PIECES[i % 3], 4.0))
    layers.append(Dots(at, palette.INK, 3.4))
    for value in np.unique(knots):
        many = int(np.count_nonzero(knots == value))
        below = place(np.array([value]), -STACK * (many + 1.6))[0]
        layers.append(words(f"{value:.4g}", below, offset=(0.0, -9.0), size=13.0))
    if inserted is not None:
        layers.append(Dots(place(np.array([inserted])), palette.MOVING, 4.5))
    depth = STACK * (max(order, int(stacked.max()) + 1) + 1.6) + 0.35
    return plane(-0.3, -depth, STRIP + 0.3, BASIS + 0.15), tuple(layers)


def handles(points: Array) -> Handles:
    """The control points."""

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        moved = values["points"].copy()
        moved[index] = point[:2]
        return {"points": moved}

    return Handles(in_space(points), drag, tuple(f"P{i}" for i in range(len(points))))


def strip_handles(knots: Array, at: Array, first: float, last: float) -> Handles:
    """The knots: dragged between their neighbours (of equal ones the top one goes to the left, the
    bottom one to the right); a click inserts the knot once more, so the curve stays."""

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        present = values["knots"].copy()
        to = first + (last - first) * float(point[0]) / STRIP
        for near in np.delete(present, index):
            if abs(near - to) < SNAP * (last - first):
                to = float(near)
        left = present[index - 1] if index else to
        right = present[index + 1] if index + 1 < len(present) else to
        present[index] = min(max(to, left), right)
        return {"knots": present}

    def click(values: Mapping[str, Any], index: int) -> Mapping[str, Any]:
        order = len(values["knots"]) - len(values["points"])
        net = homogeneous(values["points"], values["weights"])
        more, refined = insert_knot(values["knots"], net, order, float(values["knots"][index]))
        found = {"knots": more, "points": refined[:, :2] / refined[:, 3:]}
        return {**found, "weights": refined[:, 3]} if len(values["weights"]) else found

    return Handles(at, drag, tuple(f"t{i}" for i in range(len(knots))), click=click)


@spline.claims
def claims() -> Iterator[Claim]:
    net = homogeneous(POINTS, NONE)
    t = np.linspace(*domain(KNOTS, 4), 201)
    total = basis_functions(KNOTS, 4, t)[1].sum(-1)
    statement = "the basis functions sum to 1: largest and smallest sum"
    yield Claim("glu", statement, [1.0, 1.0], [float(total.max()), float(total.min())], 1e-15)
    moved = [
        difference((KNOTS, net), insert_knot(KNOTS, net, 4, at, times), 4)
        for at, times in ((0.35, 1), (2.0, 2), (3.7, 3))
    ]
    statement = "how far the curve moves as a knot is inserted once, twice, three times"
    yield Claim("glu", statement, [0.0] * 3, moved, 1e-14)
    random = np.random.default_rng(2)
    weights = random.uniform(0.5, 2.0, len(POINTS))
    rational = homogeneous(POINTS, weights)
    moved = [difference((KNOTS, rational), insert_knot(KNOTS, rational, 4, 1.4), 4)]
    yield Claim("glu", "the same with weights from 1/2 to 2", [0.0], moved, 1e-14)
    exact = [[Fraction(x) for x in row] for row in POINTS.tolist()]
    agree = []
    for many in (1, 2, 3):
        knots = [Fraction(0)] * 4 + [Fraction(1)] * many + [Fraction(2)] * 4
        sides = [
            spline_jet(knots, exact[: 4 + many], Fraction(1), 3, side).derivatives
            for side in ("left", "right")
        ]
        agree.append(int((sides[0] == sides[1]).all(1).sum()) - 1)
    statement = (
        "derivatives of a cubic that agree, exactly, at a knot once, twice, three times there"
    )
    yield Claim("glu", statement, [2, 1, 0], agree, 0)
