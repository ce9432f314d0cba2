"""How patches join along their edges: gap, tangent plane, and the change of variables of (14).

Both patches are written so that the shared edge is x = 0 and runs with y. They join smoothly of
order k (G^k) if g continues f after a change of variables r that keeps the edge,

        y ^                g(x, y) = f(r(x, y)) to order k at x = 0,
          |
     f    |    g           r_x = (-beta, alpha),   beta > 0 or the surface folds back.
    <-----+----->
    x     |      x

Where f and g agree along the edge, their derivatives along it do; so at each of its points only
the derivatives across, d^m g/dx^m, must be matched. Two of their three components determine r, the
third, along the normal, is the jump of order m.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .curve import curve_points, restrict
from .edge_pairs import edge_nets, edge_pairs
from .evaluate import project
from .net import Array
from .normal import surface_normal
from .partials import partials

Indices = NDArray[np.intp]

SIDES = ("u=0", "u=1", "v=0", "v=1")
HIGHEST = 3
SAMPLES = 50
TOLERANCE = 1e-6
SINGULAR_SINE = 1e-6  # a sample where the tangents of a patch are so nearly parallel is passed over
CHUNK = 4096  # joins analysed at a time


@dataclass(frozen=True, eq=False)
class Joins:
    """The joins of many patches; J of them, S samples along each, r's derivatives in (x, y).

    Lengths are in the body's size, the diagonal of its box: `jumps` (J, K) are the largest jumps of
    order 1, an angle in radians, and of 2 and 3, normal parts of the derivatives by arc length.
    NaN where all samples are singular.
    """

    patches: Indices  # (J, 2)
    sides: Indices  # (J, 2) indices of SIDES
    spans: Array  # (J, 2, 2) low and high: the part of each edge; the first is whole
    reversed: NDArray[np.bool_]  # (J,) whether the edge runs the other way in the second patch
    opposed: NDArray[np.bool_]  # (J,) whether p_u x p_v of the two have opposite sides
    gaps: Array  # (J,)
    jumps: Array  # (J, K)
    r: Array  # (J, K, S, 2): r_x, r_xx, r_xxx
    free: Indices  # (K, 2) patch and side of the edges that others do not cover
    points: int  # edges that have shrunk to a point
    size: float
    tolerance: float

    @cached_property
    def beta(self) -> Array:
        """(J, S), positive where the surface goes on."""
        return -self.r[:, 0, :, 0]

    @cached_property
    def alpha(self) -> Array:
        """(J, S), the shear along the edge."""
        return self.r[:, 0, :, 1]

    @cached_property
    def angles(self) -> Array:
        """(J,) the largest angle between the tangent planes, degrees; 180 where it folds back."""
        return np.degrees(self.jumps[:, 0])

    @cached_property
    def orders(self) -> Indices:
        """(J,) the highest k with G^k, up to K."""
        with np.errstate(invalid="ignore"):
            smooth = self.jumps <= self.tolerance
        return np.asarray(np.cumprod(smooth, axis=1).sum(1))


def joins(
    nets: Array, tolerance: float = TOLERANCE, samples: int = SAMPLES, highest: int = HIGHEST
) -> Joins:
    """All pairs of edges of nets (P, m, m, 4) that coincide, forwards or backwards, and of edges
    that are a half, quarter or eighth of another.

    `tolerance` is for gaps, relative to the size of the body, and for `orders`; derivatives are
    compared up to the order `highest`, K = 1, 2 or 3.
    """
    t = np.linspace(0.0, 1.0, samples)
    affine = project(nets[nets[..., 3] > 0.0])
    size = float(np.linalg.norm(np.ptp(affine, axis=0))) or 1.0
    number = np.arange(4 * len(nets))
    curves = edge_nets(nets, number // 4, number % 4)
    length = np.linalg.norm(np.diff(curve_points(curves, t), axis=1), axis=-1).sum(1)
    points = length <= tolerance * size
    pairs = edge_pairs(curves, ~points, tolerance * size, samples)
    first, second = pairs.edges.T
    gaps = np.zeros(len(first))
    jumps = np.zeros((len(first), highest))
    r = np.zeros((len(first), highest, samples, 2))
    for start in range(0, len(first), CHUNK):
        part = slice(start, start + CHUNK)
        spans, backwards = pairs.spans[part], pairs.backwards[part]
        f = _from_edge(nets, first[part], spans[:, 0], np.zeros(len(spans), bool))
        g = _from_edge(nets, second[part], spans[:, 1], backwards)
        gaps[part], jumps[part], r[part] = _compare(f, g, t, size, highest)
    parity = np.array([1, -1, -1, 1])
    turned = parity[first % 4] * parity[second % 4] * np.where(pairs.backwards, -1, 1)
    return Joins(
        pairs.edges // 4, pairs.edges % 4, pairs.spans, pairs.backwards, turned > 0, gaps, jumps, r,
        np.stack([pairs.free // 4, pairs.free % 4], -1), int(points.sum()), size, tolerance,
    )  # fmt: skip


def _from_edge(nets: Array, edges: Indices, spans: Array, backwards: NDArray[np.bool_]) -> Array:
    """The patches of these edges, written so that the part of the edge from low to high is x = 0,
    y running as asked."""
    side = (edges % 4)[:, None, None, None]
    chosen = nets[edges // 4]
    chosen = np.where(side >= 2, chosen.swapaxes(1, 2), chosen)
    chosen = np.where(side % 2 == 1, chosen[:, ::-1], chosen)
    for low, high in np.unique(spans, axis=0):
        here = (spans == (low, high)).all(1)
        chosen[here] = restrict(chosen[here], low, high)
    return np.where(backwards[:, None, None, None], chosen[:, :, ::-1], chosen)


def _compare(f: Array, g: Array, t: Array, size: float, highest: int) -> tuple[Array, Array, Array]:
    """Gaps (J,), jumps (J, K) and r's derivatives (J, K, S, 2) along the edges x = 0."""
    edge = np.zeros_like(t)
    F, G = partials(f, edge, t, highest), partials(g, edge, t, highest)
    F, G = F / size, G / size
    gaps = np.linalg.norm(F[0, 0] - G[0, 0], axis=-1).max(1)
    f_x, f_y = F[1, 0], F[0, 1]
    n_f, n_g = np.cross(f_x, f_y), np.cross(G[1, 0], G[0, 1])
    singular = _is_singular(n_f, f_x, f_y) | _is_singular(n_g, G[1, 0], G[0, 1])
    with np.errstate(invalid="ignore", divide="ignore"):
        # On the other side of the edge x runs the other way: -n_g continues n_f.
        angle = np.arctan2(np.linalg.norm(np.cross(n_f, n_g), axis=-1), -(n_f * n_g).sum(-1))
        unit = n_f / np.linalg.norm(n_f, axis=-1, keepdims=True)
        speed = np.linalg.norm(G[1, 0], axis=-1)
        r = np.empty((highest, *n_f.shape[:2], 2))
        jump = np.empty((highest, *n_f.shape[:2]))
        for m in range(highest):
            rest = G[m + 1, 0] - _already_matched(F, r, m + 1)
            r[m] = _in_tangent_plane(rest, f_x, f_y, n_f)
            jump[m] = np.abs((rest * unit).sum(-1)) / speed ** (m + 1)
    jump[0] = angle
    jump[:, singular] = -1.0
    r[:, singular] = np.nan
    largest = jump.max(-1)
    return gaps, np.where(largest < 0.0, np.nan, largest).T, np.moveaxis(r, 0, 1)


def _is_singular(normal: Array, a: Array, b: Array) -> NDArray[np.bool_]:
    product = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
    return np.asarray(np.linalg.norm(normal, axis=-1) <= SINGULAR_SINE * product)


def _already_matched(F: Array, r: Array, m: int) -> Array:
    """d^m/dx^m f(r(x, y)) without the terms of r's own m-th derivative (Faa di Bruno)."""
    if m == 1:
        return np.zeros(1)
    a, b = r[0, ..., :1], r[0, ..., 1:]
    if m == 2:
        return np.asarray(a * a * F[2, 0] + 2.0 * a * b * F[1, 1] + b * b * F[0, 2])
    c, d = r[1, ..., :1], r[1, ..., 1:]
    third = a**3 * F[3, 0] + 3.0 * a * b * (a * F[2, 1] + b * F[1, 2]) + b**3 * F[0, 3]
    mixed = a * c * F[2, 0] + (a * d + b * c) * F[1, 1] + b * d * F[0, 2]
    return np.asarray(third + 3.0 * mixed)


def _in_tangent_plane(vector: Array, f_x: Array, f_y: Array, normal: Array) -> Array:
    """(a, b) with a f_x + b f_y the part of the vector in the tangent plane."""
    area = (normal * normal).sum(-1)
    a = (np.cross(vector, f_y) * normal).sum(-1) / area
    b = (np.cross(f_x, vector) * normal).sum(-1) / area
    return np.stack([a, b], -1)


def fold(nets: Array, level: int = 32) -> Array:
    """(P,) the smallest cosine between the normals of neighbours on a grid of each patch.

    Near 1 for a patch without folds; negative where the surface turns back within a cell.
    """
    t = np.linspace(0.0, 1.0, level + 1)
    normals = surface_normal(nets, *np.meshgrid(t, t, indexing="ij"))
    along_u = (normals[:, 1:] * normals[:, :-1]).sum(-1).min((1, 2))
    along_v = (normals[:, :, 1:] * normals[:, :, :-1]).sum(-1).min((1, 2))
    return np.asarray(np.minimum(along_u, along_v))
