"""Triangles of the coarsest uniform level that is as accurate as our adaptive ones, over ours.

Accuracy is measured, at every fragment, as `reparam accuracy` does it; triangles are counted by
OpenGL. With the whole body in view, and in close-ups where most patches are out of view.

Of a quadratic patch's bound a tenth to a quarter is left over, since f'' might be at its largest
for each edge of a triangle at another place. Third derivatives tell that it is not: 12 to 15
percent fewer triangles where the blend ratio is 0.1, up to 7 elsewhere. That is not done: where
triangles are seen from their edge, more than one fragment in 10,000 was then beyond the tolerance
(three handles, ratio 0.1, by tessellation on llvmpipe).
"""

from __future__ import annotations

import numpy as np

from reparam.accuracy import FORGIVEN
from reparam.bench import Row, Rows, Skipped
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.meshes import MESHES
from reparam.geometry.net import Array
from reparam.geometry.planar_maps import R
from reparam.geometry.surface_spline import surface_spline
from reparam.geometry.torus import two_halves
from reparam.gpu.accuracy import Drawn, deviations
from reparam.gpu.plans import Plan, Tolerance, uniform_plan
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

SIZE = (512, 512)
TOLERANCE = 0.5
FINEST = 96  # above, the ratio is at least what is reported
ZOOMS = {"whole": 1.0, "close-up": 8.0}
GOALS = {"whole": 0.85, "close-up": 0.85}
MEANS = {"whole": 1.5, "close-up": 4.0}  # of all bodies, geometric
SOLIDS = ("cube", "tetrahedron", "octahedron", "icosahedron", "dodecahedron", "three_handles")
SPLINES = [*((name, 0.5) for name in SOLIDS), ("cube", 0.1), ("three_handles", 0.1)]
AZIMUTH, ELEVATION = -60.0, 30.0


def bodies() -> dict[str, Array]:
    """Nets of the project's own bodies."""
    found = {"r": R[None], "torus-halves": two_halves().patches().reshape(-1, 3, 3, 4)}
    for name, ratio in SPLINES:
        mesh = MESHES[name]()
        spline = surface_spline(mesh.topology, ratio)
        found[f"{name.replace('_', '-')}-{ratio:g}"] = spline.nets(mesh.vertices)
    return found


def rows(_: int) -> Rows:
    """Each body, whole and close up, then the geometric means."""
    studio = Studio()
    if not studio.painter.capabilities.tessellation:
        yield Skipped("uniform", "tessellation needs OpenGL 4.0")
        return
    for view, zoom in ZOOMS.items():
        ratios = []
        for name, nets in bodies().items():
            camera = look(nets, zoom)
            row = compare(studio, f"uniform/{name}/{view}", Patches(nets), camera, GOALS[view])
            ratios.append(row.ratio)
            yield row
        mean = float(np.exp(np.mean(np.log(ratios))))
        yield Row(f"uniform/mean/{view}", mean, goal=MEANS[view], at_least=True)


def look(nets: Array, zoom: float) -> Camera:
    """From above the left; close up at what is nearest to the eye."""
    points, spatial = sample_surface(nets), bool(nets[..., 2].any())
    whole = frame(points, *SIZE, View(azimuth=AZIMUTH, elevation=ELEVATION), spatial)
    if zoom == 1.0:
        return whole
    nearest = points[np.argmax(points @ whole.rotation[2])]
    half = whole.half_width / zoom, whole.half_height / zoom
    return Camera(whole.rotation, nearest, *half, whole.half_depth)


def compare(studio: Studio, name: str, layer: Patches, camera: Camera, goal: float) -> Row:
    """The row of one body in one view."""
    tolerance = Tolerance(TOLERANCE, SIZE)
    adaptive = studio.painter.surfaces.adaptive.plan(layer, camera, "tessellation", tolerance)
    off = most_off(studio, layer, camera, adaptive)
    low, high = 0, 1
    while high < FINEST and most_off(studio, layer, camera, uniform_plan(layer, high)) > off:
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        fine = most_off(studio, layer, camera, uniform_plan(layer, middle)) <= off
        low, high = (low, middle) if fine else (middle, high)
    ours = triangles(studio, layer, camera, adaptive)
    other = triangles(studio, layer, camera, uniform_plan(layer, high))
    settings = {"pixels_off": round(off, 4), "triangles": ours, "uniform_triangles": other,
                "uniform_level": high, "size": "512x512"}  # fmt: skip
    return Row(name, other / ours, settings=settings, goal=goal, at_least=True)


def most_off(studio: Studio, layer: Patches, camera: Camera, plan: Plan) -> float:
    """Pixels that a drawn point is off, but for the share that `reparam accuracy` forgives."""
    off = deviations(Drawn(studio.painter, layer, camera, "tessellation", plan, SIZE))
    return float(np.quantile(off, 1.0 - FORGIVEN)) if len(off) else 0.0


def triangles(studio: Studio, layer: Patches, camera: Camera, plan: Plan) -> int:
    """Counted by OpenGL."""
    query = studio.ctx.query(primitives=True)
    with query:
        deviations(Drawn(studio.painter, layer, camera, "tessellation", plan, SIZE))
    return int(query.primitives)
