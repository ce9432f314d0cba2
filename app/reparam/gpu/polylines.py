"""Points of polylines in numpy: how they are linked, and at which parameters curves are sampled.

Points stand one after another, (count, 4) homogeneous, each with a link: 0 where a line begins, 1
where a segment comes from the point before; of a closed line of n segments the first link is -n
and the last 1 + n (shaders/lib/polyline.glsl reads them).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import project

Array = NDArray[np.float64]
Values = tuple[float, ...]

MEETING = 1e-9  # of the size of all curves: ends nearer than this are one point


def joined(points: Array, closed: bool = False) -> tuple[Array, Array]:
    """Points (k, 3) or (lines, k, 3) with their links; a closed line gets its first point again."""
    lines = points.reshape(-1, *points.shape[-2:])
    if closed:
        lines = np.concatenate([lines, lines[:, :1]], 1)
    count, length = lines.shape[:2]
    links = np.ones((count, length))
    links[:, 0] = 0.0
    if closed and length > 2:
        links[:, 0], links[:, -1] = 1 - length, length
    flat = lines.reshape(-1, 3)
    return np.concatenate([flat, np.ones((len(flat), 1))], -1), links.ravel()


def net_legs(net: Array) -> tuple[Array, Array]:
    """The rows and columns of control nets; points without weight are left out.

    The net of a curve, (curves, n, 1, 4), has rows of one point, which are no lines.
    """
    patches = net.reshape(-1, *net.shape[-3:])
    rows = [row for patch in patches for row in patch]
    columns = [column for patch in patches for column in patch.swapaxes(0, 1)]
    lines = [line[line[:, 3] > 0.0] for line in rows + columns]
    lines = [line for line in lines if len(line) > 1] or [patches[0, 0]]
    links = np.ones(sum(map(len, lines)))
    links[np.cumsum([0, *map(len, lines)])[:-1]] = 0.0
    return np.concatenate(lines), links


def lines_of(net: Array) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The first curve of each line (k,) that curves (curves, n, 4) make, and whether it is closed:
    where one ends and the next begins the line runs on, and it is closed where the last one ends at
    the start of the first."""
    ends = project(net[:, [0, -1]])
    near = MEETING * max(float(np.ptp(ends.reshape(-1, 3), axis=0).max()), 1e-30)
    runs_on = np.abs(ends[1:, 0] - ends[:-1, 1]).max(-1) <= near
    first = np.append(0, np.flatnonzero(~runs_on) + 1)
    last = np.append(first[1:], len(net)) - 1
    return first, np.abs(ends[first, 0] - ends[last, 1]).max(-1) <= near


def curve_links(net: Array, samples: int) -> Array:
    """Links of curves (curves, n, 4) sampled at `samples` points each."""
    first, closed = lines_of(net)
    last = np.append(first[1:], len(net)) - 1
    links = np.ones((len(net), samples))
    links[first, 0] = 0.0
    first, last = first[closed], last[closed]
    segments = (last - first + 1) * samples - 1
    links[first, 0], links[last, -1] = -segments, 1 + segments
    return links.ravel()


def segments(links: Array) -> NDArray[np.int32]:
    """Of the segment that ends at each point (k, 4): its line's first and last segment, 1 if that
    leads to the first, and itself; a point where a line begins stands before its first."""
    first = np.flatnonzero(links < 0.5)
    lines = np.stack([first + 1, np.append(first[1:], len(links)) - 1, links[first] < -0.5], -1)
    lines = np.repeat(lines, np.diff(np.append(first, len(links))), 0)
    return np.column_stack([lines, np.arange(len(links))]).astype(np.int32)


@lru_cache(maxsize=256)
def line_parameters(
    u: Values, v: Values, span: tuple[float, float], segments: int
) -> tuple[Array, Array]:
    """(u, 1-u, v, 1-v) along the curves u = const and v = const of one patch, and their links.

    The same object for the same curves: it is uploaded once.
    """
    links = np.ones((len(u) + len(v), segments + 1))
    links[:, 0] = 0.0
    return _with_complements(_along(u, v, _fractions(span, segments))), links.ravel()


@lru_cache(maxsize=256)
def arrow_parameters(u: Values, v: Values, span: tuple[float, float]) -> Array:
    """Parameters of the last two points of each curve."""
    return _with_complements(_along(u, v, np.array([span[1] - 1e-3, span[1]])))


@lru_cache(maxsize=256)
def curve_parameters(span: tuple[float, float], segments: int) -> Array:
    """(u, 1-u, 0, 1) along a curve, whose net has order 1 in v."""
    u = _fractions(span, segments)
    return _with_complements(np.stack([u, np.zeros_like(u)], -1))


def _fractions(span: tuple[float, float], segments: int) -> Array:
    return np.linspace(*span, segments + 1)


def _along(u: Values, v: Values, t: Array) -> Array:
    """(u, v) of the points t of each curve, one curve after another."""
    curves = [np.stack([np.full_like(t, value), t], -1) for value in u]
    curves += [np.stack([t, np.full_like(t, value)], -1) for value in v]
    return np.concatenate(curves)


def _with_complements(uv: Array) -> Array:
    u, v = uv.T
    return np.stack([u, 1.0 - u, v, 1.0 - v], -1)
