"""What a map does to a small square: its derivative there, determinant and singular values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .evaluate import evaluate, evaluate_derivatives, project
from .net import Array

SINGULAR = 1e-9  # least singular value, in terms of the largest, of a map that can be undone


@dataclass(frozen=True)
class Stretch:
    """The derivative of a map at a point: a small square of side h becomes a parallelogram with
    sides h times the columns of `jacobian` (d, 2)."""

    jacobian: Array

    @property
    def determinant(self) -> float:
        """How areas grow; in the plane it is negative where the map turns the square over."""
        j = self.jacobian
        if len(j) == 2:
            return float(j[0, 0] * j[1, 1] - j[0, 1] * j[1, 0])
        return float(np.linalg.norm(np.cross(j[:, 0], j[:, 1])))

    @property
    def factors(self) -> tuple[float, float]:
        """The largest and the smallest factor by which lengths grow: the singular values."""
        largest, smallest = np.linalg.svd(self.jacobian, compute_uv=False)
        return float(largest), float(smallest)

    def of_unit(self, du: float, dv: float) -> Stretch:
        """Of a map whose unit square is du by dv in the parameters that count."""
        return Stretch(self.jacobian / np.array([du, dv]))

    def after(self, first: Stretch) -> Stretch | None:
        """From the image of `first`, a map of the plane, to ours; None where it is singular."""
        largest, smallest = first.factors
        if len(first.jacobian) != 2 or not smallest > SINGULAR * largest:
            return None
        return Stretch(self.jacobian @ np.linalg.inv(first.jacobian))


def stretch(net: Array, u: float, v: float) -> Stretch:
    """Of a patch (m, n, 4), rational or not, at (u,v): of a planar one, z = 0, in the plane.

    (The NURBS Book, eq. 4.20.)
    """
    point, along = evaluate(net, u, v), evaluate_derivatives(net, u, v)
    columns = [(d[:3] - d[3] * project(point)) / point[3] for d in along]
    jacobian = np.stack(columns, -1)
    return Stretch(jacobian if np.any(net[..., 2] != 0.0) else jacobian[:2])
