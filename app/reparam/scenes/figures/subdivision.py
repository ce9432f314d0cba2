"""Subdivision where n quads meet: (u, v) blow up or vanish, characteristic coordinates do not."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Annotated

import numpy as np

from ...geometry import subdivision as catmull_clark
from ...geometry.evaluate import jacobian_determinant
from ...geometry.patch_joins import joins
from ...geometry.surface_spline import surface_spline
from ..attachments import attachment
from ..claims import Claim
from ..layers import Array, Figure, Layer, Patches, Picture, Polylines, Space, Texture
from ..parameters import Range
from ..registry import scene
from ..splines import IDENTITY, outlines, polylines

LEVELS = 7
STEP = 8  # squares to a unit of (u, v)
GRID = (0.25, 0.25, 0.25)


@scene(
    "Subdivision around an extraordinary point: (u, v) against characteristic coordinates",
    plates=(("valence=3",), ("valence=8",)),
)
def subdivision(
    valence: Annotated[int, Range(3, 12), "how many quads meet in the middle"] = 5,
    levels: Annotated[int, Range(1, 10), "rings, each half as large in (u, v)"] = LEVELS,
) -> Figure:
    nets, edges, by_parameter, by_chi = disc(valence, levels)
    factor = 2.0 * catmull_clark.subdominant(valence)
    spline, spline_edges = spline_disc(valence)
    squares = Picture("checkerboard", scale=STEP / 2.0, offset=0.0)
    fine = attachment(2, "", "repeat", "smooth")
    bounds = nets[..., :3].reshape(-1, 3)

    def space(name: str, title: str, *layers: Layer) -> Space:
        return Space(name, bounds, layers, title=title)

    lines, spline_lines = Polylines(edges, GRID, 0.5), Polylines(spline_edges, GRID, 0.3)
    in_parameters, in_chi = (Texture(map, squares) for map in (by_parameter, by_chi))
    own = Texture(IDENTITY, fine)
    spaces = (
        space("parameters", "squares in (u, v)", Patches(nets, in_parameters), lines),
        space("characteristic", "squares in (χ₁, χ₂)", Patches(nets, in_chi), lines),
        space("spline", "a surface spline there", Patches(spline, own), spline_lines),
    )
    does = "keep their size" if valence == 4 else "grow" if factor > 1.0 else "shrink"
    caption = (
        f"λ = {factor / 2:.5f}: from ring to ring the squares {does}, by 2λ = {factor:.4f}",
        f"after {levels - 1} rings by {factor ** (levels - 1):.3g}; those of χ keep theirs",
    )
    return Figure(spaces, caption)


@cache
def disc(n: int, levels: int) -> tuple[Array, Array, Array, Array]:
    """Nets of all rings, their edges, and two texture maps: (u, v) of the sector, and chi."""
    first = catmull_clark.ring(n, catmull_clark.characteristic_points(n))
    nets = catmull_clark.rings(first, catmull_clark.subdominant(n), levels)
    parameters = catmull_clark.rings(catmull_clark.parameters(n), 0.5, levels)
    sides = [nets[:, 0], nets[:, -1], nets[:, :, 0], nets[:, :, -1]]
    return nets, polylines(np.concatenate(sides)), parameters, nets


@cache
def spline_disc(n: int) -> tuple[Array, Array]:
    """The surface spline over the same control points: its nets and their edges."""
    mesh = catmull_clark.star(n)
    spline = surface_spline(mesh.topology)
    nets = spline.nets(mesh.vertices)
    return nets, outlines(spline.index, nets)


@subdivision.claims
def claims() -> Iterator[Claim]:
    valences = range(3, 13)
    values = [
        sorted(np.linalg.eigvals(catmull_clark.matrix(n)).real.tolist())[-3:-1] for n in valences
    ]
    formula = [catmull_clark.subdominant(n) for n in valences]
    for k in (0, 1):
        statement = f"eigenvalue {k + 2} of subdivision for n = 3 .. 12, and its formula"
        yield Claim("§5", statement, formula, [pair[k] for pair in values], 1e-12)
    t = np.linspace(0.0, 1.0, 21)
    u, v = np.meshgrid(t, t, indexing="ij")
    least = []
    for n in valences:
        first = catmull_clark.ring(n, catmull_clark.characteristic_points(n))
        least.append(float(jacobian_determinant(first, u, v).min()))
    statement = "least det of the characteristic map for n = 3, 4, 5, 6, 8, 12: positive, injective"
    chosen = [least[n - 3] for n in (3, 4, 5, 6, 8, 12)]
    yield Claim("§5", statement, [1.665, 1.0, 0.531, 0.351, 0.206, 0.115], chosen, 1e-3)
    nets = disc(5, 2)[0]
    report = joins(nets)
    statement = "n = 5, patches of a ring: joins inside it that are not G3"
    yield Claim("§5", statement, 0, int((report.orders < 3).sum()), 0)
