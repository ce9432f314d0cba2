"""Figure 8: a body with three handles, smooth everywhere, from a mesh of squares."""

from __future__ import annotations

from collections.abc import Iterator

from ...geometry.evaluate import sample_surface
from ...geometry.meshes import MESHES
from ...geometry.patch_joins import joins
from ...geometry.surface_spline import surface_spline
from ..attachments import Checks, attachment
from ..claims import Claim
from ..layers import Figure, Space
from ..registry import scene
from ..remember import remember
from ..splines import (
    NO_CREASES,
    NONE_MOVED,
    Creases,
    Map,
    Moved,
    Ratio,
    built_in,
    count_words,
    distortion_words,
    edge_handles,
    moved_mesh,
    nets_of,
    patch_layers,
    ratios_of,
    spline_of,
    vertex_handles,
)


@scene(
    "Three handles, one smooth surface",
    figure=8,
    animates="ratio",
    plates=(("level=8", "shading=kind"), ("level=8", "shading=zebra")),
)
def fig8(
    ratio: Ratio = 0.5,
    texture: Map = "layout",
    checks: Checks = 4,
    creases: Creases = NO_CREASES,
    moved: Moved = NONE_MOVED,
) -> Figure:
    control = moved_mesh(built_in("three_handles"), moved)
    ratios = ratios_of(control.topology, ratio, creases)
    spline = spline_of(control.topology, ratios)
    picture = attachment(checks, "", "repeat", "smooth")
    surface = patch_layers(spline, control.vertices, texture, picture, outline=0.4)
    handles = (edge_handles(control, ratios), vertex_handles(control))
    points = sampled(nets_of(spline, control.vertices))
    body = Space("body", points, (*surface, *handles), True)
    caption = (
        f"{count_words(spline)}; blend ratio {ratio:.2g}",
        distortion_words(spline, control.vertices, texture),
    )
    return Figure((body,), caption)


sampled = remember(sample_surface)


@fig8.claims
def claims() -> Iterator[Claim]:
    found = MESHES["three_handles"]()
    t = found.topology
    statement = "vertices - edges + faces of the mesh: 2 - 2 x 3 handles"
    yield Claim("Fig. 8", statement, -4, t.euler_characteristic(), 0)
    for ratio in (0.1, 0.5, 0.9):
        report = joins(surface_spline(t, ratio).nets(found.vertices), highest=1)
        statement = f"ratio {ratio:g}, all 2176 edges: largest normal jump in degrees, largest gap"
        measured = [float(report.angles.max()), float(report.gaps.max())]
        yield Claim("Fig. 8", statement, [0.0, 0.0], measured, 1e-8)
    statement = "patches: 8 for each edge of the mesh; edges without a neighbour"
    counted = [len(surface_spline(t).facet), len(report.free)]
    yield Claim("Fig. 8", statement, [8 * 136, 0], counted, 0)
