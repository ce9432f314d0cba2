"""The Red Book's trim.c as the real libGLU draws it, beside ours: lit, in perspective."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
import real_glu
from numpy.typing import NDArray
from PIL import Image
from real_opengl import Missing, RealOpenGL
from test_real_pictures import (
    DEPTH_TEST,
    LIGHT0,
    LIGHTING,
    MODELVIEW,
    PACK,
    PICTURES,
    PROJECTION,
    RGB,
    UNSIGNED_BYTE,
    light,
)

from reparam.evaluators import Evaluators
from reparam.evaluators.constants import GL_AUTO_NORMAL, GL_MAP2_VERTEX_3
from reparam.evaluators.glu import (
    GLU_AUTO_LOAD_MATRIX,
    GLU_DISPLAY_MODE,
    GLU_FILL,
    GLU_NURBS_MODE,
    GLU_NURBS_RENDERER,
    GLU_SAMPLING_TOLERANCE,
    NurbsRenderer,
)
from reparam.evaluators.light import Light
from reparam.evaluators.matrices import perspective, rotate, scale, translate
from reparam.evaluators.nurbs_parts import recording
from reparam.geometry.net import Array
from reparam.scenes.figures.redbook_trim import BORDER, HOLE
from reparam.scenes.nurbs_programs import HILL, KNOTS
from reparam.snapshot import Studio

GLU = real_glu.library()
pytestmark = pytest.mark.skipif(GLU is None, reason="no libGLU here to compare with")

NORMALIZE = 0x0BA1
SIZE, PIXELS = 300, 2.0
LIGHT = Light(
    ambient=(0.0, 0.0, 0.0),
    position=(0.0, 0.3, 1.0, 0.0),
    material_diffuse=(0.7, 0.7, 0.7),
    material_specular=(0.0, 0.0, 0.0),
)
LINE = HOLE[[3, 4, 0]]


def matrices() -> tuple[Array, Array]:
    modelview = translate(0.0, 0.0, -5.0) @ rotate(330.0, 1.0, 0.0, 0.0) @ scale(0.5, 0.5, 0.5)
    return perspective(45.0, 1.0, 3.0, 8.0), modelview


def drawn_by_the_real_one() -> NDArray[np.uint8]:
    try:
        real = RealOpenGL((SIZE, SIZE))
    except Missing as missing:
        pytest.skip(f"no real evaluators here: {missing}")
    assert GLU is not None
    projection, modelview = matrices()
    keep = [np.array(m.T, np.float32).copy() for m in (projection, modelview)]
    with real.current() as gl:
        gl.glViewport(0, 0, SIZE, SIZE)
        for mode, matrix in zip((PROJECTION, MODELVIEW), keep, strict=True):
            gl.glMatrixMode(mode)
            gl.glLoadMatrixf(matrix.ctypes.data)
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
        gl.glClear(0x4100)
        gl.glEnable(DEPTH_TEST)
        gl.glEnable(GL_AUTO_NORMAL)
        gl.glEnable(NORMALIZE)
        light(gl, modelview)
        gl.glFrontFace(0x0901)
        nurbs = real_glu.RealNurbs(GLU)
        nurbs.call("gluNurbsProperty", GLU_NURBS_MODE, GLU_NURBS_RENDERER)
        nurbs.call("gluNurbsProperty", GLU_AUTO_LOAD_MATRIX, 1)
        nurbs.call("gluNurbsProperty", GLU_SAMPLING_TOLERANCE, PIXELS)
        nurbs.call("gluNurbsProperty", GLU_DISPLAY_MODE, GLU_FILL)
        nurbs.call("gluBeginSurface")
        nurbs.surface(KNOTS, KNOTS, HILL, (4, 4), GL_MAP2_VERTEX_3)
        for loop in ([BORDER], [HOLE[:4], LINE]):
            nurbs.call("gluBeginTrim")
            for piece in loop:
                if len(piece) == 4:
                    nurbs.curve(KNOTS, piece, 4, real_glu.TRIM_2)
                else:
                    nurbs.call("gluPwlCurve", len(piece), piece, 2, real_glu.TRIM_2)
            nurbs.call("gluEndTrim")
        nurbs.call("gluEndSurface")
        assert not nurbs.errors
        pixels = np.zeros((SIZE, SIZE, 3), np.uint8)
        gl.glPixelStorei(PACK, 1)
        gl.glReadPixels(0, 0, SIZE, SIZE, RGB, UNSIGNED_BYTE, pixels.ctypes.data)
        for cap in (DEPTH_TEST, LIGHTING, LIGHT0, GL_AUTO_NORMAL, NORMALIZE):
            gl.glDisable(cap)
    return pixels


def drawn_by_ours(studio: Studio) -> NDArray[np.uint8]:
    projection, modelview = matrices()
    nurb = NurbsRenderer()
    nurb.gluLoadSamplingMatrices(modelview.T, projection.T, (0, 0, SIZE, SIZE))
    nurb.gluNurbsProperty(GLU_SAMPLING_TOLERANCE, PIXELS)
    nurb.gluBeginSurface()
    nurb.gluNurbsSurface(KNOTS, KNOTS, HILL, GL_MAP2_VERTEX_3)
    for loop in ([BORDER], [HOLE[:4], LINE]):
        nurb.gluBeginTrim()
        for piece in loop:
            if len(piece) == 4:
                nurb.gluNurbsCurve(KNOTS, piece, real_glu.TRIM_2)
            else:
                nurb.gluPwlCurve(piece, real_glu.TRIM_2)
        nurb.gluEndTrim()
    nurb.gluEndSurface()
    ctx = studio.ctx
    parts = [ctx.renderbuffer((SIZE, SIZE), 4), ctx.depth_renderbuffer((SIZE, SIZE))]
    framebuffer = ctx.framebuffer(parts[:1], parts[1])
    with ctx.scope(framebuffer, moderngl.DEPTH_TEST):
        framebuffer.clear(0.0, 0.0, 0.0, 1.0)
        Evaluators(painter=studio.painter).draw(
            recording(*nurb.take()), projection=projection, modelview=modelview, light=LIGHT
        )
        found = np.frombuffer(framebuffer.read(alignment=1), np.uint8).reshape(SIZE, SIZE, 3)
    for part in (framebuffer, *parts):
        part.release()
    return found


def test_a_trimmed_hill_as_the_real_one_draws_it(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the two differ is the border alone: libGLU's are chords, of two pixels here."""
    monkeypatch.setattr("test_real_pictures.LIGHT", LIGHT)
    reference, found = drawn_by_the_real_one(), drawn_by_ours(studio)
    PICTURES.mkdir(parents=True, exist_ok=True)
    both = np.concatenate([reference[::-1], found[::-1]], 1)
    Image.fromarray(both).save(PICTURES / "trim.png")
    seen, ours = reference.max(-1) > 0, found.max(-1) > 0
    assert 0.1 < seen.mean() < 0.9
    assert (seen != ours).mean() < 2e-3
    off = np.abs(reference.astype(int) - found).max(-1)[seen & ours]
    assert (off > 16).mean() < 5e-3
