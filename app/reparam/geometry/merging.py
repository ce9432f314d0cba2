"""Four biquadratic patches that are one: what the last cut did not need to divide.

Where all that surrounds a vertex is regular, a cut in halves divides its biquadratic patch in four
and changes nothing:

      +-----+-----+
      |  3  |  2  |       along one direction, l and r the halves:
      +-----o-----+           b0 = l0,   b1 = 2 l1 - l0,   ...   bm = rm
      |  0  |  1  |       since l1 = (b0 + b1)/2 and so on (de Casteljau at 1/2).
      +-----+-----+

The whole is read off the outer coefficients of the parts, of whatever degree they have been raised
to; so is that of anything else with the same stencils, as texture maps have.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .net import Array
from .surface_spline import SurfaceSpline

Indices = NDArray[np.intp]
T = TypeVar("T", np.float64, np.intp)

# Which corner of each part is the centre o, as indices of the first and last row and column.
CENTRES = ((-1, -1), (0, -1), (0, 0), (-1, 0))


@dataclass(frozen=True, eq=False)
class Merging:
    """`kept` (K,) are the patches that stay, `parts` (M, 4) those that become one, `turns` (M, 4)
    the quarter turns that bring them side by side."""

    kept: Indices
    parts: Indices
    turns: Indices

    def __len__(self) -> int:
        """How many patches there are then."""
        return len(self.kept) + len(self.parts)

    def nets(self, nets: Array) -> Array:
        """Nets of all patches (P, m, m, c) as those of the kept ones, then of the merged ones."""
        return np.concatenate([nets[self.kept], _whole(self._blocks(nets))])

    def of_patch(self, values: Indices) -> Indices:
        """What is known of each patch (P,): the parts of one agree."""
        return np.concatenate([values[self.kept], values[self.parts[:, 0]]])

    def index(self, index: Indices) -> Indices:
        """The points of the nets (P, m, m) likewise: on the rim of the merged ones the ends of the
        parts' edges, so that neighbours name theirs alike; -1 inside."""
        blocks = self._blocks(index)
        m = index.shape[1]
        place = np.minimum(np.arange(m), 1) * (m - 1) + (np.arange(m) == m - 1) * m
        merged = blocks[:, place[:, None], place]
        merged[:, 1:-1, 1:-1] = -1
        return np.concatenate([index[self.kept], merged])

    def _blocks(self, nets: NDArray[T]) -> NDArray[T]:
        """The parts of each merged patch in one block (M, 2m, 2m, ...)."""
        turned = np.stack([np.rot90(nets, k, (1, 2)) for k in range(4)])
        a, b, c, d = (turned[self.turns[:, i], self.parts[:, i]] for i in range(4))
        low, high = np.concatenate([a, d], 2), np.concatenate([b, c], 2)
        return np.concatenate([low, high], 1)


def _whole(blocks: Array) -> Array:
    """Nets (M, m, m, c) from blocks of four parts."""
    for axis in (1, 2):
        parts = np.moveaxis(blocks, axis, 0)
        m = len(parts) // 2
        left, right = parts[:m], parts[m:][::-1]
        rows = [left[0], 2.0 * left[1] - left[0]]
        ends = [right[0], 2.0 * right[1] - right[0]]
        whole = [rows[0], (rows[1] + ends[1]) / 2.0, ends[0]] if m == 3 else [*rows, *ends[::-1]]
        blocks = np.moveaxis(np.stack(whole), 0, axis)
    return blocks


def merging(spline: SurfaceSpline) -> Merging:
    """What of a surface spline can be one patch: around a vertex of the mesh before the last cut,
    in four quads, all corners cut in halves and then left where they were."""
    parent = spline.cuts[-2]
    halves = (spline.fractions[0] == 0.5) & (spline.fractions[1] == 0.5)
    facets = spline.stages[-2]
    still = np.bincount(facets.rows, minlength=facets.shape[0]) == 1
    sound = np.bincount(parent.face, ~(halves & still), len(parent.sizes)) == 0
    sound &= parent.sizes == 4
    regular = (parent.valence == 4) & ~parent.on_boundary
    regular &= np.bincount(parent.origin, ~sound[parent.face], parent.vertex_count) == 0
    ring = parent.around[regular[parent.origin[parent.around]]].reshape(-1, 4)
    patch = np.full(spline.cuts[-1].vertex_count, -1)
    patch[spline.corner] = np.arange(len(spline.corner))
    parts = patch[ring]
    parts = parts[(parts >= 0).all(1)]
    kept = np.setdiff1d(np.arange(len(spline.corner)), parts)
    return Merging(kept, parts, _turns(spline.index, parts))


def _turns(index: Indices, parts: Indices) -> Indices:
    """Quarter turns (M, 4) after which the corner that all four parts have in common is in the
    middle."""
    rows, columns = np.array(CENTRES).T
    corners = index[:, rows, columns][parts]  # (M, part, corner)
    shared = (corners[:, :, None, :] == corners[:, :1, :, None]).any(-1).all(1)  # (M, corner)
    centre = np.take_along_axis(corners[:, 0], np.argmax(shared, 1)[:, None], 1)
    found = np.argmax(corners == centre[:, :, None], 2)
    return np.asarray((np.arange(4) - found) % 4)
