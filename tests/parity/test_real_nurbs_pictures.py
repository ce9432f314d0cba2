"""The Red Book's NURBS programs drawn by the real GLU and by ours, with the same matrices.

The real one lights vertices and ours each fragment, and they tessellate by other vertices: so a
share of the pixels may differ by more than 24 of 255, all near highlights and edges.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from real_glu import TRIM_2, RealNurbs, library
from real_opengl import Missing, RealOpenGL

from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_MAP2_VERTEX_3,
    GL_MAP2_VERTEX_4,
    Evaluators,
    Light,
)
from reparam.evaluators.grids import primitive_indices
from reparam.evaluators.matrices import frustum, perspective
from reparam.evaluators.nurbs_parts import recording
from reparam.evaluators.tessellations import read_float64, tessellate
from reparam.geometry.net import Array
from reparam.scenes import nurbs_programs as book
from reparam.scenes.figures import redbook_nurbs, redbook_trim
from reparam.snapshot import Studio

SIZE = 500  # the programs' own window, so that 25 pixels are theirs
PICTURES = Path(__file__).parents[1] / "report" / "redbook"
PROJECTION, MODELVIEW = 0x1701, 0x1700
DEPTH_TEST, LIGHTING, LIGHT0, NORMALIZE = 0x0B71, 0x0B50, 0x4000, 0x0BA1
AMBIENT, DIFFUSE, SPECULAR, POSITION, SHININESS = 0x1200, 0x1201, 0x1202, 0x1203, 0x1601
FRONT, MODEL_AMBIENT, RGB, UNSIGNED_BYTE, PACK = 0x0404, 0x0B53, 0x1907, 0x1401, 0x0D05
SAMPLING_TOLERANCE = 100203
SEEN = 24


@dataclass(frozen=True)
class Program:
    """A program: its calls, matrices, light, and the share of the pixels that may be off."""

    calls: Callable[[Any], None]
    modelview: Array
    projection: Array
    light: Light
    off: float


def hill(gl: Any) -> None:
    points = np.array(book.HILL)
    knots = book.KNOTS
    gl.gluNurbsSurface(8, knots, 8, knots, 4 * 3, 3, points, 4, 4, GL_MAP2_VERTEX_3)


def trim(gl: Any) -> None:
    hill(gl)
    hole, knots = redbook_trim.HOLE, book.KNOTS
    gl.gluBeginTrim()
    gl.gluPwlCurve(5, redbook_trim.BORDER, 2, TRIM_2)
    gl.gluEndTrim()
    gl.gluBeginTrim()
    gl.gluNurbsCurve(8, knots, 2, hole[:4], 4, TRIM_2)
    gl.gluPwlCurve(3, hole[[3, 4, 0]], 2, TRIM_2)
    gl.gluEndTrim()


def heart(gl: Any) -> None:
    s, t = redbook_nurbs.S_KNOTS, redbook_nurbs.T_KNOTS
    points = redbook_nurbs.heart()
    gl.gluNurbsSurface(16, s, 6, t, 4 * 3, 4, points, 3, 3, GL_MAP2_VERTEX_4)


def heart_modelview() -> Array:
    look, middle = redbook_nurbs.LOOK, redbook_nurbs.MIDDLE
    eye = book.affine(look, tuple(-look @ redbook_nurbs.EYE))
    there, back = book.affine(np.eye(3), tuple(middle)), book.affine(np.eye(3), tuple(-middle))
    return np.asarray(eye @ there @ book.affine(redbook_nurbs.TURN) @ back)


HILL = (book.affine(0.5 * book.PROGRAM_TURN, (0.0, 0.0, -5.0)), perspective(45.0, 1.0, 3.0, 8.0))
HEART = (heart_modelview(), frustum(-1.0, 1.0, -1.5, 0.5, 0.8, 10.0))
PROGRAMS = {
    "surface": Program(hill, *HILL, book.LIGHT, 1e-3),
    # The real one has a bright rim along all trims, which the untrimmed hill has not.
    "trim": Program(trim, *HILL, book.LIGHT, 8e-3),
    "nurbs": Program(heart, *HEART, redbook_nurbs.LIGHT, 2e-3),
}


class Theirs:
    """C's calls of one GLUnurbs object: arrays as float pointers."""

    def __init__(self, library: ctypes.CDLL) -> None:
        self._library, self._kept = library, list[Any]()
        self._nurbs = ctypes.c_void_p(library.gluNewNurbsRenderer())

    def __getattr__(self, name: str) -> Callable[..., None]:
        def call(*arguments: Any) -> None:
            getattr(self._library, name)(self._nurbs, *(self._plain(a) for a in arguments))

        return call

    def _plain(self, argument: Any) -> Any:
        if not isinstance(argument, (tuple, np.ndarray)):
            return argument
        self._kept.append(np.ascontiguousarray(argument, np.float32))
        return self._kept[-1].ctypes.data_as(ctypes.POINTER(ctypes.c_float))


def drawn_by_the_real_one(real: RealOpenGL, program: Program) -> NDArray[np.uint8]:
    found = library()
    assert found is not None
    nurbs, light = Theirs(found), program.light
    with real.current() as gl:
        gl.glViewport(0, 0, SIZE, SIZE)
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
        gl.glClear(0x4100)
        for cap in (DEPTH_TEST, LIGHTING, LIGHT0, NORMALIZE, GL_AUTO_NORMAL):
            gl.glEnable(cap)
        gl.glMatrixMode(MODELVIEW)
        gl.glLoadIdentity()  # the light stands in eye coordinates
        values = (light.material_ambient, light.material_diffuse, light.material_specular,
                  light.model_ambient)  # fmt: skip
        keep = [np.array((*rgb, 1.0), np.float32) for rgb in values]
        place = np.array(light.position, np.float32)
        gl.glLightfv(LIGHT0, POSITION, place.ctypes.data)
        for name, value in zip((AMBIENT, DIFFUSE, SPECULAR), keep, strict=False):
            gl.glMaterialfv(FRONT, name, value.ctypes.data)
        gl.glMaterialf(FRONT, SHININESS, light.shininess)
        gl.glLightModelfv(MODEL_AMBIENT, keep[3].ctypes.data)
        for mode, matrix in ((PROJECTION, program.projection), (MODELVIEW, program.modelview)):
            columns = np.array(matrix.T, np.float32).copy()
            gl.glMatrixMode(mode)
            gl.glLoadMatrixf(columns.ctypes.data)
        nurbs.gluNurbsProperty(SAMPLING_TOLERANCE, 25.0)
        nurbs.gluBeginSurface()
        program.calls(nurbs)
        nurbs.gluEndSurface()
        nurbs.gluDeleteNurbsRenderer()
        pixels = np.zeros((SIZE, SIZE, 3), np.uint8)
        gl.glPixelStorei(PACK, 1)
        gl.glReadPixels(0, 0, SIZE, SIZE, RGB, UNSIGNED_BYTE, pixels.ctypes.data)
    return pixels


def drawn_by_ours(studio: Studio, program: Program) -> NDArray[np.uint8]:
    view = (program.modelview, program.projection)
    nurb = book.new_renderer("path-length", 25.0, "fill", *view)
    nurb.gluBeginSurface()
    program.calls(nurb)
    nurb.gluEndSurface()
    (surface,) = nurb.take()
    ctx, gl = studio.ctx, Evaluators(painter=studio.painter)
    parts = [ctx.renderbuffer((SIZE, SIZE), 4), ctx.depth_renderbuffer((SIZE, SIZE))]
    screen = ctx.framebuffer(parts[:1], parts[1])
    with ctx.scope(screen, moderngl.DEPTH_TEST):
        screen.clear(0.0, 0.0, 0.0, 1.0)
        gl.draw(recording(surface), modelview=view[0], projection=view[1], light=program.light)
        pixels = np.frombuffer(screen.read(alignment=1), np.uint8).reshape(SIZE, SIZE, 3)
    for part in (screen, *parts):
        part.release()
    return pixels


@pytest.mark.skipif(library() is None, reason="no libGLU here")
@pytest.mark.parametrize("name", PROGRAMS)
def test_as_the_real_one_draws_it(studio: Studio, name: str) -> None:
    try:
        real = RealOpenGL((SIZE, SIZE))
    except Missing as missing:
        pytest.skip(f"no real evaluators here: {missing}")
    program = PROGRAMS[name]
    reference, found = drawn_by_the_real_one(real, program), drawn_by_ours(studio, program)
    PICTURES.mkdir(parents=True, exist_ok=True)
    both = np.concatenate([reference[::-1], found[::-1]], 1)
    Image.fromarray(both).save(PICTURES / f"{name}.png")
    assert np.count_nonzero(reference.max(-1)) > 10000
    off = np.abs(reference.astype(int) - found).max(-1)
    assert np.mean(off > SEEN) <= program.off


@pytest.mark.skipif(library() is None, reason="no libGLU here")
@pytest.mark.parametrize(("pixels", "share"), [(10.0, 0.76), (25.0, 0.29), (50.0, 0.30)])
def test_the_hill_takes_that_share_of_libglu_s_triangles(pixels: float, share: float) -> None:
    """docs/porting.md says so."""
    found = library()
    assert found is not None
    real = RealNurbs(found)
    real.properties({SAMPLING_TOLERANCE: pixels})
    real.load(*(matrix.T for matrix in HILL), (0, 0, SIZE, SIZE))
    real.surface(book.KNOTS, book.KNOTS, book.HILL, (4, 4), GL_MAP2_VERTEX_3)
    theirs = sum(len(primitive_indices(p.mode, len(p.vertices))[1]) for p in real.primitives)
    nurb = book.new_renderer("path-length", pixels, "fill", *HILL)
    hill(nurb)
    (surface,) = nurb.take()
    ours = len(tessellate(surface, read_float64).primitives)
    assert ours / theirs == pytest.approx(share, abs=0.01)
