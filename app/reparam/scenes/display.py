"""How any scene is drawn: the settings that all scenes share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ..geometry.camera import WIDEST
from .cursor import EXPECTED, is_cursor
from .parameters import Form, Range
from .shading import Shading


@dataclass(frozen=True)
class Display:
    """Settings shared by all scenes, set like a scene's own parameters."""

    level: Annotated[int, Range(1, 1024), "tessellation level: steps in u and in v"] = 32
    tolerance: Annotated[
        float, Range(0, 64, 0.5), "pixels that a drawn point may be off; 0: the level decides"
    ] = 0.0
    perspective: Annotated[
        float, Range(0, WIDEST, 10), "field of view of what is spatial, degrees; 0: orthographic"
    ] = 0.0
    shading: Annotated[
        Shading,
        "lit surfaces: light, zebra lines, curvature, kinds of patches; or how the texture lies: "
        "area, stretch and angle; or how it is drawn: level (steps), error (pixels off)",
    ] = "light"
    wireframe: Annotated[bool, "the triangles' edges over the surface"] = False
    net: Annotated[bool, "the control net"] = False
    handles: Annotated[bool, "the points that a hand can drag in the window"] = False
    compare: Annotated[str, "two values of a parameter in one picture, as texture=identity|r"] = ""
    divider: Annotated[float, Range(0, 1, 0.1), "where the second one begins"] = 0.5
    blend: Annotated[float, Range(0, 1, 0.1), "how far the first one has faded into it"] = 0.0
    joins: Annotated[bool, "the edges of patches in the colours of their joins"] = False
    linked: Annotated[bool, "beside the picture its domain, and its texture if it has one"] = False
    cursor: Annotated[str, Form(EXPECTED, is_cursor), "a point marked in all linked spaces"] = ""
    samples: Annotated[int, Range(0, 16), "samples a pixel; 0: the most up to 8"] = 0
