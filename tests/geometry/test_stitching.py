"""Patches that have steps of their own inside and on each edge: their triangles fit together."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.edge_levels import fitted
from reparam.geometry.net import Array
from reparam.geometry.stitching import stitched, stitched_patch

KINDS = [
    [3, 3, 3, 3, 3, 3, 0],
    [1, 1, 4, 2, 3, 9, 1],
    [7, 1, 1, 11, 1, 10, 0],
    [40, 30, 30, 41, 77, 60, 1],
]


def kinds(count: int) -> list[list[int]]:
    """Steps in u and v, those of the edges, and whether diagonals fall."""
    random = np.random.default_rng(1)
    steps = random.integers(1, 8, (count, 2))
    more = random.integers(0, 6, (count, 4)) * (random.random((count, 4)) < 0.5)
    falling = random.integers(0, 2, count)
    return np.column_stack([steps, steps[:, [1, 0, 1, 0]] + more, falling]).tolist()


def parameters(places: NDArray[np.uint16]) -> Array:
    """The (u, v) of vertices."""
    of_u, of_v = places[:, :2].astype(np.float64), places[:, 2:].astype(np.float64)
    return np.stack([of_u[:, 0] / of_u[:, 1], of_v[:, 0] / of_v[:, 1]], -1)


@pytest.mark.parametrize("kind", [*KINDS, *kinds(40)])
def test_triangles_of_a_patch(kind: list[int]) -> None:
    """They cover the square once, meet side by side, and none reaches further than a cell."""
    nu, nv, *edges, _ = kind
    places, triangles = stitched_patch(*kind)
    at = parameters(places)
    assert len(np.unique(at, axis=0)) == len(at)
    assert len(triangles) == 2 * nu * nv + sum(edges) - 2 * (nu + nv)
    sides = np.roll(at[triangles], -1, axis=1) - at[triangles]
    areas = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    assert areas.min() > 1e-9
    assert areas.sum() == pytest.approx(2.0)
    assert (np.abs(sides) <= np.array([1.0 / nu, 1.0 / nv]) + 1e-12).all()
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], -1).reshape(-1, 2)
    forth, back = (set(map(tuple, pairs.tolist())) for pairs in (ends, ends[:, ::-1]))
    assert len(forth) == len(ends)
    alone = at[np.array(sorted(forth - back))]
    on_edge = [alone[..., 0] == 0.0, alone[..., 1] == 0.0, alone[..., 0] == 1.0, alone[..., 1] == 1]
    assert [int(both.all(-1).sum()) for both in on_edge] == edges
    for both, axis, steps in zip(on_edge, (1, 0, 1, 0), edges, strict=True):
        low = np.sort(alone[both.all(-1)][..., axis], -1)
        np.testing.assert_allclose(np.sort(low[:, 0]) * steps, np.arange(steps), atol=1e-9)


def test_no_side_goes_back_by_more_than_half_a_step() -> None:
    rows = np.array(kinds(400))
    steps, edges, falling = rows[:, :2], rows[:, 2:6], rows[:, 6]
    edges = fitted(steps, edges, np.arange(edges.size).reshape(edges.shape))
    assert (edges >= rows[:, 2:6]).all()
    assert edges.sum() < 1.1 * rows[:, 2:6].sum()
    back = []
    for kind in np.column_stack([steps, edges, falling]).tolist():
        places, triangles = stitched_patch(*kind)
        at = parameters(places) * kind[:2]
        sides = np.roll(at[triangles], -1, axis=1) - at[triangles]
        sides[..., 0] *= -1.0 if kind[6] else 1.0
        away = np.abs(sides[sides.prod(-1) < -1e-9])
        back.append(away.min(-1).max(initial=0.0))
    assert max(back) == pytest.approx(0.5)


def test_many_patches_are_each_as_alone() -> None:
    rows = np.array([*kinds(50), *kinds(9)])
    found = stitched(rows[:, :2], rows[:, 2:6], rows[:, 6] > 0)
    assert sorted(set(found.rows.tolist())) == list(range(59))
    owner = found.rows[found.triangles]
    assert (owner == owner[:, :1]).all()
    for row, kind in enumerate(rows.tolist()):
        places, triangles = stitched_patch(*kind)
        first = int(np.flatnonzero(found.rows == row)[0])
        assert (found.places[found.rows == row] == places).all()
        assert (found.triangles[owner[:, 0] == row] == triangles + first).all()
