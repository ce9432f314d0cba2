"""What the GPU keeps of an array, for as long as the same object is drawn."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")
Array = NDArray[np.float64]


class Kept(Generic[T]):
    """Results by the identity of an array and a key; dropped when unused for some frames.

    The array itself is held, so its identity cannot pass to another one; it must not change.
    """

    def __init__(self, release: Callable[[T], None], frames: int = 4) -> None:
        self._entries: dict[tuple[int, Hashable], tuple[Array, T, int]] = {}
        self._release = release
        self._frames = frames
        self._now = 0

    def get(self, array: Array, key: Hashable, make: Callable[[], T]) -> T:
        """The result kept for this very array and key, made if there is none."""
        slot = (id(array), key)
        entry = self._entries.get(slot)
        result = entry[1] if entry else make()
        self._entries[slot] = (array, result, self._now)
        return result

    def sweep(self) -> None:
        """End of a frame: drop what the last frames did not use."""
        self._now += 1
        for slot, (_, result, used) in list(self._entries.items()):
            if self._now - used > self._frames:
                del self._entries[slot]
                self._release(result)

    def clear(self) -> None:
        """Drop everything."""
        for _, result, _ in self._entries.values():
            self._release(result)
        self._entries.clear()
