"""Trimming: loops in the parameter domain, and which part of a surface they leave."""

from .errors import (
    BadTrimPiece,
    CrossingTrims,
    EmptyTrim,
    MisorientedTrims,
    TrimError,
    UnconnectedTrim,
)
from .region import UNIT_DOMAIN, Domain, TrimRegion, trim_region

__all__ = [
    "UNIT_DOMAIN",
    "BadTrimPiece",
    "CrossingTrims",
    "Domain",
    "EmptyTrim",
    "MisorientedTrims",
    "TrimError",
    "TrimRegion",
    "UnconnectedTrim",
    "trim_region",
]
