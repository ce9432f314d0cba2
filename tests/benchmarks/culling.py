"""What is not seen costs next to nothing.

`facing-away`, `half-outside`: the frame of the whole body over that of the same body, at the same
tolerance, with what makes patches vanish. `all-outside`: a frame of the body beside the picture
over a frame in which nothing is drawn.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import count

from frames import frames

from reparam.bench import Rows, interleave
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.meshes import MESHES
from reparam.geometry.surface_spline import surface_spline
from reparam.gpu.plans import Tolerance
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

SIZE = (512, 512)
VIEW = View(azimuth=-60.0, elevation=30.0)
GOAL = 1.5  # frames of nothing


def rows(pairs: int) -> Rows:
    """Three handles, 1088 patches, in perspective, by each evaluator."""
    studio = Studio()
    mesh = MESHES["three_handles"]()
    body = Patches(surface_spline(mesh.topology, 0.5).nets(mesh.vertices), lit=True)
    camera = frame(sample_surface(body.net), *SIZE, VIEW, True, 40.0)
    right = camera.rotation[0] * camera.half_width
    cases = {
        "facing-away": (replace(body, solid=True), camera),
        "half-outside": (body, replace(camera, center=camera.center + right)),
    }
    outside = replace(camera, center=camera.center + 4.0 * right)
    tolerance = Tolerance(0.5, SIZE)
    surfaces, turns = studio.painter.surfaces, count()
    with frames(studio, SIZE) as timed:
        for evaluator in studio.painter.capabilities.evaluators:

            def draw(
                layer: Patches = body, seen: Camera = camera, evaluator: str = evaluator
            ) -> None:
                """Seen anew each time: a view that stays is not planned again."""
                moved = replace(seen, center=seen.center + 1e-9 * next(turns))
                surfaces.draw(layer, moved, evaluator, tolerance)

            for name, (layer, seen) in cases.items():
                times = interleave(timed(partial(draw, layer, seen)), timed(draw), pairs)
                patches = len(surfaces.adaptive.plan(layer, seen, evaluator, tolerance).patches)
                yield times.row(f"culling/{name}/{evaluator}", inverse=True, patches=patches)
            assert not len(surfaces.adaptive.plan(body, outside, evaluator, tolerance).patches)
            times = interleave(timed(partial(draw, body, outside)), timed(nothing), pairs)
            yield times.row(f"culling/all-outside/{evaluator}", goal=GOAL, patches=len(body.net))


def nothing() -> None:
    """What a frame costs that is only cleared and resolved."""
