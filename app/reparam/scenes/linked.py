"""The linked view: a patch's domain, its texture if it has one, and the patch, side by side.

      domain (u,v)  --- q --->  texture (s,t)
            |                        :
            x                        : picture
            v                        v
      physical (x,y), each point in the colour that the picture has at q(x^-1(point))

(Figure 6 of the note.) Made from any figure whose subject has patches; every space says by its
map where the square lands, so that a cursor in one is seen in all (cursor.py).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..geometry.evaluate import sample_surface
from ..geometry.net import bounding_box, control_net
from ..geometry.planar_maps import DOMAIN
from . import palette
from .directions import directions
from .layers import Array, Color, Figure, IsoLines, Layer, Patches, Space, Texture, plane

LINES = 8  # pieces between the iso-lines
FADED: Color = (0.78, 0.78, 0.78)  # what no point of the patch shows
TITLES = {"domain": "domain (u, v)", "texture": "texture (s, t)"}
AROUND = 0.06  # of free space about a map's image


def can_link(figure: Figure) -> bool:
    """Whether the subject has patches."""
    return _subject_patches(figure) is not None


def linked(figure: Figure) -> Figure:
    """The figure with its subject's domain and texture beside it; itself if it has no patches."""
    patches = _subject_patches(figure)
    if patches is None:
        return figure
    subject = figure.spaces[-1]
    spaces = [domain_space()]
    if patches.texture is not None:
        spaces.append(texture_space(patches.texture))
    others = [s for s in figure.spaces[:-1] if s.name not in ("physical", *TITLES)]
    title = "physical (x, y, z)" if subject.spatial else "physical (x, y)"
    shown = replace(subject, map=patches.net, title=subject.title or title)
    return replace(figure, spaces=(*others, *spaces, shown))


def _subject_patches(figure: Figure) -> Patches | None:
    return next((layer for layer in figure.spaces[-1].layers if isinstance(layer, Patches)), None)


def domain_space() -> Space:
    """The square with its iso-lines, u down and v right as the note's r has them."""
    layers = (Patches(DOMAIN, color=palette.DOMAIN), *iso_lines(DOMAIN), *directions(DOMAIN))
    bounds = plane(-0.12, -0.04, 1.04, 1.12)
    return Space("domain", bounds, layers, title=TITLES["domain"], map=DOMAIN)


def texture_space(texture: Texture) -> Space:
    """The picture, bright where the image of the square covers it."""
    net = in_plane(texture.net)
    low, high = bounding_box(
        np.concatenate([sample_surface(net), [[-1.0, -1.0, 0], [1.0, 1.0, 0]]])
    )
    gap = AROUND * (high - low).max()
    (s0, t0, _), (s1, t1, _) = low - gap, high + gap
    sheet = control_net([[(s0, t1), (s1, t1)], [(s0, t0), (s1, t0)]])
    layers: tuple[Layer, ...] = (
        Patches(sheet, Texture(sheet, texture.picture), color=FADED),
        Patches(net, Texture(net, texture.picture)),
        *iso_lines(net),
    )
    return Space("texture", plane(s0, t0, s1, t1), layers, title=TITLES["texture"], map=net)


def in_plane(net: Array) -> Array:
    """A texture map by its (s,t) alone: the net itself if that is all it has."""
    if not np.any(net[..., 2]):
        return net
    flat = net.copy()
    flat[..., 2] = 0.0
    return flat


def iso_lines(net: Array) -> tuple[Layer, ...]:
    """The outline, and thin lines within a single patch: those of many would lie in a heap."""
    outline = IsoLines(net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.2)
    if net.ndim == 4 and len(net) > 1:
        return (outline,)
    steps = tuple(k / LINES for k in range(1, LINES))
    return (
        IsoLines(net, v=steps, color=palette.ALONG_U, width=0.7),
        IsoLines(net, u=steps, color=palette.ALONG_V, width=0.7),
        outline,
    )
