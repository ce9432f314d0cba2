"""A line of text that the window asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass
class Prompt:
    """A line of text that is asked for, and what it is for. `accept` raises what is wrong."""

    title: str
    text: str
    accept: Callable[[str], None]
    offered: bool  # the text is only proposed: typing begins a new one

    def type(self, text: str) -> None:
        """More of the line."""
        self.text = text if self.offered else self.text + text
        self.offered = False

    def take_back(self) -> None:
        """The last letter, or all that was only proposed."""
        self.text = "" if self.offered else self.text[:-1]
        self.offered = False
