"""The Red Book's programs drawn by the real fixed function and by ours, with the same matrices."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from real_opengl import Missing, RealOpenGL

from reparam import evaluators as ev
from reparam.assets import texture_path
from reparam.evaluators import Evaluators
from reparam.evaluators.matrices import rotate
from reparam.scenes.figures.redbook_bezcurve import CONTROL_POINTS
from reparam.scenes.figures.redbook_bezmesh import LIGHT
from reparam.scenes.figures.redbook_texturesurf import TEXTURE_POINTS
from reparam.scenes.redbook import SURFACE
from reparam.snapshot import Studio

SIZE = 256
PICTURES = Path(__file__).parents[1] / "report" / "redbook"
DEPTH_TEST, LIGHTING, LIGHT0, TEXTURE_2D = 0x0B71, 0x0B50, 0x4000, 0x0DE1
PROJECTION, MODELVIEW = 0x1701, 0x1700
CW, CCW, TWO_SIDE = 0x0900, 0x0901, 0x0B52
AMBIENT, DIFFUSE, SPECULAR, POSITION, SHININESS = 0x1200, 0x1201, 0x1202, 0x1203, 0x1601
FRONT_AND_BACK, RGB, UNSIGNED_BYTE = 0x0408, 0x1907, 0x1401
NEAREST, MIN_FILTER, MAG_FILTER = 0x2600, 0x2801, 0x2800
PACK, UNPACK = 0x0D05, 0x0CF5


def bezcurve(gl: Any) -> None:
    points = np.ascontiguousarray(CONTROL_POINTS, np.float32)
    gl.glMap1f(ev.GL_MAP1_VERTEX_3, 0, 1, 3, 4, pointer(gl, points))
    gl.glEnable(ev.GL_MAP1_VERTEX_3)
    gl.glColor4f(1, 1, 1, 1)
    gl.glBegin(ev.GL_LINE_STRIP)
    for i in range(31):
        gl.glEvalCoord1f(i / 30)
    gl.glEnd()


def surface(gl: Any) -> None:
    points = np.ascontiguousarray(SURFACE, np.float32)
    gl.glMap2f(ev.GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, pointer(gl, points))
    gl.glEnable(ev.GL_MAP2_VERTEX_3)
    gl.glMapGrid2f(20, 0, 1, 20, 0, 1)
    gl.glColor4f(1, 1, 1, 1)


def bezsurf(gl: Any) -> None:
    surface(gl)
    for j in range(9):
        gl.glBegin(ev.GL_LINE_STRIP)
        for i in range(31):
            gl.glEvalCoord2f(i / 30, j / 8)
        gl.glEnd()
        gl.glBegin(ev.GL_LINE_STRIP)
        for i in range(31):
            gl.glEvalCoord2f(j / 8, i / 30)
        gl.glEnd()


def bezmesh(gl: Any) -> None:
    surface(gl)
    gl.glEnable(ev.GL_AUTO_NORMAL)
    gl.glEvalMesh2(ev.GL_FILL, 0, 20, 0, 20)


def texturesurf(gl: Any) -> None:
    surface(gl)
    texpts = np.ascontiguousarray(TEXTURE_POINTS, np.float32)
    gl.glMap2f(ev.GL_MAP2_TEXTURE_COORD_2, 0, 1, 2, 2, 0, 1, 4, 2, pointer(gl, texpts))
    gl.glEnable(ev.GL_MAP2_TEXTURE_COORD_2)
    gl.glEvalMesh2(ev.GL_FILL, 0, 20, 0, 20)


def pointer(gl: Any, points: NDArray[np.float32]) -> Any:
    """C gets the place of the numbers, and copies them at the call."""
    return points.ctypes.data if isinstance(gl, RealOpenGL) else points


Program = Callable[[Any], None]
# half width of glOrtho; share of the pixels that may differ by more than 16 (the real one lights
# vertices, ours each fragment)
PROGRAMS: dict[Program, tuple[float, float]] = {
    bezcurve: (5.0, 1e-3),
    bezsurf: (4.0, 1e-3),
    bezmesh: (4.0, 1e-2),
    texturesurf: (4.0, 3e-3),
}


@pytest.fixture(scope="module")
def real() -> RealOpenGL:
    try:
        return RealOpenGL((SIZE, SIZE))
    except Missing as missing:
        pytest.skip(f"no real evaluators here: {missing}")


def waves() -> Image.Image:
    with Image.open(texture_path("waves")) as image:
        return image.convert("RGB").transpose(Image.Transpose.FLIP_TOP_BOTTOM)


def matrices(program: Program) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    half, modelview = PROGRAMS[program][0], np.eye(4)
    if program is not bezcurve:
        modelview = rotate(85.0, 1.0, 1.0, 1.0)
    return np.diag([1 / half, 1 / half, -1 / half, 1.0]), modelview


def drawn_by_the_real_one(real: RealOpenGL, program: Program) -> NDArray[np.uint8]:
    projection, modelview = matrices(program)
    keep = [np.array(m.T, np.float32).copy() for m in (projection, modelview)]
    with real.current() as gl:
        for cap in (*range(0x0D90, 0x0D99), *range(0x0DB0, 0x0DB9), ev.GL_AUTO_NORMAL):
            gl.glDisable(cap)
        gl.glViewport(0, 0, SIZE, SIZE)
        for mode, matrix in zip((PROJECTION, MODELVIEW), keep, strict=True):
            gl.glMatrixMode(mode)
            gl.glLoadMatrixf(matrix.ctypes.data)
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
        gl.glClear(0x4100)
        gl.glEnable(DEPTH_TEST)
        if program is bezmesh:
            light(gl, modelview)
        if program is texturesurf:
            texture(gl)
        program(gl)
        pixels = np.zeros((SIZE, SIZE, 3), np.uint8)
        gl.glPixelStorei(PACK, 1)
        gl.glReadPixels(0, 0, SIZE, SIZE, RGB, UNSIGNED_BYTE, pixels.ctypes.data)
        for cap in (DEPTH_TEST, LIGHTING, LIGHT0, TEXTURE_2D):
            gl.glDisable(cap)
        gl.glFrontFace(CCW)
    return pixels


def light(gl: Any, modelview: NDArray[np.float64]) -> None:
    """glEvalMesh2 winds clockwise: both sides are lit only if that is called the front."""
    gl.glEnable(LIGHTING)
    gl.glEnable(LIGHT0)
    gl.glFrontFace(CW)
    gl.glLightModeli(TWO_SIDE, 1)
    gl.glLoadIdentity()  # the light stands in eye coordinates
    values = {AMBIENT: (*LIGHT.ambient, 1), POSITION: LIGHT.position}
    keep = [np.array(v, np.float32) for v in values.values()]
    for name, value in zip(values, keep, strict=True):
        gl.glLightfv(LIGHT0, name, value.ctypes.data)
    again = np.array(modelview.T, np.float32).copy()
    gl.glLoadMatrixf(again.ctypes.data)
    for name, value in ((DIFFUSE, LIGHT.material_diffuse), (SPECULAR, LIGHT.material_specular)):
        material = np.array((*value, 1.0), np.float32)
        gl.glMaterialfv(FRONT_AND_BACK, name, material.ctypes.data)
    gl.glMaterialf(FRONT_AND_BACK, SHININESS, LIGHT.shininess)


def texture(gl: Any) -> None:
    image = np.array(waves())
    gl.glPixelStorei(UNPACK, 1)
    for name in (MIN_FILTER, MAG_FILTER):
        gl.glTexParameteri(TEXTURE_2D, name, NEAREST)
    size = (image.shape[1], image.shape[0])
    gl.glTexImage2D(TEXTURE_2D, 0, RGB, *size, 0, RGB, UNSIGNED_BYTE, image.ctypes.data)
    gl.glEnable(TEXTURE_2D)


@pytest.fixture
def screen(studio: Studio) -> Iterator[moderngl.Framebuffer]:
    ctx = studio.ctx
    parts = [ctx.renderbuffer((SIZE, SIZE), 4), ctx.depth_renderbuffer((SIZE, SIZE))]
    framebuffer = ctx.framebuffer(parts[:1], parts[1])
    with ctx.scope(framebuffer, moderngl.DEPTH_TEST):
        framebuffer.clear(0.0, 0.0, 0.0, 1.0)
        yield framebuffer
    for part in (framebuffer, *parts):
        part.release()


@pytest.mark.parametrize("program", PROGRAMS)
def test_as_the_real_one_draws_it(
    studio: Studio, real: RealOpenGL, screen: moderngl.Framebuffer, program: Program
) -> None:
    reference = drawn_by_the_real_one(real, program)
    gl = Evaluators(painter=studio.painter)
    program(gl)
    projection, modelview = matrices(program)
    image = waves()
    picture = studio.ctx.texture(image.size, 3, image.tobytes(), alignment=1)
    picture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    gl.draw(
        projection=projection,
        modelview=modelview,
        light=LIGHT if program is bezmesh else None,
        texture=picture if program is texturesurf else None,
    )
    picture.release()
    found = np.frombuffer(screen.read(alignment=1), np.uint8).reshape(SIZE, SIZE, 3)
    assert np.count_nonzero(reference.max(-1)) > 200
    PICTURES.mkdir(parents=True, exist_ok=True)
    both = np.concatenate([reference[::-1], found[::-1]], 1)
    Image.fromarray(both).save(PICTURES / f"{program.__name__}.png")
    off = np.abs(reference.astype(int) - found).max(-1)
    assert np.mean(off > 16) <= PROGRAMS[program][1]
