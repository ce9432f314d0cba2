"""The claims of a scene, measured one a frame while the window goes on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import moderngl

from ..errors import ReparamError
from ..scenes.claims import Claim, Measure, Verdict, judge
from ..scenes.registry import Scene

if TYPE_CHECKING:
    from collections.abc import Callable

FAILURES = (ReparamError, ValueError, ArithmeticError, OSError, moderngl.Error)


class Verdicts:
    """What was measured of one scene so far. `measure` makes what claims are measured with."""

    def __init__(self, measure: Callable[[], Measure]) -> None:
        self._make = measure
        self._measure: Measure | None = None
        self._claims: Iterator[Claim] | None = None
        self.scene: Scene | None = None
        self.found: list[Verdict] = []
        self.trouble = ""  # why measuring broke off

    @property
    def running(self) -> bool:
        """Whether there are claims left."""
        return self._claims is not None

    def begin(self, scene: Scene) -> None:
        """Measure the claims of this scene from now on."""
        self.scene, self.found, self.trouble = scene, [], ""
        self._claims = scene.claimed()

    def step(self) -> None:
        """Measure the next one."""
        if self._claims is None or self.scene is None:
            return
        try:
            claim = next(self._claims, None)
            if claim is None:
                self._claims = None
                return
            self._measure = self._measure or self._make()
            self.found.append(judge(self.scene.name, claim, self._measure))
        except FAILURES as fault:
            self._claims, self.trouble = None, str(fault)
