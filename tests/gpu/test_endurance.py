"""Ten thousand frames with edits, levels and views that change leave memory as it was."""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from test_memory import MIB, STATM, resident

from reparam.evaluators import (
    GL_AUTO_NORMAL,
    GL_FILL,
    GL_LINE,
    GL_MAP2_TEXTURE_COORD_2,
    GL_MAP2_VERTEX_3,
    GL_QUAD_STRIP,
    Evaluators,
)
from reparam.geometry.camera import View
from reparam.gpu.targets import Target
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject

FRAMES = 10_000
WARM = 2_000  # frames: every level, scene and program has been seen several times
SIZE = (64, 48)

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not STATM.exists(), reason="/proc/self/statm is Linux"),
]


def growth(frame: Callable[[int], None]) -> int:
    """Bytes by which the process has grown between the warm-up and the last frame."""
    before = 0
    for number in range(FRAMES):
        frame(number)
        if number == WARM:
            before = settled()
    return settled() - before


def settled() -> int:
    """Resident memory without what the allocator keeps for later."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    return resident()


def edited(number: int) -> Subject:
    """A frame's subject: one of three scenes in turn, edited since the frame before."""
    random = np.random.default_rng(number)
    turn = number // 25  # frames of one scene, as a hand drags
    level = 1 + turn % 13
    name = ("fig5", "fig9", "fig4")[turn % 3]
    subject = open_subject(name).changed("level", level).changed("samples", 1)
    subject = subject.changed("net", turn % 2 == 0)
    if name == "fig9":
        moved = np.array([[random.integers(8), *random.uniform(-1.0, 1.0, 3)]])
        subject = subject.changed("moved", moved)
        view = View(azimuth=float(number), elevation=20.0)
        subject = replace(subject, views={"patches": view})
    else:
        subject = subject.changed("morph", float(random.uniform()))
    if turn % 5 == 4:
        subject = subject.changed("tolerance", 0.5 + turn % 3)
    return subject.changed("wireframe", turn % 7 == 6)


@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
def test_scenes(studio: Studio, evaluator: str) -> None:
    studio.evaluator = evaluator
    try:
        assert growth(lambda number: _drawn(studio, edited(number))) <= 4 * MIB
    finally:
        studio.evaluator = None


def _drawn(studio: Studio, subject: Subject) -> None:
    studio.draw(subject, SIZE)
    assert studio.ctx.error == "GL_NO_ERROR"


def test_evaluators(studio: Studio) -> None:
    """What a program does that was ported: new points, a mesh, a strip, drawn and now and then
    read."""
    gl = Evaluators(painter=studio.painter)
    target = Target(studio.ctx, SIZE, 0, studio.painter.capabilities)

    def frame(number: int) -> None:
        random = np.random.default_rng(number)
        steps = 1 + number // 25 % 30
        gl.glEnable(GL_AUTO_NORMAL)
        order = int(random.integers(2, 6))
        gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, random.uniform(-1, 1, (order, 4, 3)))
        gl.glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 0, 1, random.uniform(-1, 1, (2, 2, 2)))
        gl.glEnable(GL_MAP2_VERTEX_3)
        gl.glEnable(GL_MAP2_TEXTURE_COORD_2)
        gl.glMapGrid2f(steps, 0, 1, 7, 0, 1)
        gl.glEvalMesh2(GL_LINE if number % 3 == 0 else GL_FILL, 0, steps, 0, 7)
        gl.glBegin(GL_QUAD_STRIP)
        for u, v in random.uniform(size=(6, 2)):
            gl.glEvalCoord2f(u, v)
        gl.glEnd()
        target.framebuffer.use()
        target.framebuffer.clear()
        if number % 10 == 0:
            gl.read()
        else:
            gl.draw()
        studio.ctx.finish()
        assert studio.ctx.error == "GL_NO_ERROR"

    try:
        assert growth(frame) <= 4 * MIB
    finally:
        studio.ctx.extra.use()
        target.release()
