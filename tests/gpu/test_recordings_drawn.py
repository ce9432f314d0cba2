"""Recorded evaluator calls, drawn by the built-in program and by one of the user's."""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam import evaluators as ev
from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_MAP2_COLOR_4,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    Evaluators,
    InvalidOperation,
    InvalidValue,
    Light,
    Recording,
)
from reparam.gpu import evaluation
from reparam.gpu.drawables import Drawable
from reparam.snapshot import Studio

SQUARE = np.array([[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0)]], float)
SIZE = 64
GROUND = (0.0, 0.0, 1.0)


@pytest.fixture
def gl(studio: Studio) -> Evaluators:
    return Evaluators(painter=studio.painter)


def define_square(gl: Evaluators) -> None:
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, SQUARE)
    gl.glEnable(GL_MAP2_VERTEX_3)
    gl.glEnable(GL_AUTO_NORMAL)


@pytest.fixture
def screen(studio: Studio) -> Iterator[moderngl.Framebuffer]:
    ctx = studio.ctx
    parts = [ctx.renderbuffer((SIZE, SIZE), 4), ctx.depth_renderbuffer((SIZE, SIZE))]
    framebuffer = ctx.framebuffer(parts[:1], parts[1])
    with ctx.scope(framebuffer, moderngl.DEPTH_TEST | moderngl.CULL_FACE):
        framebuffer.clear(*GROUND, 1.0)
        yield framebuffer
    for part in (framebuffer, *parts):
        part.release()


def picture(screen: moderngl.Framebuffer) -> NDArray[np.uint8]:
    """(row, column, 3), lowest row first."""
    return np.frombuffer(screen.read(alignment=1), np.uint8).reshape(SIZE, SIZE, 3)


def square_mesh(gl: Evaluators) -> Recording:
    define_square(gl)
    gl.glMap2f(GL_MAP2_COLOR_4, 0, 1, 0, 1, [[(0, 0, 0, 1), (0, 1, 0, 1)], [(1, 0, 0, 1)] * 2])
    gl.glMapGrid2f(4, 0, 1, 3, 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, 4, 0, 3)
    return gl.take()


def to_clip(low: float, high: float) -> NDArray[np.float64]:
    scale = 2 / (high - low)
    matrix = np.diag([scale, scale, 1.0, 1.0])
    matrix[:2, 3] = -1 - low * scale
    return matrix


def test_drawn_in_the_current_colour(gl: Evaluators, screen: moderngl.Framebuffer) -> None:
    """The culled back faces show that front is where the normal is."""
    gl.glColor3f(0.2, 0.4, 0.6)
    gl.draw(square_mesh(gl), projection=to_clip(-1, 1))
    found = picture(screen)
    assert (found[SIZE // 2 :, SIZE // 2 :] == [51, 102, 153]).all()
    assert (found[: SIZE // 2] == [0, 0, 255]).all()
    assert (found[:, : SIZE // 2] == [0, 0, 255]).all()


def test_drawn_in_the_mapped_colour(gl: Evaluators, screen: moderngl.Framebuffer) -> None:
    gl.glEnable(GL_MAP2_COLOR_4)
    gl.draw(square_mesh(gl), projection=to_clip(0, 1))
    u = (np.arange(SIZE) + 0.5) / SIZE
    found = picture(screen)
    np.testing.assert_allclose(found[10, :, 0], 255 * u, atol=0.6)
    np.testing.assert_allclose(found[:, 10, 1], 255 * u * (1 - u[10]), atol=0.6 + 255 / 48)


def test_drawn_with_a_texture(gl: Evaluators, screen: moderngl.Framebuffer, studio: Studio) -> None:
    pixels = np.random.default_rng(11).integers(0, 256, (4, 4, 3), dtype=np.uint8)
    texture = studio.ctx.texture((4, 4), 3, pixels.tobytes(), alignment=1)
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, SQUARE[..., :2])
    gl.glEnable(GL_MAP2_TEXTURE_COORD_2)
    gl.draw(square_mesh(gl), projection=to_clip(0, 1), texture=texture)
    texture.release()
    assert (picture(screen) == pixels.repeat(SIZE // 4, 0).repeat(SIZE // 4, 1)).all()


@pytest.mark.parametrize("turn", [0.0, 60.0, 180.0])
def test_lit_by_opengl_s_formula_on_both_sides(
    gl: Evaluators, screen: moderngl.Framebuffer, studio: Studio, turn: float
) -> None:
    a = np.radians(turn)
    modelview = np.eye(4)
    modelview[0, [0, 2]], modelview[2, [0, 2]] = (np.cos(a), np.sin(a)), (-np.sin(a), np.cos(a))
    modelview[:2, 3] = -0.5 * np.cos(a), -0.5
    studio.ctx.disable(moderngl.CULL_FACE)
    light = Light(material_specular=(0.1, 0.2, 0.3), shininess=2.0, diffuse=(1.0, 0.5, 0.25))
    projection = to_clip(-0.6, 0.6) @ np.diag([1, 1, -0.1, 1])
    gl.draw(square_mesh(gl), projection=projection, modelview=modelview, light=light)
    facing = abs(np.cos(a))
    expected = 0.2 * 0.2 + 0.8 * facing * np.array([1, 0.5, 0.25])
    expected += facing**2 * np.array([0.1, 0.2, 0.3])
    found = picture(screen)[SIZE // 2, SIZE // 2]
    np.testing.assert_allclose(found, 255 * np.minimum(expected, 1.0), atol=0.6)


VERTEX = """#version 330 core
in vec2 in_position; in float index; out float shade;
void main() { gl_Position = vec4(in_position, 0.0, 1.0); shade = index; }"""
FRAGMENT = """#version 330 core
in float shade; out vec4 color;
void main() { color = vec4(shade, 0.0, 0.0, 1.0); }"""


def test_drawn_with_a_program_of_one_s_own(
    gl: Evaluators, screen: moderngl.Framebuffer, studio: Studio
) -> None:
    program = studio.ctx.program(VERTEX, FRAGMENT)
    gl.glIndexf(0.4)
    gl.draw(square_mesh(gl), program)
    assert (picture(screen)[SIZE // 2 :, SIZE // 2 :] == [102, 0, 0]).all()
    program.release()
    odd = studio.ctx.program(VERTEX.replace("index", "weight"), FRAGMENT)
    with pytest.raises(InvalidOperation, match="attribute weight: expected position, normal"):
        gl.draw(square_mesh(gl), odd)
    odd.release()


def test_collections_are_drawn_too(gl: Evaluators, screen: moderngl.Framebuffer) -> None:
    define_square(gl)
    gl.glColor3f(1, 0, 0)
    gl.glBegin(ev.GL_QUADS)
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
        gl.glEvalCoord2f(u, v)
    gl.glEnd()
    gl.draw(projection=to_clip(-1, 1))
    assert (picture(screen)[SIZE // 2 :, SIZE // 2 :] == [255, 0, 0]).all()
    assert not gl.take().items


@pytest.mark.usefixtures("screen")
@pytest.mark.parametrize("page", ["docs/porting.md", "README.md"])
def test_the_pages_examples_run(studio: Studio, page: str) -> None:
    text = (Path(__file__).parents[2] / page).read_text("utf-8")
    block, *_ = re.findall(r"```python\n(.+?)```", text, re.DOTALL)  # GLU's: test_nurbs_drawn.py
    line = "ctx = moderngl.create_context()"
    assert line in block or page == "README.md"
    program = studio.ctx.program(VERTEX, FRAGMENT)
    names = {"ctx": studio.ctx, "points": np.ones((4, 4, 3)) * SQUARE[1, 1], "program": program}
    names |= {"P": np.eye(4), "M": np.eye(4)}
    exec(block.replace(line, ""), names)
    program.release()
    if page != "README.md":
        assert names["mesh"].vertices.shape == (441, 4)


@pytest.mark.usefixtures("screen")
@pytest.mark.parametrize("vectors", [evaluation.MOST_VECTORS, 0])
def test_a_recording_is_brought_to_the_gpu_once_and_its_memory_given_back(
    gl: Evaluators, monkeypatch: pytest.MonkeyPatch, vectors: int
) -> None:
    """On the spot or, where attributes are too few, evaluated beforehand."""
    monkeypatch.setattr(evaluation, "MOST_VECTORS", vectors)
    made, released = [], []
    upload = Drawable.__init__
    monkeypatch.setattr(
        Drawable, "__init__", lambda self, *parts: made.append(parts) or upload(self, *parts)
    )
    first, second = square_mesh(gl), square_mesh(gl)
    for _ in range(3):
        gl.draw(first, projection=to_clip(0, 1))
        gl.draw(second, projection=to_clip(0, 1))
    assert len(made) == 2
    release = Drawable.release
    monkeypatch.setattr(
        Drawable, "release", lambda self: released.append(self.owned) or release(self)
    )
    del first
    gc.collect()
    gl.draw(second, projection=to_clip(0, 1))
    (buffers,) = released
    assert buffers
    assert all(isinstance(buffer.mglo, moderngl.InvalidObject) for buffer in buffers)


def test_what_cannot_be_drawn_is_named(gl: Evaluators) -> None:
    mesh = square_mesh(gl)
    with pytest.raises(InvalidValue, match=r"draw: recording: .*, found a tuple"):
        gl.draw((mesh,))  # type: ignore[arg-type]
    with pytest.raises(InvalidValue, match=r"read: recording: .*, found a Batch"):
        gl.read(mesh.batches[0])  # type: ignore[arg-type]
    with pytest.raises(InvalidValue, match="draw: light: expected a Light, found 2"):
        gl.draw(mesh, light=2)  # type: ignore[arg-type]
