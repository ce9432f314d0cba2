"""Values that move with the clock: to and fro, slower at both ends, or round and round."""

from __future__ import annotations

from collections.abc import Callable
from math import asin, sin

from ..scenes.parameters import Range

Motion = Callable[[float], float | None]  # a value by the clock, None when it is over


def value_at(interval: Range, phase: float) -> float:
    """The value at a phase: at 0 the low end, at 1 the high one, at 2 the low one again.

    A clock starts anew at each whole phase.
    """
    length = interval.high - interval.low
    if interval.clock:
        return interval.low + length * (phase % 1.0)
    way = phase % 2.0
    way = 2.0 - way if way > 1.0 else way
    return interval.low + length * way * way * (3.0 - 2.0 * way)


def phase(interval: Range, value: float) -> float:
    """Where on its way a value stands, 0 to 1: `value_at` gives it back."""
    share = float((value - interval.low) / (interval.high - interval.low))
    return share if interval.clock else unsmooth(share)


def unsmooth(share: float) -> float:
    """The inverse of smoothstep."""
    return 0.5 - sin(asin(max(-1.0, min(1.0, 1.0 - 2.0 * share))) / 3.0)
