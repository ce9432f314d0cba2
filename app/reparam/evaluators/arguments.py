"""What a call was given, as OpenGL takes it; InvalidValue names the call and the argument."""

from __future__ import annotations

import math
import struct

import numpy as np

from .errors import InvalidValue

Quad = tuple[float, float, float, float]

_FLOAT = struct.Struct("f")


def single(call: str, name: str, value: object) -> float:
    """A number as OpenGL's float has it. Raises InvalidValue where that is not finite."""
    try:
        (number,) = _FLOAT.unpack(_FLOAT.pack(value))  # several times as fast as numpy
    except (TypeError, ValueError, OverflowError, struct.error):
        number = math.nan
    if not math.isfinite(number):
        raise InvalidValue(f"{call}: {name}: expected a finite number, found {value!r}")
    return float(number)


def interval(call: str, letter: str, start: object, end: object) -> tuple[float, float]:
    """A map's domain in one direction. Raises InvalidValue where it is empty, in float32."""
    low, high = single(call, f"{letter}1", start), single(call, f"{letter}2", end)
    if low == high:
        raise InvalidValue(
            f"{call}: {letter}1, {letter}2: expected two different numbers, found {low:g} twice"
        )
    return low, high


def integer(call: str, name: str, value: object) -> int:
    """A whole number."""
    if isinstance(value, (int, np.integer)):
        return int(value)
    raise InvalidValue(f"{call}: {name}: expected a whole number, found {value!r}")


def numbers(call: str, name: str, values: object, counts: tuple[int, ...]) -> tuple[float, ...]:
    """A sequence of as many numbers as one of `counts`."""
    flat = np.ravel(values)  # type: ignore[call-overload]
    if len(flat) not in counts:
        expected = " or ".join(str(count) for count in counts)
        raise InvalidValue(f"{call}: {name}: expected {expected} numbers, found {len(flat)}")
    return tuple(single(call, name, value) for value in flat)


def padded(
    call: str, name: str, given: tuple[object, ...], counts: tuple[int, ...], fill: Quad
) -> Quad:
    """Numbers, or one sequence of them, with what they lack from `fill`."""
    flat = given[0] if len(given) == 1 and np.ndim(given[0]) > 0 else given  # type: ignore[arg-type]
    found = numbers(call, name, flat, counts)
    x, y, z, w = (*found, *fill[len(found) :])
    return x, y, z, w
