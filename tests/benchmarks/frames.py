"""Frames to be timed: a layer drawn into a multisampled target, until the GPU has finished."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import moderngl
import numpy as np

from reparam.geometry.camera import Camera
from reparam.geometry.net import Array
from reparam.gpu.targets import Target
from reparam.snapshot import Studio

FROM_ABOVE = Camera(np.eye(3), np.zeros(3), 1.05, 1.05, 4.0)
"""Shows [-1,1]^2, and a little more."""

Frame = Callable[[Callable[[], object]], Callable[[], None]]


@contextmanager
def frames(studio: Studio, size: tuple[int, int], samples: int = 0) -> Iterator[Frame]:
    """A function that makes of a drawing a whole frame: clear, draw, finish."""
    target = Target(studio.ctx, size, samples, studio.painter.capabilities)

    def frame(draw: Callable[[], object]) -> Callable[[], None]:
        def run() -> None:
            target.framebuffer.use()
            target.framebuffer.clear(1.0, 1.0, 1.0, depth=1.0)
            studio.ctx.enable(moderngl.DEPTH_TEST)
            draw()
            studio.ctx.finish()

        return run

    try:
        yield frame
    finally:
        studio.ctx.disable(moderngl.DEPTH_TEST)
        studio.ctx.extra.use()
        target.release()


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
