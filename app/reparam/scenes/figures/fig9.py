"""Figure 9: from a mesh with a blend ratio for each edge to a smooth surface, step by step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

import numpy as np

from ...geometry.body import Body
from ...geometry.evaluate import evaluate, project
from ...geometry.mesh import mesh as mesh_from
from ...geometry.meshes import MESHES
from ...geometry.patch_joins import joins
from ...geometry.surface_spline import surface_spline
from .. import palette
from ..attachments import Checks, attachment
from ..claims import Claim
from ..layers import Color, Figure, Layer, Space
from ..legend import legend
from ..merged import Merged
from ..mesh_files import mesh_of
from ..parameters import MeshFile, Presets
from ..registry import scene
from ..spline_nets import maps_of, ratios_of, spline_of
from ..splines import (
    IDENTITY,
    NO_CREASES,
    NONE_MOVED,
    OF_EDGE,
    OF_FACE,
    OF_VERTEX,
    Creases,
    Map,
    Moved,
    Ratio,
    built_in,
    count_words,
    cut_layers,
    distortion,
    distortion_words,
    edge_handles,
    edges_of,
    mesh_layers,
    moved_mesh,
    net_layers,
    patch_layers,
    vertex_handles,
)

Step = Literal["patches", "mesh", "cut", "nets", "all"]
TITLES = {
    "mesh": "the mesh",
    "cut": "cut off",
    "nets": "coefficients read off",
    "patches": "patches",
}


@scene(
    "Surface splines: cut off corners and edges, read off the coefficients",
    figure=9,
    animates="ratio",
    plates=(("step=all",), ("ratio=0.2",), ("ratio=0.2", "texture=identity")),
)
def fig9(
    mesh: Annotated[
        str, Presets(tuple(MESHES)), MeshFile(), "the control mesh, or a file with one (.obj, .bv)"
    ] = "cube",
    step: Annotated[Step, "one step of the construction, or all side by side"] = "patches",
    ratio: Ratio = 0.5,
    texture: Map = "layout",
    checks: Checks = 4,
    creases: Creases = NO_CREASES,
    moved: Moved = NONE_MOVED,
    merged: Merged = False,
    file: Body | None = None,
) -> Figure:
    control = moved_mesh(mesh_of(file, "mesh") if file else built_in(mesh), moved)
    ratios = ratios_of(control.topology, ratio, creases)
    spline = spline_of(control.topology, ratios)
    picture = attachment(checks, "", "repeat", "smooth")

    def layers(name: str) -> tuple[Layer, ...]:
        if name == "mesh":
            return mesh_layers(control, OF_FACE)
        if name == "cut":
            return cut_layers(control, spline)
        if name == "nets":
            return net_layers(control, spline)
        surface = patch_layers(spline, control.vertices, texture, picture, merged=merged)
        return (*surface, edges_of(control, width=0.6))

    handles = (edge_handles(control, ratios), vertex_handles(control))
    panels = []
    for name in ("mesh", "nets", "cut", "patches") if step == "all" else (step,):
        content = layers(name) + (handles if name in ("patches", step) else ())
        side = 2 if step == "all" else 1
        strip = legend(f"{name}-words", TITLES[name], _entries(name), side, side)
        panels.append((strip, Space(name, control.vertices, content, True, below=True)))
    caption = (
        f"{count_words(spline, merged)}; blend ratio {ratio:.2g}",
        distortion_words(spline, control.vertices, texture),
    )
    return Figure(_columns(panels), caption)


def _entries(name: str) -> Sequence[tuple[Color, str]]:
    if name == "cut":
        return (OF_EDGE, "edge"), (OF_VERTEX, "corner")
    if name == "nets":
        return (palette.ALONG_U, "3 × 3"), (palette.ALONG_V, "4 × 4")
    return ()


def _columns(panels: list[tuple[Space, Space]]) -> tuple[Space, ...]:
    """Two panels a column, each below its strip of words."""
    spaces: list[Space] = []
    for number, (strip, space) in enumerate(panels):
        spaces += [
            Space(
                strip.name, strip.bounds, strip.layers, height=strip.height, below=number % 2 == 1
            ),
            space,
        ]
    return tuple(spaces)


@fig9.claims
def claims() -> Iterator[Claim]:
    cube = MESHES["cube"]()
    t = cube.topology
    middle = np.linspace(0.0, 1.0, 3)
    u, v = np.meshgrid(middle, middle, indexing="ij")
    for ratio in (0.1, 0.5, 0.9):
        points = project(evaluate(surface_spline(t, ratio).nets(cube.vertices), u, v))
        places = np.array([[1 - 2 * ratio / 3] * 3, [1 - ratio / 2, 1 - ratio / 2, 0], [1, 0, 0]])
        gaps = np.linalg.norm(points.reshape(-1, 1, 3) - places, axis=-1).min(0).tolist()
        statement = f"the cube at ratio {ratio:g}: distance from the points of its closed form"
        yield Claim("Fig. 9", statement, [0.0, 0.0, 0.0], gaps, 1e-14)
    gaps = []
    for name in ("cube", "tetrahedron", "octahedron", "prism7", "open_cube"):
        worst = [rough_joins(name, ratio) for ratio in (0.1, 0.5, 0.9, None)]
        angle, gap = np.max(worst, axis=0).tolist()
        gaps.append(gap)
        statement = f"{name}, ratios .1, .5, .9 and mixed: largest normal jump in degrees"
        yield Claim("Fig. 9", statement, 0.0, angle, 1e-8)
    for name in ("icosahedron", "dodecahedron", "prism8", "prism9"):
        angle, gap = rough_joins(name, None)
        gaps.append(gap)
        statement = f"{name}, each edge with its own ratio: largest normal jump in degrees"
        yield Claim("Fig. 9", statement, 0.0, angle, 1e-8)
    yield Claim("Fig. 9", "the largest gap of these, by the body's size", 0.0, max(gaps), 1e-14)
    statement = "a grid at ratio 1/2: distance from the uniform biquadratic B-spline"
    yield Claim("Fig. 9", statement, 0.0, off_the_spline(), 1e-13)
    ratios = (0.5, 0.25, 0.1)
    for name, expected in (("identity", [6.9, 41.9, 688.9]), ("layout", [1.2, 1.2, 1.3])):
        spread = []
        for ratio in ratios:
            spline = spline_of(t, ratios_of(t, ratio, NO_CREASES))
            maps = IDENTITY if name == "identity" else maps_of(spline, cube.vertices)
            _, _, low, high = distortion(spline.nets(cube.vertices), maps)
            spread.append(high / low)
        statement = f"the cube by {name}, ratios .5, .25, .1: largest area over least"
        yield Claim("Fig. 9b", statement, expected, spread, 0.1)


def rough_joins(name: str, ratio: float | None) -> tuple[float, float]:
    """The largest normal jump, in degrees, and gap over a mesh; None: all ratios differ."""
    found = MESHES[name]()
    mixed = np.random.default_rng(9).uniform(0.1, 0.9, len(found.topology.ends))
    spline = surface_spline(found.topology, mixed if ratio is None else ratio)
    report = joins(spline.nets(found.vertices), highest=1)
    return float(report.angles.max()), float(report.gaps.max())


def off_the_spline() -> float:
    """Coefficients i^2 j^2 on a grid: away from its rim the B-spline is (x^2 + 1/4) (y^2 + 1/4)."""
    x, y = np.meshgrid(np.arange(-3.0, 4.0), np.arange(-2.0, 3.0), indexing="ij")
    number = np.arange(x.size).reshape(x.shape)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1)
    grid = mesh_from(
        np.stack([x, y, x**2 * y**2], -1).reshape(-1, 3), quads.reshape(-1, 4).tolist()
    )
    t = np.linspace(0.0, 1.0, 5)
    nets = surface_spline(grid.topology, 0.5).nets(grid.vertices)
    x, y, z = project(evaluate(nets, *np.meshgrid(t, t, indexing="ij"))).reshape(-1, 3).T
    inner = (np.abs(x) <= 2.5) & (np.abs(y) <= 1.5)
    return float(np.abs(z - (x**2 + 0.25) * (y**2 + 0.25))[inner].max())
