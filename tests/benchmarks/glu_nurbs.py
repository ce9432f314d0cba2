"""Our surfaces against the real gluNurbsSurface: 37 x 37 bicubic pieces, lit, equally accurate.

The real one draws a cubic spline by GLU_PARAMETRIC_ERROR, each frame anew as it always does. Ours
draws the spline's pieces with a tolerance of half a pixel: `still` in a view that stays, of which
levels and triangles are kept and vertices are evaluated anew, `turned` in another view each frame,
planned anew. The view is parallel and slanting: GLU bounds the error on the screen, and so do we.

Both are held to the same measure: pixels between a drawn point and the exact one of the same
(u, v). Ours says at each fragment where it lies (`reparam accuracy`); the real one's triangles are
those of its tessellator callbacks, which hand (u, v) back with each vertex, sampled inside and on
their edges. Of its tolerances the largest, to one per cent, is taken that is no worse than ours.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

import numpy as np
from frames import frames
from numpy.typing import NDArray

from reparam.accuracy import FORGIVEN
from reparam.bench import Rows, Skipped, interleave
from reparam.evaluators import GL_AUTO_NORMAL, GL_MAP2_VERTEX_3
from reparam.evaluators.grids import primitive_indices
from reparam.geometry.bernstein import bernstein
from reparam.geometry.body import homogeneous
from reparam.geometry.camera import Camera, View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.extraction import surface_to_bezier
from reparam.geometry.net import Array
from reparam.gpu.accuracy import Drawn, deviations
from reparam.gpu.plans import Tolerance
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

sys.path.insert(0, str(Path(__file__).parents[1] / "parity"))

ACCOUNT = """
Where the goal is missed, this is why (processor time on llvmpipe, all threads together): the real
one takes 21 ms for what is as accurate as ours, 14 of them for its vertices, which it makes one by
one. By the vertex evaluator a view that stays takes us 5.1 ms. A static mesh of the same 17,590
triangles, evaluated never, takes 4.4: that is the rasteriser, and 4.8 would be the ratio with it
alone. A view that turns takes 4 ms more: 1.8 for the bound of 1369 patches, in software as well,
the rest in numpy, to fit edges to each other and to lay out the triangles. (With all its loops
unrolled the bound takes 0.5 ms, and the compiler takes 4 s for it.) Tessellators cut cells as they
like, so the tessellation evaluator cannot choose the better diagonals, and has half as many
triangles again.
"""

PIECES, ORDER = 37, 4
SIZE = (512, 512)
PIXELS = 0.5
GOAL = 4.0
TURNS = np.linspace(-1.0, 1.0, 21)  # degrees
KNOTS = np.clip(np.arange(-3.0, PIECES + 4.0), 0.0, PIECES)
SAMPLES = np.array([  # barycentric, times 6
    (2, 2, 2), (3, 3, 0), (0, 3, 3), (3, 0, 3), (4, 1, 1), (1, 4, 1), (1, 1, 4),
])  # fmt: skip

SAMPLING_METHOD, PARAMETRIC_ERROR, PARAMETRIC_TOLERANCE = 100205, 100216, 100202
PROJECTION, MODELVIEW = 0x1701, 0x1700
DEPTH_TEST, LIGHTING, LIGHT0, TWO_SIDE = 0x0B71, 0x0B50, 0x4000, 0x0B52


def control_points() -> Array:
    """Rough hills over [-1,1]^2: (40, 40, 3)."""
    t = np.linspace(-1.0, 1.0, PIECES + ORDER - 1)
    x, y = np.meshgrid(t, t, indexing="ij")
    rough = np.random.default_rng(4).normal(scale=0.02, size=x.shape)
    return np.stack([x, y, 0.2 * np.sin(5.0 * x) * np.cos(4.0 * y) + rough], -1)


class Real:
    """The real one in a context of its own, seen by the same camera."""

    def __init__(self, points: Array, camera: Camera) -> None:
        from real_glu import library
        from real_opengl import Missing, RealOpenGL

        glu = library()
        if glu is None:
            raise Missing("no libGLU")
        self._glu, self._points = glu, points
        modelview = np.eye(4)
        modelview[:3, :3] = camera.rotation  # the light stands in eye coordinates
        projection = camera.clip_from_model() @ modelview.T
        self._matrices = [np.ascontiguousarray(m.T, np.float32) for m in (modelview, projection)]
        self.opengl = RealOpenGL(SIZE)
        with self.opengl.current() as gl:
            gl.glViewport(0, 0, *SIZE)
            for cap in (DEPTH_TEST, LIGHTING, LIGHT0, GL_AUTO_NORMAL):
                gl.glEnable(cap)
            gl.glLightModeli(TWO_SIDE, 1)
            gl.glClearColor(1, 1, 1, 1)
            for mode, matrix in zip((MODELVIEW, PROJECTION), self._matrices, strict=True):
                gl.glMatrixMode(mode)
                gl.glLoadMatrixf(matrix.ctypes.data)
            self._renderer = ctypes.c_void_p(glu.gluNewNurbsRenderer())
        self._clear, self._finish = gl.glClear, gl.glFinish
        knots, net = np.array(KNOTS, np.float32), np.array(points, np.float32)
        self._kept = knots, net
        pointers = [a.ctypes.data_as(ctypes.POINTER(ctypes.c_float)) for a in self._kept]
        side = points.shape[1]
        self._surface = (len(KNOTS), pointers[0], len(KNOTS), pointers[0], 3 * side, 3,
                         pointers[1], ORDER, ORDER, GL_MAP2_VERTEX_3)  # fmt: skip

    def tune(self, wanted: float, exact: Array, camera: Camera) -> tuple[float, float]:
        """The largest GLU_PARAMETRIC_TOLERANCE that is off by no more, and by how much."""
        low, high = wanted / 8.0, wanted * 8.0
        while high / low > 1.01:
            middle = float(np.sqrt(low * high))
            low, high = (
                (middle, high) if self.off(middle, exact, camera) <= wanted else (low, middle)
            )
        for name, value in ((SAMPLING_METHOD, PARAMETRIC_ERROR), (PARAMETRIC_TOLERANCE, low)):
            self._glu.gluNurbsProperty(self._renderer, name, value)
        return low, self.off(low, exact, camera)

    def off(self, tolerance: float, exact: Array, camera: Camera) -> float:
        """Pixels that its triangles are off, as ours are measured."""
        triangles = self.triangles(tolerance)
        drawn = np.einsum("sc,tcx->tsx", SAMPLES / 6.0, triangles)
        piece = np.clip(np.floor(triangles[..., 3:].mean(1)), 0, PIECES - 1).astype(int)
        local = drawn[..., 3:] - piece[:, None]
        row, column = (bernstein(ORDER - 1, local[..., k]) for k in (0, 1))
        nets = exact[piece[:, 0] * PIECES + piece[:, 1]]
        points = np.einsum("tsi,tsj,tijc->tsc", row, column, nets[..., :3], optimize=True)
        apart = camera.pixels(points, *SIZE) - camera.pixels(drawn[..., :3], *SIZE)
        return float(np.quantile(np.linalg.norm(apart, axis=-1), 1.0 - FORGIVEN))

    def triangles(self, tolerance: float) -> Array:
        """What its tessellator hands back: (k, 3, 5), with x, y, z, u, v."""
        from real_glu import RealNurbs

        nurbs = RealNurbs(self._glu)
        nurbs.properties({SAMPLING_METHOD: PARAMETRIC_ERROR, PARAMETRIC_TOLERANCE: tolerance})
        nurbs.load(*self._matrices, (0, 0, *SIZE))
        nurbs.surface(KNOTS, KNOTS, self._points, (ORDER, ORDER), GL_MAP2_VERTEX_3)
        nurbs.close()
        found: list[NDArray[np.float64]] = []
        for primitive in nurbs.primitives:
            vertices = np.array(primitive.vertices)
            found.append(vertices[primitive_indices(primitive.mode, len(vertices))[1]])
        return np.concatenate(found)

    def draw(self) -> None:
        glu = self._glu
        with self.opengl.current():
            self._clear(0x4100)
            glu.gluBeginSurface(self._renderer)
            glu.gluNurbsSurface(self._renderer, *self._surface)
            glu.gluEndSurface(self._renderer)
            self._finish()


def rows(pairs: int) -> Rows:
    """A whole frame, on each evaluator, of a view that stays and of views that turn."""
    from real_opengl import Missing

    name = f"gluNurbsSurface/{{}}/{PIECES}x{PIECES}"
    studio, points = Studio(), control_points()
    net = surface_to_bezier((KNOTS, KNOTS), homogeneous(points), (ORDER, ORDER)).patches()
    layer = Patches(net, lit=True)
    camera, *turns = (
        frame(sample_surface(net), *SIZE, View(azimuth=-60.0 + turn, elevation=30.0), True)
        for turn in (0.0, *TURNS)
    )
    tolerance = Tolerance(PIXELS, SIZE)
    surfaces = studio.painter.surfaces
    try:
        real = Real(points, camera)
    except Missing as missing:
        yield Skipped(name.format("vertex"), f"no real GLU here: {missing}")
        return
    for evaluator in ("vertex", "tessellation"):
        if evaluator == "tessellation" and not studio.painter.capabilities.tessellation:
            yield Skipped(name.format(evaluator), "tessellation needs OpenGL 4.0")
            continue
        plan = surfaces.adaptive.plan(layer, camera, evaluator, tolerance)
        off = deviations(Drawn(studio.painter, layer, camera, evaluator, plan, SIZE))
        wanted = float(np.quantile(off, 1.0 - FORGIVEN))
        asked, theirs = real.tune(wanted, net, camera)
        settings = {
            "size": "512x512", "pixels_off": round(wanted, 4), "other_pixels_off": round(theirs, 4),
            "parametric_tolerance": round(asked, 4), "triangles": plan.triangles(),
            "other_triangles": len(real.triangles(asked)),
        }  # fmt: skip
        for kind, views in (("still", [camera]), ("turned", turns)):
            around = cycle(views)

            def ours(evaluator: str = evaluator, around: Iterator[Camera] = around) -> None:
                surfaces.draw(layer, next(around), evaluator, tolerance)
                surfaces.sweep()

            with frames(studio, SIZE, samples=1) as whole:
                found = interleave(whole(ours), real.draw, pairs)
            row = f"{name.format(evaluator)}/{kind}"
            yield found.row(row, inverse=True, goal=GOAL, **settings)
