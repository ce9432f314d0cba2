"""The user's own surface, from a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np

from ...geometry.body import Body, with_points
from ...geometry.evaluate import sample_surface
from ...geometry.mesh import Mesh
from ...geometry.surface_spline import SurfaceSpline
from .. import palette
from ..attachments import Checks, Filter, Image, Wrap, attachment
from ..layers import (
    Array,
    ControlNet,
    Figure,
    Handles,
    IsoLines,
    Layer,
    Patches,
    Picture,
    Space,
    Texture,
)
from ..merged import Merged
from ..mesh_files import mesh_of
from ..parameters import Points
from ..registry import scene
from ..remember import remember
from ..spline_nets import ratios_of, spline_of
from ..splines import (
    NO_CREASES,
    NONE_MOVED,
    Creases,
    Ratio,
    count_words,
    distortion_words,
    edge_handles,
    edges_of,
    moved_mesh,
    patch_layers,
    vertex_handles,
)

NONE = np.zeros((0, 6))
Smooth = Annotated[
    Literal["off", "on", "layout"],
    "a polyhedron as it is, or as the control mesh of a smooth surface; layout: textured by the "
    "mesh laid flat",
]
Vertices = Annotated[Array, Points((None, 4), "vertices moved, if smooth: vertex, x, y, z")]
Moved = Annotated[Array, Points((None, 6), "control points moved: patch, row, column, x, y, z")]

MOST_OUTLINED = 4096


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
    moved: Moved = NONE,
    smooth: Smooth = "off",
    ratio: Ratio = 0.5,
    creases: Creases = NO_CREASES,
    vertices: Vertices = NONE_MOVED,
    merged: Merged = False,
) -> Figure:
    """From .bv files as they are; polyhedra may be the control mesh of a surface spline."""
    picture = attachment(checks, image, wrap, filter)
    if smooth != "off":
        control = moved_mesh(mesh_of(body, "smooth"), vertices, "vertices")
        spline = spline_of(control.topology, ratios_of(control.topology, ratio, creases))
        chosen = "layout" if smooth == "layout" else texture
        figure = smoothed(control, spline, chosen, picture, merged)
        caption = f"{count_words(spline, merged)}; blend ratio {ratio:.2g}"
        return replace(figure, caption=(caption, *figure.caption))
    nets = edited(body, moved)
    points = sampled(nets)
    spatial = bool(np.any(nets[..., 2] != 0.0))
    texture_net = nets if texture == "r" else identity(body)
    layers: tuple[Layer, ...] = (
        Patches(nets, Texture(texture_net, picture), lit=spatial),
        *outlines(nets),
        ControlNet(nets, palette.CONTROL_NET),
        handles(nets),
    )
    attached = {
        "identity": "attached by the identity of each patch, (s, t) = (2v − 1, 1 − 2u)",
        "r": "attached by the surface itself, (s, t) = (x, y)",
    }
    return Figure((Space("physical", points, layers, spatial),), (attached[texture],))


def outlines(nets: Array) -> tuple[IsoLines, ...]:
    """The patches' edges, thinner the more there are; very many would be a grey haze alone."""
    if len(nets) > MOST_OUTLINED:
        return ()
    width = min(1.2, 30.0 / len(nets) ** 0.5)
    return (IsoLines(nets, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=width),)


def smoothed(
    control: Mesh,
    spline: SurfaceSpline,
    texture: str,
    picture: Picture,
    merged: bool,
) -> Figure:
    """The surface spline over the file's polyhedron, with its mesh around it."""
    layers = (
        *patch_layers(spline, control.vertices, texture, picture, merged=merged),
        edges_of(control, width=0.4),
        edge_handles(control, spline.ratios),
        vertex_handles(control, "vertices"),
    )
    caption = distortion_words(spline, control.vertices, texture)
    return Figure((Space("physical", control.vertices, layers, True),), (caption,))


@remember
def edited(body: Body, moved: Array) -> Array:
    """The body's nets with points moved; the body's own array where none is."""
    return with_points(body.nets, moved) if len(moved) else body.nets


sampled = remember(sample_surface)


@remember
def handles(nets: Array) -> Handles:
    """A handle at each control point that has a weight; points at one place go together."""
    flat = nets.reshape(-1, 4)
    (indices,) = np.nonzero(flat[:, 3] > 0.0)
    at = flat[indices, :3] / flat[indices, 3:]

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        together = indices[(at == at[index]).all(-1)]
        places = np.stack(np.unravel_index(together, nets.shape[:-1]), -1)
        rows = {tuple(row[:3]): row for row in values["moved"]}
        rows |= {tuple(place): np.array([*place, *point]) for place in places.astype(float)}
        return {"moved": np.array([*rows.values()])}

    return Handles(at, drag, radius=min(4.0, 32.0 / len(at) ** 0.5), quiet=True)


@remember
def identity(body: Body) -> Array:
    """(s,t) = (2v-1, 1-2u) as bilinear nets (patches, 2, 2, 4), from each patch's own (u,v)."""
    u, v = body.domains[..., 0], body.domains[..., 1]
    return np.stack([2.0 * v - 1.0, 1.0 - 2.0 * u, np.zeros_like(u), np.ones_like(u)], -1)
