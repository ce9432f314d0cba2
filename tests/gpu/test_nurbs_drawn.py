"""NURBS drawn into a framebuffer through `Evaluators.draw`, and the porting guide's example."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.evaluators import GL_MAP2_COLOR_4, GL_MAP2_VERTEX_3, Evaluators
from reparam.evaluators.glu import (
    GLU_DISPLAY_MODE,
    GLU_MAP1_TRIM_2,
    GLU_OUTLINE_PATCH,
    gluBeginSurface,
    gluBeginTrim,
    gluEndSurface,
    gluEndTrim,
    gluNewNurbsRenderer,
    gluNurbsProperty,
    gluNurbsSurface,
    gluPwlCurve,
)
from reparam.evaluators.tessellations import Tessellation, recording
from reparam.snapshot import Studio

SIZE = 64
KNOTS = [0.0, 0.0, 0.5, 1.0, 1.0]
SQUARE = [[(x, y, 0.0) for y in (-1.0, 0.0, 1.0)] for x in (-1.0, 0.0, 1.0)]
BORDER = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]
HOLE = [[0.25, 0.25], [0.25, 0.75], [0.75, 0.75], [0.75, 0.25], [0.25, 0.25]]


@pytest.fixture
def screen(studio: Studio) -> Iterator[moderngl.Framebuffer]:
    """A black square framebuffer, in use."""
    target = studio.ctx.simple_framebuffer((SIZE, SIZE))
    target.use()
    target.clear()
    studio.ctx.enable_only(moderngl.NOTHING)
    yield target
    studio.ctx.extra.use()
    target.release()


def lit(screen: moderngl.Framebuffer) -> NDArray[np.bool_]:
    pixels = np.frombuffer(screen.read(), np.uint8).reshape(SIZE, SIZE, 3)
    return np.asarray(pixels.any(-1))


def draw_square(studio: Studio, display: int | None = None) -> None:
    """The whole screen, green by a colour map, but for a hole in the middle."""
    nurb = gluNewNurbsRenderer()
    if display is not None:
        gluNurbsProperty(nurb, GLU_DISPLAY_MODE, display)
    gluBeginSurface(nurb)
    gluNurbsSurface(nurb, [0, 1], [0, 1], [[[0, 1, 0, 1]]], GL_MAP2_COLOR_4)
    gluNurbsSurface(nurb, KNOTS, KNOTS, SQUARE, GL_MAP2_VERTEX_3)
    for loop in (BORDER, HOLE):
        gluBeginTrim(nurb)
        gluPwlCurve(nurb, loop, GLU_MAP1_TRIM_2)
        gluEndTrim(nurb)
    gluEndSurface(nurb)
    Evaluators(studio.ctx).draw(recording(*nurb.take()))


def test_a_trimmed_surface(studio: Studio, screen: moderngl.Framebuffer) -> None:
    draw_square(studio)
    expected = np.ones((SIZE, SIZE), bool)
    expected[SIZE // 4 : -SIZE // 4, SIZE // 4 : -SIZE // 4] = False
    assert (lit(screen) == expected).all()


def test_its_outline(studio: Studio, screen: moderngl.Framebuffer) -> None:
    draw_square(studio, GLU_OUTLINE_PATCH)
    assert 0.05 < lit(screen).mean() < 0.2
    assert not lit(screen)[SIZE // 2 - 8 : SIZE // 2 + 8, SIZE // 2 - 8 : SIZE // 2 + 8].any()


@pytest.mark.usefixtures("screen")
def test_the_porting_guide_s_example_runs(studio: Studio) -> None:
    text = (Path(__file__).parents[2] / "docs" / "porting.md").read_text("utf-8")
    _, block = re.findall(r"```python\n(.+?)```", text, re.DOTALL)
    points = [[(u, v, u * v) for v in range(4)] for u in range(4)]
    names = {"ctx": studio.ctx, "ctlpoints": points, "knots": [0, 0, 0, 0, 1, 1, 1, 1]}
    names |= {"P": np.eye(4), "M": np.eye(4), "modelview": np.eye(4), "projection": np.eye(4)}
    names["viewport"] = (0, 0, 256, 256)
    exec(block, names)
    mesh = names["mesh"]
    assert isinstance(mesh, Tessellation)
    x, y, z = mesh.points.T
    np.testing.assert_allclose(z, x * y, atol=1e-5)
    np.testing.assert_allclose(mesh.parameters, np.stack([x, y], -1) / 3.0, atol=1e-6)
