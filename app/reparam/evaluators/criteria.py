"""What the sampling methods ask of a cell: its excess, 1 where it just keeps the tolerance.

GLU_PATH_LENGTH: no edge of a triangle in the cell, diagonals included, is longer than the
tolerance. GLU_PARAMETRIC_ERROR: no point of a triangle in the cell is farther from the surface,
in space; with the second derivatives M over a cell of a x b (D. Filip, R. Magedson, R. Markot,
Surface algorithms using bounds on derivatives, CAGD 3 (1986), 295-311)

    (M_uu a^2 + 2 M_uv a b + M_vv b^2) / 8

Both are bounds from the control net, not samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.derivative_bounds import bounds, directional_bound
from ..geometry.extraction import restricted
from ..geometry.net import Array
from .glu_constants import (
    GLU_DOMAIN_DISTANCE,
    GLU_OBJECT_PATH_LENGTH,
    GLU_PARAMETRIC_ERROR,
    GLU_PATH_LENGTH,
)
from .nurbs_properties import View
from .splines import Nurbs

NEAREST = 1e-3  # of the largest depth


@dataclass(frozen=True, eq=False)
class PathLength:
    """Edges in pixels, or with no view in object units."""

    tolerance: float
    view: View | None
    power: ClassVar[int] = 1  # the excess goes with this power of the cell's size
    border: ClassVar[float] = 0.9  # what a border may take of the tolerance

    def excess(self, nets: Array, a: ArrayLike, b: ArrayLike) -> Array:
        """Of cells a x b in the own parameters of nets (..., m, n, 4); infinite without a bound."""
        both = [self._longest(nets, a, sign * np.asarray(b)) for sign in (1, -1)]
        return np.maximum(*both)

    def triangles(self, net: Array, triangles: Array) -> Array:
        """Of triangles (t, 3, 2) in the parameters of a net (m, n, 4): (t,)."""
        edge = np.stack([triangles, np.roll(triangles, -1, 1)], 2).reshape(-1, 2, 2)
        rising = (edge[:, 1] - edge[:, 0]).prod(-1) >= 0.0
        cells = restricted(net, edge.min(1), edge.max(1))
        found = self._longest(cells, 1.0, np.where(rising, 1.0, -1.0))
        return np.asarray(found.reshape(-1, 3).max(1))

    def _longest(self, nets: Array, a: ArrayLike, b: ArrayLike) -> Array:
        if self.view is None:
            return directional_bound(nets, a, b) / self.tolerance
        longest = directional_bound(nets @ self.view.pixels_from_object.T, a, b)
        return np.where(eye_within_reach(nets, self.view), np.inf, longest / self.tolerance)


@dataclass(frozen=True, eq=False)
class ParametricError:
    """Distances in pixels, or with no view in object units."""

    tolerance: float
    view: View | None
    power: ClassVar[int] = 2
    border: ClassVar[float] = 0.4

    def excess(self, nets: Array, a: ArrayLike, b: ArrayLike) -> Array:
        """Of cells a x b in the own parameters of nets (..., m, n, 4); infinite without a bound."""
        a, b = np.asarray(a), np.asarray(b)
        found = bounds(nets)
        error = (found.uu * a * a + 2.0 * found.uv * a * b + found.vv * b * b) / 8.0
        if self.view is None:
            return np.asarray(error / self.tolerance)
        error = error * pixels_per_unit(nets, self.view) / self.tolerance
        return np.where(eye_within_reach(nets, self.view), np.inf, error)

    def triangles(self, net: Array, triangles: Array) -> Array:
        """Of triangles (t, 3, 2) in the parameters of a net (m, n, 4): (t,)."""
        return self.excess(restricted(net, triangles.min(1), triangles.max(1)), 1.0, 1.0)


Criterion = PathLength | ParametricError


def criterion(nurbs: Nurbs) -> Criterion | None:
    """That of the sampling method; none for GLU_DOMAIN_DISTANCE."""
    properties = nurbs.properties
    method = properties.sampling_method
    if method == GLU_DOMAIN_DISTANCE:
        return None
    on_screen = method in (GLU_PATH_LENGTH, GLU_PARAMETRIC_ERROR)
    view = nurbs.view if on_screen else None
    if method in (GLU_PATH_LENGTH, GLU_OBJECT_PATH_LENGTH):
        return PathLength(properties.sampling_tolerance, view)
    return ParametricError(properties.parametric_tolerance, view)


def eye_within_reach(nets: Array, view: View) -> NDArray[np.bool_]:
    """Whether nets (..., m, n, 4) come so close to the plane of the eye that sizes in pixels mean
    nothing."""
    depth = (nets @ view.pixels_from_object[2]) / np.where(nets[..., 3] > 0.0, nets[..., 3], 1.0)
    return np.asarray(depth.min((-2, -1)) <= NEAREST * np.abs(depth).max((-2, -1)))


def pixels_per_unit(nets: Array, view: View) -> Array:
    """How many pixels a step of length 1 can be, anywhere in each net's hull and in any direction.

    Nets (..., m, n, 4) in front of the eye. Depth counts as much as width: a hill seen from above
    keeps its shape.
    """
    matrix = view.pixels_from_object
    seen = nets @ matrix.T
    depth = seen[..., 2] / np.where(nets[..., 3] > 0.0, nets[..., 3], 1.0)
    pixels = seen[..., :2] / np.where(seen[..., 2:] > 0.0, seen[..., 2:], 1.0)
    box = np.stack([pixels.min((-3, -2)), pixels.max((-3, -2))])
    x, y = box[[0, 0, 1, 1], ..., 0], box[[0, 1, 0, 1], ..., 1]
    # d(pixel)/d(point), times the depth: linear in the pixel, so the largest is at a corner.
    jacobians = matrix[:2, :3] - np.stack([x, y], -1)[..., None] * matrix[2, :3]
    largest = np.linalg.norm(jacobians, ord=2, axis=(-2, -1)).max(0)
    nearest = depth.min((-2, -1))
    return np.asarray(largest / np.where(nearest > 0.0, nearest, 1.0))
