"""Figure 8: a body with three handles, smooth everywhere, from a mesh of squares."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, radians, sin
from typing import Annotated

import numpy as np

from ...geometry.mesh import Mesh
from ...geometry.meshes import MESHES
from ...geometry.patch_joins import joins
from ...geometry.surface_spline import surface_spline
from ..attachments import Checks, attachment
from ..claims import Claim
from ..layers import Array, Figure, Space
from ..merged import Merged, merging_of
from ..parameters import Range
from ..registry import scene
from ..remember import remember
from ..spline_nets import nets_of, ratios_of, spline_of
from ..splines import (
    NO_CREASES,
    NONE_MOVED,
    Creases,
    Map,
    Moved,
    Ratio,
    built_in,
    count_words,
    distortion_words,
    edge_handles,
    moved_mesh,
    patch_layers,
    vertex_handles,
)


@scene(
    "Three handles, one smooth surface",
    figure=8,
    animates="turn",
    plates=(
        ("level=8", "shading=kind"),
        ("level=8", "shading=zebra"),
        ("tolerance=0.5", "shading=level"),
        ("level=2", "shading=error"),
    ),
)
def fig8(
    ratio: Ratio = 0.5,
    texture: Map = "layout",
    checks: Checks = 4,
    creases: Creases = NO_CREASES,
    moved: Moved = NONE_MOVED,
    merged: Merged = False,
    turn: Annotated[float, Range(0, 360, 15), "degrees about the z-axis"] = 0.0,
) -> Figure:
    control = turned(moved_mesh(built_in("three_handles"), moved), turn)
    ratios = ratios_of(control.topology, ratio, creases)
    spline = spline_of(control.topology, ratios)
    picture = attachment(checks, "", "repeat", "smooth")
    untouched = not len(moved)  # by a hand a body may be pulled through itself
    surface = patch_layers(spline, control.vertices, texture, picture, 0.4, merged, untouched)
    handles = (edge_handles(control, ratios), vertex_handles(control)) if turn == 0.0 else ()
    bounds = room_to_turn(nets_of(spline, control.vertices))
    body = Space("body", bounds, (*surface, *handles), True)
    caption = (
        f"{count_words(spline, merged)}; blend ratio {ratio:.2g}",
        distortion_words(spline, control.vertices, texture),
    )
    return Figure((body,), caption)


def turned(control: Mesh, degrees: float) -> Mesh:
    """The mesh turned about the z-axis; the mesh itself for 0."""
    if degrees == 0.0:
        return control
    c, s = cos(radians(degrees)), sin(radians(degrees))
    turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return Mesh(control.vertices @ turn, control.topology)


@remember
def room_to_turn(nets: Array) -> Array:
    """Points (k, 3) around all that a surface sweeps when it turns about the z-axis."""
    points = nets[..., :3].reshape(-1, 3)
    radius = np.hypot(points[:, 0], points[:, 1]).max()
    angle = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
    rim = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle], -1)
    heights = points[:, 2].min(), points[:, 2].max()
    return np.concatenate([rim + np.array([0.0, 0.0, z]) for z in heights])


@fig8.claims
def claims() -> Iterator[Claim]:
    found = MESHES["three_handles"]()
    t = found.topology
    statement = "vertices - edges + faces of the mesh: 2 - 2 x 3 handles"
    yield Claim("Fig. 8", statement, -4, t.euler_characteristic(), 0)
    for ratio in (0.1, 0.5, 0.9):
        report = joins(surface_spline(t, ratio).nets(found.vertices), highest=1)
        statement = f"ratio {ratio:g}, all 2176 edges: largest normal jump in degrees, largest gap"
        measured = [float(report.angles.max()), float(report.gaps.max())]
        yield Claim("Fig. 8", statement, [0.0, 0.0], measured, 1e-8)
    statement = "patches: 8 for each edge of the mesh; edges without a neighbour"
    counted = [len(surface_spline(t).facet), len(report.free)]
    yield Claim("Fig. 8", statement, [8 * 136, 0], counted, 0)
    statement = "patches if those that are one are one"
    yield Claim("Fig. 8", statement, 704, len(merging_of(surface_spline(t))), 0)
