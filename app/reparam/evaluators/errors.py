"""OpenGL's errors as exceptions: raised at the call, naming the argument and what was found.

A call that raises changes nothing, as in OpenGL, where it would have left its error for
glGetError.
"""

from __future__ import annotations

from ..errors import ReparamError
from .constants import (
    GL_INVALID_ENUM,
    GL_INVALID_OPERATION,
    GL_INVALID_VALUE,
    GL_STACK_OVERFLOW,
    GL_STACK_UNDERFLOW,
)


class OpenGLError(ReparamError):
    """What glGetError would have returned, as `code`."""

    code = 0


class InvalidEnum(OpenGLError, ValueError):
    """GL_INVALID_ENUM: a constant that does not belong there."""

    code = GL_INVALID_ENUM


class InvalidValue(OpenGLError, ValueError):
    """GL_INVALID_VALUE: a number, or an array, out of range."""

    code = GL_INVALID_VALUE


class InvalidOperation(OpenGLError):
    """GL_INVALID_OPERATION: not now, as inside glBegin/glEnd."""

    code = GL_INVALID_OPERATION


class StackOverflow(OpenGLError):
    """GL_STACK_OVERFLOW: glPushAttrib once too often."""

    code = GL_STACK_OVERFLOW


class StackUnderflow(OpenGLError):
    """GL_STACK_UNDERFLOW: glPopAttrib without glPushAttrib."""

    code = GL_STACK_UNDERFLOW
