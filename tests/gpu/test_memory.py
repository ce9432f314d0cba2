"""Nothing is kept of what is not drawn any more."""

from __future__ import annotations

import ctypes
import os
import platform
import resource
from collections.abc import Callable
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import pytest

from reparam.gpu.kept import Kept
from reparam.snapshot import Studio
from reparam.subject import open_subject

STATM = Path("/proc/self/statm")
FRAMES = 120
MIB = 1 << 20
OBJECTS = [
    "buffer", "vertex_array", "texture", "renderbuffer", "depth_renderbuffer", "framebuffer"
]  # fmt: skip


def resident() -> int:
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not STATM.exists(), reason="/proc/self/statm is Linux")
@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
def test_a_morph_of_many_frames_leaves_memory_as_it_was(studio: Studio, evaluator: str) -> None:
    subject = open_subject("fig5").changed("level", 8).changed("net", True)
    before = 0
    studio.evaluator = evaluator
    try:
        for frame in range(FRAMES):
            if frame == FRAMES // 4:
                before = resident()
            picture = studio.draw(subject.changed("morph", frame / FRAMES), (48, 40))
            assert picture.shape == (40, 48, 3)
    finally:
        studio.evaluator = None
    assert resident() - before < 8 * MIB


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="the GNU C library's mallopt")
def test_memory_for_a_software_rasteriser_is_kept(studio: Studio) -> None:
    """What it frees after a frame is there for the next one, without page faults."""
    if not studio.painter.capabilities.software:
        pytest.skip("not a software rasteriser")
    libc, size = ctypes.CDLL(None), 100_000
    libc.malloc.restype, libc.free.argtypes = ctypes.c_void_p, [ctypes.c_void_p]
    faults = []
    for _ in range(3):
        blocks = [libc.malloc(size) for _ in range(200)]
        for block in blocks:
            ctypes.memset(block, 1, size)
        for block in blocks:
            libc.free(block)
        faults.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt)
    assert faults[2] - faults[1] < 200


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """All that is made of OpenGL objects from now on."""
    objects: list[Any] = []

    def recorded(make: Callable[..., Any]) -> Callable[..., Any]:
        def record(*arguments: Any, **named: Any) -> Any:
            objects.append(make(*arguments, **named))
            return objects[-1]

        return record

    for kind in OBJECTS:
        monkeypatch.setattr(moderngl.Context, kind, recorded(getattr(moderngl.Context, kind)))
    return objects


@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
@pytest.mark.parametrize(("name", "fine"), [("level", 4), ("tolerance", 0.5)])
def test_no_object_outlives_its_use(
    studio: Studio, made: list[Any], evaluator: str, name: str, fine: float
) -> None:
    subject = open_subject("fig5").changed(name, fine).changed("net", True)
    studio.evaluator = evaluator
    alive = []
    try:
        for frame in range(50):
            studio.draw(subject.changed("morph", frame / 50), (16, 16))
            alive.append(sum(not isinstance(o.mglo, moderngl.InvalidObject) for o in made))
    finally:
        studio.evaluator = None
    assert len(made) > 50 * 10
    # What is kept for longer may end, and lines are sampled as finely as they bend.
    assert np.ptp(alive[40:]) < 5, alive


def test_a_result_is_made_once_while_it_is_used() -> None:
    made: list[int] = []
    kept: Kept[int] = Kept(lambda _: None, frames=2)
    array = np.zeros(3)
    for _ in range(10):
        assert kept.get(array, "key", lambda: made.append(1) or len(made)) == 1
        kept.sweep()
    kept.get(array, "other key", lambda: made.append(2) or len(made))
    kept.get(array.copy(), "key", lambda: made.append(3) or len(made))
    assert made == [1, 2, 3]


def test_what_is_not_used_is_released_once() -> None:
    released: list[str] = []
    kept: Kept[str] = Kept(released.append, frames=2)
    used, unused = np.zeros(1), np.zeros(1)
    kept.get(unused, None, lambda: "unused")
    history = []
    for _ in range(6):
        kept.get(used, None, lambda: "used")
        kept.sweep()
        history.append(released.copy())
    assert history == [[], [], *[["unused"]] * 4]
    kept.clear()
    kept.clear()
    assert released == ["unused", "used"]


def test_arrays_made_and_dropped_are_never_confused() -> None:
    kept: Kept[float] = Kept(lambda _: None, frames=3)
    for value in range(100):
        array = np.full(4, float(value))
        assert kept.get(array, None, lambda array=array: float(array[0])) == value
        kept.sweep()
