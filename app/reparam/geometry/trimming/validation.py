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

from .contacts import CONTACT, contacts
from .errors import CrossingTrims, EmptyTrim, MisorientedTrims
from .pieces import Array, Indices, Pieces
from .winding import WindingIndex, area_integrals

PROBE = 4e-6  # how far around a contact the winding numbers are looked at
APART = 1e-9  # how far across their way branches must part, to look between them
LEAST_AREA = 1e-13


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
    """CrossingTrims if two pieces cross, or run along each other in one direction.

    All pieces that meet in one place are looked at together: the winding numbers between each two
    of their branches that follow each other around it.
    """
    pieces = index.pieces
    pair, t = contacts(pieces)
    if len(pair) == 0:
        return
    center, place = places(pieces.points(pair[:, 0], t[:, 0]))
    probes, owner, between = around(pieces, center, place, pair, t)
    turns = index.winding(probes)
    by_place = np.argsort(owner, kind="stable")
    begin = np.searchsorted(owner[by_place], np.arange(len(center)))
    turned = turns[by_place]
    spread = np.maximum.reduceat(turned, begin) - np.minimum.reduceat(turned, begin)
    crossed = np.flatnonzero(spread > 1)
    if len(crossed) == 0:
        return
    here = np.flatnonzero(owner == crossed[0])
    least, most = (here[turns[here] == value] for value in (turns[here].min(), turns[here].max()))
    rarer = min(most, least, key=len)
    amid = rarer[between[rarer, 0] >= 0]
    two = between[amid[0]] if len(amid) else pair[place == crossed[0]][0]
    one, other = np.sort(two)
    u, v = center[crossed[0]]
    raise CrossingTrims(
        int(pieces.loop[one]), int(pieces.source[one]),
        f"expected loops that do not cross, found it crossing loop {pieces.loop[other]}, piece "
        f"{pieces.source[other]}, at ({u:.6g}, {v:.6g}) of the unit domain",
    )  # fmt: skip


def places(points: Array) -> tuple[Array, Indices]:
    """Points (k, 2) that are one place to within CONTACT: the places (m, 2), and of each point the
    number of its place (k,)."""
    number = np.zeros(len(points), dtype=np.intp)
    for axis in (0, 1):
        order = np.lexsort((points[:, axis], number))
        fresh = np.diff(number[order], prepend=0) != 0
        fresh |= np.diff(points[order, axis], prepend=points[order[0], axis]) > CONTACT
        number[order] = np.cumsum(fresh)
    _, first, number = np.unique(number, return_index=True, return_inverse=True)
    return points[first], number


def around(
    pieces: Pieces, center: Array, place: Indices, pair: Indices, t: Array
) -> tuple[Array, Indices, Indices]:
    """Points (n, 2) around the places (m, 2) where pairs (k, 2) meet at t (k, 2): on a circle, and
    amid the branches that leave it, one after the other. Also of which place they are (n,), and
    between which pieces (n, 2), -1 on the circle."""
    angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False) + 0.1234
    circle = PROBE * np.stack([np.cos(angle), np.sin(angle)], -1)
    rim = (center[:, None] + circle).reshape(-1, 2)
    member = np.stack([np.repeat(place, 2), pair.ravel()], -1)
    members, first = np.unique(member, axis=0, return_index=True)
    (at, piece), t = members.T, t.ravel()[first]
    low, high = pieces.span[piece].T
    speed = np.hypot(*pieces.velocities(piece, t).T)
    step = np.minimum(PROBE / np.maximum(speed, 1e-30), (high - low) / 4.0)
    tips = [pieces.points(piece, np.clip(t + way, low, high)) for way in (-step, step)]
    at, piece = np.tile(at, 2), np.tile(piece, 2)
    way = np.concatenate(tips) - center[at]
    length = np.hypot(*way.T)
    leaving = length > CONTACT
    at, piece, way, length = at[leaving], piece[leaving], way[leaving], length[leaving]
    turn = np.arctan2(way[:, 1], way[:, 0])
    order = np.lexsort((turn, at))
    at, piece, way, length, turn = at[order], piece[order], way[order], length[order], turn[order]
    begin = np.searchsorted(at, at)
    last = np.append(at[1:] != at[:-1], True)[: len(at)]
    after = np.where(last, begin, np.arange(len(at)) + 1)
    gap = turn[after] - turn + np.where(last, 2.0 * np.pi, 0.0)
    amid = PROBE * np.stack([np.cos(turn + gap / 2.0), np.sin(turn + gap / 2.0)], -1)
    short = np.minimum(length, length[after])
    thin = (way / length[:, None] + way[after] / length[after, None]) * short[:, None] / 2.0
    wide = gap > 0.5
    amid = np.where(wide[:, None], amid, thin)
    kept = np.flatnonzero(wide | (short * gap > APART))  # else amid is on the curves
    probes = np.concatenate([rim, center[at[kept]] + amid[kept]])
    owner = np.concatenate([np.repeat(np.arange(len(center)), len(circle)), at[kept]])
    between = np.full((len(probes), 2), -1)
    between[len(rim) :] = np.stack([piece, piece[after]], -1)[kept]
    return probes, owner, between
