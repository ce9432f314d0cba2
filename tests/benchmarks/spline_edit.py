"""One vertex of a mesh dragged: new control nets of the whole surface spline.

The least that anybody could do is the sparse product of stencils and vertices; ours recomputes the
points that depend on the vertex, and picks the nets from them. The product is our own in numpy, or
SciPy's, which is compiled. With `layout` the mesh is laid flat as well, face by face, and its
texture nets are made.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

import numpy as np

from reparam.bench import Rows, Skipped, interleave
from reparam.geometry.meshes import torus
from reparam.geometry.net import Array
from reparam.geometry.sparse import Sparse
from reparam.geometry.surface_spline import SurfaceSpline, surface_spline
from reparam.scenes.spline_nets import maps_of, nets_of

GOAL = 3.0

ACCOUNT = """
The product is of the whole matrix; an edit touches few of its rows, so from some hundred faces on
it costs less than our own product, and about what SciPy's does. In the smallest mesh the product
takes a twentieth of a millisecond and an edit a fifth of one: calls of numpy, not arithmetic.
Laying the mesh flat is not linear in the vertices, and is done for all faces.
"""


def rows(pairs: int) -> Rows:
    """ours / the sparse product, for meshes of more and more faces."""
    for around, across in ((8, 6), (32, 24), (96, 64)):
        mesh = torus(around, across)
        spline = surface_spline(mesh.topology, 0.4)
        name = f"spline_edit/{around * across}"
        product = own_product(spline.stencils, mesh.vertices)
        for what, maps in (("nets", False), ("nets+layout", True)):
            times = interleave(edit(spline, mesh.vertices, maps), product, pairs)
            yield times.row(f"{name}/{what}", goal=GOAL, patches=len(spline.index))
        try:
            product = scipy_product(spline.stencils, mesh.vertices)
        except ImportError:
            yield Skipped(f"{name}/nets/scipy", "scipy is not installed")
            continue
        times = interleave(edit(spline, mesh.vertices, False), product, pairs)
        yield times.row(f"{name}/nets/scipy", goal=GOAL, patches=len(spline.index))


def edit(spline: SurfaceSpline, vertices: Array, maps: bool) -> Callable[[], None]:
    """Moves a vertex, a little elsewhere each time."""
    turn = iter(range(1 << 30))

    def run() -> None:
        moved = vertices.copy()
        moved[7] += 1e-3 * np.sin(next(turn))
        nets_of(spline, moved)
        if maps:
            maps_of(spline, moved)

    return run


def own_product(stencils: Sparse, vertices: Array) -> Callable[[], Array]:
    """In numpy."""
    return lambda: stencils @ vertices


def scipy_product(stencils: Sparse, vertices: Array) -> Callable[[], Array]:
    """By scipy.sparse, in rows."""
    place = (stencils.rows, stencils.columns)
    matrix = import_module("scipy.sparse").csr_matrix((stencils.values, place), stencils.shape)
    return lambda: matrix @ vertices  # type: ignore[no-any-return]
