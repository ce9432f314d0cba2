"""Trims: what libGLU's triangles cover is what ours leaves, but for its polygons' chords."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from evaluator_truth import Array
from numpy.typing import NDArray
from nurbs_outputs import Theirs, areas

from reparam.evaluators.splines import Nurbs

if TYPE_CHECKING:
    from parity import Row

LARGEST_SAGITTA = 0.2  # of the domain: libGLU's chords and ours, of a circle that it makes three
SAMPLES = 1500


def compare_regions(nurbs: Nurbs, theirs: Theirs, domain: Array, row: Row) -> None:
    """Points farther from the trims than libGLU's polygons are stay in both or in neither."""
    assert nurbs.region is not None
    uv, size = theirs.fields["uv"], np.diff(domain).ravel()
    square = (uv - domain[:, 0]) / size
    edges = boundary_edges(square, theirs.triangles)
    points = np.concatenate([edges, edges.mean(1, keepdims=True)], 1)
    inner = ((points > 1e-6) & (points < 1 - 1e-6)).all(-1)
    away = np.zeros(points.shape[:2])
    where = domain[:, 0] + points[inner] * size
    away[inner] = np.abs(nurbs.region.signed_distance(*where.T))
    sagitta = float(away.max(initial=0.0))
    if sagitta > LARGEST_SAGITTA:
        row.complaint = f"expected trims within {LARGEST_SAGITTA}, found them {sagitta:.2g} apart"
        return
    samples = np.random.default_rng(0).uniform(0.0, 1.0, (SAMPLES, 2))
    where = domain[:, 0] + samples * size
    distance = nurbs.region.signed_distance(*where.T)
    margin = 1.5 * sagitta + 1e-4  # a chord is not farthest off at its middle
    clear = np.abs(distance) > margin
    covered = covers(square, theirs.triangles, samples[clear])
    wrong = int((covered != (distance[clear] > 0.0)).sum())
    row.rows += int(clear.sum())
    if wrong:
        row.complaint = f"{wrong} of {clear.sum()} sample points lie on the other side of a trim"
    found = float(np.abs(areas(square, theirs.triangles).sum()))
    exact = nurbs.region.area() / float(size.prod())
    lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=-1)
    between = float((lengths * (1.5 * away.max(1, initial=0.0) + 1e-4)).sum())
    if abs(found - exact) > between:
        row.complaint = f"expected an area of {exact:.6g}, found {found:.6g}"


def boundary_edges(points: Array, triangles: NDArray[np.intp]) -> Array:
    """Edges (p, 2, 2) that have no twin, and are not covered on both sides: libGLU's triangles
    have T-junctions."""
    keys = np.unique(points.round(6), axis=0, return_inverse=True)[1].reshape(-1)[triangles]
    edges = np.stack([keys, np.roll(keys, -1, 1)], -1).reshape(-1, 2)
    corners = np.stack([triangles, np.roll(triangles, -1, 1)], -1).reshape(-1, 2)
    proper = edges[:, 0] != edges[:, 1]
    edges, corners = edges[proper], corners[proper]
    _, which, counts = np.unique(np.sort(edges, 1), axis=0, return_inverse=True, return_counts=True)
    lonely = points[corners[counts[which.reshape(-1)] == 1]]
    along = lonely[:, 1] - lonely[:, 0]
    left = np.stack([-along[:, 1], along[:, 0]], -1) / np.linalg.norm(along, axis=-1)[:, None]
    sides = [covers(points, triangles, lonely.mean(1) + s * 1e-4 * left) for s in (1, -1)]
    return lonely[~(sides[0] & sides[1])]


def covers(points: Array, triangles: NDArray[np.intp], samples: Array) -> NDArray[np.bool_]:
    """Whether samples (k, 2) lie in one of the triangles."""
    corners = points[triangles]
    corners = corners[areas(points, triangles) != 0.0]
    inside = np.zeros(len(samples), bool)
    for some in np.array_split(np.arange(len(corners)), max(1, len(corners) // 200)):
        a = corners[some][:, None]
        to = samples[None, :, None] - a
        along = np.roll(a, -1, 2) - a
        side = along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0]
        inside |= ((side >= 0.0).all(-1) | (side <= 0.0).all(-1)).any(0)
    return inside
