"""The arguments of gluNurbsCurve, gluNurbsSurface and gluPwlCurve, checked in libGLU's order.

Each call takes C's arguments, the same without the counts, or PyOpenGL's: knots, an array of
control points and the type; the order is then the number of knots less that of the points.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..geometry.net import LARGEST, Array
from ..geometry.nurbs import KnotError, KnotFault, check_knots
from .glu_constants import GLU_MAP1_TRIM_2, GLU_MAP1_TRIM_3
from .glu_errors import (
    DecreasingKnots,
    DuplicatePoint,
    EmptyKnotRange,
    GluInvalidValue,
    ImproperPwlType,
    KnotMultiplicity,
    NegativeCount,
    NegativeStride,
    NullControlPoints,
    NurbsError,
    OrderUnsupported,
    TooFewKnots,
    UnknownKnotError,
    UnknownType,
)
from .maps import TARGETS
from .splines import NurbsTrim, PwlTrim, Spline

MAX_ORDER = 24  # libGLU's; its text for error 1
TRIM_COMPONENTS = {GLU_MAP1_TRIM_2: 2, GLU_MAP1_TRIM_3: 3}
KNOT_ERRORS: dict[KnotFault, type[NurbsError]] = {
    KnotFault.ORDER: OrderUnsupported,
    KnotFault.TOO_FEW: TooFewKnots,
    KnotFault.EMPTY_RANGE: EmptyKnotRange,
    KnotFault.DECREASING: DecreasingKnots,
    KnotFault.MULTIPLICITY: KnotMultiplicity,
    KnotFault.NOT_FINITE: UnknownKnotError,
}


def curve_argument(*arguments: Any) -> Spline | NurbsTrim:
    """gluNurbsCurve's curve. Raises NurbsError 1-5, 32, 34-36, GluInvalidValue."""
    call = "gluNurbsCurve"
    match arguments:
        case (count, knots, stride, points, order, kind):
            knots = _counted(call, count, knots)
        case (knots, stride, points, order, kind):
            pass
        case (knots, points, kind):
            stride, order = None, None
        case _:
            raise TypeError(f"{call}(nurb, [[nknots,] knots, stride, points, order,] type)")
    components = TRIM_COMPONENTS.get(kind) or _components(call, kind, 1)
    net, (knots,), (order,) = _net(call, components, (knots,), (stride,), points, (order,))
    if kind in TARGETS:
        return Spline(TARGETS[kind], (knots,), (order,), net)
    homogeneous = net if components == 3 else np.column_stack([net, np.ones(len(net))])
    return NurbsTrim(knots, order, homogeneous)


def surface_argument(*arguments: Any) -> Spline:
    """gluNurbsSurface's surface. Raises NurbsError 1-5, 32, 34-36, GluInvalidValue."""
    call = "gluNurbsSurface"
    match arguments:
        case (s_count, s_knots, t_count, t_knots, *rest, points, s_order, t_order, kind) if (
            len(rest) == 2
        ):
            knots = (_counted(call, s_count, s_knots), _counted(call, t_count, t_knots))
            strides, orders = tuple(rest), (s_order, t_order)
        case (s_knots, t_knots, s_stride, t_stride, points, s_order, t_order, kind):
            knots, strides, orders = (s_knots, t_knots), (s_stride, t_stride), (s_order, t_order)
        case (s_knots, t_knots, points, kind):
            knots, strides, orders = (s_knots, t_knots), (None, None), (None, None)
        case _:
            raise TypeError(
                f"{call}(nurb, [sknot_count,] sknots, [tknot_count,] tknots, "
                "[s_stride, t_stride,] points, [sorder, torder,] type)"
            )
    components = _components(call, kind, 2)
    net, checked, found = _net(call, components, knots, strides, points, orders)
    return Spline(TARGETS[kind], checked, found, net)


def pwl_argument(*arguments: Any) -> PwlTrim:
    """gluPwlCurve's curve. Raises NurbsError 22, 33-37, GluInvalidValue."""
    call = "gluPwlCurve"
    match arguments:
        case (count, points, stride, kind):
            pass
        case (points, kind):
            count, stride = len(points) if points is not None else 0, None
        case _:
            raise TypeError(f"{call}(nurb, [count,] points, [stride,] type)")
    if kind not in TRIM_COMPONENTS:
        error = ImproperPwlType if kind in TARGETS else UnknownType
        raise error(f"{call}: type: expected GLU_MAP1_TRIM_2 or _3, found {kind!r}")
    if points is None:
        raise NullControlPoints(f"{call}: points: expected an array, found None")
    if _whole(call, "count", count) < 0:
        raise NegativeCount(f"{call}: count: expected at least 0, found {count}")
    _check_stride(call, stride)
    net = _points(call, TRIM_COMPONENTS[kind], points, (stride,), (count,))
    if kind == GLU_MAP1_TRIM_3:
        if not (net[:, 2] > 0.0).all():
            raise GluInvalidValue(f"{call}: points: expected weights above 0, found {net[:, 2]}")
        net = net[:, :2] / net[:, 2:]
    twice = np.flatnonzero((net[1:] == net[:-1]).all(-1))
    if twice.size:
        at, point = int(twice[0]), net[twice[0]].tolist()
        raise DuplicatePoint(
            f"{call}: expected different points, found {point} at {at} and {at + 1}"
        )
    return PwlTrim(net)


def _components(call: str, kind: int, dimension: int) -> int:
    target = TARGETS.get(kind)
    if target is None or target.dimension != dimension:
        found = target.name if target else repr(kind)
        raise UnknownType(f"{call}: type: expected GL_MAP{dimension}_..., found {found}")
    return target.components


def _whole(call: str, name: str, value: Any) -> int:
    if isinstance(value, (int, np.integer)):
        return int(value)
    raise GluInvalidValue(f"{call}: {name}: expected a whole number, found {value!r}")


def _numbers(call: str, name: str, values: ArrayLike) -> Array:
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise GluInvalidValue(
            f"{call}: {name}: expected an array of numbers, found {error}"
        ) from None


def _counted(call: str, count: int, knots: ArrayLike) -> Array:
    values = _numbers(call, "knots", knots).ravel()
    if _whole(call, "knot count", count) > len(values):
        raise GluInvalidValue(f"{call}: knots: expected {count} numbers, found {len(values)}")
    return values[: max(count, 0)]


def _check_stride(call: str, stride: int | None) -> None:
    if stride is not None and _whole(call, "stride", stride) < 0:
        raise NegativeStride(f"{call}: stride: expected at least 0, found {stride}")


def _net(
    call: str,
    components: int,
    knots: Sequence[ArrayLike],
    strides: Sequence[int | None],
    points: ArrayLike | None,
    orders: Sequence[int | None],
) -> tuple[Array, tuple[Array, ...], tuple[int, ...]]:
    """Control points, knots and orders, rounded to float32 as GLU takes them."""
    if points is None:
        raise NullControlPoints(f"{call}: control points: expected an array, found None")
    for stride in strides:
        _check_stride(call, stride)
    net = _numbers(call, "points", points)
    if orders[0] is None and net.ndim != len(knots) + 1:
        expected = "(m, n, " if len(knots) == 2 else "(n, "
        raise GluInvalidValue(
            f"{call}: points: expected an array {expected}{components}), found shape {net.shape}; "
            "a flat buffer needs its strides and orders"
        )
    counts, checked, found = [], [], []
    with np.errstate(over="ignore"):
        rounded = [_numbers(call, "knots", t).astype(np.float32).ravel() for t in knots]
    for axis, values in enumerate(rounded):
        given = orders[axis]
        order = values.size - net.shape[axis] if given is None else _whole(call, "order", given)
        try:
            checked.append(check_knots(values, order, max_order=MAX_ORDER))
        except KnotError as fault:
            raise KNOT_ERRORS[fault.fault](f"{call}: {fault}") from None
        counts.append(values.size - order)
        found.append(order)
    return _points(call, components, net, strides, counts), tuple(checked), tuple(found)


def _points(
    call: str,
    components: int,
    points: ArrayLike,
    strides: Sequence[int | None],
    counts: Sequence[int],
) -> Array:
    """Points (*counts, components) from an array of that shape, or from a buffer with strides."""
    values = _numbers(call, "points", points)
    if strides[0] is None:
        if values.shape != (*counts, components):
            expected = (*counts, components)
            raise GluInvalidValue(
                f"{call}: points: expected shape {expected}, found {values.shape}"
            )
    else:
        places = np.arange(components)
        for stride, count in zip(reversed(strides), reversed(counts), strict=True):
            assert stride is not None
            places = stride * np.arange(count).reshape(-1, *[1] * places.ndim) + places
        needed = int(places.max(initial=-1)) + 1
        if needed > values.size:
            raise GluInvalidValue(
                f"{call}: points: expected at least {needed} numbers, found {values.size}"
            )
        values = values.ravel()[places]
    bad = np.argwhere(~(np.abs(values) <= LARGEST))
    if len(bad):
        at = tuple(int(i) for i in bad[0])
        raise GluInvalidValue(
            f"{call}: points: expected numbers up to {LARGEST:g}, "
            f"found {values[at]:g} at {list(at)}"
        )
    return values.astype(np.float32).astype(np.float64)
