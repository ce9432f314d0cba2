"""The matrices of glOrtho, gluPerspective, glRotatef and their kin: (4, 4), for column vectors.

    modelview = translate(0, 0, -5) @ rotate(330, 1, 0, 0)
    gl.draw(projection=perspective(45, 1, 3, 8), modelview=modelview)

As calls that follow each other multiply from the left to the right. gluLoadSamplingMatrices takes
them as C does, column after column: `.T`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .maps import Array


def ortho(left: float, right: float, bottom: float, top: float, near: float, far: float) -> Array:
    """glOrtho."""
    low, high = np.array([left, bottom, near]), np.array([right, top, far])
    matrix = np.diag([*(2.0 / (high - low)), 1.0])
    matrix[:3, 3] = -(high + low) / (high - low)
    matrix[2, 2] *= -1.0
    return matrix


def frustum(left: float, right: float, bottom: float, top: float, near: float, far: float) -> Array:
    """glFrustum."""
    wide, high, deep = right - left, top - bottom, far - near
    return np.array([
        [2.0 * near / wide, 0.0, (right + left) / wide, 0.0],
        [0.0, 2.0 * near / high, (top + bottom) / high, 0.0],
        [0.0, 0.0, -(far + near) / deep, -2.0 * far * near / deep],
        [0.0, 0.0, -1.0, 0.0],
    ])  # fmt: skip


def perspective(fovy: float, aspect: float, near: float, far: float) -> Array:
    """gluPerspective: `fovy` in degrees."""
    reach = near * np.tan(np.radians(fovy) / 2.0)
    return frustum(-aspect * reach, aspect * reach, -reach, reach, near, far)


def look_at(eye: ArrayLike, center: ArrayLike, up: ArrayLike) -> Array:
    """gluLookAt: three points of three numbers."""
    eye, center, up = (np.asarray(point, np.float64) for point in (eye, center, up))
    back = (eye - center) / np.linalg.norm(eye - center)
    right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(back, right), back])
    return np.asarray(matrix @ translate(*-eye))


def rotate(degrees: float, x: float, y: float, z: float) -> Array:
    """glRotatef: about the axis (x, y, z), by Rodrigues' formula."""
    x, y, z = np.array([x, y, z]) / np.linalg.norm([x, y, z])
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = np.radians(degrees)
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return matrix


def translate(x: float, y: float, z: float) -> Array:
    """glTranslatef."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def scale(x: float, y: float, z: float) -> Array:
    """glScalef."""
    return np.diag([x, y, z, 1.0])
