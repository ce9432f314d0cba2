"""What the GPU keeps of an array, for as long as the same object is drawn."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, Generic, TypeVar

from numpy.typing import NDArray

from .changes import changed_runs

T = TypeVar("T")
Array = NDArray[Any]
Renew = Callable[[T, list[range]], None]


class Kept(Generic[T]):
    """Results by the identity of an array and a key; dropped when unused for some frames.

    The array itself is held, so its identity cannot pass to another one; it must not change.
    """

    def __init__(self, release: Callable[[T], None], frames: int = 4) -> None:
        self._entries: dict[tuple[int, Hashable], tuple[Array, T, int]] = {}
        self._release = release
        self._frames = frames
        self._now = 0

    def get(
        self, array: Array, key: Hashable, make: Callable[[], T], renew: Renew[T] | None = None
    ) -> T:
        """The result kept for this very array and key, made if there is none.

        With `renew` it may instead be the result of an array that this one differs little from
        and that the frame has not used: `renew` gets it with the patches (rows of the first axis)
        that have changed, and rewrites those.
        """
        slot = (id(array), key)
        entry = self._entries.get(slot)
        result = entry[1] if entry else None
        if result is None and renew is not None:
            result = self._renewed(array, key, renew)
        if result is None:
            result = make()
        self._entries[slot] = (array, result, self._now)
        return result

    def _renewed(self, array: Array, key: Hashable, renew: Renew[T]) -> T | None:
        for slot, (before, result, used) in list(self._entries.items()):
            if slot[1] == key and used < self._now:
                changed = changed_runs(before, array)
                if changed is not None:
                    del self._entries[slot]
                    try:
                        renew(result, changed)
                    except BaseException:
                        self._release(result)
                        raise
                    return result
        return None

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
