"""The evaluators in an OpenGL context: recorded calls drawn, or read back."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .errors import InvalidValue
from .light import Light
from .maps import Array
from .recorder import Recorder
from .recording import Evaluated, Recording

if TYPE_CHECKING:
    import moderngl

    from ..gpu.painter import Painter


class Evaluators(Recorder):
    """A Recorder that can draw.

    `ctx` is the moderngl context to draw in, which must stay current; None makes a headless one
    of our own when it is first needed. All drawing is gpu's, which is asked for here, late: a
    Recorder alone needs no OpenGL. A host that has a painter in that context shares its programs.
    """

    def __init__(
        self, ctx: moderngl.Context | None = None, *, painter: Painter | None = None
    ) -> None:
        super().__init__()
        self._given = ctx if painter is None else painter

    @cached_property
    def _painter(self) -> Painter:
        from ..gpu.context import create_headless
        from ..gpu.painter import Painter

        if isinstance(self._given, Painter):
            return self._given
        return Painter(self._given if self._given is not None else create_headless())

    @property
    def ctx(self) -> moderngl.Context:
        """The context. Raises GraphicsError where OpenGL does not start."""
        return self._painter.ctx

    def read(
        self, recording: Recording | None = None, *, evaluator: str | None = None
    ) -> list[Evaluated]:
        """The recording, or all since the last `take`, `read` or `draw`, as numpy arrays: one
        Evaluated for each glEvalMesh and each glBegin ... glEnd.

        `evaluator` is "vertex" (the default) or "tessellation".
        """
        from ..gpu.evaluated import read_recording

        return read_recording(self._painter, self._taken("read", recording), evaluator)

    def draw(
        self,
        recording: Recording | None = None,
        program: moderngl.Program | None = None,
        *,
        projection: ArrayLike | None = None,
        modelview: ArrayLike | None = None,
        light: Light | None = None,
        texture: moderngl.Texture | None = None,
    ) -> None:
        """Draw the recording, or all since the last `take`, `read` or `draw`, into the current
        framebuffer, with the state that the context has.

        With a program of yours, whose uniforms and textures are yours to set, each vertex
        attribute called position, normal, color, texcoord or index (or in_position ...) is fed
        by its map or by the current value. Without one, the built-in program has the matrices
        (4, 4) for column vectors, the light, and the texture, times the colour. A recording that
        is drawn again is not evaluated again.
        """
        recording = self._taken("draw", recording)
        if light is not None and not isinstance(light, Light):
            raise InvalidValue(f"draw: light: expected a Light, found {light!r}")
        if program is not None:
            self._painter.recordings.draw(recording, program)
        else:
            matrices = (_matrix("projection", projection), _matrix("modelview", modelview))
            self._painter.recordings.draw_built_in(recording, *matrices, light, texture)

    def _taken(self, call: str, recording: Recording | None) -> Recording:
        if isinstance(recording, Recording):
            return recording
        if recording is None:
            return self.take()
        raise InvalidValue(
            f"{call}: recording: expected what take() has handed over, or glu.recording(surface), "
            f"found a {type(recording).__name__}"
        )


def _matrix(name: str, given: ArrayLike | None) -> Array:
    matrix = np.eye(4) if given is None else np.asarray(given, np.float64)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise InvalidValue(f"draw: {name}: expected 4 x 4 finite numbers, found {matrix.tolist()}")
    return matrix
