"""An interactive edit: every control point moved, 129 x 129 points, a new frame.

What a user of numpy, SciPy, geomdl or splinepy would do today: evaluate on the CPU, upload the
vertices, draw; against our frame after the same edit. The peers' frame is drawn with the same
shaders from the same triangles: only who evaluates differs. So no ratio can be above `ceiling`, the
peer's frame over one for which nothing is evaluated or uploaded at all.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.bench import Rows, Skipped, interleave
from reparam.geometry.bernstein import bernstein
from reparam.geometry.net import Array
from reparam.gpu.meshes import triangle_indices
from reparam.gpu.surfaces import Look
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

LEVEL = 128
DEGREE = 3
SIZE = (512, 512)
COLOR = (0.0, 0.45, 0.7)
GOALS = {"geomdl": 100.0}
GOAL = 2.0
SLOWEST_PAIRS = 5  # geomdl takes seconds

ACCOUNT = """
Out of reach on a software rasteriser against whoever computes in compiled code: two small matrix
products in numpy take a twentieth of a millisecond, drawing the triangles takes hundreds of times
as long, and both sides must draw them. So `ceiling` is near 1 for numpy, SciPy and splinepy, and
what is left of the ratio is ours: a new net is uploaded (16 texels, a hundredth of a millisecond)
and evaluated by the GPU's stages in software, while the peer writes its points into a buffer.
geomdl computes in Python, and is behind by what its ceiling allows.
"""

Evaluate = Callable[[Array], Array]  # points (4, 4, 3) -> (129 * 129, 3)

T = np.arange(LEVEL + 1) / LEVEL


def numpy_evaluate() -> Evaluate:
    """Two matrix products with a basis computed once."""
    basis = bernstein(DEGREE, T)
    return lambda points: np.einsum("ui,vj,ijc->uvc", basis, basis, points, optimize=True)


def scipy_evaluate() -> Evaluate:
    """scipy.interpolate.NdBSpline."""
    spline = import_module("scipy.interpolate").NdBSpline
    knots = np.repeat([0.0, 1.0], DEGREE + 1)
    grid = np.stack(np.meshgrid(T, T, indexing="ij"), -1)
    return lambda points: spline((knots, knots), points, DEGREE)(grid)


def geomdl_evaluate() -> Evaluate:
    """geomdl.BSpline.Surface, evaluated as its documentation does."""
    surface_type = import_module("geomdl.BSpline").Surface

    def evaluate(points: Array) -> Array:
        surface = surface_type()
        surface.degree_u = surface.degree_v = DEGREE
        surface.set_ctrlpts(points.reshape(-1, 3).tolist(), DEGREE + 1, DEGREE + 1)
        surface.knotvector_u = surface.knotvector_v = [0.0] * 4 + [1.0] * 4
        surface.sample_size = LEVEL + 1
        return np.array(surface.evalpts)

    return evaluate


def splinepy_evaluate() -> Evaluate:
    """splinepy.Bezier, sampled on the grid."""
    bezier: Any = import_module("splinepy").Bezier

    def evaluate(points: Array) -> Array:
        flat = points.swapaxes(0, 1).reshape(-1, 3)
        sampled = bezier([DEGREE, DEGREE], flat).sample([LEVEL + 1, LEVEL + 1])
        return np.asarray(sampled).reshape(LEVEL + 1, LEVEL + 1, 3).swapaxes(0, 1)

    return evaluate


PEERS = {
    "numpy": numpy_evaluate,
    "scipy": scipy_evaluate,
    "geomdl": geomdl_evaluate,
    "splinepy": splinepy_evaluate,
}


def rows(pairs: int) -> Rows:
    """peer / ours, for each peer that is installed."""
    studio = Studio()
    net = wavy_patches(1, DEGREE)
    surfaces = studio.painter.surfaces
    evaluator = studio.painter.capabilities.evaluator(None)
    program = studio.painter.programs.get("mesh.vert", "patch.frag")
    buffer = studio.ctx.buffer(reserve=4 * 4 * (LEVEL + 1) ** 2)
    indices = studio.ctx.buffer(triangle_indices(LEVEL, 1).tobytes())
    mesh = studio.ctx.vertex_array(program.gl, [(buffer, "4f", "point")], indices)
    vertices = np.ones(((LEVEL + 1) ** 2, 4), np.float32)
    layer = Patches(net[0], color=COLOR)

    def ours() -> None:
        fresh = Patches(net[0] * 1.0, color=COLOR)
        surfaces.draw(fresh, FROM_ABOVE, evaluator, LEVEL)
        surfaces.sweep()
        studio.painter.evaluation.sweep()

    def nothing() -> None:
        surfaces.set_common(program, layer, FROM_ABOVE, Look(layer.color))
        program.ready()
        mesh.render()

    for name, make in PEERS.items():
        try:
            evaluate = make()
        except ImportError:
            yield Skipped(f"edited/{name}", f"{name} is not installed")
            continue

        def peer(evaluate: Evaluate = evaluate) -> None:
            vertices[:, :3] = evaluate(net[0, ..., :3] * 1.0).reshape(-1, 3)
            buffer.write(vertices)
            nothing()

        slow = name in GOALS
        count = min(pairs, SLOWEST_PAIRS) if slow else pairs
        with frames(studio, SIZE) as frame:
            frame.check_alike(ours, peer)
            times = interleave(frame(ours), frame(peer), count, 1)
            least = interleave(frame(nothing), frame(peer), count, 1)
        goal = GOALS.get(name, GOAL)
        ceiling = round(least.row("", inverse=True).ratio, 3)
        evaluation = round(1e3 * seconds(evaluate, net[0, ..., :3] * 1.0, 1 if slow else 9), 3)
        settings = {"points": "129x129", "ceiling": ceiling, "peer_evaluation_ms": evaluation}
        yield times.row(f"edited/{name}", inverse=True, goal=goal, **settings)


def seconds(evaluate: Evaluate, points: Array, times: int) -> float:
    """How long a peer's evaluation takes, the median."""
    return statistics.median(interleave(lambda: evaluate(points), lambda: None, times, 1).ours)
