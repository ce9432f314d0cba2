"""NURBS drawn into a framebuffer through `Evaluators.draw`, and the porting guide's example."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.evaluators import GL_MAP2_COLOR_4, GL_MAP2_VERTEX_3, Evaluators
from reparam.evaluators.glu import (
    GLU_DISPLAY_MODE,
    GLU_DOMAIN_DISTANCE,
    GLU_MAP1_TRIM_2,
    GLU_MAP1_TRIM_3,
    GLU_OUTLINE_PATCH,
    GLU_PATH_LENGTH,
    GLU_SAMPLING_METHOD,
    GLU_SAMPLING_TOLERANCE,
    GLU_U_STEP,
    GLU_V_STEP,
    gluBeginSurface,
    gluBeginTrim,
    gluEndSurface,
    gluEndTrim,
    gluLoadSamplingMatrices,
    gluNewNurbsRenderer,
    gluNurbsCurve,
    gluNurbsProperty,
    gluNurbsSurface,
    gluPwlCurve,
)
from reparam.evaluators.nurbs_parts import recording
from reparam.evaluators.recording import Recording
from reparam.evaluators.tessellations import Tessellation
from reparam.geometry.net import Array
from reparam.geometry.trimming import trim_region
from reparam.gpu.targets import Target
from reparam.snapshot import Studio
from trim_cases import Loop, circle, reverse

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


def plane(loops: list[Loop], *, method: int, color: Array, varied: bool) -> Recording:
    """The whole screen in 2 x 2 pieces, (x, y) = (u, v), in a few large cells, and trimmed; the
    colour the same everywhere, or from a map that differs from piece to piece."""
    nurb = gluNewNurbsRenderer()
    gluNurbsProperty(nurb, GLU_SAMPLING_METHOD, method)
    gluNurbsProperty(nurb, GLU_SAMPLING_TOLERANCE, 200.0)
    for step in (GLU_U_STEP, GLU_V_STEP):
        gluNurbsProperty(nurb, step, 3)
    gluLoadSamplingMatrices(nurb, np.eye(4), np.eye(4), (0, 0, SIZE, SIZE))
    gluBeginSurface(nurb)
    if varied:
        colors = np.tile(color, (3, 3, 1))
        gluNurbsSurface(nurb, KNOTS, KNOTS, colors, GL_MAP2_COLOR_4)
    else:
        gluNurbsSurface(nurb, [0, 1], [0, 1], color[None, None], GL_MAP2_COLOR_4)
    gluNurbsSurface(nurb, KNOTS, KNOTS, SQUARE, GL_MAP2_VERTEX_3)
    for loop in loops:
        gluBeginTrim(nurb)
        for piece in loop:
            flat = [0.0] * len(piece) + [1.0] * len(piece)
            gluNurbsCurve(nurb, flat, piece, GLU_MAP1_TRIM_3)
        gluEndTrim(nurb)
    gluEndSurface(nurb)
    return recording(*nurb.take())


LOOPS = [circle((0.45, 0.55), 0.4), reverse(circle((0.35, 0.6), 0.15)), circle((0.34, 0.6), 0.07)]


@pytest.mark.parametrize("varied", [False, True])
@pytest.mark.parametrize("method", [GLU_DOMAIN_DISTANCE, GLU_PATH_LENGTH])
def test_pixel_centres_against_float64(
    studio: Studio, screen: moderngl.Framebuffer, method: int, varied: bool
) -> None:
    """Chords at this tolerance leave ten pixels or more on the wrong side."""
    kept = plane(LOOPS, method=method, color=np.ones(4), varied=varied)
    Evaluators(studio.ctx).draw(kept)
    region = trim_region([[piece.astype(np.float32) for piece in loop] for loop in LOOPS])
    t = (np.arange(SIZE) + 0.5) / SIZE
    u, v = np.meshgrid(t, t)
    wrong = lit(screen) != region.inside(u, v)
    assert (np.abs(region.signed_distance(u[wrong], v[wrong])) * SIZE < 1e-3).all()
    assert 0.3 < lit(screen).mean() < 0.5


def test_surfaces_that_share_their_trims_leave_no_crack(studio: Studio) -> None:
    """Each of a pixel's samples belongs to one of the two."""
    if studio.painter.capabilities.samples < 4:
        pytest.skip(f"{studio.painter.capabilities.renderer} has not 4 samples a pixel")
    border = [np.array([(*a, 1.0), (*b, 1.0)]) for a, b in pairwise(BORDER)]
    parts = (LOOPS, [border, *(reverse(loop) for loop in LOOPS)])
    target = Target(studio.ctx, (SIZE, SIZE), 4, studio.painter.capabilities)
    target.framebuffer.use()
    target.framebuffer.clear()
    studio.ctx.enable_only(moderngl.BLEND)
    studio.ctx.blend_func = moderngl.ONE, moderngl.ONE
    for loops, color in zip(parts, [(1, 0, 0, 1), (0, 1, 0, 1)], strict=True):
        for varied in (False, True):
            half = np.array(color) * 0.5
            drawn = plane(loops, method=GLU_DOMAIN_DISTANCE, color=half, varied=varied)
            Evaluators(studio.ctx).draw(drawn)
    target.resolve()
    pixels = target.pixels().astype(int)
    studio.ctx.enable_only(moderngl.NOTHING)
    studio.ctx.extra.use()
    target.release()
    assert np.isin(pixels[..., :2].sum(-1), [254, 255, 256]).all()
    mixed = (pixels[..., 0] > 2) & (pixels[..., 0] < 253)
    assert mixed.sum() > 100


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
