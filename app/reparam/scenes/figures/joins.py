"""Equations (7) to (10): where two pieces join, derivatives may disagree on a smooth curve.

The pieces keep their image at any speed: the second is run through by u -> s u / (1 - u + s u),
which multiplies its first derivative at the joint by s and makes it a rational curve. What the
analyser finds, the highest G^k and the change of variables r, is told beneath.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Annotated, Any, Literal

import numpy as np

from ...geometry.continuity import Joint, composed, join, join_curves
from ...geometry.curve import curve_derivatives, curve_net, curve_points
from ...geometry.jets import Jet, bezier_jet
from .. import palette
from ..claims import Claim
from ..drawing import arrow, in_space, polygon, words
from ..layers import Array, Curves, Dots, Figure, Handles, Layer, Polylines, Space
from ..parameters import Points, Range
from ..registry import scene

THIRD = Fraction(1, 3)
NONE = np.zeros((0, 2))


def cut(points: list[list[float]], t: float) -> tuple[list[list[float]], list[list[float]]]:
    """A Bezier curve in two pieces, each over [0,1], by de Casteljau's algorithm."""
    rows = [np.array(points)]
    while len(rows[-1]) > 1:
        rows.append((1.0 - t) * rows[-1][:-1] + t * rows[-1][1:])
    return [row[0].tolist() for row in rows], [row[-1].tolist() for row in rows[::-1]]


Piece = Sequence[Sequence[float | Fraction]]
LINE: tuple[Piece, Piece] = ([[0, 0], [THIRD, THIRD]], [[THIRD, THIRD], [1, 1]])
PRESETS: dict[str, tuple[Piece, Piece]] = {
    "line": LINE,
    "arch": cut([[0.0, 0.0], [0.1, 1.2], [1.1, 1.1], [1.0, 0.0]], 1 / 3),
    "bend": ([[0, 0], [0.1, 0.7], [0.5, 0.7]], [[0.5, 0.7], [1.0, 0.7], [1, 0]]),
    "corner": ([[0, 0], [0.2, 0.8], [0.5, 0.8]], [[0.5, 0.8], [0.7, 0.3], [1, 0]]),
}
FIRST, SECOND = palette.PIECES[:2]
STEPS = np.linspace(0.0, 1.0, 11)
ASIDE = 0.05  # of the picture: how far beside the curve the derivatives are drawn


@scene(
    "Derivatives disagree, the curve is smooth",
    animates="speed",
    plates=((), ("pieces=bend", "speed=2")),
)
def joins(
    pieces: Annotated[
        Literal["line", "arch", "bend", "corner"], "line: (7) and (8); or others that join"
    ] = "line",
    speed: Annotated[float, Range(0.25, 4, 0.25), "of the second piece at the joint"] = 1.0,
    first: Annotated[Array, Points((None, 2), "control points of a first piece, instead")] = NONE,
    second: Annotated[Array, Points((None, 2), "control points of a second one")] = NONE,
) -> Figure:
    own = [
        np.array(preset if len(given) == 0 else given, dtype=np.float64)
        for given, preset in zip((first, second), PRESETS[pieces], strict=True)
    ]
    if min(map(len, own)) < 2:
        raise ValueError("expected at least two control points of each piece, found one")
    f, g = curve_net(own[0]), faster(curve_net(own[1]), speed)
    found = join_curves(plane_net(f), plane_net(g))
    spaces = (
        Space("physical", *curve_layers(f, g, own)),
        Space("hodograph", *hodograph_layers(f, g, found)),
    )
    lengths = [np.linalg.norm(x) for x in ends(f, g)]
    disagree = "disagree" if abs(lengths[0] - lengths[1]) > 1e-9 or found.order < 1 else "agree"
    compared = f"the derivatives {disagree}: |f′(1)| = {lengths[0]:.4g}, |g′(0)| = {lengths[1]:.4g}"
    return Figure(spaces, (compared, found.told()))


def faster(net: Array, speed: float) -> Array:
    """The same image, its first derivative at 0 times `speed`: weights w_i speed^i."""
    return net * (speed ** np.arange(len(net)))[:, None]


def plane_net(net: Array) -> Array:
    """A net (n, 3), x y w."""
    return net[:, [0, 1, 3]]


def ends(f: Array, g: Array) -> tuple[Array, Array]:
    """f'(1) and g'(0), (3,) each."""
    return curve_derivatives(f, 1.0, 1)[1, 0], curve_derivatives(g, 0.0, 1)[1, 0]


def curve_layers(f: Array, g: Array, own: list[Array]) -> tuple[Array, tuple[Layer, ...]]:
    """The pieces, points at equal steps of u, and both derivatives beside the joint."""
    joint = f[-1, :3] / f[-1, 3], g[0, :3] / g[0, 3]
    everything = np.concatenate([in_space(points) for points in own])
    size = float(np.ptp(everything, axis=0).max())
    before, after = ends(f, g)
    layers: list[Layer] = [handles(own)]
    for points in own:
        layers += polygon(points, palette.GUIDE, 1.0, 2.2)
    for net, color in ((f, FIRST), (g, SECOND)):
        layers.append(Curves(net, color, 3.0))
        layers.append(Dots(curve_points(net, STEPS), color, 4.0))
    layers.append(Dots(np.stack(joint), palette.INK, 3.4))
    scale = 0.4 * size / max(float(np.linalg.norm(x)) for x in (before, after, [1e-12]))
    bends = np.cross(before + after, everything - joint[0])[:, 2].sum()
    outside = 1.0 if bends <= 0.0 else -1.0
    tips, shorter = [], np.linalg.norm(before) < np.linalg.norm(after)
    lanes = (2.0, 1.0) if shorter else (1.0, 2.0)  # no arrow runs through the other's name
    for at, vector, color, name, lane in (
        (joint[0], before, FIRST, "f′(1)", lanes[0]),
        (joint[1], after, SECOND, "g′(0)", lanes[1]),
    ):
        along = vector / max(float(np.linalg.norm(vector)), 1e-12)
        across = outside * np.array([-along[1], along[0], 0.0])
        start = at + lane * ASIDE * size * across
        tips.append(start + scale * vector + size * (0.08 * along + 0.03 * across))
        layers.append(arrow(start, scale * vector, color, 2.4))
        layers.append(words(name, tips[-1], color=color, size=15.0))
    low, high = everything.min(0), everything.max(0)
    title = np.array([(low[0] + high[0]) / 2.0, max(high[1], tips[0][1], tips[1][1]), 0.0])
    title[1] += 0.08 * size
    layers.append(words("ten equal steps of u on each piece", title, size=15.0))
    return np.concatenate([everything, np.stack([*tips, title])]), tuple(layers)


def hodograph_layers(f: Array, g: Array, found: Joint) -> tuple[Array, tuple[Layer, ...]]:
    """The velocities x'(u) as a curve, and how far r' takes that of g to that of f."""
    t = np.linspace(0.0, 1.0, 97)
    paths = [curve_derivatives(net, t, 1)[1] for net in (f, g)]
    before, after = ends(f, g)
    everything = np.concatenate([np.zeros((1, 3)), *paths])
    low, high = everything.min(0), everything.max(0)
    reach = 0.08 * float((high - low).max())
    low, high = low - reach, high + reach
    axes = [[[low[0], 0, 0], [high[0], 0, 0]], [[0, low[1], 0], [0, high[1], 0]]]
    layers: list[Layer] = [Polylines(np.array(axes), palette.GUIDE, 1.0, arrow=True)]
    for path, color in zip(paths, (FIRST, SECOND), strict=True):
        layers.append(Polylines(path, color, 2.0))
    layers += [arrow([0, 0], after, SECOND, 2.4), arrow([0, 0], before, FIRST, 2.4)]
    layers.append(Dots(before[None], FIRST, 4.0))
    layers.append(Dots(after[None], SECOND, 4.0))
    if found.derivatives:
        text = f"f′(1) = r′ g′(0),   r′ = {float(found.derivatives[0]):.4g}"
    elif not found.regular:
        text = "a derivative vanishes: the image is asked"
    else:
        text = "no r′ > 0 takes g′(0) to f′(1)"
    top = np.array([(low[0] + high[0]) / 2.0, high[1], 0.0])
    layers.append(words(text, top, offset=(0.0, 14.0), anchor=(0.5, 0.0), size=15.0))
    layers.append(words("x′", [high[0], 0.0], offset=(0.0, -12.0), size=14.0))
    layers.append(words("y′", [0.0, high[1]], offset=(-12.0, 0.0), size=14.0))
    room = top + np.array([0.0, 2.0 * reach, 0.0])
    return np.stack([low, high, room]), tuple(layers)


def handles(own: list[Array]) -> Handles:
    """All control points; both ends at the joint move together if they are together."""
    together = bool((own[0][-1] == own[1][0]).all())
    count = len(own[0])

    def drag(_values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        points = np.concatenate(own)
        points[index] = point[:2]
        if together and index in (count - 1, count):
            points[[count - 1, count]] = point[:2]
        return {"first": points[:count], "second": points[count:]}

    names = tuple([f"f{i}" for i in range(count)] + [f"g{i}" for i in range(len(own[1]))])
    return Handles(in_space(np.concatenate(own)), drag, names)


@joins.claims
def claims() -> Iterator[Claim]:
    f, g = ([[x, y, 1] for x, y in points] for points in LINE)
    found = join_curves(f, g, 9)
    statement = "r', r'', .., r⁽⁹⁾ found for the two pieces of the diagonal, exactly"
    values = [float(x) for x in found.derivatives]
    expected = [0.5 if m == 0 else 0.0 for m in range(9)]
    yield Claim("(7), (8)", statement, expected, values, 0)
    statement = "their derivatives at the joint: f'(1) and g'(0)"
    slopes = [float(x.derivatives[1, 0]) for x in (bezier_jet(f, 1, 1), bezier_jet(g, 0, 1))]
    yield Claim("(7), (8)", statement, [1 / 3, 2 / 3], slopes, 1e-15)
    speeds = [0.25, 0.5, 1.0, 2.0, 4.0]
    nets = [curve_net(np.array(points, float)) for points in LINE]
    betas, orders = [], []
    for speed in speeds:
        joint = join_curves(plane_net(nets[0]), plane_net(faster(nets[1], speed)))
        betas.append(float(joint.derivatives[0]))
        orders.append(joint.order)
    statement = "β = r' if the second piece is 1/4, 1/2, 1, 2, 4 times as fast: 1/(2 s)"
    yield Claim("(10)", statement, [0.5 / speed for speed in speeds], betas, 1e-14)
    yield Claim(
        "(10)", "how smoothly they join at these speeds: G5, all asked for", [5] * 5, orders, 0
    )
    wanted = [Fraction(2, 3), Fraction(2, 5), Fraction(-18, 7), Fraction(0), Fraction(0)]
    after = bezier_jet([[0, 0], [1, 2], [3, -1], [2, 5]], 0, 5)
    before = composed(after, wanted)
    found = join(before, after)
    statement = "r', .., r⁽⁵⁾ recovered from f = g o r, less 2/3, 2/5, −18/7, 0, 0, exactly"
    off = [float(x - y) for x, y in zip(found.derivatives, wanted, strict=True)]
    yield Claim("(9)", statement, [0.0] * 5, off, 0)
    disturbed = before.derivatives.copy()
    disturbed[3, 0] += Fraction(1, 1000)
    statement = "the highest G^k once the third derivative of f is disturbed by 1/1000"
    yield Claim("(9)", statement, 2, join(Jet(disturbed, before.sizes), after).order, 0)
