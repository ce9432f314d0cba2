"""OpenGL's evaluators under the names their users know.

from reparam.evaluators import *

gl = Recorder()
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
