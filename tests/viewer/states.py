"""States without a window, for tests of what changes them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from reparam.subject import open_subject
from reparam.viewer.state import State

MIXED = Path(__file__).parents[1] / "data" / "mixed.bv"
BOTH = ("vertex", "tessellation")


def opened(name: str = "fig5", *assignments: str) -> State:
    state = State(open_subject(name).assigned(assignments), BOTH, "vertex")
    state.advance(0.0)
    return state


def value(state: State, name: str) -> object:
    return state.subject.value(name)


def run(state: State, start: float, seconds: float) -> list[float]:
    """The morph at 60 steps a second; it never leaves its range."""
    values = []
    for now in np.arange(start, start + seconds, 1 / 60):
        state.advance(float(now))
        values.append(float(state.subject.value("morph")))
    assert min(values) >= 0.0
    assert max(values) <= 1.0
    return values
