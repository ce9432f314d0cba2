"""surface of the OpenGL Programming Guide: a hill by gluNurbsSurface."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from ...evaluators.constants import GL_MAP2_VERTEX_3
from ...evaluators.glu import gluBeginSurface, gluEndSurface, gluNurbsSurface
from ...evaluators.tessellations import read_float64, tessellate
from ...geometry.evaluate import sample_surface
from ...geometry.net import control_net
from .. import palette
from ..claims import Claim
from ..layers import Array, ControlNet, Figure, Handles, Space
from ..nurbs_programs import (
    HILL,
    KNOTS,
    LIGHT,
    NAMES,
    POINTS_HELP,
    PROGRAM_TURN,
    Display,
    Pixels,
    Sampling,
    drag_hill,
    drawn,
    hill_renderer,
    properties_caption,
    seen,
)
from ..parameters import Points
from ..registry import scene


@scene(
    "The Red Book's surface: gluNurbsSurface",
    plates=((), ("display=outline-polygon",)),
)
def redbook_surface(
    sampling: Sampling = "path-length",
    pixels: Pixels = 25.0,
    display: Display = "fill",
    points: Annotated[Array, Points((4, 4, 3), POINTS_HELP)] = HILL,
) -> Figure:
    shown = points @ seen(PROGRAM_TURN).T
    nurb = hill_renderer(sampling, pixels, display)
    gluBeginSurface(nurb)
    gluNurbsSurface(nurb, 8, KNOTS, 8, KNOTS, 4 * 3, 3, shown, 4, 4, GL_MAP2_VERTEX_3)
    gluEndSurface(nurb)
    (surface,) = nurb.take()
    net = control_net(shown)
    layers = (
        drawn(surface, LIGHT),
        ControlNet(net, palette.CONTROL_NET),
        Handles(shown.reshape(-1, 3), drag_hill, NAMES, quiet=True),
    )
    caption = (
        "gluNurbsSurface(nurb, 8, knots, 8, knots, 4*3, 3, ctlpoints, 4, 4, GL_MAP2_VERTEX_3);",
        properties_caption(sampling, pixels, display),
    )
    return Figure((Space("physical", sample_surface(net), layers, spatial=True),), caption)


@redbook_surface.claims
def claims() -> Iterator[Claim]:
    for pixels in (25.0, 5.0):
        edges = edges_on_the_screen(pixels)
        statement = f"edges longer than GLU_SAMPLING_TOLERANCE {pixels:g} in the program's window"
        yield Claim("surface.c", statement, 0, int((edges > pixels).sum()), 0)
        statement = "the longest edge, in units of the tolerance"
        yield Claim("surface.c", statement, 0.9, float(edges.max()) / pixels, 0.1)


def edges_on_the_screen(pixels: float) -> Array:
    """Lengths of the triangles' edges in the program's window."""
    nurb = hill_renderer("path-length", pixels, "fill")
    gluNurbsSurface(nurb, KNOTS, KNOTS, HILL @ seen(PROGRAM_TURN).T, GL_MAP2_VERTEX_3)
    (surface,) = nurb.take()
    found = tessellate(surface, read_float64)
    seen_points = found.vertices.astype(float) @ surface.view.pixels_from_object.T
    corners = (seen_points[:, :2] / seen_points[:, 2:])[found.primitives]
    return np.asarray(np.linalg.norm(corners - np.roll(corners, 1, 1), axis=-1))
