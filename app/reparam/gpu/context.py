"""OpenGL contexts, and what the one at hand can do."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import moderngl

from ..errors import GraphicsError
from .diagnosis import explain

MINIMUM = 330
TESSELLATION = 400
KEPT_MEMORY = {-1: 1 << 28, -3: 1 << 25}  # M_TRIM_THRESHOLD, M_MMAP_THRESHOLD of mallopt: bytes
SOFTWARE = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software", "gdi generic")


@dataclass(frozen=True)
class Capabilities:
    """What an OpenGL context offers."""

    version: int  # 330 is OpenGL 3.3
    renderer: str
    vendor: str
    driver: str  # the version in the driver's own words
    software: bool
    tessellation: bool
    samples: int
    anisotropy: float
    largest: int  # width and height of a texture or renderbuffer

    @property
    def evaluators(self) -> tuple[str, ...]:
        """Those that run here."""
        return ("vertex", "tessellation") if self.tessellation else ("vertex",)

    def evaluator(self, wanted: str | None) -> str:
        """The evaluator to use: the wanted one, else tessellation on a GPU that has it."""
        if wanted == "tessellation" and not self.tessellation:
            raise GraphicsError(
                f"--evaluator tessellation: expected OpenGL 4.0, found {self.version / 100:.1f} "
                f"({self.renderer}); --evaluator vertex needs only 3.3"
            )
        if wanted is not None:
            return wanted
        return "tessellation" if self.tessellation and not self.software else "vertex"


def capabilities(ctx: moderngl.Context) -> Capabilities:
    """Read off a live context."""
    renderer = ctx.info["GL_RENDERER"]
    return Capabilities(
        version=ctx.version_code,
        renderer=renderer,
        vendor=ctx.info["GL_VENDOR"],
        driver=ctx.info["GL_VERSION"],
        software=any(name in renderer.lower() for name in SOFTWARE),
        tessellation=ctx.version_code >= TESSELLATION,
        samples=ctx.max_samples,
        anisotropy=ctx.max_anisotropy,
        largest=min(ctx.info["GL_MAX_TEXTURE_SIZE"], ctx.info["GL_MAX_RENDERBUFFER_SIZE"]),
    )


def create_for_window() -> moderngl.Context:
    """The context that the windowing library has made current."""
    return _prepared(moderngl.create_context(require=MINIMUM))


def create_headless() -> moderngl.Context:
    """A context without a window: EGL on Linux, the system's own way elsewhere.

    Raises GraphicsError with the line that mends it.
    """
    backend: dict[str, Any] = {"backend": "egl"} if sys.platform.startswith("linux") else {}
    try:
        ctx = moderngl.create_context(require=MINIMUM, standalone=True, **backend)
    except Exception as error:  # moderngl raises bare Exception, and ImportError from glcontext
        raise GraphicsError(explain(str(error))) from error
    # Surfaceless EGL has no framebuffer of its own, and without one nothing is evaluated.
    ctx.extra = ctx.framebuffer([ctx.renderbuffer((1, 1))])
    ctx.extra.use()
    return _prepared(ctx)


def _prepared(ctx: moderngl.Context) -> moderngl.Context:
    """A software rasteriser takes and frees some megabytes in each frame. The GNU C library hands
    them back to the system and gets them anew, page by page: a third of the time of a frame of
    many triangles. So it is asked to keep them; other libraries have no such word.
    """
    if sys.platform.startswith("linux") and capabilities(ctx).software:
        mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
        if mallopt is not None:
            for parameter, value in KEPT_MEMORY.items():
                mallopt(parameter, value)
    return ctx


@contextmanager
def bound(
    ctx: moderngl.Context, framebuffer: moderngl.Framebuffer, flags: int = 0
) -> Iterator[None]:
    """With this framebuffer and only these flags enabled; then all as it was."""
    scope = ctx.scope(framebuffer, flags)
    try:
        with scope:
            yield
    finally:
        scope.release()  # or its memory is lost
