"""glColor, glNormal, glTexCoord, glIndex: the current values, between glBegin and glEnd too."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from .arguments import padded
from .maps import FILL, Attribute
from .recording import Current


class CurrentValues:
    """What a vertex has where no map feeds it."""

    def __init__(self) -> None:
        super().__init__()
        self._current = Current()

    def glColor(self, *color: Any) -> None:
        """The colour of what no map colours: 3 or 4 numbers, or one sequence of them."""
        self._set_current("glColor", "color", color, (3, 4))

    def glNormal(self, *normal: Any) -> None:
        """The normal of what no map gives one: 3 numbers, or one sequence of them."""
        self._set_current("glNormal", "normal", normal, (3,))

    def glTexCoord(self, *texcoord: Any) -> None:
        """The texture coordinates of what no map gives any: 1 to 4 numbers, or one sequence."""
        self._set_current("glTexCoord", "texcoord", texcoord, (1, 2, 3, 4))

    def glIndex(self, *index: Any) -> None:
        """The colour index of what no map gives one."""
        self._set_current("glIndex", "index", index, (1,))

    def _set_current(
        self, call: str, attribute: Attribute, values: tuple[Any, ...], counts: tuple[int, ...]
    ) -> None:
        new = padded(call, attribute, values, counts, FILL[attribute])
        self._current = replace(self._current, **{attribute: new})

    glColor3f = glColor3d = glColor3fv = glColor3dv = glColor
    glColor4f = glColor4d = glColor4fv = glColor4dv = glColor
    glNormal3f = glNormal3d = glNormal3fv = glNormal3dv = glNormal
    glTexCoord1f = glTexCoord1d = glTexCoord2f = glTexCoord2d = glTexCoord
    glTexCoord1i = glTexCoord2i = glTexCoord3i = glTexCoord4i = glTexCoord
    glTexCoord3f = glTexCoord3d = glTexCoord4f = glTexCoord4d = glTexCoord
    glTexCoord1fv = glTexCoord2fv = glTexCoord3fv = glTexCoord4fv = glTexCoord

    def glColor3ub(self, *color: Any) -> None:
        """Three or four numbers from 0 to 255."""
        self.glColor(np.ravel(color) / 255.0)

    glColor4ub = glColor3ubv = glColor4ubv = glColor3ub
    glIndexf = glIndexd = glIndex
