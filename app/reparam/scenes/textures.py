"""What patches are covered with: a texture map, and a picture or a field that it looks up."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..geometry.formula import Formula

Array = NDArray[np.float64]


class Frozen:
    """Of dataclasses whose arrays become read-only."""

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            if isinstance(value, np.ndarray):
                value.setflags(write=False)


@dataclass(frozen=True)
class Picture:
    """What a texture map looks up, and where: (s, t) * scale + offset, the whole picture being
    [0,1]^2 with (0,0) at its lower left."""

    source: str = "checkerboard"  # a name in textures/, or a file
    scale: float = 0.5
    offset: float = 0.5
    wrap: Literal["repeat", "mirror"] = "repeat"
    filter: Literal["smooth", "nearest"] = "smooth"


@dataclass(frozen=True)
class Ramp:
    """A scalar field in colours, from `low` (violet) to `high` (yellow): g(s, t) where there is a
    formula, else s itself. `contours` lines show where it has equally spaced values."""

    low: float
    high: float
    formula: Formula | None = None  # in x and y, which s and t are called there
    contours: int = 0

    @property
    def scalar(self) -> bool:
        """Whether the map that looks it up has but one coordinate."""
        return self.formula is None


@dataclass(frozen=True)
class Texture(Frozen):
    """A second net, (m, n, 4) for all patches or (patches, m, n, 4), with what it looks up.

    GL_MAP2_TEXTURE_COORD: evaluated at the vertices by the same evaluator as the position, and
    interpolated between them; the map of a ramp may be `exact`, evaluated at every fragment.
    """

    net: Array
    picture: Picture | Ramp
    exact: bool = False

    def __post_init__(self) -> None:
        if self.exact and not isinstance(self.picture, Ramp):
            raise ValueError("expected a ramp to be looked up exactly, found a picture")
        super().__post_init__()
