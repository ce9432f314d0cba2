"""Trim loops for tests: circles, stars, cusps, slivers, the Red Book's, and random ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from reparam.geometry.net import Array
from reparam.geometry.trimming import TrimRegion, trim_region

Loop = list[Array]

HALF = np.sqrt(0.5)
NINE = np.array(
    [
        (1, 0, 1), (HALF, HALF, HALF), (0, 1, 1), (-HALF, HALF, HALF), (-1, 0, 1),
        (-HALF, -HALF, HALF), (0, -1, 1), (HALF, -HALF, HALF), (1, 0, 1),
    ]
)  # fmt: skip
SQUARE: Loop = [np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)])]


def bezier(*points: Sequence[float]) -> Array:
    """A polynomial Bezier curve as a piece (k, 3)."""
    return np.column_stack([np.array(points, float), np.ones(len(points))])


def reverse(loop: Loop) -> Loop:
    return [piece[::-1] for piece in loop[::-1]]


def circle(center: Sequence[float] = (0.5, 0.5), radius: float = 0.3) -> Loop:
    """Four rational quadratic arcs, counter-clockwise."""
    points = NINE.copy()
    points[:, :2] = points[:, :2] * radius + np.array(center) * points[:, 2:]
    return [points[i : i + 3] for i in (0, 2, 4, 6)]


def star(center: Sequence[float], radius: float, tips: int = 5, inner: float = 0.45) -> Loop:
    """A closed polyline, counter-clockwise."""
    angle = np.pi / tips * np.arange(2 * tips + 1) + 0.3
    length = radius * np.where(np.arange(2 * tips + 1) % 2 == 0, 1.0, inner)
    points = np.array(center) + length[:, None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    points[-1] = points[0]
    return [points]


def petals(count: int, bend: float, shift: float = 0.0) -> list[Loop]:
    """Narrow loops from one point, sides bent; the last one begins so much too early."""
    angle = 2.0 * np.pi / count * (np.arange(count)[:, None] + [0.1, 0.9])
    angle[-1, 0] -= 2.0 * np.pi / count * shift
    tips = 0.5 + 0.4 * np.stack([np.cos(angle), np.sin(angle)], -1)
    middle = np.array([0.5, 0.5])
    loops = []
    for a, b in tips:
        across = bend * np.array([-(b - a)[1], (b - a)[0]])
        one, other = (middle + a) / 2.0 + across, (middle + b) / 2.0 + across
        loops.append([bezier(middle, one, a), np.array([a, b]), bezier(b, other, middle)])
    return loops


def red_book() -> list[Loop]:
    """The loops of the OpenGL Programming Guide's trim.c."""
    curve = bezier((0.25, 0.5), (0.25, 0.75), (0.75, 0.75), (0.75, 0.5))
    line = np.array([(0.75, 0.5), (0.5, 0.25), (0.25, 0.5)])
    return [SQUARE, [curve, line]]


def cusps() -> list[Loop]:
    """A square with a hole of two cubics, each with a cusp in the middle of its parameter."""
    upper = bezier((0.8, 0.5), (0.2, 0.9), (0.8, 0.9), (0.2, 0.5))
    lower = bezier((0.2, 0.5), (0.8, 0.1), (0.2, 0.1), (0.8, 0.5))
    return [SQUARE, reverse([upper, lower])]


def crescent(x: float, width: float) -> Loop:
    """Between two parabolas, so wide in its middle, and 0.8 high."""
    right = bezier((x, 0.1), (x + 0.2 + 2.0 * width, 0.5), (x, 0.9))
    left = bezier((x, 0.9), (x + 0.2, 0.5), (x, 0.1))
    return [right, left]


def slivers() -> list[Loop]:
    """Three crescents and a ring, cut out: 1e-2 down to 1e-4 wide."""
    holes = [crescent(0.15 + 0.2 * k, 10.0 ** -(2 + k)) for k in range(3)]
    return [
        SQUARE,
        *map(reverse, holes),
        reverse(circle((0.88, 0.5), 0.1)),
        circle((0.88, 0.5), 0.0999),
    ]


def blob(random: np.random.Generator, center: Sequence[float], radius: float) -> Loop:
    """A star-shaped loop, counter-clockwise: arcs, cubics, quintics of any weights, polylines."""
    count = int(random.integers(5, 9))
    angle = np.sort(np.arange(count) + random.uniform(-0.3, 0.3, count)) * 2.0 * np.pi / count
    angle = np.append(angle, angle[0] + 2.0 * np.pi)
    length = radius * random.uniform(0.45, 1.0, count)
    length = np.append(length, length[0])
    pieces = []
    for i in range(count):
        inner = int(random.integers(0, 5))
        a = np.linspace(angle[i], angle[i + 1], inner + 2)
        r = np.concatenate([[length[i]], radius * random.uniform(0.4, 1.0, inner), [length[i + 1]]])
        points = np.array(center) + r[:, None] * np.stack([np.cos(a), np.sin(a)], -1)
        if i == count - 1:
            points[-1] = pieces[0][0, :2] / (pieces[0][0, 2] if pieces[0].shape[1] == 3 else 1.0)
        if random.random() < 0.25:
            pieces.append(points)
        else:
            weights = 10.0 ** random.uniform(-0.5, 0.5, len(points))
            pieces.append(np.column_stack([points * weights[:, None], weights]))
    return pieces


def discs(side: int) -> list[Loop]:
    """side * side round holes in even rows."""
    middles = (np.stack(np.divmod(np.arange(side**2), side), -1) + 0.5) / side
    return [reverse(circle(middle, 0.4 / side)) for middle in middles]


def random_loops(random: np.random.Generator, side: int) -> list[Loop]:
    """A square with side * side holes, islands in some of them; a few reach over the border."""
    loops = [[SQUARE[0] * 2.0 - 0.5]]
    for i in range(side):
        for j in range(side):
            radius = 0.48 / side
            center = (np.array([i, j]) + 0.5) / side
            if side > 1 and i == 0:
                center[0] = 0.0
            loops.append(reverse(blob(random, center, radius)))
            if random.random() < 0.5:
                loops.append(blob(random, center, 0.2 * radius))
    return loops


CASES: dict[str, Callable[[], list[Loop]]] = {
    "red book": red_book,
    "cusps": cusps,
    "slivers": slivers,
    "blobs": lambda: random_loops(np.random.default_rng(1), 4),
    "more blobs": lambda: random_loops(np.random.default_rng(2), 3),
    "sixty-four": lambda: discs(8),
    "over the border": lambda: [circle((1.0, 1.0)), circle((0.0, 0.3), 0.2), star((0.5, 0.4), 0.2)],
    "no loops": list,
}
"""By name, loops that `trim_region` takes."""


@cache
def region_of(name: str) -> TrimRegion:
    """The region of a case, made once."""
    return trim_region(CASES[name]())
