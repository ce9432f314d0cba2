"""How a long read tells how far it is."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float], None]  # told the share, from 0 to 1; may raise to stop the read


def silent(_: float) -> None:
    """Nobody wants to know."""
