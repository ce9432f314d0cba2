"""Frames to be timed: a layer drawn into a multisampled target, until the GPU has finished."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import moderngl
import numpy as np

import reparam
from reparam.geometry.camera import Camera
from reparam.geometry.net import Array
from reparam.gpu.targets import Target
from reparam.snapshot import Studio

FROM_ABOVE = Camera(np.eye(3), np.zeros(3), 1.05, 1.05, 4.0)
"""Shows [-1,1]^2, and a little more."""

Draw = Callable[[], object]

OTHER = 24  # grey levels: a pixel of another picture
FEW = 0.02  # share of pixels at edges, where bits of another evaluation may tell


@dataclass(frozen=True)
class Frame:
    """Makes of a drawing a whole frame: clear, draw, finish."""

    studio: Studio
    target: Target

    def __call__(self, draw: Draw) -> Callable[[], None]:
        """A function that draws the frame."""

        def run() -> None:
            self.target.framebuffer.use()
            self.target.framebuffer.clear(1.0, 1.0, 1.0, depth=1.0)
            self.studio.ctx.enable(moderngl.DEPTH_TEST)
            draw()
            self.studio.ctx.finish()

        return run

    def check_alike(self, ours: Draw, other: Draw) -> None:
        """Times of different pictures say nothing. Raises AssertionError if these are two."""
        pictures = []
        for draw in (ours, other):
            self(draw)()
            self.target.resolve()
            pictures.append(self.target.pixels().astype(int))
        assert np.ptp(pictures[0]) > OTHER, "nothing is drawn"
        different = (np.abs(pictures[0] - pictures[1]).max(-1) > OTHER).mean()
        assert different < FEW, f"expected one picture, found {different:.1%} of the pixels other"


@contextmanager
def frames(studio: Studio, size: tuple[int, int], samples: int = 0) -> Iterator[Frame]:
    """What makes frames of that size."""
    target = Target(studio.ctx, size, samples, studio.painter.capabilities)
    try:
        yield Frame(studio, target)
    finally:
        studio.ctx.disable(moderngl.DEPTH_TEST)
        studio.ctx.extra.use()
        target.release()


def python(*words: str) -> str:
    """What a Python process prints that imports the package that runs here."""
    environment = os.environ | {"PYTHONPATH": str(Path(reparam.__file__).parents[1])}
    command = [sys.executable, *words]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=environment)
    return done.stdout


def wavy_patches(count: int, degree: int) -> Array:
    """Patches (count, d+1, d+1, 4) that tile [-1,1]^2, each with bumps of its own."""
    side = int(np.ceil(np.sqrt(count)))
    place = np.stack(np.divmod(np.arange(count), side), -1)[:, None, None, :]
    t = np.arange(degree + 1) / degree
    corner = np.stack(np.meshgrid(t, t, indexing="ij"), -1)
    nets = np.zeros((count, degree + 1, degree + 1, 4))
    nets[..., :2] = (place + corner) / side * 2.0 - 1.0
    nets[..., 2] = np.random.default_rng(1).normal(scale=0.2 / side, size=nets.shape[:3])
    nets[..., 3] = 1.0
    return nets
