"""Equation (11): a derivative that vanishes says nothing about the image.

Both curves stop at the joint: all of x' is zero there, from the left and from the right, so both
are C1 as maps of u. One turns by 90 degrees, the other runs straight on. What decides is the
direction of x' on either side (the tangent line of the image), not x' itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from ...geometry.continuity import Joint, join_curves
from ...geometry.curve import curve_derivatives, curve_net, curve_points
from .. import palette
from ..claims import Claim
from ..drawing import arrow, words
from ..layers import Array, Curves, Dots, Figure, Layer, Polylines, Space, plane
from ..parameters import Range
from ..registry import scene

LEFT = [[-1, 1], [0, 0], [0, 0]]  # (11): (-1, 1) (1 - u)^2, then (1, 1) u^2
RIGHT = [[0, 0], [0, 0], [1, 1]]
STRAIGHT = [[-1, -1], [0, 0], [0, 0]]
STEPS = np.linspace(0.0, 1.0, 11)
SHORT = 0.25  # of a velocity, as it is drawn on the curve
EXTENT = plane(-2.9, -2.9, 2.9, 2.9)
BEFORE, AFTER = palette.PIECES[:2]


@scene(
    "The derivative vanishes: a corner, or no fault at all",
    animates="u",
    plates=((),),
)
def cusp(
    u: Annotated[float, Range(0, 2, 0.1), "where the point is: the joint is at 1"] = 0.6,
    turn: Annotated[float, Range(0, 180, 15), "degrees by which the first curve turns"] = 90.0,
) -> Figure:
    spaces: list[Space] = []
    told = []
    for name, degrees in (("corner", turn), ("straight", 0.0)):
        f, g = pieces(degrees)
        found = join_curves(f[:, [0, 1, 3]], g[:, [0, 1, 3]])
        told.append(found.told())
        net, t = (f, u) if u <= 1.0 else (g, u - 1.0)
        at, velocity = curve_derivatives(net, t, 1)[:, 0]
        curve = (*drawn(f, g, at, velocity), title(found))
        spaces.append(Space(name, plane(-1.5, -1.2, 1.5, 1.85), curve, height=1.5))
        hodograph = tuple(velocities(f, g, velocity))
        spaces.append(Space(f"velocity of {name}", EXTENT, hodograph, below=True))
    formula = "x(u) = a (1 − u)², then b (u − 1)²: from either side x′(1) = 0"
    return Figure(tuple(spaces), (formula, f"first: {told[0]};  its sibling: {told[1]}"))


def pieces(degrees: float) -> tuple[Array, Array]:
    """Two parabolas run through on a line each, nets (3, 4), that turn so much at the joint.

    At 90 they are (11), at 0 its sibling, to the last bit.
    """
    exact = {90.0: LEFT, 0.0: STRAIGHT}.get(degrees)
    if exact is not None:
        return curve_net(exact), curve_net(RIGHT)
    angle = np.radians(225.0 - degrees)
    arriving = np.zeros((3, 2))
    arriving[0] = np.sqrt(2.0) * np.array([np.cos(angle), np.sin(angle)])
    return curve_net(arriving), curve_net(RIGHT)


def title(found: Joint) -> Layer:
    runs = f"turns by {found.turn:.4g}°" if found.turn > 1e-9 else "runs straight on"
    return words(f"the image {runs}", [0.0, 1.7], size=16.0)


def drawn(f: Array, g: Array, at: Array, velocity: Array) -> Iterator[Layer]:
    """The pieces with ten equal steps of u each, and the point that moves, with its velocity."""
    for net, color in ((f, BEFORE), (g, AFTER)):
        yield Curves(net, color, 3.0)
        yield Dots(curve_points(net, STEPS), color, 3.6)
    if velocity.any():
        yield arrow(at, SHORT * velocity, palette.DERIVATIVE, 2.6)
    yield Dots(at[None], palette.MOVING, 5.5)


def velocities(f: Array, g: Array, velocity: Array) -> Iterator[Layer]:
    """x'(u): through 0 at the joint, and on in another direction or in the same."""
    axes = np.array([[[-2.6, 0.0, 0.0], [2.6, 0.0, 0.0]], [[0.0, -2.4, 0.0], [0.0, 2.4, 0.0]]])
    yield Polylines(axes, palette.GUIDE, 1.0, arrow=True)
    for net, color, width in ((f, BEFORE, 4.4), (g, AFTER, 1.8)):  # both seen where they coincide
        path = curve_derivatives(net, np.array([0.0, 1.0]), 1)[1]
        yield Polylines(path, color, width)
    if velocity.any():
        yield arrow(np.zeros(2), velocity, palette.DERIVATIVE, 2.6)
        beside = np.array([-velocity[1], velocity[0], 0.0]) / float(np.linalg.norm(velocity))
        yield words("x′(u)", velocity + 0.5 * beside, color=palette.DERIVATIVE, size=14.0)
    yield Dots(np.zeros((1, 3)), palette.INK, 3.0)
    yield words("x′(1) = 0", [-0.15, -0.15], anchor=(1.0, 1.0), size=14.0)


@cusp.claims
def claims() -> Iterator[Claim]:
    corner, straight = (
        join_curves([[x, y, 1] for x, y in left], [[x, y, 1] for x, y in RIGHT])
        for left in (LEFT, STRAIGHT)
    )
    yield Claim("(11)", "degrees by which the curve turns at the joint", 90.0, corner.turn, 1e-12)
    yield Claim("(11)", "degrees by which its sibling turns", 0.0, straight.turn, 0)
    slopes = [
        float(np.abs(curve_derivatives(net, t, 1)[1]).max())
        for degrees in (90.0, 0.0)
        for net, t in zip(pieces(degrees), (1.0, 0.0), strict=True)
    ]
    statement = "largest component of x' on either side of the joint, of both curves"
    yield Claim("(11)", statement, [0.0] * 4, slopes, 0)
    statement = "the order up to which the images are smooth, of all orders up to 5"
    yield Claim("(11)", statement, [0, 5], [corner.order, straight.order], 0)
    t = np.linspace(0.0, 1.0, 33)
    points = np.concatenate([curve_points(net, t) for net in pieces(0.0)])
    statement = "how far the sibling leaves the line y = x"
    yield Claim("(11)", statement, 0.0, float(np.abs(points[:, 0] - points[:, 1]).max()), 1e-15)
