"""Our evaluators against the real glEvalMesh2, lit and textured, each in a context of its own.

A frame of the real one calls glMap2f and glEvalMesh2 for each patch (in a display list, which
evaluates again at each call, it is slower still). Ours, all patches in one draw:

kept       a recording is drawn again, as a display list would be: its control points are on the
           GPU, every vertex is evaluated anew as it is drawn
evaluated  all control points are packed and uploaded anew in each frame as well
recorded   the calls are made from Python in each frame as well

`discard` is the work on vertices alone: nothing is rasterised.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import moderngl
import numpy as np
from frames import wavy_patches

from reparam.bench import Rows, Skipped, interleave
from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    Evaluators,
    Light,
    Recording,
)
from reparam.geometry.net import Array
from reparam.snapshot import Studio

sys.path.insert(0, str(Path(__file__).parents[1] / "parity"))

ACCOUNT = """
Each vertex is evaluated in every row, in the vertex shader that draws it: a patch is an instance,
and its control points are attributes that stay for an instance, so nothing is fetched. Against a
static mesh of the same triangles that costs 1 ms for 81,000 vertices. The rasteriser takes 14 ms of
a frame of the 1000 patches, ours and the real one's alike, so that no evaluator can make that frame
more than about 2.5 times as fast. Of `recorded` some 10 us are Python's for each pair of glMap2f
and glEvalMesh2.

What did not help: evaluating strips of nine points at a time by transform feedback (7 ms), and
basis functions in a table instead of computed for each vertex (they cost next to nothing beside
fetching control points from a texture, 2 ns a fetch).
"""

SIZE = 256
DEGREE = 3
CASES = ((1000, 8), (1, 128))  # patches, segments
GOALS = {(1000, "discard"): 3.0, (1000, "frame"): 1.8, (1, "frame"): 1.3}
SQUARE = np.array([[(0, 0), (0, 1)], [(1, 0), (1, 1)]], np.float32)
CHECKS = np.array([[(255, 255, 255), (0, 80, 160)], [(0, 80, 160), (255, 255, 255)]], np.uint8)

DEPTH_TEST, LIGHTING, LIGHT0, TEXTURE_2D = 0x0B71, 0x0B50, 0x4000, 0x0DE1
CW, TWO_SIDE, RASTERIZER_DISCARD = 0x0900, 0x0B52, 0x8C89
RGB, UNSIGNED_BYTE, NEAREST, MIN_FILTER, MAG_FILTER, UNPACK = (
    0x1907, 0x1401, 0x2600, 0x2801, 0x2800, 0x0CF5,
)  # fmt: skip


class Real:
    """The real one: fixed function, as a program of its time would draw."""

    def __init__(self, points: Array, segments: int) -> None:
        from real_opengl import RealOpenGL

        self.opengl = RealOpenGL((SIZE, SIZE))
        self._nets = np.ascontiguousarray(points, np.float32)
        self._square = SQUARE.copy()
        count, order = points.shape[:2]
        first, step = self._nets.ctypes.data, self._nets[0].nbytes
        with self.opengl.current() as gl:
            gl.glViewport(0, 0, SIZE, SIZE)
            for cap in (DEPTH_TEST, LIGHTING, LIGHT0, TEXTURE_2D):
                gl.glEnable(cap)
            gl.glLightModeli(TWO_SIDE, 1)
            gl.glFrontFace(CW)
            gl.glPixelStorei(UNPACK, 1)
            for name in (MIN_FILTER, MAG_FILTER):
                gl.glTexParameteri(TEXTURE_2D, name, NEAREST)
            pixels = CHECKS.ctypes.data
            gl.glTexImage2D(TEXTURE_2D, 0, RGB, 2, 2, 0, RGB, UNSIGNED_BYTE, pixels)
            texpts = self._square.ctypes.data
            gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 4, 2, 0, 1, 2, 2, texpts)
            for cap in (GL_MAP2_TEXTURE_COORD_2, GL_MAP2_VERTEX_3, GL_AUTO_NORMAL):
                gl.glEnable(cap)
            gl.glMapGrid2f(segments, 0, 1, segments, 0, 1)
            gl.glClearColor(1, 1, 1, 1)
            along_u, along_v = (0, 1, 3 * order, order), (0, 1, 3, order)
            self._calls = [
                partial(gl.glMap2f, GL_MAP2_VERTEX_3, *along_u, *along_v, first + i * step)
                for i in range(count)
            ]
            self._mesh = partial(gl.glEvalMesh2, GL_FILL, 0, segments, 0, segments)
            self._finish, self._clear = gl.glFinish, gl.glClear

    def draw(self) -> None:
        with self.opengl.current():
            self._clear(0x4100)
            for call in self._calls:
                call()
                self._mesh()
            self._finish()

    def discard(self, on: bool) -> None:
        with self.opengl.current() as gl:
            (gl.glEnable if on else gl.glDisable)(RASTERIZER_DISCARD)


class Ours:
    """The same calls, in the studio's context, into a framebuffer of the same kind."""

    def __init__(self, studio: Studio, points: Array, segments: int) -> None:
        self._ctx = ctx = studio.ctx
        self._gl = Evaluators(painter=studio.painter)
        self._points = points.astype(np.float32)
        self._segments = segments
        self._texture = ctx.texture((2, 2), 3, CHECKS.tobytes(), alignment=1)
        self._texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        color, depth = ctx.renderbuffer((SIZE, SIZE), 4), ctx.depth_renderbuffer((SIZE, SIZE))
        self.framebuffer = ctx.framebuffer([color], depth)
        gl = self._gl
        gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, SQUARE)
        for cap in (GL_MAP2_TEXTURE_COORD_2, GL_MAP2_VERTEX_3, GL_AUTO_NORMAL):
            gl.glEnable(cap)
        gl.glMapGrid2f(segments, 0, 1, segments, 0, 1)
        self._kept = self._record()
        assert len(self._kept.batches) == 1

    def _record(self) -> Recording:
        gl, n = self._gl, self._segments
        for points in self._points:
            gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, points)
            gl.glEvalMesh2(GL_FILL, 0, n, 0, n)
        return gl.take()

    def draw(self, recording: Callable[[], Recording]) -> None:
        self.framebuffer.clear(1.0, 1.0, 1.0, depth=1.0)
        self._gl.draw(recording(), light=Light(), texture=self._texture)
        self._ctx.finish()

    def ways(self) -> dict[str, Callable[[], Recording]]:
        return {
            "evaluated": lambda: Recording(self._kept.items),
            "recorded": self._record,
            "kept": lambda: self._kept,
        }


def rows(pairs: int) -> Rows:
    """Vertex work and whole frames of 256 x 256, of many patches and of one."""
    from real_opengl import Missing

    studio = Studio()
    for count, segments in CASES:
        points = wavy_patches(count, DEGREE)[..., :3]
        name = f"glEvalMesh2/vertex/{count}x{segments}"
        try:
            real = Real(points, segments)
        except Missing as missing:
            yield Skipped(name, f"no real evaluators here: {missing}")
            continue
        ours = Ours(studio, points, segments)
        for work in ("discard", "frame"):
            yield from _measure(studio, ours, real, name, work, GOALS.get((count, work)), pairs)


def _measure(
    studio: Studio, ours: Ours, real: Real, name: str, work: str, goal: float | None, pairs: int
) -> Rows:
    real.discard(work == "discard")
    flags = moderngl.DEPTH_TEST | (moderngl.RASTERIZER_DISCARD if work == "discard" else 0)
    for way, recording in ours.ways().items():

        def run_ours(recording: Callable[[], Recording] = recording) -> None:
            with studio.ctx.scope(ours.framebuffer, flags):
                ours.draw(recording)

        wanted = goal if way != "recorded" else None
        found = interleave(run_ours, real.draw, pairs)
        yield found.row(
            f"{name}/{work}/{way}", inverse=True, goal=wanted, size=f"{SIZE}x{SIZE}", degree=DEGREE
        )
