"""Which way u and v run on a patch: two arrows just outside its first edges, with their letters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import evaluate, project
from . import palette
from .layers import Color, IsoLines, Label, Layer

OUTSIDE = -0.06  # how far beyond the edge, in parameters: the patch is extrapolated there
SPAN = (0.04, 0.30)
LETTER = 0.40


def directions(net: NDArray[np.float64]) -> tuple[Layer, ...]:
    """Arrows along u beside the edge v = 0 and along v beside the edge u = 0 of one patch."""
    return (
        IsoLines(net, v=(OUTSIDE,), color=palette.ALONG_U, width=1.8, span=SPAN, arrow=True),
        IsoLines(net, u=(OUTSIDE,), color=palette.ALONG_V, width=1.8, span=SPAN, arrow=True),
        _letter(net, "u", LETTER, OUTSIDE, palette.ALONG_U),
        _letter(net, "v", OUTSIDE, LETTER, palette.ALONG_V),
    )


def _letter(net: NDArray[np.float64], text: str, u: float, v: float, color: Color) -> Label:
    x, y, z = project(evaluate(net, u, v))
    return Label(text, (float(x), float(y), float(z)), size=20.0, color=color, italic=True)
