"""Figure 4: the parameter square beside its image under r, and the morph from one to the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from ...geometry import planar_maps
from ...geometry.net import control_net
from ...geometry.planar_maps import DOMAIN, R
from .. import palette
from ..claims import Claim
from ..directions import directions
from ..handles import COEFFICIENTS, Coefficients, morph_handles
from ..layers import (
    Array,
    Color,
    ControlNet,
    Figure,
    IsoLines,
    Label,
    Layer,
    Patches,
    Space,
    including,
    plane,
)
from ..parameters import Range
from ..registry import scene


@scene(
    "The square and its image under r",
    figure=4,
    animates="morph",
    plates=((), ("morph=0.5",)),
)
def fig4(
    morph: Annotated[float, Range(0, 1, 0.1), "the image: 0 the aligned square, 1 r"] = 1.0,
    lines: Annotated[int, Range(1, 64), "pieces between the iso-lines of u and of v"] = 8,
    points: Coefficients = COEFFICIENTS,
) -> Figure:
    r = R if np.array_equal(points, COEFFICIENTS) else control_net(points)
    net = r if morph == 1.0 else planar_maps.morph(r, morph)
    domain = (
        *mapped(DOMAIN, palette.DOMAIN, lines),
        title("the domain, (u, v) in [0,1]²", 0.5, 1.08),
    )
    image = (
        *mapped(net, palette.IMAGE, lines),
        title("the image, (x, y) = r(u, v)" if morph == 1.0 else "on the way to r", 0.0, 1.72),
        ControlNet(net, palette.CONTROL_NET),
        *morph_handles("points", r, morph),
    )
    spaces = (
        Space("domain", plane(-0.14, -0.04, 1.04, 1.24), domain),
        Space("physical", including(plane(-1.7, -1.52, 1.52, 1.98), net), image),
    )
    caption = f"(1 − w) (V, −U) + w r(u, v),   w = {morph:.4g},   U = 2u − 1,  V = 2v − 1"
    return Figure(spaces, (caption,))


def mapped(net: Array, color: Color, lines: int) -> tuple[Layer, ...]:
    """The filled patch with its iso-lines, one colour where u runs, another where v runs."""
    steps = tuple(k / lines for k in range(lines + 1))
    return (
        Patches(net, color=color),
        IsoLines(net, v=steps, color=palette.ALONG_U, width=1.4),
        IsoLines(net, u=steps, color=palette.ALONG_V, width=1.4),
        *directions(net),
    )


def title(text: str, x: float, y: float) -> Label:
    return Label(text, (x, y, 0.0), offset=(0.0, 10.0), anchor=(0.5, 0.0), size=17.0)


@fig4.claims
def claims() -> Iterator[Claim]:
    weights = [0.0, 0.25, 0.5, 0.75, 0.9, 0.99]
    least = [
        float(planar_maps.determinant_coefficients(planar_maps.morph(R, w)).min()) for w in weights
    ]
    statement = (
        "least det on the way, at w = 0, 1/4, 1/2, 3/4, .9, .99: 4(1 - w²), so nothing folds"
    )
    yield Claim("Fig. 4", statement, [4.0 * (1.0 - w * w) for w in weights], least, 1e-12)
    statement = "least det once r is reached: 0, at the corners alone"
    last = float(planar_maps.determinant_coefficients(R).min())
    yield Claim("Fig. 4", statement, 0.0, last, 1e-12)
