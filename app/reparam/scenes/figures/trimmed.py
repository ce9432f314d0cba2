"""A surface and what trim loops leave of it: NURBS arcs and polylines, holes and an island."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Annotated, Literal

import numpy as np

from ...geometry import camera
from ...geometry.net import control_net
from ...geometry.trimming import TrimRegion, trim_region
from .. import palette
from ..attachments import Checks, attachment
from ..claims import Claim, Measure
from ..directions import directions
from ..drawing import in_space, words
from ..layers import Array, Curves, Figure, Layer, Patches, Polylines, Space, Texture, plane
from ..parameters import Range
from ..registry import scene
from .fig5 import is_ground

Loop = Sequence[Array]

HALF = np.sqrt(0.5)
ARCS = np.array(
    [
        [(1, 0, 1), (HALF, HALF, HALF), (0, 1, 1)],
        [(0, 1, 1), (-HALF, HALF, HALF), (-1, 0, 1)],
        [(-1, 0, 1), (-HALF, -HALF, HALF), (0, -1, 1)],
        [(0, -1, 1), (HALF, -HALF, HALF), (1, 0, 1)],
    ]
)
"""The unit circle, counter-clockwise: homogeneous (w u, w v, w)."""

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)])
DOMAIN = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
IDENTITY = control_net([[(-1, -1), (-1, 1)], [(1, -1), (1, 1)]])
HOLE, STAR = (0.36, 0.58), (0.76, 0.24)
STAR_RADII = (0.17, 0.075)
RED_BOOK = (
    [SQUARE],
    [
        np.array([(0.25, 0.5, 1), (0.25, 0.75, 1), (0.75, 0.75, 1), (0.75, 0.5, 1)]),
        np.array([(0.75, 0.5), (0.5, 0.25), (0.25, 0.5)]),
    ],
)
"""The loops of trim.c in the OpenGL Programming Guide."""


@scene(
    "A trimmed surface, and its loops in the domain",
    animates="hole",
    plates=((), ("loops=redbook",)),
)
def trimmed(
    loops: Annotated[
        Literal["island", "redbook"], "an island in a round hole and a star, or the Red Book's"
    ] = "island",
    hole: Annotated[float, Range(0.05, 0.32, 0.01), "radius of the round hole"] = 0.28,
    lift: Annotated[float, Range(0, 1, 0.1), "the surface: 0 the square itself, 1 a hill"] = 1.0,
    checks: Checks = 8,
) -> Figure:
    region = region_of(loops, hole)
    net = hill(lift)
    domain = (
        Patches(DOMAIN, color=palette.DOMAIN, trim=region),
        *(layer for loop in region.loops for layer in drawn_loop(loop)),
        *directions(DOMAIN),
        words("the domain", (0.5, 1.06), anchor=(0.5, 0.0), size=17.0),
    )
    surface = (
        Patches(net, Texture(IDENTITY, attachment(checks, "", "mirror", "smooth")),
                lit=lift > 0.0, trim=region),
    )  # fmt: skip
    points = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.28 * lift]])
    caption = (
        "what lies to the left of a loop stays: inside blue ones, outside red ones",
        f"area of what stays of the domain: {region.area():.6f}",
    )
    return Figure(
        (
            Space("domain", plane(-0.14, -0.12, 1.06, 1.16), domain),
            Space("physical", points, surface, spatial=lift > 0.0),
        ),
        caption,
    )


@cache
def region_of(loops: str, hole: float) -> TrimRegion:
    """The same object for the same loops, so that the GPU keeps it."""
    if loops == "redbook":
        return trim_region(RED_BOOK)
    round_hole = circle(HOLE, hole)[::-1, ::-1]
    island = circle(HOLE, 0.45 * hole)
    return trim_region([[SQUARE], list(round_hole), list(island), [star()[::-1]]])


def circle(center: tuple[float, float], radius: float) -> Array:
    """Four rational arcs (4, 3, 3), counter-clockwise."""
    arcs: Array = ARCS.copy()
    arcs[..., :2] = radius * ARCS[..., :2] + np.array(center) * ARCS[..., 2:]
    return np.asarray(arcs)


def star() -> Array:
    """A closed polyline (11, 2), counter-clockwise."""
    angle = np.pi * (np.arange(11) / 5.0 + 0.5)
    radius = np.resize(STAR_RADII, 11)
    points: Array = np.array(STAR) + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    points[-1] = points[0]
    return points


def hill(lift: float) -> Array:
    """A bicubic patch over the unit square, x = u and y = v, its inner points lifted."""
    t = np.arange(4) / 3.0
    x, y = np.meshgrid(t, t, indexing="ij")
    z = np.zeros((4, 4))
    z[1:3, 1:3] = 0.5 * lift
    return control_net(np.stack([x, y, z], -1))


def drawn_loop(loop: Loop) -> Iterator[Layer]:
    """Its pieces with an arrow at the end of each, in the colour of its orientation."""
    first = np.concatenate([corners(piece) for piece in loop])
    u, v = first.T - first[:1].T
    inwards = float((u * np.roll(v, -1) - v * np.roll(u, -1)).sum())
    color = palette.STAYS if inwards > 0.0 else palette.GOES
    for piece in loop:
        if piece.shape[1] == 2:
            yield Polylines(in_space(piece), color, 2.2, arrow=True)
        else:
            yield Curves(np.insert(piece, 2, 0.0, axis=1), color, 2.2, arrow=True)


def corners(piece: Array) -> Array:
    """Its points, or the control points of a curve, without the last: (k, 2)."""
    return np.asarray(piece[:-1, :2] / piece[:-1, 2:] if piece.shape[1] == 3 else piece[:-1])


@trimmed.claims
def claims() -> Iterator[Claim]:
    radius = 0.28
    pentagram = 5.0 * STAR_RADII[0] * STAR_RADII[1] * np.sin(np.pi / 5.0)
    expected = 1.0 - np.pi * radius**2 * (1.0 - 0.45**2) - float(pentagram)
    area = region_of("island", radius).area()
    yield Claim("trimming", "area that stays, by Green's theorem", expected, area, 1e-13)
    statement = "the same, by the pixels that are drawn of 512 x 512"
    yield Claim("trimming", statement, expected, drawn_area, 1e-3)
    statement = "share of the pixel centres that are on the right side of every loop"
    yield Claim("trimming", statement, 1.0, right_share, 0.0)


def flat_picture(measure: Measure) -> Array:
    """Whether the pixels of the flat surface are drawn, and their (u, v): (512, 512, 3)."""
    size = 512
    picture = measure.picture("trimmed", (size, size), lift=0.0, samples=1)
    t = 0.5 + camera.MARGIN * ((np.arange(size) + 0.5) / size - 0.5)
    u, v = np.meshgrid(t, t[::-1])
    return np.stack([~is_ground(picture), u, v], -1)


def drawn_area(measure: Measure) -> float:
    picture = flat_picture(measure)
    return float(picture[..., 0].mean() * camera.MARGIN**2)


def right_share(measure: Measure) -> float:
    drawn, u, v = np.moveaxis(flat_picture(measure), -1, 0)
    within = (np.abs(u - 0.5) < 0.5 - 1e-6) & (np.abs(v - 0.5) < 0.5 - 1e-6)
    region = region_of("island", 0.28)
    wrong = within & (region.inside(u, v) != (drawn > 0.5))
    pixel = camera.MARGIN / 512
    far = np.abs(region.signed_distance(u[wrong], v[wrong])) > 1e-3 * pixel
    return float(1.0 - far.sum() / within.sum())
