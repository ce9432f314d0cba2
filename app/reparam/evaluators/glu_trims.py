"""What can be wrong with a surface's trims, as GLU's errors."""

from __future__ import annotations

from ..geometry.trimming import errors as trim_errors
from .glu_errors import (
    GluError,
    GluInvalidValue,
    IntersectingTrims,
    MisorientedTrims,
    TrimCurveMissing,
    UnconnectedTrims,
)
from .splines import Nurbs

TRIM_ERRORS: dict[type[trim_errors.TrimError], type[GluError]] = {
    trim_errors.EmptyTrim: TrimCurveMissing,
    trim_errors.MisorientedTrims: MisorientedTrims,
    trim_errors.CrossingTrims: IntersectingTrims,
    trim_errors.UnconnectedTrim: UnconnectedTrims,
    trim_errors.BadTrimPiece: GluInvalidValue,
}


def check_trims(nurbs: Nurbs) -> None:
    """Raises NurbsError 18, 28, 29 or 31, or GluInvalidValue, for trims that bound no region.

    The outermost loop is counter-clockwise in GLU: a hole alone leaves nothing to cut it from, and
    libGLU draws nothing. `trim_region` lets it cut the whole domain, as the specification may be
    read; a ported program would show what it never did.
    """
    try:
        region = nurbs.region
    except trim_errors.TrimError as error:
        raise TRIM_ERRORS[type(error)](f"gluEndSurface: {error}") from None
    if region is not None and (region.pieces.loop < 0).any():
        raise MisorientedTrims(
            "gluEndSurface: expected an outermost loop that runs counter-clockwise, the border of "
            "the domain perhaps, found clockwise ones alone"
        )
