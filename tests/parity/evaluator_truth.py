"""What maps are worth in float64, and how much of it float32 can tell."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reparam.evaluators.maps import Map
from reparam.geometry.bernstein import bernstein
from reparam.geometry.evaluate import evaluate, evaluate_derivatives
from reparam.geometry.normal import projected_derivative, surface_normal

Array = NDArray[np.float64]
Single = NDArray[np.float32]

POINT_TOLERANCE, NORMAL_TOLERANCE = 1e-6, 1e-5
MILD, SEEN = 5e-5, 0.25  # of normals near singular points
LIMIT_TOLERANCE = 2e-3  # of a normal at a singular point, a limit from float32
ATTRIBUTES = {"pos": "vertex", "normal": "normal", "color": "color", "tex": "texcoord"}


def padded(map_: Map) -> Array:
    """Four numbers a control point: (uorder, vorder, 4)."""
    net = np.zeros((*map_.points.shape[:2], 4))
    net[..., 3] = 1.0
    net[..., : map_.target.components] = map_.points
    return net


def unit(map_: Map, parameters: Array) -> tuple[Array, Array]:
    """(u, v) of shape (k, 2) in [0,1]."""
    u1, u2, v1, v2 = map_.domain
    return (parameters[:, 0] - u1) / (u2 - u1), (parameters[:, 1] - v1) / (v2 - v1)


def rounded_unit(map_: Map, parameters: Array) -> tuple[Array, Array]:
    """The same as Mesa has it: (u - u1) * (1 / (u2 - u1)), all in float32."""
    ends, given = np.array(map_.domain, np.float32), parameters.astype(np.float32)
    found = [
        (given[:, axis] - ends[2 * axis])
        * (np.float32(1.0) / (ends[2 * axis + 1] - ends[2 * axis]))
        for axis in (0, 1)
    ]
    return found[0].astype(float), found[1].astype(float)


def true_values(map_: Map, where: tuple[Array, Array]) -> Array:
    """(k, 4) from the map's own float32 numbers, in float64."""
    return evaluate(padded(map_), *where)


def true_normals(map_: Map, where: tuple[Array, Array]) -> Array:
    """Unit normals (k, 3), d/du x d/dv in the user's own u and v."""
    u1, u2, v1, v2 = map_.domain
    return surface_normal(padded(map_), *where) * np.sign((u2 - u1) * (v2 - v1))


def sizes_of(map_: Map | None, values: Array, where: tuple[Array, Array]) -> Array:
    """Of each vertex (k,): the largest coordinate of its values and of the control points; at
    least 1. Outside its domain a map is a difference of larger terms: then their sum. Rounding
    adds up with the order, that of the real one by Horner's scheme too: above 4 in proportion."""
    sizes = np.maximum(1.0, np.abs(values).max(-1, initial=0.0))
    if map_ is None:
        return np.asarray(sizes)
    sizes = np.maximum(sizes, terms_of(map_.points, where))
    return np.asarray(sizes * rounding_of(map_.points.shape[:2]))


def terms_of(net: Array | Single, where: tuple[Array, Array]) -> Array:
    """How large what is added up is, (k,): the largest control number, or outside [0,1] more."""
    row, column = (np.abs(bernstein(net.shape[k] - 1, where[k])) for k in (0, 1))
    terms = np.einsum("ki,kj,ijc->kc", row, column, np.abs(net))
    return np.asarray(np.maximum(terms.max(-1), np.abs(net).max(initial=0.0)))


def rounding_of(orders: tuple[int, ...]) -> float:
    """How much more than of a cubic: Horner's scheme rounds at each degree."""
    return max(1.0, max(orders) / 4.0)


def normal_tolerances(net: Array, where: tuple[Array, Array]) -> Array:
    """Of each unit normal (k,): NORMAL_TOLERANCE, or what the tangents' own tolerance makes of it.

    A tangent is a point of the hodograph: it is known to POINT_TOLERANCE of the largest of its
    control points. The normal is off by that beside the tangents' lengths and the sine between
    them: without a bound where these vanish, at a singular point. Float32 does better by SEEN:
    above MILD that is asked for, lest 1e-4 be allowed where it need not.
    """
    points = evaluate(net, *where)
    tangents = [projected_derivative(points, d) for d in evaluate_derivatives(net, *where)]
    projected = np.abs(points[:, :3]).max(-1) / np.where(points[:, 3] == 0.0, 1.0, points[:, 3])
    off = []
    for axis in (0, 1):
        hodograph = np.diff(net, axis=axis) * (net.shape[axis] - 1.0)
        if not hodograph.size:
            return np.full(len(points), np.inf)
        moved = terms_of(hodograph[..., :3], where)
        moved += terms_of(hodograph[..., 3:], where) * np.abs(projected)
        off.append(POINT_TOLERANCE * rounding_of(net.shape[:2]) * moved)
    lengths = [np.linalg.norm(tangent, axis=-1) for tangent in tangents]
    cross = np.linalg.norm(np.cross(*tangents), axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = (off[0] * lengths[1] + off[1] * lengths[0]) / cross
    found = np.where(cross > 0.0, found, np.inf)
    return np.maximum(NORMAL_TOLERANCE, np.minimum(found, np.maximum(MILD, SEEN * found)))


def has_limit(map_: Map, where: tuple[Array, Array]) -> NDArray[np.bool_]:
    """Whether the normals nearby, at (k,) points of [0,1]^2, go towards one: not where the surface
    is folded, or has no extent in one direction."""
    at = np.stack(where, -1)
    towards = ([0.5, 0.5], [0.3, 0.6], [0.6, 0.3], [0.45, 0.75])
    nearby = [true_normals(map_, tuple((at + 1e-4 * (np.array(t) - at)).T)) for t in towards]
    spread = np.linalg.norm(np.ptp(np.stack(nearby), axis=0), axis=-1)
    flat = min(map_.points.shape[:2]) == 1
    return np.asarray((spread < 10.0 * LIMIT_TOLERANCE) & (not flat))
