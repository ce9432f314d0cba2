"""trim of the OpenGL Programming Guide: a hole in the hill, its border a cubic and two lines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Annotated, Any

import numpy as np

from ...evaluators.constants import GL_MAP2_VERTEX_3
from ...evaluators.glu import (
    GLU_MAP1_TRIM_2,
    GLU_OUTLINE_PATCH,
    NurbsError,
    gluBeginSurface,
    gluBeginTrim,
    gluEndSurface,
    gluEndTrim,
    gluNurbsCurve,
    gluNurbsSurface,
    gluPwlCurve,
)
from ...evaluators.splines import Nurbs
from ...geometry.body import homogeneous
from ...geometry.evaluate import sample_surface
from ...geometry.net import control_net
from .. import palette
from ..claims import Claim
from ..directions import directions
from ..layers import (
    Array,
    ControlNet,
    Curves,
    Dots,
    Figure,
    Handles,
    Layer,
    Patches,
    Polylines,
    Space,
    plane,
)
from ..nurbs_programs import (
    HILL,
    KNOTS,
    LIGHT,
    PROGRAM_TURN,
    Display,
    Pixels,
    Sampling,
    drawn,
    hill_renderer,
    properties_caption,
    seen,
)
from ..parameters import Points
from ..registry import scene

BORDER = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)])  # edgePt
# curvePt, whose ends are those of pwlPt, and the middle of pwlPt.
HOLE = np.array([(0.25, 0.5), (0.25, 0.75), (0.75, 0.75), (0.75, 0.5), (0.5, 0.25)])
NAMES = ("curvePt[0]", "curvePt[1]", "curvePt[2]", "curvePt[3]", "pwlPt[1]")
UNIT = control_net([[(0, 0), (0, 1)], [(1, 0), (1, 1)]])
GREY = (0.72, 0.72, 0.72)


@scene("The Red Book's trim: a hole of a cubic and two lines", plates=((),))
def redbook_trim(
    sampling: Sampling = "path-length",
    pixels: Pixels = 25.0,
    display: Display = "fill",
    hole: Annotated[
        Array, Points((5, 2), "the hole in (u, v): four control points of a cubic, then a corner")
    ] = HOLE,
) -> Figure:
    try:
        surface = trimmed_hill(hole, sampling, pixels, display)
    except NurbsError as error:
        raise ValueError(f"hole: {error}") from None
    net = control_net(turned_hill())
    kept = replace(surface.properties, display_mode=GLU_OUTLINE_PATCH)
    layers: tuple[Layer, ...] = (drawn(replace(surface, properties=kept), LIGHT),)
    if display == "fill":  # decided for each pixel, from the curves themselves
        patches = Patches(net, color=GREY, lit=True, trim=surface.region)
        layers = (patches, *layers)
    elif display == "outline-polygon":
        layers = (drawn(surface, LIGHT),)
    layers = (*layers, ControlNet(net, palette.CONTROL_NET))
    caption = (
        "gluPwlCurve(edgePt);   gluNurbsCurve(curvePt), gluPwlCurve(pwlPt);",
        properties_caption(sampling, pixels, display),
    )
    domain = Space("domain", plane(-0.14, -0.14, 1.08, 1.08), domain_layers(hole))
    spatial = Space("physical", sample_surface(net), layers, spatial=True)
    return Figure((domain, spatial), caption)


def turned_hill() -> Array:
    """The control points as the programs see them."""
    return np.asarray(HILL @ seen(PROGRAM_TURN).T)


def trimmed_hill(hole: Array, sampling: str, pixels: float, display: str) -> Nurbs:
    """The program's calls. Raises NurbsError for a hole that crosses itself or leaves the hill."""
    nurb = hill_renderer(sampling, pixels, display)
    gluBeginSurface(nurb)
    gluNurbsSurface(nurb, 8, KNOTS, 8, KNOTS, 4 * 3, 3, turned_hill(), 4, 4, GL_MAP2_VERTEX_3)
    gluBeginTrim(nurb)
    gluPwlCurve(nurb, 5, BORDER, 2, GLU_MAP1_TRIM_2)
    gluEndTrim(nurb)
    gluBeginTrim(nurb)
    gluNurbsCurve(nurb, 8, KNOTS, 2, hole[:4], 4, GLU_MAP1_TRIM_2)
    gluPwlCurve(nurb, 3, hole[[3, 4, 0]], 2, GLU_MAP1_TRIM_2)
    gluEndTrim(nurb)
    gluEndSurface(nurb)
    (surface,) = nurb.take()
    return surface


def domain_layers(hole: Array) -> tuple[Layer, ...]:
    """The two loops, what stays to their left, and the points under the hand."""
    border, points = lifted(BORDER), lifted(hole)
    corners = homogeneous(points[[3, 4, 0]])
    cubic = homogeneous(points[:4])
    legs = np.stack([points[:3], points[1:4]], 1)
    return (
        *directions(UNIT),
        Polylines(border, palette.INK, width=1.8, arrow=True),
        Polylines(legs, palette.GUIDE, width=1.0),
        Curves(cubic, palette.ALONG_V, width=1.8, arrow=True),
        Curves(np.stack([corners[:-1], corners[1:]], 1), palette.ALONG_V, width=1.8, arrow=True),
        Dots(points, palette.ALONG_V, radius=3.5),
        Handles(points, drag, NAMES),
    )


def lifted(points: Array) -> Array:
    """(u, v) as (u, v, 0)."""
    return np.column_stack([points, np.zeros(len(points))])


def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
    """A point of the hole follows the hand, as long as there is a hole."""
    hole = values["hole"].copy()
    hole[index] = point[:2]
    try:
        trimmed_hill(hole, "path-length", 50.0, "fill")
    except NurbsError:
        return {}
    return {"hole": hole}


@redbook_trim.claims
def claims() -> Iterator[Claim]:
    region = trimmed_hill(HOLE, "path-length", 25.0, "fill").region
    assert region is not None
    area = 1 - 1 / 16 - 3 / 40  # less the triangle, less the cubic's cap: 3/5 of its box
    yield Claim("trim.c", "area that stays of the domain", area, region.area(), 1e-12)
