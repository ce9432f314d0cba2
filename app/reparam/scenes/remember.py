"""What was computed from the same arrays a moment ago is not computed again.

A scene runs anew for each change of a parameter; an array that comes back as the same object is
not uploaded again either.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

T = TypeVar("T")


def remember(function: Callable[..., T]) -> Callable[..., T]:
    """Decorator: the last result again, as long as the very same objects are handed in."""
    last: list[tuple[tuple[Any, ...], T]] = []

    @wraps(function)
    def remembered(*arguments: Any) -> T:
        if last and len(last[0][0]) == len(arguments):
            before, result = last[0]
            if all(a is b for a, b in zip(before, arguments, strict=True)):
                return result
        last[:] = [(arguments, function(*arguments))]
        return last[0][1]

    return remembered
