"""nurbs of the OpenGL Programming Guide: a heart, rational, of thirteen by three control points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...evaluators.constants import GL_MAP2_VERTEX_4
from ...evaluators.glu import NurbsRenderer, gluBeginSurface, gluEndSurface, gluNurbsSurface
from ...evaluators.light import Light
from ...evaluators.matrices import frustum, look_at, rotate
from ...evaluators.tessellations import evaluate_at, read_float64
from ...geometry.evaluate import sample_surface
from ...geometry.extraction import surface_to_bezier
from .. import palette
from ..claims import Claim
from ..layers import Array, ControlNet, Figure, Space
from ..nurbs_programs import (
    Display,
    Pixels,
    Sampling,
    affine,
    drawn,
    new_renderer,
    properties_caption,
    seen,
)
from ..registry import scene

S_KNOTS = (-1.0, -1.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 9.0, 9.0)
T_KNOTS = (1.0, 1.0, 1.0, 2.0, 2.0, 2.0)
# The outline, x, y and weight of its points; the surface runs from z = 2 to z = 3 and bulges
# towards y at its tip and in its notch.
OUTLINE = np.array([
    (4.0, 2.0, 1.0), (5.0, 4.0, 1.0), (6.0, 5.0, 1.0), (6.0, 6.0, 2.0**0.5), (5.2, 6.7, 1.0),
    (4.0, 6.0, 2.0**0.5), (4.0, 5.2, 1.0), (4.0, 6.0, 2.0**0.5), (2.8, 6.7, 1.0),
    (2.0, 6.0, 2.0**0.5), (2.0, 5.0, 1.0), (3.0, 4.0, 1.0), (4.0, 2.0, 1.0),
])  # fmt: skip
TIP, NOTCH = 1.6, 4.6
# The program turns a second light on and gives it a place, but no colour: OpenGL's lights are black
# but for the first. And it does not ask for two sides, so what faces away from that one is grey.
LIGHT = Light(
    position=(1.0, 0.1, 1.0, 0.0),
    model_ambient=(0.3, 0.3, 0.3),
    material_ambient=(1.0, 1.0, 1.0),
    material_diffuse=(1.0, 0.2, 1.0),
    material_specular=(1.0, 1.0, 1.0),
    shininess=50.0,
    two_sided=False,
)


def heart() -> Array:
    """ctlpoints[13][3][4], premultiplied."""
    points = np.empty((13, 3, 4))
    points[..., :2] = OUTLINE[:, None, :2]
    points[..., 2] = (2.0, 2.5, 3.0)
    points[[0, 12], 1, 1], points[6, 1, 1] = TIP, NOTCH
    points[..., 3] = 1.0
    return np.asarray(points * OUTLINE[:, None, 2:])


EYE = np.array([7.0, 4.5, 4.0])
LOOK = look_at(EYE, (4.5, 4.5, 2.0), (6.0, -3.0, 2.0))[:3, :3]
TURN = (rotate(220.0, 1.0, 0.0, 0.0) @ rotate(115.0, 0.0, 1.0, 0.0))[:3, :3]
MIDDLE = np.array([4.0, 4.5, 2.5])  # what the program turns about


@scene("The Red Book's nurbs: a rational heart", plates=((), ("display=outline-patch",)))
def redbook_nurbs(
    sampling: Sampling = "path-length", pixels: Pixels = 25.0, display: Display = "fill"
) -> Figure:
    turn = seen(LOOK @ TURN)
    points = heart()
    points[..., :3] = (points[..., :3] - MIDDLE * points[..., 3:]) @ turn.T
    shift = LOOK @ (MIDDLE - EYE)
    modelview = affine(LOOK @ TURN @ turn.T, (float(shift[0]), float(shift[1]), float(shift[2])))
    projection = frustum(-1.0, 1.0, -1.5, 0.5, 0.8, 10.0)
    nurb = new_renderer(sampling, pixels, display, modelview, projection)
    gluBeginSurface(nurb)
    gluNurbsSurface(nurb, 16, S_KNOTS, 6, T_KNOTS, 4 * 3, 4, points, 3, 3, GL_MAP2_VERTEX_4)
    gluEndSurface(nurb)
    (surface,) = nurb.take()
    bounds = sample_surface(surface_to_bezier((S_KNOTS, T_KNOTS), points, (3, 3)).patches())
    layers = (drawn(surface, LIGHT), ControlNet(points, palette.CONTROL_NET))
    caption = (
        "gluNurbsSurface(nurb, 16, sknots, 6, tknots, 4*3, 4, ctlpoints, 3, 3, GL_MAP2_VERTEX_4);",
        properties_caption(sampling, pixels, display),
    )
    return Figure((Space("physical", bounds, layers, spatial=True),), caption)


@redbook_nurbs.claims
def claims() -> Iterator[Claim]:
    nurb = NurbsRenderer()
    gluNurbsSurface(nurb, S_KNOTS, T_KNOTS, heart(), GL_MAP2_VERTEX_4)
    (surface,) = nurb.take()

    def at(*parameters: tuple[float, float]) -> Array:
        return evaluate_at(surface, np.array(parameters), read_float64).points.astype(np.float64)

    tip, middle, notch = at((-1.0, 1.5), (4.0, 1.5), (4.0, 1.0)).tolist()
    yield Claim("nurbs.c", "the tip, where the outline bulges", [4.0, 1.8, 2.5], tip, 1e-6)
    yield Claim("nurbs.c", "the notch is a control point: 4 is twice a knot", [4.0, 5.2, 2.0],
                notch, 1e-6)  # fmt: skip
    yield Claim("nurbs.c", "the notch half-way up", [4.0, 4.9, 2.5], middle, 1e-6)
    here, there = at((2.3, 1.2)), at((8.0 - 2.3, 1.2))
    mirrored = ([8.0, 0.0, 0.0] + there * [-1.0, 1.0, 1.0])[0].tolist()
    yield Claim("nurbs.c", "s = 2.3 and its mirror image s = 5.7", mirrored, here[0].tolist(), 1e-6)
