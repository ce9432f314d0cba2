"""The user's own surface, from a file."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np

from ...geometry.body import Body
from ...geometry.evaluate import sample_surface
from .. import palette
from ..attachments import Checks, Filter, Image, Wrap, attachment
from ..layers import Array, ControlNet, Figure, IsoLines, Patches, Space, Texture
from ..registry import scene


@scene("a surface from a file", opens_files=True)
def surface(
    body: Body,
    texture: Annotated[
        Literal["identity", "r"], "each patch's (s, t) = (2v−1, 1−2u), or r: its own (x, y)"
    ] = "identity",
    checks: Checks = 8,
    image: Image = "",
    wrap: Wrap = "mirror",
    filter: Filter = "smooth",
) -> Figure:
    points = sample_surface(body.nets)
    spatial = bool(np.any(body.nets[..., 2] != 0.0))
    texture_net = body.nets if texture == "r" else identity(body)
    outline = min(1.2, 30.0 / len(body.nets) ** 0.5)  # many patches would be outlines alone
    layers = (
        Patches(
            body.nets, Texture(texture_net, attachment(checks, image, wrap, filter)), lit=spatial
        ),
        IsoLines(body.nets, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=outline),
        ControlNet(body.nets, palette.CONTROL_NET),
    )
    caption = {
        "identity": "attached by the identity of each patch, (s, t) = (2v − 1, 1 − 2u)",
        "r": "attached by the surface itself, (s, t) = (x, y)",
    }
    return Figure((Space("physical", points, layers, spatial),), (caption[texture],))


def identity(body: Body) -> Array:
    """(s,t) = (2v-1, 1-2u) as bilinear nets (patches, 2, 2, 4), from each patch's own (u,v)."""
    u, v = body.domains[..., 0], body.domains[..., 1]
    return np.stack([2.0 * v - 1.0, 1.0 - 2.0 * u, np.zeros_like(u), np.ones_like(u)], -1)
