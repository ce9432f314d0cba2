"""A circle cut into sections that stay and sections that a designer may change (figure 3).

Each section that is kept is one conic piece, or a few where it is long. One that may be modified
is cut into equal parts: the control points of the first and last belong to the transition, since
the kept neighbours depend on them; those between are free.

        kept  |  transition  free .. free  transition  |  kept
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .conics import ConicNet, circle_net
from .sections import curved_section

Array = NDArray[np.float64]
Smooth = Literal["G1", "G2"]

LONGEST = 120.0  # degrees of one conic piece: beyond, its control point is far out
LEAST = 1.0  # degrees of a section


@dataclass(frozen=True)
class Section:
    """One section: whether it is kept, and which pieces of the circle it has."""

    kept: bool
    pieces: range


@dataclass(frozen=True, eq=False)
class Partition:
    """The circle's sections, counter-clockwise, with its control net and radius."""

    sections: tuple[Section, ...]
    circle: ConicNet
    radius: float

    @property
    def free(self) -> list[int]:
        """The control points that can be moved without touching what is kept."""
        modified = [section.pieces[1:-1] for section in self.sections if not section.kept]
        return [index for pieces in modified for index in pieces]

    def edited(self, displacements: ArrayLike) -> ConicNet:
        """The net with the free control points displaced, in their order, by (k, 2)."""
        net = self.circle
        for index, step in zip(self.free, np.asarray(displacements), strict=True):
            if step.any():
                net = net.moved(index, net.points[index] + step)
        return net

    def pieces(self, net: ConicNet, smooth: Smooth) -> list[list[Array]]:
        """The curve of a net edited at its free points: a list of Bezier nets for each section.

        With "G1" all pieces are conics. With "G2" the control points of a modified section are
        the polygon of a spline that joins its neighbours with the circle's curvature.
        """
        conics = net.pieces()
        found = []
        for section in self.sections:
            first, last = section.pieces[0], section.pieces[-1]
            if section.kept or smooth == "G1":
                found.append(list(conics[first : last + 1]))
            else:
                ends = conics[first][:1, :2], conics[last][2:, :2]
                polygon = np.concatenate([ends[0], net.points[first : last + 1], ends[1]])
                found.append(curved_section(polygon, 1.0 / self.radius, 1.0 / self.radius))
        return found


def partition(
    cuts: ArrayLike, kept: Sequence[bool], parts: int = 3, radius: float = 1.0
) -> Partition:
    """The circle cut at these angles (degrees), section i from cut i to the next.

    `parts` (at least 3) are those of a modified section. Raises ValueError for fewer than two
    cuts, cuts that do not go once around in order, or another number of sections.
    """
    angles = np.asarray(cuts, dtype=np.float64)
    if angles.ndim != 1 or len(angles) < 2:
        raise ValueError(f"expected at least two cuts, found {angles.size}")
    if len(kept) != len(angles):
        raise ValueError(f"expected {len(angles)} sections for as many cuts, found {len(kept)}")
    if parts < 3:
        raise ValueError(f"expected at least 3 parts of a modified section, found {parts}")
    widths = np.diff(np.append(angles, angles[0] + 360.0))
    if not (widths >= LEAST).all():
        found = ", ".join(f"{angle:g}" for angle in angles)
        raise ValueError(f"expected angles that go once around, {LEAST:g} apart, found {found}")
    counts = [ceil(w / LONGEST) if keep else parts for w, keep in zip(widths, kept, strict=True)]
    starts = np.cumsum([0, *counts])
    ranges = [range(a, b) for a, b in pairwise(starts.tolist())]
    half = np.radians(np.repeat(widths / counts, counts)) / 2.0
    circle = circle_net(half, radius, start=float(np.radians(angles[0])))
    sections = tuple(Section(keep, pieces) for keep, pieces in zip(kept, ranges, strict=True))
    return Partition(sections, circle, radius)
