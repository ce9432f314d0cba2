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
    """Colour and depth of one size, and the picture resolved from them.

    `samples` 0 asks for the most up to 8, 1 for none; others are rounded down to a power of two
    that there is. Raises GraphicsError if there is too little memory.
    """

    def __init__(
        self, ctx: moderngl.Context, size: tuple[int, int], samples: int, capabilities: Capabilities
    ) -> None:
        self.size = check_size(*size, capabilities)
        most = min(samples or DEFAULT_SAMPLES, capabilities.samples)
        multisampled = 1 << (most.bit_length() - 1) if most > 1 else 0
        self._ctx = ctx
        self._parts: list[moderngl.Renderbuffer | moderngl.Framebuffer] = []
        try:
            self.resolved = self._framebuffer(0, depth=False)
            self.framebuffer = self._framebuffer(multisampled, depth=True)
            failed = ctx.error == "GL_OUT_OF_MEMORY"
        except moderngl.Error:
            failed = True
        if failed:
            self.release()
            raise GraphicsError(
                f"expected memory for {size[0]}x{size[1]} with {max(1, multisampled)} samples a "
                "pixel, found too little; --set samples=1 takes the least"
            )

    def _framebuffer(self, samples: int, depth: bool) -> moderngl.Framebuffer:
        # The attachments are held: releasing a framebuffer alone would leak them.
        color = self._ctx.renderbuffer(self.size, 4, samples=samples)
        self._parts.append(color)
        deep = None
        if depth:
            deep = self._ctx.depth_renderbuffer(self.size, samples=samples)
            self._parts.append(deep)
        framebuffer = self._ctx.framebuffer([color], deep)
        self._parts.append(framebuffer)
        return framebuffer

    def resolve(self) -> None:
        """The frame is whole: average its samples into the picture, which stays until the next."""
        self._copy(self.resolved, self.framebuffer)

    def show(self) -> None:
        """The picture onto the window's framebuffer, which is bound from then on."""
        screen = self._ctx.detect_framebuffer(0)
        screen.viewport = (0, 0, *self.size)
        self._copy(screen, self.resolved)
        screen.use()

    def _copy(self, to: moderngl.Framebuffer, source: moderngl.Framebuffer) -> None:
        # moderngl then restores the bound framebuffer's buffers by a call that knows no GL_BACK,
        # the window's, before OpenGL 4.0: so one of ours is bound.
        source.use()
        self._ctx.copy_framebuffer(to, source)

    def pixels(self) -> NDArray[np.uint8]:
        """The picture (height, width, 3), top row first."""
        width, height = self.size
        data = self.resolved.read(components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]

    def release(self) -> None:
        """Give the memory back."""
        for part in reversed(self._parts):
            part.release()
        self._parts.clear()
