"""One vertex of a mesh dragged: new control nets of the whole surface spline.

The least that anybody could do is the sparse product of stencils and vertices; ours recomputes the
points that depend on the vertex, and picks the nets from them.
"""

from __future__ import annotations

import numpy as np

from reparam.bench import Rows, interleave
from reparam.geometry.meshes import torus
from reparam.geometry.surface_spline import surface_spline
from reparam.scenes.splines import nets_of

GOAL = 3.0


def rows(pairs: int) -> Rows:
    """ours / the sparse product, for meshes of more and more faces."""
    for around, across in ((8, 6), (32, 24), (96, 64)):
        mesh = torus(around, across)
        spline = surface_spline(mesh.topology, 0.4)
        stencils, vertices = spline.stencils, mesh.vertices
        nets_of(spline, vertices)
        turn = iter(range(1 << 30))

        def ours(spline=spline, vertices=vertices, turn=turn) -> None:  # type: ignore[no-untyped-def]
            moved = vertices.copy()
            moved[7] += 1e-3 * np.sin(next(turn))
            nets_of(spline, moved)

        def product(stencils=stencils, vertices=vertices) -> None:  # type: ignore[no-untyped-def]
            _ = stencils @ vertices

        times = interleave(ours, product, pairs)
        name = f"spline_edit/{around * across}"
        yield times.row(name, goal=GOAL, patches=len(spline.index))
