"""One point dragged in a large model: a frame after the edit over a frame without any.

`edit/100000`: a control point of one patch of many; the edit hands in a new net, as a scene does,
and nobody says what has changed. `edit/spline`: one vertex of a mesh whose surface spline has
about as many patches, lit and textured by each patch's (u, v) or by the mesh laid flat; its layers
are computed from the vertices within the frame.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.bench import Rows, interleave
from reparam.geometry.camera import View, frame
from reparam.geometry.meshes import torus
from reparam.geometry.net import Array
from reparam.geometry.surface_spline import SurfaceSpline
from reparam.scenes.layers import Layer, Patches, Picture
from reparam.scenes.spline_nets import spline_of
from reparam.scenes.splines import patch_layers
from reparam.snapshot import Studio

GOAL = 1.2
PATCHES = 100_000
LEVEL = 2
SIZE = (1024, 1024)
MESH = (96, 64)  # faces around and across a torus: 16 patches each

ACCOUNT = """
Before, any change uploaded and evaluated the whole net: a frame with an edit cost 1.7 to 2.2 times
one without. Now the new net is compared with the one on the GPU, bit by bit in blocks that fit the
cache (2.3 ms for 100,000 patches), the runs of patches that differ are written into the texture and
evaluated into their places in the vertex buffers. No scene has to say what it changed; a hint
would save the comparison, a hundredth of this frame. What remains is copying the net in numpy.
"""

Draw = Callable[[], None]


def rows(pairs: int) -> Rows:
    """The frame with an edit over the frame without, for each model and evaluator."""
    studio = Studio()
    evaluators = ["vertex", "tessellation"][: 1 + studio.painter.capabilities.tessellation]
    for evaluator in evaluators:
        for lit in (False, True):
            steady, edited = many_patches(studio, evaluator, lit)
            with frames(studio, SIZE) as drawn:
                times = interleave(drawn(edited), drawn(steady), pairs)
            look = "lit" if lit else "unlit"
            yield times.row(f"edit/{PATCHES}/{evaluator}/{look}", goal=GOAL, level=LEVEL)
    mesh = torus(*MESH)
    spline = spline_of(mesh.topology, np.full(len(mesh.topology.ends), 0.4))
    settings = {"level": LEVEL, "faces": len(mesh.topology.sizes), "patches": len(spline.index)}
    for texture in ("identity", "layout"):
        steady, edited = surface_spline(studio, spline, mesh.vertices, texture)
        with frames(studio, SIZE) as drawn:
            times = interleave(drawn(edited), drawn(steady), pairs)
        yield times.row(f"edit/spline/{texture}", goal=GOAL, **settings)


def many_patches(studio: Studio, evaluator: str, lit: bool) -> tuple[Draw, Draw]:
    """Drawing a model as it is, and after another edit."""
    layer = Patches(wavy_patches(PATCHES, 2), lit=lit)
    random = np.random.default_rng(2)

    def steady() -> None:
        studio.painter.surfaces.draw(layer, FROM_ABOVE, evaluator, LEVEL)
        end_frame(studio)

    def edited() -> None:
        nonlocal layer
        nets = layer.net.copy()
        nets[random.integers(PATCHES), 1, 1, 2] += 1e-3
        layer = Patches(nets, lit=lit)
        steady()

    return steady, edited


def surface_spline(
    studio: Studio, spline: SurfaceSpline, vertices: Array, texture: str
) -> tuple[Draw, Draw]:
    """The same of a surface spline, whose vertices are dragged."""
    camera = frame(vertices, *SIZE, View(), True)
    random = np.random.default_rng(3)

    def layers() -> Sequence[Layer]:
        return patch_layers(spline, vertices, texture, Picture(), outline=0.0)

    shown = layers()

    def steady() -> None:
        for layer in shown:
            assert isinstance(layer, Patches)
            studio.painter.surfaces.draw(layer, camera, "vertex", LEVEL, by_sample=True)
        end_frame(studio)

    def edited() -> None:
        nonlocal vertices, shown
        vertices = vertices.copy()
        vertices[random.integers(len(vertices))] *= 1.001
        shown = layers()
        steady()

    return steady, edited


def end_frame(studio: Studio) -> None:
    """What the painter does after each frame."""
    studio.painter.evaluation.sweep()
    studio.painter.surfaces.sweep()
