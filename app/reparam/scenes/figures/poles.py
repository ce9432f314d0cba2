"""Why a sphere must have singular points, and of all closed surfaces only a torus need not.

Where quads meet four by four, u and v run on for ever: a periodic parameterisation. Points where n
other than four meet are singular, and (4 - n)/4 summed over them is the Euler characteristic: 2 for
a sphere, 0 for a torus, -4 for three handles.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np

from ...geometry.mesh import Topology
from ...geometry.meshes import MESHES
from ...geometry.normal import surface_normal
from ...geometry.surface_spline import surface_spline
from .. import palette
from ..attachments import Checks, attachment
from ..claims import Claim
from ..layers import Array, Color, Dots, Figure, Layer, Patches, Polylines, Space, Texture
from ..legend import legend
from ..registry import scene
from ..splines import IDENTITY, built_in, outlines

BODIES = {"cube": ("sphere", 2), "torus": ("torus", 2), "three_handles": ("3 handles", 1)}
COLORS: dict[int, Color] = {3: palette.SMOOTH, 5: palette.SHARP}

LIFT = 0.05


@scene(
    "Poles: how many quads meet in a point knows how many handles there are",
    plates=(("level=8",),),
)
def poles(checks: Checks = 2) -> Figure:
    picture = attachment(checks, "", "repeat", "smooth")
    spaces: list[Space] = []
    for name, (words, rows) in BODIES.items():
        nets, lines, at = surface_and_poles(name)
        layers: list[Layer] = [
            Patches(nets, Texture(IDENTITY, picture), lit=True, solid=True),
            Polylines(lines, palette.INK, 0.3),
            *(Dots(points, COLORS[n], 4.0) for n, points in at.items()),
        ]
        title = f"{words}, Σ = {index_sum(name):g}".replace("-", "−")
        counts = [(COLORS[n], f"{len(points)} × {n}") for n, points in at.items()]
        strip = legend(f"{name}-words", title, counts, rows, 2)
        below = name == "torus"
        spaces.append(
            Space(strip.name, strip.bounds, strip.layers, height=strip.height, below=below)
        )
        spaces.append(Space(name, nets[..., :3].reshape(-1, 3), tuple(layers), True, below=True))
    caption = (
        "Σ (4 − n)/4 over the points where n patches meet is the Euler characteristic",
        "where n = 4 in every point, u and v run on without end",
    )
    return Figure(tuple(spaces), caption)


@cache
def surface_and_poles(name: str) -> tuple[Array, Array, dict[int, Array]]:
    """Nets and outlines of the spline over a mesh, its singular points by how many patches meet."""
    control = built_in(name)
    spline = surface_spline(control.topology)
    nets = spline.nets(control.vertices)
    irregular = {n: spline.facet == n for n in np.unique(spline.facet).tolist() if n != 4}
    poles = {}
    for n, chosen in irregular.items():
        at, first = np.unique(nets[chosen, 0, 0, :3], axis=0, return_index=True)
        outwards = surface_normal(nets[chosen][first], 0.0, 0.0)
        poles[n] = at + LIFT * outwards  # or the surface would hide half of a disc
    return nets, outlines(spline.index, nets), poles


def index_sum(name: str) -> float:
    """The sum of (4 - n)/4 over the singular points."""
    return sum((4 - n) / 4 * len(points) for n, points in surface_and_poles(name)[2].items())


def valence_sum(t: Topology) -> float:
    """The same over the vertices of a mesh of quads."""
    return float(((4 - t.valence) / 4).sum())


@poles.claims
def claims() -> Iterator[Claim]:
    for name, (words, _) in BODIES.items():
        t = MESHES[name]().topology
        statement = (
            f"{words}: vertices - edges + faces, sum over the mesh, over the patches' corners"
        )
        sums = [valence_sum(t), index_sum(name)]
        yield Claim("Fig. 8", statement, [t.euler_characteristic()] * 2, sums, 1e-12)
    singular = [sum(len(at) for at in surface_and_poles(name)[2].values()) for name in BODIES]
    yield Claim(
        "Fig. 8", "singular points of sphere, torus, three handles", [8, 0, 32], singular, 0
    )
