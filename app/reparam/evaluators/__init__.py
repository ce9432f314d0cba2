"""OpenGL's evaluators under the names their users know.

    from reparam.evaluators import *

    gl = Evaluators()            # or Evaluators(ctx), in a moderngl context of yours
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, points)
    gl.glEnable(GL_MAP2_VERTEX_3)
    gl.glMapGrid2f(20, 0, 1, 20, 0, 1)
    gl.glEvalMesh2(GL_FILL, 0, 20, 0, 20)
    mesh = gl.take()             # what was recorded: gl.draw(mesh), gl.read(mesh)

docs/porting.md has OpenGL's calls on the left and these on the right.
"""

from __future__ import annotations

from . import constants
from .constants import *  # noqa: F403
from .errors import (
    InvalidEnum,
    InvalidOperation,
    InvalidValue,
    OpenGLError,
    StackOverflow,
    StackUnderflow,
)
from .light import Light
from .recorder import Recorder
from .recording import Evaluated, Recording
from .session import Evaluators

__all__ = [
    "Evaluated",
    "Evaluators",
    "InvalidEnum",
    "InvalidOperation",
    "InvalidValue",
    "Light",
    "OpenGLError",
    "Recorder",
    "Recording",
    "StackOverflow",
    "StackUnderflow",
    *(name for name in vars(constants) if name.startswith("GL_")),
]
