"""An interactive edit: every control point moved, 129 x 129 points, a new frame.

What a user of numpy, SciPy, geomdl or splinepy would do today: evaluate on the CPU, upload the
vertices, draw; against our frame after the same edit. The peers' frame is drawn with the same
shaders from the same triangles: only who evaluates differs. So no ratio can be above `ceiling`, the
peer's frame over one for which nothing is evaluated or uploaded at all.

`by-bound` is the same against our frame as the viewer draws it by key A: in as many steps as half a
pixel asks for, found anew in each frame. `pixels off` is then measured as `reparam accuracy` does.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from functools import partial
from importlib import import_module
from typing import Any

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.accuracy import FORGIVEN
from reparam.bench import Rows, Skipped, interleave
from reparam.geometry.bernstein import bernstein
from reparam.geometry.net import Array
from reparam.gpu.accuracy import Drawn, deviations
from reparam.gpu.looks import Look
from reparam.gpu.meshes import triangle_indices
from reparam.gpu.plans import Tolerance
from reparam.gpu.surfaces import Fine
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

LEVEL = 128
DEGREE = 3
SIZE = (512, 512)
COLOR = (0.0, 0.45, 0.7)
GOALS = {"geomdl": 100.0}
GOAL = 2.0
BOUND = Tolerance(0.5, SIZE)
SLOWEST_PAIRS = 5  # geomdl takes seconds

ACCOUNT = """
Point for point out of reach on a software rasteriser against whoever computes in compiled code: two
small matrix products in numpy take a twentieth of a millisecond, drawing the triangles takes
hundreds of times as long, and both sides must draw them. So `ceiling` is near 1 for numpy, SciPy
and splinepy, and what is left of the ratio is ours: a new net is uploaded (16 texels, a hundredth
of a millisecond) and evaluated by the GPU's stages in software, while the peer writes its points
into a buffer. geomdl computes in Python, and is behind by what its ceiling allows.

What an edit needs is not 129 x 129 points but a right picture. The bound tells how many do for it,
so `by-bound` draws a fraction of the triangles; who evaluates on the CPU does not know how many.
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


class Edited:
    """The frames after an edit: ours, and a peer's."""

    def __init__(self) -> None:
        self.studio = Studio()
        painter = self.studio.painter
        self.surfaces, self.evaluation = painter.surfaces, painter.evaluation
        self.evaluator = painter.capabilities.evaluator(None)
        self.program = painter.programs.get("mesh.vert", "patch.frag")
        self.buffer = self.studio.ctx.buffer(reserve=4 * 4 * (LEVEL + 1) ** 2)
        indices = self.studio.ctx.buffer(triangle_indices(LEVEL, 1).tobytes())
        self.mesh = self.studio.ctx.vertex_array(
            self.program.gl, [(self.buffer, "4f", "point")], indices
        )
        self.vertices = np.ones(((LEVEL + 1) ** 2, 4), np.float32)
        self.net = wavy_patches(1, DEGREE)[0]
        self.count = 0

    def edit(self) -> Array:
        """The net (4, 4, 4), every control point moved: too little to be seen."""
        self.count += 1
        net = self.net.copy()
        net[..., :3] += 1e-6 * self.count
        return net

    def layer(self) -> Patches:
        """As it is after an edit."""
        return Patches(self.edit(), color=COLOR)

    def ours(self, fine: Fine) -> None:
        """Our frame."""
        self.surfaces.draw(self.layer(), FROM_ABOVE, self.evaluator, fine)
        self.surfaces.sweep()
        self.evaluation.sweep()

    def peer(self, evaluate: Evaluate) -> None:
        """A peer's."""
        self.vertices[:, :3] = evaluate(self.edit()[..., :3]).reshape(-1, 3)
        self.buffer.write(self.vertices)
        self.nothing()

    def nothing(self) -> None:
        """The peer's frame without what is to be evaluated."""
        layer = Patches(self.net, color=COLOR)
        self.surfaces.looks.set(self.program, layer, FROM_ABOVE, Look(COLOR))
        self.program.ready()
        self.mesh.render()

    def pixels_off(self) -> float:
        """What `reparam accuracy` finds of our frame by the bound."""
        layer = self.layer()
        plan = self.surfaces.adaptive.plan(layer, FROM_ABOVE, self.evaluator, BOUND)
        off = deviations(Drawn(self.studio.painter, layer, FROM_ABOVE, self.evaluator, plan, SIZE))
        return float(np.quantile(off, 1.0 - FORGIVEN))


def rows(pairs: int) -> Rows:
    """peer / ours, for each peer that is installed."""
    edited = Edited()
    off = round(edited.pixels_off(), 4)
    for name, make in PEERS.items():
        try:
            evaluate = make()
        except ImportError:
            yield Skipped(f"edited/{name}", f"{name} is not installed")
            continue
        slow = name in GOALS
        count = min(pairs, SLOWEST_PAIRS) if slow else pairs
        goal = GOALS.get(name, GOAL)
        with frames(edited.studio, SIZE) as frame:
            ours, by_bound = (frame(partial(edited.ours, fine)) for fine in (LEVEL, BOUND))
            peer = frame(partial(edited.peer, evaluate))
            frame.check_alike(partial(edited.ours, LEVEL), partial(edited.peer, evaluate))
            least = interleave(frame(edited.nothing), peer, count, 1)
            times = interleave(ours, peer, count, 1)
            bounded = interleave(by_bound, peer, count, 1)
        evaluation = round(1e3 * seconds(evaluate, edited.net[..., :3], 1 if slow else 9), 3)
        settings = {"points": "129x129", "peer_evaluation_ms": evaluation}
        ceiling = round(least.row("", inverse=True).ratio, 3)
        yield times.row(f"edited/{name}", inverse=True, goal=goal, ceiling=ceiling, **settings)
        settings = {**settings, "pixels_off": off}
        yield bounded.row(f"edited/{name}/by-bound", inverse=True, goal=goal, **settings)


def seconds(evaluate: Evaluate, points: Array, times: int) -> float:
    """How long a peer's evaluation takes, the median."""
    return statistics.median(interleave(lambda: evaluate(points), lambda: None, times, 1).ours)
