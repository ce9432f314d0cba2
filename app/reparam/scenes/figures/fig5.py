"""Figure 5: one patch, one checkerboard, two texture maps.

Attached by the identity (s,t) = (V,-U) the squares are squeezed with the parameter; attached by
r itself, (s,t) = r(u,v), the change of variables cancels and the squares stay square.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import log, sqrt
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray

from ...geometry import camera, planar_maps
from ...geometry.evaluate import jacobian_determinant
from ...geometry.net import control_net
from ...geometry.planar_maps import ALIGNED_IDENTITY, R
from ...geometry.regions import count_regions
from .. import palette
from ..attachments import Checks, Filter, Image, Wrap, attachment
from ..claims import Claim, Measure
from ..directions import directions
from ..handles import COEFFICIENTS, Coefficients, morph_handles
from ..layers import ControlNet, Figure, IsoLines, Patches, Space, Texture, including, plane
from ..parameters import Range
from ..registry import scene

ATTACHED = {
    "identity": "attached by the identity, (s, t) = (V, −U)",
    "r": "attached by r itself, (s, t) = r(u, v)",
}
CHECKS_ON_R = {"identity": "the squares are squeezed", "r": "the squares stay square"}
IMAGE_ON_R = {"identity": "the picture is squeezed", "r": "the picture stays as it was"}
FORMULA = "r(u, v) = ( V(3 − U²)/2, −U(3 − V²)/2 )    U = 2u − 1,  V = 2v − 1"
EDITED = "r(u, v), bi-quadratic, with its control points moved"


@scene(
    "One patch, one checkerboard, two texture maps",
    figure=5,
    animates="morph",
    plates=(("texture=identity",), ("texture=r",), ("compare=texture=identity|r",)),
)
def fig5(
    texture: Annotated[Literal["identity", "r"], "the map that attaches the picture"] = "identity",
    checks: Checks = 8,
    image: Image = "",
    wrap: Wrap = "mirror",
    filter: Filter = "smooth",
    morph: Annotated[float, Range(0, 1, 0.1), "the patch: 0 the square, 1 the image of r"] = 1.0,
    points: Coefficients = COEFFICIENTS,
) -> Figure:
    edited = not np.array_equal(points, COEFFICIENTS)
    r = control_net(points) if edited else R
    net = r if morph == 1.0 else planar_maps.morph(r, morph)
    maps = {"identity": ALIGNED_IDENTITY, "r": r}
    layers = (
        Patches(net, Texture(maps[texture], attachment(checks, image, wrap, filter))),
        IsoLines(net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.6),
        *directions(net),
        ControlNet(net, palette.CONTROL_NET),
        *morph_handles("points", r, morph),
    )
    space = Space("physical", including(plane(-1.65, -1.5, 1.5, 1.65), net), layers)
    if morph == 1.0 and texture == "identity" and edited:
        caption = (ATTACHED[texture], EDITED)
    elif morph == 1.0:
        seen = (IMAGE_ON_R if image else CHECKS_ON_R)[texture]
        caption = (f"{ATTACHED[texture]}: {seen}", EDITED if edited else FORMULA)
    else:
        shape = f"drawn on (1 − w) (V, −U) + w r(u, v),   w = {morph:.4g}"
        caption = (ATTACHED[texture], shape)
    return Figure((space,), caption)


@fig5.claims
def claims() -> Iterator[Claim]:
    yield Claim("(13)", "area of the image of r", 20 / 3, planar_maps.area(R), 1e-12)
    boundary = 4 * sqrt(2) + 4 * log(1 + sqrt(2))
    yield Claim("(13)", "perimeter of the image of r", boundary, planar_maps.perimeter(R), 1e-12)
    u, v = np.array([0.5, 0.0, 0.0, 1.0, 1.0]), np.array([0.5, 0.0, 1.0, 0.0, 1.0])
    values = jacobian_determinant(R, u, v).tolist()
    statement = "det d(x,y)/d(u,v) at the centre and at the four corners"
    yield Claim("(13)", statement, [9.0, 0.0, 0.0, 0.0, 0.0], values, 1e-12)
    coefficients = planar_maps.determinant_coefficients(R)
    statement = "Bernstein coefficients of det that are not positive: the four corners"
    yield Claim("(13)", statement, 4, int(np.count_nonzero(coefficients < 1e-9)), 0)
    yield Claim("Fig. 5a", "regions under the identity, 8 x 8 checks", 64, identity_regions, 0)
    statement = "share of the pixels, at 2 x 2 steps, that equal checker(x, y) under r"
    yield Claim("Fig. 5b", statement, 1.0, square_share, 0)
    yield Claim("Fig. 5", "area covered at 32 x 32 steps", 20 / 3 - 8 / 3 / 32**2, covered, 5e-3)


def plain_axes(size: int) -> NDArray[np.float64]:
    """x of the pixel centres, left to right, in a plain square picture of r (y is its reverse)."""
    return ((np.arange(size) + 0.5) / size - 0.5) * 3.0 * camera.MARGIN


def is_ground(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which pixels show the ground of a plain picture."""
    ground = np.round(255 * np.array(palette.PLAIN_GROUND))
    return np.asarray((picture == ground).all(-1))


def exact_picture(measure: Measure, size: int, texture: str, level: int) -> NDArray[np.uint8]:
    exact = {"checks": 8, "filter": "nearest", "samples": 1}
    return measure.picture("fig5", (size, size), texture=texture, level=level, **exact)


def identity_regions(measure: Measure) -> int:
    picture = exact_picture(measure, 512, "identity", 32)
    inside, bright = ~is_ground(picture), picture[..., 0] > 127
    cell = inside.sum() / 64
    return count_regions(inside & bright, 0.05 * cell) + count_regions(
        inside & ~bright, 0.05 * cell
    )


def square_share(measure: Measure) -> float:
    size = 512
    picture = exact_picture(measure, size, "r", 2)
    x, y = np.meshgrid(plain_axes(size), -plain_axes(size))
    cells_x, cells_y = (x + 1.0) * 4.0, (y + 1.0) * 4.0
    clear = np.abs(cells_x - np.round(cells_x)) > 4e-3
    clear &= np.abs(cells_y - np.round(cells_y)) > 4e-3
    seen = clear & ~is_ground(picture)
    bright = (np.floor(cells_x) + np.floor(cells_y)) % 2 == 1
    return float(np.mean(bright[seen] == (picture[..., 0] > 127)[seen]))


def covered(measure: Measure) -> float:
    size = 512
    picture = exact_picture(measure, size, "r", 32)
    return float((~is_ground(picture)).sum() * (3.0 * camera.MARGIN / size) ** 2)
