"""Whether closed loops bound a region: nothing crosses, and orientations alternate.

Both are questions about winding numbers. Where two curves cross, the sectors between them have
three different ones (w, w+1, w+2); where they only touch, two. And when nothing crosses, the
loops alternate if the same winding number, 1 or 0, lies to the left of each of them.

            w+1 \\ / w+2                   w+1
         -------- X ------->         ----->--_--->-----
            w    / \\ w+1                w   / \\   w
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .errors import CrossingTrims, EmptyTrim, MisorientedTrims
from .pieces import STRAIGHT, Array, Indices, Pieces
from .winding import WindingIndex, area_integrals, expand

CONTACT = 1e-7  # two pieces nearer than this meet, in the domain's unit square
PROBE = 4e-6  # how far around a contact the winding numbers are looked at
APART = 1e-9  # how far across their way branches must part, to look between them
LEAST_AREA = 1e-13
MOST_ENTRIES = 1 << 22
BRANCHES = 32  # places where one pair of pieces may meet that are followed up


def check_loops(pieces: Pieces, loops: int) -> bool:
    """Whether the outside of all the loops stays; TrimError if they bound no region."""
    if loops == 0:
        return True
    index = WindingIndex(pieces)
    check_crossings(index)
    empty = np.abs(np.bincount(pieces.loop, area_integrals(pieces), loops)) < LEAST_AREA
    if empty.any():
        found = int(empty.argmax())
        raise EmptyTrim(found, None, "expected it to enclose something, found no area")
    left = left_winding(index, loops)
    wanted = left[0] if left[0] in (0, 1) else 1
    wrong = np.flatnonzero(left != wanted)
    if len(wrong):
        raise MisorientedTrims(
            int(wrong[0]), None,
            "expected loops that alternate, counter-clockwise around what stays and clockwise "
            f"around what goes, found {left[wrong[0]]} turns to its left and "
            f"{wanted} to the left of others",
        )  # fmt: skip
    return bool(wanted == 0)


def left_winding(index: WindingIndex, loops: int) -> Indices:
    """The winding number just to the left of each loop: the median beside its longest pieces."""
    pieces = index.pieces
    along = pieces.ends[:, 1] - pieces.ends[:, 0]
    length = np.hypot(*along.T)
    by_length = np.lexsort((-length, pieces.loop))
    begin = np.searchsorted(pieces.loop[by_length], np.arange(loops + 1))
    place = np.minimum(begin[:-1, None] + np.arange(5), begin[1:, None] - 1)
    longest = by_length[place].ravel()
    at = pieces.points(longest, pieces.span[longest].mean(1))
    along, length = along[longest], length[longest, None]
    left = np.stack([-along[:, 1], along[:, 0]], -1) / length
    turns = index.winding(at + left * np.minimum(1e-6, 1e-3 * length))
    return np.asarray(np.median(turns.reshape(loops, 5), axis=1).astype(np.intp))


def check_crossings(index: WindingIndex) -> None:
    """CrossingTrims if two pieces cross, or run along each other in one direction."""
    pieces = index.pieces
    pair, t = contacts(pieces)
    if len(pair) == 0:
        return
    probes = around(pieces, pair, t)
    turns = index.winding(probes.reshape(-1, 2)).reshape(probes.shape[:-1])
    crossing = np.flatnonzero(np.ptp(turns, axis=1) > 1)
    if len(crossing) == 0:
        return
    worst = crossing[0]
    one, other = pair[worst]
    u, v = pieces.points(pair[worst, :1], t[worst, :1])[0]
    raise CrossingTrims(
        int(pieces.loop[one]), int(pieces.source[one]),
        f"expected loops that do not cross, found it crossing loop {pieces.loop[other]}, piece "
        f"{pieces.source[other]}, at ({u:.6g}, {v:.6g}) of the unit domain",
    )  # fmt: skip


def around(pieces: Pieces, pair: Indices, t: Array) -> Array:
    """Points around contacts (k, 2): on a circle, and amid the branches that leave it."""
    center = pieces.points(pair[:, 0], t[:, 0])
    angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False) + 0.1234
    circle = center[:, None] + PROBE * np.stack([np.cos(angle), np.sin(angle)], -1)
    probes, branches = circle, []
    for side in (0, 1):
        speed = np.hypot(*pieces.velocities(pair[:, side], t[:, side]).T)
        low, high = pieces.span[pair[:, side]].T
        step = np.minimum(PROBE / np.maximum(speed, 1e-30), (high - low) / 4.0)
        ahead = pieces.points(pair[:, side], np.minimum(t[:, side] + step, high))
        behind = pieces.points(pair[:, side], np.maximum(t[:, side] - step, low))
        branches.append((ahead, behind))
    along = pieces.velocities(pair[:, 0], t[:, 0])
    along /= np.maximum(np.hypot(*along.T), 1e-30)[:, None]
    for a in branches[0]:
        for b in branches[1]:
            across = (a - b)[:, 0] * along[:, 1] - (a - b)[:, 1] * along[:, 0]
            apart = np.abs(across)[:, None] > APART  # else amid is on the curves
            amid = np.where(apart, (a + b) / 2.0, circle[:, 0])
            probes = np.concatenate([probes, amid[:, None]], 1)
    return probes


def contacts(pieces: Pieces) -> tuple[Indices, Array]:
    """Pairs (k, 2) of pieces that meet, other than end to end, and where: parameters (k, 2).

    The end points of a monotone piece are the corners of its bounding box, so both pieces are
    halved and the halves whose boxes meet are kept, until they are points. Where that are too
    many, along curves that run together, those whose chords cross go first.
    """
    pair = candidate_pairs(pieces)
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
    return pair[number], span.mean(-1)


def boxes_meet(ends: Array) -> NDArray[np.bool_]:
    """Whether the bounding boxes of pairs of monotone pieces (k, 2, 2, 2) come within CONTACT."""
    low, high = ends.min(2), ends.max(2)
    return np.asarray((low.max(1) <= high.min(1) + CONTACT).all(-1))


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
        if cells == 1 or across.prod(1).sum() <= MOST_ENTRIES:
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
        pairs.append(found[boxes_meet(pieces.ends[found])])
    pair = np.unique(np.concatenate(pairs), axis=0)
    return pair[~_end_to_end(pieces, pair)]


def _end_to_end(pieces: Pieces, pair: Indices) -> NDArray[np.bool_]:
    """Neighbours that cannot meet again: both straight, or one going on in u or v as the other."""
    one, other = pieces.ends[pair[:, 0]], pieces.ends[pair[:, 1]]
    follows = (one[:, 1] == other[:, 0]).all(-1) | (other[:, 1] == one[:, 0]).all(-1)
    straight = (pieces.table[pair] == STRAIGHT).all(-1)
    goes_on = ((one[:, 1] - one[:, 0]) * (other[:, 1] - other[:, 0]) > 0.0).any(-1)
    twice = (one[:, 1] == other[:, 0]).all(-1) & (other[:, 1] == one[:, 0]).all(-1)
    return np.asarray(follows & (straight | goes_on & ~twice))
