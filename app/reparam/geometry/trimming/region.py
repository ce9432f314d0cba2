"""Trim regions: what closed loops in the parameter domain leave of a surface.

A loop is a closed chain of pieces; what lies to the left of it stays: the inside of a
counter-clockwise loop, the outside of a clockwise one. Loops may be nested, with alternating
orientation; beyond the domain they are clipped; no loops leave the whole surface. (OpenGL
Graphics with the X Window System, gluBeginTrim. libGLU 9.0.2 agrees, except that it draws
nothing where all outermost loops are clockwise, and is silent about bad loops.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BadTrimPiece, EmptyTrim, UnconnectedTrim
from .packing import PackedTrim, pack
from .pieces import Array, Chain, Pieces, clamp_to_square, monotone_pieces, on_border
from .validation import check_loops
from .winding import WindingIndex, area_integrals

Domain = tuple[float, float, float, float]
Loop = Sequence[ArrayLike]

UNIT_DOMAIN: Domain = (0.0, 1.0, 0.0, 1.0)
LARGEST_GAP = 5e-6  # of the domain's size: what libGLU joins
MAX_ORDER = 32
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


@dataclass(frozen=True, eq=False)
class TrimRegion:
    """The part of a domain that stays; made by `trim_region`.

    loops: as they were given, in the surface's parameters; domain (u0, u1, v0, v1); pieces: the
    monotone pieces that bound the region in its unit square, ((u-u0)/(u1-u0), (v-v0)/(v1-v0)),
    closed loops with the winding number 1 inside and 0 outside.
    """

    loops: tuple[tuple[Array, ...], ...]
    domain: Domain
    pieces: Pieces

    @cached_property
    def index(self) -> WindingIndex:
        """The pieces, ready to be asked for."""
        return WindingIndex(self.pieces)

    @cached_property
    def _curves(self) -> WindingIndex:
        """The pieces without the domain's own border."""
        return WindingIndex(self.pieces.take(~on_border(self.pieces.ends)))

    @property
    def keeps_outside(self) -> bool:
        """Whether what lies outside all loops stays: clockwise outermost loops, or none."""
        return bool((self.pieces.loop < 0).any())

    def pack(self) -> PackedTrim:
        """The region as arrays for the GPU; made once."""
        return self._packed

    @cached_property
    def _packed(self) -> PackedTrim:
        return pack(self.pieces, self.index)

    def to_square(self, u: ArrayLike, v: ArrayLike) -> Array:
        """Parameters of the surface as points (..., 2) of the unit square."""
        u0, u1, v0, v1 = self.domain
        u, v = np.broadcast_arrays(np.asarray(u, np.float64), np.asarray(v, np.float64))
        return np.stack([(u - u0) / (u1 - u0), (v - v0) / (v1 - v0)], -1)

    def from_square(self, points: Array) -> Array:
        """Points (..., 2) of the unit square as parameters (u, v) of the surface."""
        u0, u1, v0, v1 = self.domain
        return np.asarray(points * [u1 - u0, v1 - v0] + [u0, v0])

    def inside(self, u: ArrayLike, v: ArrayLike) -> NDArray[np.bool_]:
        """Whether the surface stays at its parameters u, v (any one shape), by bisection.

        A point on a curve may go to either side; one outside the domain does not stay.
        """
        points = self.to_square(u, v)
        flat = points.reshape(-1, 2)
        stays = self.index.winding(flat) != 0
        return np.asarray(stays.reshape(points.shape[:-1]))

    def signed_distance(self, u: ArrayLike, v: ArrayLike) -> Array:
        """Distance to the nearest trim curve, in the unit square; positive inside the region."""
        points = self.to_square(u, v)
        flat = points.reshape(-1, 2)
        sign = np.where(self.index.winding(flat) != 0, 1.0, -1.0)
        return np.asarray((sign * self._curves.distance(flat)).reshape(points.shape[:-1]))

    def area(self) -> float:
        """What stays, in the surface's parameters: by Green's theorem along the loops."""
        u0, u1, v0, v1 = self.domain
        return float(area_integrals(self.pieces).sum() * (u1 - u0) * (v1 - v0))


def trim_region(loops: Sequence[Loop], domain: Domain = UNIT_DOMAIN) -> TrimRegion:
    """The region that loops leave of a domain (u0, u1, v0, v1), u0 < u1 and v0 < v1.

    A piece is an array (k, 3), a Bezier curve of homogeneous points (w u, w v, w) with k from 2
    to 32, or (k, 2), a polyline. The pieces of a loop follow each other head to tail, and the
    last one comes back to the first; gaps up to 5e-6 of the domain are joined, points that
    repeat are dropped. Raises TrimError: BadTrimPiece, EmptyTrim, UnconnectedTrim,
    CrossingTrims or MisorientedTrims.
    """
    u0, u1, v0, v1 = (float(x) for x in domain)
    if not (np.isfinite([u0, u1, v0, v1]).all() and u0 < u1 and v0 < v1):
        raise ValueError(f"trim domain: expected u0 < u1 and v0 < v1, found {domain}")
    given = tuple(
        tuple(check_piece(np.array(piece, np.float64), i, j) for j, piece in enumerate(loop))
        for i, loop in enumerate(loops)
    )
    to_square = np.array(
        [[1.0 / (u1 - u0), 0, 0], [0, 1.0 / (v1 - v0), 0], [-u0 / (u1 - u0), -v0 / (v1 - v0), 1]]
    )
    chains = [chain_of_loop(loop, i, to_square) for i, loop in enumerate(given)]
    pieces = monotone_pieces(_join(chains))
    kept_outside = check_loops(pieces, len(given))
    pieces = clamp_to_square(pieces)
    if kept_outside:
        pieces = _with_square(pieces)
    return TrimRegion(given, (u0, u1, v0, v1), pieces)


def check_piece(piece: Array, loop: int, number: int) -> Array:
    """The piece itself, read-only; BadTrimPiece if it is none."""
    if piece.ndim != 2 or piece.shape[1] not in (2, 3):
        raise BadTrimPiece(loop, number, f"expected (k, 2) or (k, 3), found {piece.shape}")
    if len(piece) < 2 or (piece.shape[1] == 3 and len(piece) > MAX_ORDER):
        most = f" to {MAX_ORDER}" if piece.shape[1] == 3 else " points or more"
        raise BadTrimPiece(loop, number, f"expected 2{most}, found {len(piece)}")
    if not np.isfinite(piece).all() or np.abs(piece).max() > 1e18:
        raise BadTrimPiece(loop, number, "expected finite numbers up to 1e18, found others")
    if piece.shape[1] == 3 and piece[:, 2].min() <= 1e-18:
        raise BadTrimPiece(loop, number, f"expected weights above 0, found {piece[:, 2].min():g}")
    piece.setflags(write=False)
    return piece


def chain_of_loop(loop: Sequence[Array], number: int, to_square: Array) -> Chain:
    """The curves of one loop in the unit square, closed."""
    curves: list[Array] = []
    sources: list[int] = []
    for source, piece in enumerate(loop):
        if piece.shape[1] == 2:
            points = np.column_stack([piece, np.ones(len(piece))]) @ to_square
            segments = np.stack([points[:-1], points[1:]], 1)
            curves.extend(segments[(segments[:, 0] != segments[:, 1]).any(-1)])
        else:
            curve = piece @ to_square
            if np.ptp(curve[:, :2] / curve[:, 2:], axis=0).any():
                curves.append(curve)
        sources.extend([source] * (len(curves) - len(sources)))
    if not curves:
        found = f"{len(loop)} pieces that are points" if loop else "none"
        raise EmptyTrim(number, None, f"expected at least one curve, found {found}")
    start = np.array([curve[0, :2] / curve[0, 2] for curve in curves])
    end = np.array([curve[-1, :2] / curve[-1, 2] for curve in curves])
    after = np.roll(start, -1, 0)
    gap = np.abs(after - end).max(1)
    if gap.max() > LARGEST_GAP:
        i = int(gap.argmax())
        following = sources[(i + 1) % len(curves)]
        raise UnconnectedTrim(
            number, sources[i],
            f"expected its end to meet the start of piece {following}, "
            f"found a gap of {gap[i]:.3g} of the domain",
        )  # fmt: skip
    for i in np.flatnonzero(gap > 0.0).tolist():
        curves[i] = curves[i].copy()
        curves[i][-1, :2] = after[i] * curves[i][-1, 2]
    corners = np.stack([start, after], 1)
    return Chain(curves, corners, np.full(len(curves), number), np.array(sources))


def _join(chains: Sequence[Chain]) -> Chain:
    if not chains:
        nothing = np.empty(0, dtype=np.intp)
        return Chain([], np.empty((0, 2, 2)), nothing, nothing)
    return Chain(
        [curve for chain in chains for curve in chain.curves],
        np.concatenate([chain.corners for chain in chains]),
        np.concatenate([chain.loop for chain in chains]),
        np.concatenate([chain.source for chain in chains]),
    )


def _with_square(pieces: Pieces) -> Pieces:
    """The loops and, counter-clockwise, the unit square."""
    ends = np.stack([SQUARE, np.roll(SQUARE, -1, 0)], 1)
    return Pieces(
        pieces.curves,
        np.append(pieces.table, np.full(4, -1)),
        np.append(pieces.row, np.zeros(4, dtype=np.intp)),
        np.concatenate([pieces.span, np.tile([0.0, 1.0], (4, 1))]),
        np.concatenate([pieces.ends, ends]),
        np.append(pieces.loop, np.full(4, -1)),
        np.append(pieces.source, np.full(4, -1)),
    )
