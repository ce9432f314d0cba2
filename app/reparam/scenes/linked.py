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
from ..geometry.net import bounding_box, control_net, raise_degree
from ..geometry.planar_maps import DOMAIN
from . import palette
from .directions import directions
from .layers import Array, Color, Figure, IsoLines, Layer, Patches, Ramp, Space, Texture, plane

LINES = 8  # pieces between the iso-lines
FADED: Color = (0.78, 0.78, 0.78)  # what no point of the patch shows
OUTSIDE: Color = (0.87, 0.87, 0.87)  # of the parameters that a trim leaves
TITLES = {"domain": "domain (u, v)", "texture": "texture (s, t)"}
AROUND = 0.06  # of free space about a map's image


def can_link(figure: Figure) -> bool:
    """Whether the subject has patches."""
    return bool(_subject_patches(figure))


def linked(figure: Figure) -> Figure:
    """The figure's subject with its domain and texture beside it; itself if it has no patches.

    Layers of patches count as one, in their order; their texture is shown if all have one and it
    is a plane.
    """
    patches = _subject_patches(figure)
    if not patches:
        return figure
    subject = figure.spaces[-1]
    textures = [layer.texture for layer in patches if layer.texture is not None]
    textures = [t for t in textures if not (isinstance(t.picture, Ramp) and t.picture.scalar)]
    spaces = [domain_space(patches)]
    if len(textures) == len(patches):
        counts = [len(each.net) if each.net.ndim == 4 else 1 for each in patches]
        net = together([spread(t.net, n) for t, n in zip(textures, counts, strict=True)])
        plane_of_it = texture_space(Texture(net, textures[0].picture))
        spaces.append(replace(plane_of_it, domains=spaces[0].domains))
    title = "physical (x, y, z)" if subject.spatial else "physical (x, y)"
    whole = together([layer.net for layer in patches])
    shown = replace(subject, map=whole, domains=spaces[0].domains, width=1.0, height=1.0,
                    title=subject.title or title, below=False)  # fmt: skip
    return replace(figure, spaces=(*spaces, shown))


def _subject_patches(figure: Figure) -> list[Patches]:
    return [layer for layer in figure.spaces[-1].layers if isinstance(layer, Patches)]


def spread(net: Array, count: int) -> Array:
    """A net for each of so many patches: one net answers for all."""
    return net if net.ndim == 4 or count == 1 else np.broadcast_to(net, (count, *net.shape))


def together(nets: list[Array]) -> Array:
    """All patches of some layers as one array of nets, raised to a common degree."""
    if len(nets) == 1:
        return nets[0]
    degrees = [max(net.shape[axis] for net in nets) - 1 for axis in (-3, -2)]
    raised = [raise_degree(net, degrees[0], degrees[1]) for net in nets]
    return np.concatenate([net.reshape(-1, *net.shape[-3:]) for net in raised])


def domain_space(patches: list[Patches]) -> Space:
    """The square with its iso-lines, u down and v right as the note's r has them.

    One surface made of many patches is shown in its own parameters, trimmed if it is.
    """
    layers: tuple[Layer, ...]
    domains = patches[0].domains if len(patches) == 1 else None
    if domains is None:
        net = DOMAIN
        layers = (Patches(net, color=palette.DOMAIN), *iso_lines(net))
    else:
        net = placed(domains)
        trim = patches[0].trim
        layers = (
            Patches(DOMAIN, color=OUTSIDE),
            Patches(net, color=palette.DOMAIN, domains=domains, trim=trim),
            *iso_lines(net),
        )
    bounds = plane(-0.12, -0.04, 1.04, 1.12)
    shown = (*layers, *directions(DOMAIN))
    return Space("domain", bounds, shown, title=TITLES["domain"], map=net, domains=domains)


def placed(domains: Array) -> Array:
    """Nets (patches, 2, 2, 4) of the domains (patches, 4): u0, u1, v0, v1, in DOMAIN's square."""
    u0, u1, v0, v1 = domains.T
    (low_u, high_u), (low_v, high_v) = (u0.min(), u1.max()), (v0.min(), v1.max())
    u = (np.stack([u0, u1]) - low_u) / (high_u - low_u)
    v = (np.stack([v0, v1]) - low_v) / (high_v - low_v)
    corners = [[(v[j], 1.0 - u[i]) for j in range(2)] for i in range(2)]
    return control_net(np.moveaxis(np.array(corners), -1, 0))


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
    count = len(net) if net.ndim == 4 else 1
    width = min(1.2, 12.0 / count**0.5)  # many would be outlines alone
    outline = IsoLines(net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=width)
    if count > 1:
        return (outline,)
    steps = tuple(k / LINES for k in range(1, LINES))
    return (
        IsoLines(net, v=steps, color=palette.ALONG_U, width=0.7),
        IsoLines(net, u=steps, color=palette.ALONG_V, width=0.7),
        outline,
    )
