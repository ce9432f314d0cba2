"""Which patches of a net differ from those of an older one: an edit moves few of many."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CHUNK = 1 << 12  # patches compared at a time: they fit into the cache
MOST_RUNS = 48  # pieces: more of them cost more than the patches between


def changed_runs(before: Array, after: Array) -> list[range] | None:
    """The patches whose bits differ, as ascending runs of few patches that do not differ between.

    None where all is better done anew: nets (patches, m, n, 4) of other shapes, of one patch, or
    more than half of the patches have changed.
    """
    if before.shape != after.shape or after.ndim != 4:
        return None
    count, found, total = len(after), [], 0
    for first in range(0, count, CHUNK):
        different = _bits(before[first : first + CHUNK]) != _bits(after[first : first + CHUNK])
        if different.any():
            found.append(first + np.flatnonzero(different.any(1)))
            total += len(found[-1])
        if 2 * total > count:
            return None
    return runs(np.concatenate(found)) if found else []


def runs(numbers: NDArray[np.intp]) -> list[range]:
    """Ascending numbers as at most MOST_RUNS ranges, which leave out the widest gaps."""
    gaps = np.diff(numbers)
    cuts = np.flatnonzero(gaps > 1)
    if len(cuts) >= MOST_RUNS:
        cuts = np.sort(cuts[np.argsort(gaps[cuts])[1 - MOST_RUNS :]])
    ends = [0, *(cuts + 1).tolist(), len(numbers)]
    return [range(int(numbers[a]), int(numbers[b - 1]) + 1) for a, b in pairwise(ends)]


def within(run: range, part: range) -> range:
    """What of a run lies in a part."""
    return range(max(run.start, part.start), min(run.stop, part.stop))


def _bits(nets: Array) -> NDArray[np.uint64]:
    return np.ascontiguousarray(nets).view(np.uint64).reshape(len(nets), -1)
