"""What the GPU should have evaluated: float64, from its own float32 (u, 1-u, v, 1-v) and net."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reparam.geometry.bernstein import bernstein
from reparam.geometry.evaluate import evaluate_derivatives, project
from reparam.geometry.net import Array
from reparam.geometry.normal import projected_derivative, safe_normalize
from reparam.gpu.readback import Points

CLEAR = 0.2  # least sine between the tangents, least ratio of their lengths, to judge a normal


@dataclass(frozen=True)
class Errors:
    """The largest: of a point, in units of the largest affine coefficient, and of a normal."""

    point: float
    normal: float


def random_nets(
    random: np.random.Generator, degrees: tuple[int, int], rational: bool, patches: int = 3
) -> Array:
    """Nets (patches, m, n, 4) without any symmetry; the weights go from .1 to 10."""
    shape = (patches, degrees[0] + 1, degrees[1] + 1)
    nets = np.ones((*shape, 4))
    nets[..., :3] = random.uniform(-1.0, 1.0, (*shape, 3))
    if rational:
        nets *= 10.0 ** random.uniform(-1.0, 1.0, (*shape, 1))
    return nets


def errors(nets: Array, found: Points) -> Errors:
    """How far the GPU is off, over all patches of `nets` (patches, m, n, 4)."""
    assert len(nets) == len(found.points)
    worst_point = worst_normal = 0.0
    for net, parameters, points, normals in zip(
        nets.astype(np.float32).astype(np.float64),
        found.parameters.astype(np.float64),
        found.points.astype(np.float64),
        found.normals,
        strict=True,
    ):
        u, s, v, t = parameters.T
        row, column = bernstein(len(net) - 1, u, s), bernstein(len(net[0]) - 1, v, t)
        exact = np.einsum("ki,kj,ijc->kc", row, column, net)
        size = np.abs(project(net)).max()
        worst_point = max(worst_point, float(np.abs(project(points) - project(exact)).max() / size))
        p_u, p_v = (projected_derivative(exact, d) for d in evaluate_derivatives(net, u, v))
        normal = np.cross(safe_normalize(p_u), safe_normalize(p_v))
        lengths = np.linalg.norm([p_u, p_v], axis=-1)
        clear = np.linalg.norm(normal, axis=-1) > CLEAR
        clear &= lengths.min(0) > CLEAR * lengths.max()
        off = np.linalg.norm(normals - safe_normalize(normal), axis=-1)[clear]
        worst_normal = max(worst_normal, float(off.max(initial=0.0)))
    return Errors(worst_point, worst_normal)
