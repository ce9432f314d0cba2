"""Figure 6: three spaces. A picture is attached to a patch x by a texture map q of its domain.

Each point of the patch has the colour RGB(q(x^-1(point))) of the picture. The cursor marks one
point (u,v) in all three.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

import numpy as np

from ...geometry import planar_maps
from ...geometry.inverse import distances, invert
from ...geometry.net import control_net
from ...geometry.planar_maps import ALIGNED_IDENTITY, R
from ...geometry.stretch import stretch
from .. import palette
from ..attachments import Checks, Filter, Image, Wrap, attachment
from ..claims import Claim, Measure
from ..handles import COEFFICIENTS, Coefficients, morph_handles
from ..layers import (
    Array,
    ControlNet,
    Figure,
    IsoLines,
    Layer,
    Patches,
    Space,
    Texture,
    including,
    plane,
)
from ..linked import linked
from ..parameters import Range
from ..registry import scene
from .fig5 import is_ground, plain_axes

ATTACHED = {
    "identity": "q the identity: (s, t) = (V, −U)",
    "r": "q the patch itself: (s, t) = r(u, v)",
}


@scene(
    "Three spaces: domain, texture, patch",
    figure=6,
    animates="morph",
    plates=(("texture=identity",), ("texture=r",)),
)
def fig6(
    texture: Annotated[Literal["identity", "r"], "the texture map q"] = "identity",
    checks: Checks = 8,
    image: Image = "",
    wrap: Wrap = "mirror",
    filter: Filter = "smooth",
    morph: Annotated[float, Range(0, 1, 0.1), "the patch: 0 the square, 1 the image of r"] = 1.0,
    points: Coefficients = COEFFICIENTS,
) -> Figure:
    r = R if np.array_equal(points, COEFFICIENTS) else control_net(points)
    net = r if morph == 1.0 else planar_maps.morph(r, morph)
    texture_map = {"identity": ALIGNED_IDENTITY, "r": r}[texture]
    layers: tuple[Layer, ...] = (
        Patches(net, Texture(texture_map, attachment(checks, image, wrap, filter))),
        IsoLines(net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.2),
        ControlNet(net, palette.CONTROL_NET),
        *morph_handles("points", r, morph),
    )
    patch = Space("physical", including(plane(-1.6, -1.6, 1.6, 1.6), net), layers)
    caption = f"{ATTACHED[texture]}; x(u, v) has the colour of the picture at q(u, v)"
    return linked(Figure((patch,), (caption,)))


@fig6.claims
def claims() -> Iterator[Claim]:
    points = [(0.5, 0.5), (0.3, 0.2), (0.9, 0.1), (0.0, 0.5)]
    statement = "stretches from (s, t) to (x, y) at four points, q = r: nothing changes"
    yield Claim("Fig. 6", statement, [1.0] * 8, stretches(R, points), 1e-12)
    statement = "the same, q the identity: 3/2 at the centre, 3/2 and 1 in the middle of an edge"
    middle = stretches(ALIGNED_IDENTITY, [(0.5, 0.5), (0.0, 0.5)])
    yield Claim("Fig. 6", statement, [1.5, 1.5, 1.5, 1.0], middle, 1e-12)
    statement = (
        "share of the pixels (x, y) = x(u, v) in the picture's colour at q(u, v), q the identity"
    )
    yield Claim("Fig. 6", statement, 1.0, inverted_share, 0)


def stretches(texture_map: Array, points: Sequence[tuple[float, float]]) -> list[float]:
    """From (s, t) to (x, y) under r: the largest and the smallest, point after point."""
    ways = [stretch(R, u, v).after(stretch(texture_map, u, v)) for u, v in points]
    return [factor for way in ways if way is not None for factor in way.factors]


def inverted_share(measure: Measure) -> float:
    """By point inversion at every fifth pixel, but for those at the rim and on checker lines."""
    exact = {"checks": 8, "filter": "nearest", "samples": 1, "level": 128}
    picture = measure.picture("fig6", (240, 240), texture="identity", **exact)[2::5, 2::5]
    x, y = np.meshgrid(plain_axes(240)[2::5], -plain_axes(240)[2::5])
    points = np.stack([x, y], -1)
    u, v = np.moveaxis(invert(R, points), -1, 0)
    inside = distances(R, points, np.stack([u, v], -1)) < 1e-9
    cells = np.stack([8.0 * v, 8.0 * (1.0 - u)])
    seen = inside & ~is_ground(picture) & (np.abs(cells - np.round(cells)) > 0.02).all(0)
    bright = np.floor(cells).sum(0) % 2 == 1
    return float(np.mean(bright[seen] == (picture[..., 0] > 127)[seen]))
