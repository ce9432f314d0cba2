"""Figure 3: modelling with conic pieces in four steps.

1 The circle is cut into sections that are kept and sections that may be modified.
2 The control net of its conic pieces appears; modified sections have three parts.
3 The control points in the middle of the modified sections are dragged.
4 The curve follows, and the sections that were kept have not left the circle.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import ceil
from typing import Annotated, Any, Literal

import numpy as np

from ...geometry.conics import ConicNet
from ...geometry.continuity import angle, join_curves
from ...geometry.curve import curvature, curve_points
from ...geometry.jets import rational_jet
from ...geometry.partition import Partition, Section, Smooth, partition
from ...geometry.sections import end_curvatures
from .. import palette
from ..claims import Claim
from ..combs import curvature_comb
from ..drawing import in_space, polygon, words
from ..layers import Array, Curves, Dots, Figure, Handles, Layer, Polylines, Space
from ..parameters import Points, Range
from ..registry import scene

CUTS = np.array([-60.0, 70.0, 160.0, 200.0])
EDITS = np.array([[-0.30, 0.45], [-0.25, -0.55]])
TOOTH, LONGEST_TOOTH = 0.22, 0.9  # of the comb: for a curvature of 1, and at all
SMOOTH: tuple[Smooth, Smooth] = ("G1", "G2")
STEPS = (
    "1: the circle is cut into sections that are kept and sections that may be modified",
    "2: the control net of its conic pieces; a modified section has {parts} parts",
    "3: the free control points are dragged",
    "4: the curve follows, and what is kept has not left the circle",
)
RULE = "each joint keeps its ratio on a leg of the net, so tangents agree however it is dragged"
JOINED = {
    "G1": "conic pieces, joined with common tangents (G1)",
    "G2": "between the arcs cubic splines, joined with common curvature too (G2)",
}


@scene(
    "A designer's circle: what is kept stays on it",
    figure=3,
    animates="step",
    plates=((), ("step=2",), ("smooth=G2", "comb=1")),
)
def fig3(
    step: Annotated[float, Range(1, 4, 1), "the designer's steps, and the ways between"] = 4.0,
    smooth: Annotated[Literal["G1", "G2"], "how the modified sections join"] = "G1",
    comb: Annotated[bool, "the curvature comb"] = False,
    arcs: Annotated[str, "each section, from the first cut on: K kept or M modified"] = "KMKM",
    cuts: Annotated[Array, Points((None,), "where sections begin, in degrees")] = CUTS,
    parts: Annotated[int, Range(3, 7), "parts of a modified section"] = 3,
    edits: Annotated[
        Array, Points((None, 2), "how far the free points are dragged; 0 where none is given")
    ] = EDITS,
) -> Figure:
    part = partition(cuts, kept_sections(arcs), parts)
    grown, dragged, followed = (min(max(step - k, 0.0), 1.0) for k in (1, 2, 3))
    displacements = fitted(edits, len(part.free))
    net = part.edited(displacements * dragged)
    curve = part.pieces(part.edited(displacements * followed), smooth if followed else "G1")
    layers = (
        *handles(part, net, displacements, grown),  # first: their places in the list stay
        Curves(part.circle.pieces(), palette.GUIDE, 1.0),
        *(combs(curve) if comb else ()),
        *(drawn_net(part, net, grown) if grown else ()),
        *drawn_curve(part, curve),
        *names(part),
    )
    stage = STEPS[ceil(step) - 1].format(parts=parts)
    caption = (stage, JOINED[smooth] if followed else RULE)
    whole = part.edited(displacements)  # the same frame at each step
    bounds = extent(part, part.pieces(whole, smooth), whole, comb)
    return Figure((Space("physical", bounds, layers),), caption)


def kept_sections(arcs: str) -> list[bool]:
    """True for K, False for M. Raises ValueError for other letters."""
    if not arcs or set(arcs) - set("KM"):
        raise ValueError(f"arcs: expected letters K (kept) and M (modified), found {arcs!r}")
    return [letter == "K" for letter in arcs]


def fitted(edits: Array, count: int) -> Array:
    """The first `count` displacements, (count, 2), 0 where there are fewer."""
    found = np.zeros((count, 2))
    found[: len(edits)] = edits[:count]
    return found


def extent(part: Partition, curve: list[list[Array]], net: ConicNet, comb: bool) -> Array:
    """Points (k, 3) to be seen: the circle with its net, the curve, the dragged net, the comb."""
    t = np.linspace(0.0, 1.0, 17)
    points = [in_space(net.points), in_space(part.circle.points)]
    points += [curve_points(piece, t) for pieces in curve for piece in pieces]
    teeth = combs(curve) if comb else ()
    points += [layer.points.reshape(-1, 3) for layer in teeth if isinstance(layer, Polylines)]
    return np.concatenate(points)


def drawn_curve(part: Partition, curve: list[list[Array]]) -> Iterator[Layer]:
    """The sections in their colours, and dots where they meet."""
    for section, pieces in zip(part.sections, curve, strict=True):
        color = palette.KEPT if section.kept else palette.MODIFIED
        for order in sorted({len(piece) for piece in pieces}):
            nets = np.stack([piece for piece in pieces if len(piece) == order])
            yield Curves(nets, color, 3.4 if section.kept else 2.4)
    starts = np.stack([pieces[0][0, :3] / pieces[0][0, 3] for pieces in curve])
    yield Dots(starts, palette.INK, 3.2)


def names(part: Partition) -> Iterator[Layer]:
    """What each section is, inside the circle."""
    for section in part.sections:
        text, color = ("kept", palette.KEPT) if section.kept else ("modified", palette.MODIFIED)
        at = middle(part, section)
        yield words(text, 0.8 * at, color=color, size=15.0)


def drawn_net(part: Partition, net: ConicNet, grown: float) -> Iterator[Layer]:
    """The control net, as far as it has grown out of the circle, and the joints on its legs."""
    lengths = np.hypot(*net.points.T)[:, None]
    points = net.points * (1.0 + (grown - 1.0) * (1.0 - part.radius / lengths))
    if grown == 1.0:
        points = net.points
    yield from polygon(points, palette.CONTROL_NET, 1.0, 2.6, closed=True)
    if grown == 1.0:
        yield Dots(in_space(net.joints()), palette.INK, 1.8)


def combs(curve: list[list[Array]]) -> Iterator[Layer]:
    """The curvature comb of all pieces to one scale, its longest tooth not beyond the frame."""
    pieces = [piece for section in curve for piece in section]
    t = np.linspace(0.0, 1.0, 25)
    bends = np.nan_to_num(np.abs([curvature(piece, t) for piece in pieces]))
    largest = max(1.0, float(bends.max()))
    scale = min(TOOTH, LONGEST_TOOTH / largest)
    for piece in pieces:
        yield from curvature_comb(piece, scale, 24)


def handles(part: Partition, net: ConicNet, displacements: Array, grown: float) -> Iterator[Layer]:
    """The middles of the sections, where they begin, and the free control points of a net."""

    def stay(_values: Mapping[str, Any], _index: int, _point: Array) -> Mapping[str, Any]:
        return {}

    def switch(values: Mapping[str, Any], index: int) -> Mapping[str, Any]:
        arcs = values["arcs"]
        return {"arcs": arcs[:index] + "MK"[arcs[index] == "M"] + arcs[index + 1 :]}

    def turn(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        cuts = values["cuts"].copy()
        way = float(np.degrees(np.arctan2(point[1], point[0]))) - cuts[index]
        cuts[index] += (way + 180.0) % 360.0 - 180.0
        return {"cuts": cuts}

    def pull(_values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        edits = displacements.copy()
        edits[index] = point[:2] - part.circle.points[part.free[index]]
        return {"edits": edits, "step": 4.0}

    starts = part.circle.joints()[[section.pieces[0] - 1 for section in part.sections]]
    middles = np.stack([middle(part, section) for section in part.sections])
    count = range(len(starts))
    yield Handles(middles, stay, tuple(f"section {i}" for i in count), click=switch)
    yield Handles(in_space(starts), turn, tuple(f"cut {i}" for i in count))
    if grown == 1.0:
        free = tuple(f"P{index}" for index in part.free)
        yield Handles(in_space(net.points[part.free]), pull, free)


def middle(part: Partition, section: Section) -> Array:
    """The point (3,) of the circle in the middle of a section."""
    pieces = part.circle.pieces()[section.pieces.start : section.pieces.stop]
    half, odd = divmod(len(pieces), 2)
    return np.asarray(curve_points(pieces[half], 0.5 if odd else 0.0)[0])


@fig3.claims
def claims() -> Iterator[Claim]:
    part = partition(CUTS, kept_sections("KMKM"))
    net = part.edited(EDITS)
    for smooth in SMOOTH:
        curve = part.pieces(net, smooth)
        pieces = [piece for section in curve for piece in section]
        joints = list(pairwise([*pieces, pieces[0]]))
        statement = f"{smooth}: how far kept arcs have left the circle after the edits, at most"
        yield Claim("Fig. 3", statement, 0.0, departure(part, curve), 1e-14)
        before = part.pieces(part.circle, smooth)
        statement = f"{smooth}: sections of which any bit has changed: the modified ones"
        yield Claim("Fig. 3", statement, [0, 1, 0, 1], changed(before, curve), 0)
        statement = f"{smooth}: largest angle between tangents at a joint, in degrees"
        yield Claim("Fig. 3", statement, 0.0, max(turn(f, g) for f, g in joints), 1e-10)
        orders = [join_curves(f, g, 2).order for f, g in joints]
        statement = f"{smooth}: the lowest order at which pieces join, found by the analyser"
        yield Claim("Fig. 3", statement, int(smooth[1]), min(orders), 0)
    jumps = [abs(end_curvatures(f)[1] - end_curvatures(g)[0]) for f, g in joints]
    yield Claim("Fig. 3", "G2: largest jump of the curvature at a joint", 0.0, max(jumps), 1e-10)


def departure(part: Partition, curve: list[list[Array]]) -> float:
    """The largest | |x| - 1 | on kept sections, at 101 points of each piece."""
    t = np.linspace(0.0, 1.0, 101)
    kept = [
        piece for s, pieces in zip(part.sections, curve, strict=True) if s.kept for piece in pieces
    ]
    points = np.concatenate([curve_points(piece, t) for piece in kept])
    return float(np.abs(np.hypot(points[:, 0], points[:, 1]) - part.radius).max())


def changed(before: list[list[Array]], after: list[list[Array]]) -> list[float]:
    """For each section 1 if any number of its nets has changed, else 0."""
    return [
        float(any(not np.array_equal(a, b) for a, b in zip(old, new, strict=True)))
        for old, new in zip(before, after, strict=True)
    ]


def turn(f: Array, g: Array) -> float:
    """Degrees between the tangents where f ends and g starts."""
    return angle(rational_jet(f, 1, 1).derivatives[1], rational_jet(g, 0, 1).derivatives[1])
