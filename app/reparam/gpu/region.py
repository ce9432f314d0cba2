"""A space's part of the picture, and the margins that its title and its notes take of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..scenes.layers import Space

TITLE_LINE = 28.0  # figure units
NOTE_LINE = 19.0
TALLEST = 1.1
NOTE_GAP = 8.0  # beneath the notes


@dataclass(frozen=True)
class Region:
    """A space's part of the picture, in pixels from the lower left."""

    left: int
    bottom: int
    width: int
    height: int

    @property
    def top(self) -> int:
        """Its upper edge."""
        return self.bottom + self.height

    def contains(self, x: float, y: float) -> bool:
        """Whether the pixel is in it."""
        return 0 <= x - self.left < self.width and 0 <= y - self.bottom < self.height

    def inside(self, spaces: Sequence[Space], unit: float, width: int) -> Region:
        """What margins leave of it: as large for all spaces of a figure as one of them needs.

        Title and notes stay near: between them it is at most TALLEST times as high as `width`,
        its own or, lest rounding set titles off, that of the narrowest of its kind.
        """
        rows = max(len(space.notes) for space in spaces)
        head = round(TITLE_LINE * unit) if any(space.title for space in spaces) else 0
        foot = round((NOTE_LINE * rows + NOTE_GAP) * unit) if rows else 0
        room = max(1, self.height - head - foot)
        height = min(room, round(TALLEST * width)) if head + foot else room
        bottom = self.bottom + min(foot, self.height - room) + (room - height) // 2
        return replace(self, bottom=bottom, height=height)
