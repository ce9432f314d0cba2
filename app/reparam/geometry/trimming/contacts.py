"""Where monotone pieces meet, other than end to end."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .pieces import STRAIGHT, Array, Indices, Mask, Pieces
from .winding import expand

CONTACT = 1e-7  # two pieces nearer than this meet, in the domain's unit square
ENTRIES = 6  # cells of a grid that a piece is in, on average
BRANCHES = 32  # places where one pair of pieces may meet that are followed up
PARALLEL = 1e-9  # angle between pieces that may run along each other


def contacts(pieces: Pieces) -> tuple[Indices, Array]:
    """Pairs (k, 2) of pieces that meet, other than end to end, and where: parameters (k, 2).

    The end points of a monotone piece are the corners of its bounding box, so both pieces are
    halved and the halves whose boxes meet are kept, until they are points. Where that are too
    many, along curves that run together, those whose chords cross go first. Pieces that part at
    once from an end in common meet nowhere else.
    """
    pair = candidate_pairs(pieces)
    parting, ends_met = _part_at_once(pieces, pair)
    apart = np.flatnonzero(parting)
    met = pair[apart], np.take_along_axis(pieces.span[pair[apart]], ends_met[apart, :, None], 2)
    pair = pair[~parting]
    span = pieces.span[pair]  # (k, 2 of the pair, 2)
    ends = pieces.ends[pair]
    number = np.arange(len(pair))
    for _ in range(64):
        if len(number) == 0 or np.ptp(ends, axis=2).max() < CONTACT / 4.0:
            break
        middle = span.mean(-1)
        joint = np.stack([pieces.points(pair[number, i], middle[:, i]) for i in (0, 1)], 1)
        halves_span = np.stack(
            [np.stack([span[..., 0], middle], -1), np.stack([middle, span[..., 1]], -1)], 1
        )
        halves_ends = np.stack(
            [np.stack([ends[:, :, 0], joint], 2), np.stack([joint, ends[:, :, 1]], 2)], 1
        )
        one, other = np.repeat([0, 1], 2), np.tile([0, 1], 2)
        span = np.stack([halves_span[:, one, 0], halves_span[:, other, 1]], 2).reshape(-1, 2, 2)
        ends = np.stack([halves_ends[:, one, 0], halves_ends[:, other, 1]], 2)
        ends = ends.reshape(-1, 2, 2, 2)
        number = np.repeat(number, 4)
        kept = np.flatnonzero(boxes_meet(ends))
        kept = kept[np.lexsort((~chords_cross(ends[kept]), number[kept]))]
        kept = kept[rank_within(number[kept]) < BRANCHES]
        number, span, ends = number[kept], span[kept], ends[kept]
    return np.concatenate([met[0], pair[number]]), np.concatenate([met[1][..., 0], span.mean(-1)])


def _part_at_once(pieces: Pieces, pair: Indices) -> tuple[Mask, Indices]:
    """Which pairs (k, 2) have one end in common and, as seen from there, lie in different
    directions, so that they cannot meet again, (k,), and which end it is of either: (k, 2)."""
    ends = pieces.ends[pair]
    same = (ends[:, 0, :, None] == ends[:, 1, None]).all(-1).reshape(-1, 4)
    met = np.stack(np.divmod(same.argmax(1), 2), -1)
    direction, least, most = (told[pair, met] for told in sectors(pieces))
    turn = np.remainder(direction[:, 1] - direction[:, 0] + np.pi, 2.0 * np.pi) - np.pi
    left = turn + least[:, 1] > most[:, 0] + PARALLEL
    right = turn + most[:, 1] < least[:, 0] - PARALLEL
    narrow = (most - least).sum(1) < np.pi / 2.0  # not so wide that they meet behind the end
    return np.asarray((same.sum(1) == 1) & (left | right) & narrow), met


def sectors(pieces: Pieces) -> tuple[Array, Array, Array]:
    """Where pieces lie as seen from either end, (n, 2) each: the direction of the other end, and
    how far they are to the right of it, < 0, and to the left: where their control points are."""
    along = pieces.ends[:, 1] - pieces.ends[:, 0]
    forth = np.arctan2(along[:, 1], along[:, 0])
    direction = np.stack([forth, np.arctan2(-along[:, 1], -along[:, 0])], -1)
    least, most = np.zeros((2, len(pieces), 2))
    for number, curves in enumerate(pieces.curves):
        here = np.flatnonzero(pieces.table == number)
        net = parts_of(curves[pieces.row[here]], pieces.span[here])
        points = net[..., :2] / net[..., 2:]
        for side in (0, 1):
            way = points - pieces.ends[here, None, side]
            seen = np.hypot(way[..., 0], way[..., 1]) > CONTACT
            turn = np.arctan2(way[..., 1], way[..., 0]) - direction[here, None, side]
            turn = np.where(seen, np.remainder(turn + np.pi, 2.0 * np.pi) - np.pi, 0.0)
            least[here, side], most[here, side] = turn.min(1), turn.max(1)
    return direction, least, most


def parts_of(curves: Array, span: Array) -> Array:
    """Control points of Bezier curves (n, k, 3) from one parameter to another, span (n, 2):
    (n, k, 3). (de Casteljau: the points on the way to the end, then to the start.)"""
    start, end = span.T[..., None, None]
    first, degree = curves.copy(), curves.shape[1] - 1
    for k in range(degree):
        first[:, k + 1 :] = (1.0 - end) * first[:, k:-1] + end * first[:, k + 1 :]
    share = start / end
    for k in range(degree):
        first[:, : degree - k] = (1.0 - share) * first[:, : degree - k] + share * first[
            :, 1 : degree - k + 1
        ]
    return first


def boxes_meet(ends: Array) -> Mask:
    """Whether pairs of monotone pieces (k, 2, 2, 2) come within CONTACT by their bounding boxes,
    those along the axes and those along the diagonals, which their ends span too."""
    u, v = np.moveaxis(ends, -1, 0)
    result = np.ones(len(ends), dtype=bool)
    for coordinate in (u, v, u + v, u - v):
        start, end = coordinate[..., 0], coordinate[..., 1]
        (low, other_low), (high, other_high) = np.minimum(start, end).T, np.maximum(start, end).T
        result &= np.maximum(low, other_low) <= np.minimum(high, other_high) + 2.0 * CONTACT
    return result


def chords_cross(ends: Array) -> NDArray[np.bool_]:
    """Whether the segments between the end points of pairs (k, 2, 2, 2) meet."""
    sides = []
    for one, other in ((ends[:, 0], ends[:, 1]), (ends[:, 1], ends[:, 0])):
        along, to = one[:, 1] - one[:, 0], other - one[:, :1]
        side = along[:, :1] * to[..., 1] - along[:, 1:] * to[..., 0]
        sides.append(side[:, 0] * side[:, 1] <= 0.0)
    return np.asarray(sides[0] & sides[1])


def rank_within(number: Indices) -> Indices:
    """0, 1, 2 ... within each run of equal numbers."""
    fresh = np.ones(len(number), dtype=bool)
    fresh[1:] = number[1:] != number[:-1]
    begin = np.flatnonzero(fresh)
    length = np.diff(np.append(begin, len(number)))
    return np.arange(len(number)) - np.repeat(begin, length)


def candidate_pairs(pieces: Pieces) -> Indices:
    """Pairs (k, 2) whose boxes meet, by a grid; without neighbours that only meet end to end."""
    low, high = pieces.ends.min(1), pieces.ends.max(1)
    corner, extent = low.min(0), np.maximum(np.ptp(np.concatenate([low, high]), axis=0), 1e-30)
    cells = int(np.clip(np.sqrt(len(pieces)), 1, 256))
    while True:
        first = np.clip((low - CONTACT - corner) / extent * cells, 0, cells - 1).astype(np.intp)
        last = np.clip((high + CONTACT - corner) / extent * cells, 0, cells - 1).astype(np.intp)
        across = last - first + 1
        if cells == 1 or across.prod(1).sum() <= ENTRIES * len(pieces):
            break
        cells //= 2
    number, place = expand(np.zeros(len(pieces), dtype=np.intp), across.prod(1))
    column = first[number, 0] + place % across[number, 0]
    cell = (first[number, 1] + place // across[number, 0]) * cells + column
    by_cell = np.lexsort((number, cell))
    cell, number = cell[by_cell], number[by_cell]
    pairs = [np.empty((0, 2), dtype=np.intp)]
    for distance in range(1, len(cell)):
        together = np.flatnonzero(cell[distance:] == cell[:-distance])
        if len(together) == 0:
            break
        found = np.stack([number[together], number[together + distance]], -1)
        corner_cell = first[found].max(1)  # of the cells that both are in, the first
        found = found[corner_cell[:, 1] * cells + corner_cell[:, 0] == cell[together]]
        pairs.append(found[boxes_meet(pieces.ends[found])])
    pair = np.concatenate(pairs)
    return pair[~_end_to_end(pieces, pair)]


def _end_to_end(pieces: Pieces, pair: Indices) -> NDArray[np.bool_]:
    """Neighbours that cannot meet again: both straight, or one going on in u or v as the other."""
    one, other = pieces.ends[pair[:, 0]], pieces.ends[pair[:, 1]]
    follows = (one[:, 1] == other[:, 0]).all(-1) | (other[:, 1] == one[:, 0]).all(-1)
    straight = (pieces.table[pair] == STRAIGHT).all(-1)
    goes_on = ((one[:, 1] - one[:, 0]) * (other[:, 1] - other[:, 0]) > 0.0).any(-1)
    twice = (one[:, 1] == other[:, 0]).all(-1) & (other[:, 1] == one[:, 0]).all(-1)
    return np.asarray(follows & (straight | goes_on & ~twice))
