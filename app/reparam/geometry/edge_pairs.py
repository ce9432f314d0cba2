"""Which edges of many patches lie on one another, by geometry; whole ones, or parts of longer ones.

Edge 4 p + s is side s of patch p. At a T-junction

      +-----+-----+
      |  a  |  b  |      the lower edge of a lies on one half of the upper edge of c, cut there by
      +-----+-----+      de Casteljau
      |     c     |
      +-----------+

the halves of what no other edge lies on are compared with the whole edges, then halves of halves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .curve import curve_points, restrict
from .net import Array

Indices = NDArray[np.intp]

HALVINGS = 3
WHOLE = (0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Pairs:
    """Edges that coincide: `edges` (J, 2), of each the part `spans` (J, 2, 2) from low to high; at
    a T-junction the short one, which is whole, comes first. `backwards` (J,) says whether the
    second runs the other way; `free` (E,) are the edges that none covers all of."""

    edges: Indices
    spans: Array
    backwards: NDArray[np.bool_]
    free: Indices


def edge_nets(nets: Array, patches: Indices, sides: Indices) -> Array:
    """The boundary curves of patches (P, m, m, 4) as Bezier curves (E, m, 4); sides 0 to 3 are
    u=0, u=1, v=0 and v=1."""
    rows = np.stack([nets[:, 0], nets[:, -1], nets[:, :, 0], nets[:, :, -1]], 1)
    return np.asarray(rows[patches, sides])


def edge_pairs(curves: Array, long: NDArray[np.bool_], reach: float, samples: int) -> Pairs:
    """The pairs among Bezier curves (E, m, 4) nearer to each other than `reach` everywhere, at
    equal parameters; those that are not `long` (E,) are points, and left alone."""
    t = np.linspace(0.0, 1.0, samples)
    points = curve_points(curves, t)
    among = np.flatnonzero(long)
    first, second, backwards = _coincident(points[among], reach)
    pairs = [np.stack([among[first], among[second]], -1)]
    spans = [np.broadcast_to(np.array(WHOLE), (len(first), 2, 2))]
    turned = [backwards]
    alone = long.copy()
    alone[pairs[0]] = False
    covered = np.where(alone, 0.0, 1.0)
    pieces = np.flatnonzero(alone)
    limits = np.broadcast_to(np.array(WHOLE), (len(pieces), 2))
    for _ in range(HALVINGS):
        short = np.flatnonzero(alone)
        if len(short) < 2:
            break
        middle = limits.mean(1)
        limits = np.concatenate(
            [np.stack([limits[:, 0], middle], -1), np.stack([middle, limits[:, 1]], -1)]
        )
        pieces = np.concatenate([pieces, pieces])
        parts = curve_points(_restricted(curves[pieces], limits), t)
        both = np.concatenate([points[short], parts])
        one, other, backwards = _coincident(both, reach)
        joined = (one < len(short)) & (other >= len(short))
        one, other, backwards = one[joined], other[joined] - len(short), backwards[joined]
        pairs.append(np.stack([short[one], pieces[other]], -1))
        whole = np.broadcast_to(np.array(WHOLE), (len(one), 2))
        spans.append(np.stack([whole, limits[other]], 1))
        turned.append(backwards)
        alone[short[one]] = alone[pieces[other]] = False
        covered[short[one]] = 1.0
        np.add.at(covered, pieces[other], np.ptp(limits[other], axis=1))
        left = np.ones(len(pieces), bool)
        left[other] = False
        left &= covered[pieces] < 1.0
        pieces, limits = pieces[left], limits[left]
    edges = np.concatenate(pairs)
    place = np.lexsort([edges[:, 1], edges[:, 0]])
    return Pairs(
        edges[place],
        np.concatenate(spans)[place],
        np.concatenate(turned)[place],
        np.flatnonzero(long & (covered < 1.0)),
    )


def _restricted(curves: Array, limits: Array) -> Array:
    """Each curve over its own part of the parameters."""
    found = np.empty_like(curves)
    for low, high in np.unique(limits, axis=0):
        here = (limits == (low, high)).all(1)
        found[here] = restrict(curves[here], low, high)
    return found


def _coincident(curves: Array, reach: float) -> tuple[Indices, Indices, NDArray[np.bool_]]:
    """Pairs of curves, by points (E, S, 3), nearer than `reach` everywhere, the lower number
    first, and whether the second runs backwards.

    Curves that coincide have the same mean point, whichever way they run; sorted along one skew
    direction, only neighbours in the list need be compared.
    """
    key = curves.mean(1) @ np.array([0.8165, 0.4714, 0.3333])
    order = np.argsort(key)
    key = key[order]
    found: list[tuple[Indices, Indices, NDArray[np.bool_]]] = []
    for apart in range(1, len(order)):
        near = np.flatnonzero(key[apart:] - key[:-apart] <= 2.0 * reach)
        if not len(near):
            break
        one, other = order[near], order[near + apart]
        one, other = np.minimum(one, other), np.maximum(one, other)
        forth = np.abs(curves[one] - curves[other]).max((1, 2))
        back = np.abs(curves[one] - curves[other][:, ::-1]).max((1, 2))
        match = np.minimum(forth, back) <= reach
        found.append((one[match], other[match], (back < forth)[match]))
    if not found:
        nothing = np.zeros(0, np.intp)
        return nothing, nothing, np.zeros(0, bool)
    first, second, backwards = (np.concatenate(part) for part in zip(*found, strict=True))
    return first, second, backwards
