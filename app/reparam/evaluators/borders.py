"""The border of a surface, divided by its own curve alone: neighbours with one border meet.

A border is halved, and its halves, until each part keeps the tolerance; so its points are the
same for every surface that has it, whatever lies inside, run backwards, in other knots, or of a
patch cut in the middle. Between border and grid lies a ring of triangles:

        o---o-----------o---o      o  border points: the border's own
        | \\ |  \\      /  | / |      +  grid points, without the first and last lines
        o   +---+---+---+   o
        |   |   |   |   |   |

The ring keeps the tolerance too. Where it does not, another line of grid points is laid nearer
and nearer to the border, where the surface is the border's curve.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ..geometry.extraction import restricted
from ..geometry.net import Array
from .criteria import Criterion, criterion
from .sampling import Steps, steps
from .splines import Nurbs

MOST_HALVINGS = 12
NEAREST_LINE = 16  # halvings of the first cell

Sides = dict[str, Array]  # of one piece: the parameters of its border points, from 0 to 1
Lines = tuple[Array, Array]  # of a grid, in u and in v


@dataclass(frozen=True, eq=False)
class Plan:
    """Cells (s,) and (t,) of the pieces, the border points of each piece that has some, and how
    often the first cell is halved for the line of points nearest to the border."""

    nu: Steps
    nv: Steps
    borders: dict[tuple[int, int], Sides]
    halvings: int = 0

    def ring(self, s: int, t: int) -> Array:
        """The triangles (k, 3, 2) between a piece's border and its grid, counter-clockwise."""
        sides = self.borders.get((s, t), {})
        nu, nv = int(self.nu[s]), int(self.nv[t])
        i0, i1, j0, j1 = inner(sides, nu, nv)
        grid = (np.arange(i0, i1 + 1) / nu, np.arange(j0, j1 + 1) / nv)
        if not self.halvings:
            return np.array(list(_strips(sides, sides, grid))).reshape(-1, 3, 2)
        near = 0.5**self.halvings
        around = (
            _with_ends(grid[0], near / nu, "left" in sides, "right" in sides),
            _with_ends(grid[1], near / nv, "bottom" in sides, "top" in sides),
        )
        nearest = {side: around[_axis(side)] for side in sides}
        parts = [*_strips(sides, sides, around), *_strips(sides, nearest, grid, around)]
        return np.array(parts).reshape(-1, 3, 2)


def plan(nurbs: Nurbs) -> Plan:
    """The grids of a surface, and its borders where its sampling method has a tolerance."""
    nu, nv = steps(nurbs)
    asked = criterion(nurbs)
    if asked is None:
        return Plan(nu, nv, {})
    nets = nurbs.pieces("vertex")
    borders = _borders(nets, asked)
    if borders is None:
        return Plan(nu, nv, {})
    nu, nv = (np.maximum(n, 2) if len(n) == 1 else n for n in (nu, nv))  # room for two rings
    for halvings in range(NEAREST_LINE):
        found = Plan(nu, nv, borders, halvings)
        if all((asked.triangles(nets[at], found.ring(*at)) <= 1.0).all() for at in borders):
            break
    return found


def _borders(nets: Array, asked: Criterion) -> dict[tuple[int, int], Sides] | None:
    """By piece; None if the eye is too near to some border for a bound."""
    columns, rows = nets.shape[:2]
    curves = {
        **{(s, 0, "bottom"): nets[s, 0][:, :1] for s in range(columns)},
        **{(s, rows - 1, "top"): nets[s, -1][:, -1:] for s in range(columns)},
        **{(0, t, "left"): nets[0, t][:1].swapaxes(0, 1) for t in range(rows)},
        **{(columns - 1, t, "right"): nets[-1, t][-1:].swapaxes(0, 1) for t in range(rows)},
    }
    found: dict[tuple[int, int], Sides] = {}
    for (s, t, side), curve in curves.items():
        points = halved(curve, asked)
        if points is None:
            return None
        found.setdefault((s, t), {})[side] = points
    return found


def halved(curve: Array, asked: Criterion) -> Array | None:
    """Dyadic parameters from 0 to 1 of a curve (k, 1, 4), each part of which keeps the tolerance.

    None without a bound.
    """
    low, high, done = np.zeros(1), np.ones(1), [np.ones(1)]
    for _ in range(MOST_HALVINGS):
        corners = (np.stack([t, np.zeros(len(t))], -1) for t in (low, high))
        over = asked.excess(restricted(curve, *corners), 1.0, 0.0)
        if not np.isfinite(over).all():
            return None
        done.append(low[over <= asked.border])
        low, high = low[over > asked.border], high[over > asked.border]
        if not len(low):
            break
        middle = (low + high) / 2.0
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
    return np.sort(np.concatenate([*done, low]))


def inner(sides: Sides, nu: int, nv: int) -> tuple[int, int, int, int]:
    """First and last grid line in u and in v that the borders leave."""
    return (
        int("left" in sides), nu - int("right" in sides),
        int("bottom" in sides), nv - int("top" in sides),
    )  # fmt: skip


def _axis(side: str) -> int:
    return 0 if side in ("bottom", "top") else 1


def _with_ends(line: Array, near: float, first: bool, last: bool) -> Array:
    """A line's points, and one at `near` from 0 and from 1 where there is a border."""
    more = [np.array([near])[: int(first)], line, np.array([1.0 - near])[: int(last)]]
    return np.concatenate(more)


def _strips(
    sides: Iterable[str], outer: Sides, inner_lines: Lines, outer_lines: Lines | None = None
) -> Iterator[Array]:
    """Triangles between the points along each side and the first line of a grid there.

    The outer points lie on the border of [0,1]^2, or on the border of another grid.
    """
    for side in sides:
        axis = _axis(side)
        far = side in ("top", "right")
        end = -1 if far else 0
        across = float(far) if outer_lines is None else float(outer_lines[1 - axis][end])
        within = _line(inner_lines[axis], float(inner_lines[1 - axis][end]), axis)
        flip = side in ("top", "left")
        yield from _strip(_line(outer[side], across, axis), within, axis, flip)


def _line(along: Array, across: float, axis: int) -> Array:
    other = np.full(len(along), across)
    return np.stack([along, other] if axis == 0 else [other, along], -1)


def _strip(outer: Array, within: Array, axis: int, flip: bool) -> Iterator[Array]:
    """Triangles between two lines, each time to the nearer next point."""
    i = k = 0
    while i + 1 < len(outer) or k + 1 < len(within):
        outside = k + 1 == len(within) or (
            i + 1 < len(outer) and outer[i : i + 2, axis].sum() <= within[k : k + 2, axis].sum()
        )
        if outside:
            corners = [outer[i], outer[i + 1], within[k]]
            i += 1
        else:
            corners = [outer[i], within[k + 1], within[k]]
            k += 1
        yield np.array(corners[::-1] if flip else corners)
