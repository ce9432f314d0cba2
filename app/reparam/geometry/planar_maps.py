"""Maps of the square into the plane: r of equation (13), the aligned identity, and their morph.

Jorg Peters, "Change of variables" (2012), figures 4 and 5. With U = 2u-1 and V = 2v-1,

    r(u,v) = (V (3 - U^2)/2,  -U (3 - V^2)/2),

so u runs down and v runs right: r keeps the orientation and turns by -90 degrees. The
identity that goes with it is therefore (V, -U), not (U, V).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .bernstein import bernstein
from .evaluate import evaluate_derivatives, jacobian_determinant
from .net import control_net, raise_degree

Array = NDArray[np.float64]

R = control_net(
    [
        [(-1, 1), (0, 2), (1, 1)],
        [(-2, 0), (0, 0), (2, 0)],
        [(-1, -1), (0, -2), (1, -1)],
    ]
)
"""The nine coefficients (13), first index u: a net (3, 3, 4)."""

ALIGNED_IDENTITY = control_net([[(-1, 1), (1, 1)], [(-1, -1), (1, -1)]])
"""(V, -U), bilinear: a net (2, 2, 4). The square itself, seen the way r is."""


DOMAIN = control_net([[(0, 1), (1, 1)], [(0, 0), (1, 0)]])
"""(v, 1-u): the parameter square on the page, u running down and v right as they do in r."""


def morph(net: Array, weight: float) -> Array:
    """The map (1 - weight) identity + weight net, with the net's own degrees (at least 1).

    Nothing folds on the way from the aligned identity to r: det > 0 for weight < 1.
    """
    degrees = (max(net.shape[-3] - 1, 1), max(net.shape[-2] - 1, 1))
    start = raise_degree(ALIGNED_IDENTITY, *degrees)
    return np.asarray((1.0 - weight) * start + weight * raise_degree(net, *degrees))


def area(net: Array) -> float:
    """Integral of det d(x,y)/d(u,v): exact by Gauss-Legendre, for r 20/3."""
    nodes, weights = _gauss(max(net.shape[:2]))
    u, v = np.meshgrid(nodes, nodes, indexing="ij")
    return float(np.einsum("i,j,ij->", weights, weights, jacobian_determinant(net, u, v)))


def perimeter(net: Array, nodes: int = 64) -> float:
    """Length of the image of the square's boundary by Gauss-Legendre on each edge.

    For r the four edges are parabolas: 4 sqrt 2 + 4 ln(1 + sqrt 2) = 9.18234860.
    """
    t, weights = _gauss(nodes)
    zero, one = np.zeros_like(t), np.ones_like(t)
    total = 0.0
    for end in (zero, one):
        along_u, _ = evaluate_derivatives(net, t, end)
        _, along_v = evaluate_derivatives(net, end, t)
        speeds = np.hypot(along_u[:, 0], along_u[:, 1]) + np.hypot(along_v[:, 0], along_v[:, 1])
        total += float(weights @ speeds)
    return total


def determinant_coefficients(net: Array) -> Array:
    """Bernstein coefficients of det d(x,y)/d(u,v), of twice the net's degrees less one.

    If none is negative the determinant is not negative anywhere in the square: a proof where
    sampling only suggests. Shape (2 degree_u, 2 degree_v).
    """
    shape = (2 * net.shape[0] - 2, 2 * net.shape[1] - 2)
    u, v = (np.linspace(0.0, 1.0, n) for n in shape)
    values = jacobian_determinant(net, *np.meshgrid(u, v, indexing="ij"))
    rows, columns = bernstein(shape[0] - 1, u), bernstein(shape[1] - 1, v)
    return np.asarray(np.linalg.solve(rows, np.linalg.solve(columns, values.T).T))


def _gauss(nodes: int) -> tuple[Array, Array]:
    x, weights = np.polynomial.legendre.leggauss(nodes)
    return (x + 1.0) / 2.0, weights / 2.0
