"""Between glBegin and glEnd, or outside: most calls are allowed in one of them alone."""

from __future__ import annotations

from dataclasses import dataclass, field

from .arguments import Quad
from .errors import InvalidOperation
from .recording import Current


@dataclass
class Vertices:
    """Between glBegin and glEnd."""

    mode: int
    dimensions: list[int] = field(default_factory=list)
    parameters: list[tuple[float, float]] = field(default_factory=list)
    positions: list[Quad] = field(default_factory=list)
    currents: list[Current] = field(default_factory=list)


class Phase:
    """Which of the two it is."""

    def __init__(self) -> None:
        super().__init__()
        self._begun: Vertices | None = None

    def _outside(self, call: str) -> None:
        if self._begun is not None:
            raise InvalidOperation(f"{call}: expected outside glBegin/glEnd, found inside")

    def _inside(self, call: str) -> Vertices:
        if self._begun is None:
            raise InvalidOperation(f"{call}: expected between glBegin and glEnd, found outside")
        return self._begun
