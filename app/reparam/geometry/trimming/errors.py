"""What can be wrong with trim loops, each a ValueError that names the loop and the piece."""

from __future__ import annotations


class TrimError(ValueError):
    """A trim loop that bounds no region. `loop` and `piece` count from 0, as they were given."""

    def __init__(self, loop: int, piece: int | None, message: str) -> None:
        where = f"trim loop {loop}" + ("" if piece is None else f", piece {piece}")
        super().__init__(f"{where}: {message}")
        self.loop = loop
        self.piece = piece


class BadTrimPiece(TrimError):
    """A piece of the wrong shape, with a number that is not finite or a weight that is not > 0."""


class EmptyTrim(TrimError):
    """A loop without pieces, or one that encloses nothing (GLU_NURBS_ERROR18)."""


class UnconnectedTrim(TrimError):
    """Two pieces that follow each other and do not meet (GLU_NURBS_ERROR31)."""


class CrossingTrims(TrimError):
    """Two pieces that cross, of one loop or of two (GLU_NURBS_ERROR29)."""


class MisorientedTrims(TrimError):
    """A loop whose left side is not what the loops around it keep (GLU_NURBS_ERROR28)."""
