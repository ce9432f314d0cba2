"""Where pictures are drawn: a multisampled framebuffer and the plain one it resolves into."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError
from .context import Capabilities

DEFAULT_SAMPLES = 8
LARGEST_SIDE = 16384


def check_size(width: int, height: int, capabilities: Capabilities) -> tuple[int, int]:
    """The size itself, or GraphicsError if no framebuffer can have it."""
    most = min(LARGEST_SIDE, capabilities.largest)
    if not (1 <= width <= most and 1 <= height <= most):
        raise GraphicsError(f"expected a size from 1x1 to {most}x{most}, found {width}x{height}")
    return width, height


class Target:
    """Colour and depth of one size. `samples` 0 asks for the most up to 8, 1 for none."""

    def __init__(
        self, ctx: moderngl.Context, size: tuple[int, int], samples: int, capabilities: Capabilities
    ) -> None:
        self.size = check_size(*size, capabilities)
        most = min(samples or DEFAULT_SAMPLES, capabilities.samples)
        self._ctx = ctx
        self._parts: list[moderngl.Renderbuffer | moderngl.Framebuffer] = []
        multisampled = most if most > 1 else 0
        self.framebuffer = self._framebuffer(multisampled, depth=True)
        self._resolved = self._framebuffer(0, depth=False) if multisampled else self.framebuffer
        if ctx.error == "GL_OUT_OF_MEMORY":
            raise GraphicsError(
                f"expected memory for {size[0]}x{size[1]} with {most} samples a pixel, "
                "found too little; --set samples=1 takes less"
            )

    def _framebuffer(self, samples: int, depth: bool) -> moderngl.Framebuffer:
        # The attachments are held: releasing a framebuffer alone would leak them.
        color = self._ctx.renderbuffer(self.size, 4, samples=samples)
        deep = self._ctx.depth_renderbuffer(self.size, samples=samples) if depth else None
        framebuffer = self._ctx.framebuffer([color], deep)
        self._parts += [part for part in (framebuffer, color, deep) if part is not None]
        return framebuffer

    def resolve(self) -> moderngl.Framebuffer:
        """The picture without multisampling."""
        if self._resolved is not self.framebuffer:
            self._ctx.copy_framebuffer(self._resolved, self.framebuffer)
        return self._resolved

    def pixels(self) -> NDArray[np.uint8]:
        """The picture (height, width, 3), top row first."""
        width, height = self.size
        data = self.resolve().read(components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]

    def release(self) -> None:
        """Give the memory back."""
        for part in self._parts:
            part.release()
        self._parts.clear()
