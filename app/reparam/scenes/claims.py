"""Claims: statements of the note that can be computed, each with its expected value."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Quantity = float | Sequence[float]


class Measure(Protocol):
    """What a claim about the GPU is measured with; the caller hands it in."""

    def picture(self, scene: str, size: tuple[int, int], **values: Any) -> NDArray[np.uint8]:
        """The scene drawn plain, as (height, width, 3), top row first."""
        ...


@dataclass(frozen=True)
class Claim:
    """`measured` should equal `expected` up to `tolerance`: the quantities, not their error."""

    equation: str  # of the note, or the figure
    statement: str
    expected: Quantity
    measured: Quantity | Callable[[Measure], Quantity]
    tolerance: float


@dataclass(frozen=True)
class Verdict:
    """A claim with what was measured."""

    scene: str
    equation: str
    statement: str
    expected: Quantity
    measured: Quantity
    tolerance: float
    ok: bool


def judge(scene: str, claim: Claim, measure: Measure) -> Verdict:
    """Measure a claim. Shapes that differ, and NaN, are failures."""
    measured = claim.measured(measure) if callable(claim.measured) else claim.measured
    found, wanted = np.asarray(measured, float), np.asarray(claim.expected, float)
    ok = found.shape == wanted.shape and bool(np.all(np.abs(found - wanted) <= claim.tolerance))
    return Verdict(
        scene, claim.equation, claim.statement, claim.expected, measured, claim.tolerance, ok
    )
