"""GLU's errors as exceptions: GLU_NURBS_ERROR1 .. GLU_NURBS_ERROR37, the table of all.

Each class has its `number`, its `code` (100250 + number, what a GLU_NURBS_ERROR callback is told)
and its `meaning` in GLU's words; its docstring tells what raises it, or why nothing does
(`occurs` is False). "GLU: silent" marks what libGLU 9.0.2 never reports, though its input had it.

A call that raises changes nothing, but an End ends. Where a GLU_NURBS_ERROR callback is set, it is
called instead, and things go on as libGLU does: what was open is closed, what is bad is not drawn.
"""

from __future__ import annotations

from typing import ClassVar

from ..errors import ReparamError
from .glu_constants import GLU_INVALID_ENUM, GLU_INVALID_VALUE


class GluError(ReparamError):
    """What GLU reports, as `code`."""

    code: ClassVar[int] = 0


class GluInvalidEnum(GluError, ValueError):
    """GLU_INVALID_ENUM: an unknown property, callback, or NURBS mode."""

    code = GLU_INVALID_ENUM


class GluInvalidValue(GluError, ValueError):
    """GLU_INVALID_VALUE: a property's value out of range, or an array that cannot be used.

    libGLU hangs at a tolerance of -1 and reads beyond arrays that are too short.
    """

    code = GLU_INVALID_VALUE


class NurbsError(GluError):
    """One of the 37."""

    number: ClassVar[int] = 0
    meaning: ClassVar[str] = ""
    occurs: ClassVar[bool] = True

    def __init_subclass__(cls, number: int, meaning: str, occurs: bool = True) -> None:
        cls.number, cls.meaning, cls.occurs = number, meaning, occurs
        cls.code = 100250 + number
        NURBS_ERRORS[number] = cls

    def __str__(self) -> str:
        detail = super().__str__()
        return f"GLU_NURBS_ERROR{self.number}: {self.meaning}" + (f": {detail}" if detail else "")


NURBS_ERRORS: dict[int, type[NurbsError]] = {}
"""All of them by number."""


class OrderUnsupported(NurbsError, number=1, meaning="spline order un-supported"):
    """An order outside 1..24, libGLU's limit."""


class TooFewKnots(NurbsError, number=2, meaning="too few knots"):
    """Fewer than twice the order."""


class EmptyKnotRange(NurbsError, number=3, meaning="valid knot range is empty"):
    """The knots order - 1 and count - order are equal."""


class DecreasingKnots(NurbsError, number=4, meaning="decreasing knot sequence knot"):
    """A knot less than the one before."""


class KnotMultiplicity(
    NurbsError, number=5, meaning="knot multiplicity greater than order of spline"
):
    """A knot that stands more often than the order."""


class EndCurveMissing(NurbsError, number=6, meaning="gluEndCurve() must follow gluBeginCurve()"):
    """gluBeginCurve twice."""


class BeginCurveMissing(NurbsError, number=7, meaning="gluBeginCurve() must precede gluEndCurve()"):
    """gluEndCurve alone."""


class GeometryMissing(NurbsError, number=8, meaning="missing or extra geometric data"):
    """A surface or curve without a vertex map, or with two. GLU: silent."""


class CurveNotDrawable(NurbsError, number=9, meaning="can't draw piecewise linear trimming curves"):
    """A curve that is empty, since gluNurbsCurve was left out or failed, or is piecewise linear."""


class DomainDataMissing(
    NurbsError, number=10, meaning="missing or extra domain data", occurs=False
):
    """Cannot occur: each call brings the knots of its own map."""


class DomainDataExtra(NurbsError, number=11, meaning="missing or extra domain data", occurs=False):
    """Cannot occur: each call brings the knots of its own map."""


class EndTrimMissing(NurbsError, number=12, meaning="gluEndTrim() must precede gluEndSurface()"):
    """gluEndSurface with a trim open."""


class BeginSurfaceMissing(
    NurbsError, number=13, meaning="gluBeginSurface() must precede gluEndSurface()"
):
    """gluEndSurface alone."""


class ImproperTrimType(
    NurbsError, number=14, meaning="curve of improper type passed as trim curve"
):
    """gluNurbsCurve in a trim, of another type than GLU_MAP1_TRIM_2 or _3. GLU: silent."""


class TrimOutsideSurface(
    NurbsError, number=15, meaning="gluBeginSurface() must precede gluBeginTrim()"
):
    """gluBeginTrim outside a surface."""


class EndTrimOverdue(NurbsError, number=16, meaning="gluEndTrim() must follow gluBeginTrim()"):
    """gluBeginTrim twice."""


class BeginTrimMissing(NurbsError, number=17, meaning="gluBeginTrim() must precede gluEndTrim()"):
    """gluEndTrim alone."""


class TrimCurveMissing(NurbsError, number=18, meaning="invalid or missing trim curve"):
    """A trim with nothing in it."""


class CurveOutsideTrim(NurbsError, number=19, meaning="gluBeginTrim() must precede gluPwlCurve()"):
    """gluPwlCurve outside a trim."""


class PwlCurveTwice(
    NurbsError,
    number=20,
    meaning="piecewise linear trimming curve referenced twice",
    occurs=False,
):
    """Cannot occur: a curve is no object here that could be named a second time."""


class NurbsThenPwl(
    NurbsError, number=21, meaning="piecewise linear trimming curve and nurbs curve mixed"
):
    """gluPwlCurve after gluNurbsCurve in one gluBeginCurve."""


class ImproperPwlType(NurbsError, number=22, meaning="improper usage of trim data type"):
    """gluPwlCurve of another type than GLU_MAP1_TRIM_2 or _3."""


class NurbsCurveTwice(NurbsError, number=23, meaning="nurbs curve referenced twice", occurs=False):
    """Cannot occur: a curve is no object here that could be named a second time."""


class PwlThenNurbs(
    NurbsError, number=24, meaning="nurbs curve and piecewise linear trimming curve mixed"
):
    """gluNurbsCurve after gluPwlCurve in one gluBeginCurve."""


class NurbsSurfaceTwice(
    NurbsError, number=25, meaning="nurbs surface referenced twice", occurs=False
):
    """Cannot occur: a surface is no object here that could be named a second time."""


class InvalidProperty(NurbsError, number=26, meaning="invalid property", occurs=False):
    """Cannot occur: gluNurbsProperty answers GLU_INVALID_ENUM."""


class EndSurfaceMissing(
    NurbsError, number=27, meaning="gluEndSurface() must follow gluBeginSurface()"
):
    """gluBeginSurface twice."""


class MisorientedTrims(NurbsError, number=28, meaning="intersecting or misoriented trim curves"):
    """Loops whose orientations do not alternate from the outside inwards. GLU: silent."""


class IntersectingTrims(NurbsError, number=29, meaning="intersecting trim curves"):
    """A loop that crosses itself or another one. GLU: silent."""


class Unused(NurbsError, number=30, meaning="UNUSED", occurs=False):
    """Cannot occur: GLU has no use for it."""


class UnconnectedTrims(NurbsError, number=31, meaning="unconnected trim curves"):
    """A loop whose curves do not meet, or that does not close. GLU: silent, or a crash."""


class UnknownKnotError(NurbsError, number=32, meaning="unknown knot error"):
    """A knot that is not a finite number. GLU: silent."""


class NegativeCount(NurbsError, number=33, meaning="negative vertex count encountered"):
    """gluPwlCurve with a negative count."""


class NegativeStride(NurbsError, number=34, meaning="negative byte-stride encounteed"):
    """A stride below 0."""


class UnknownType(NurbsError, number=35, meaning="unknown type descriptor"):
    """A type that is no GL_MAP1_..., GL_MAP2_... or GLU_MAP1_TRIM_..., or of the other kind."""


class NullControlPoints(NurbsError, number=36, meaning="null control point reference"):
    """None for the control points, as NULL in C."""


class DuplicatePoint(
    NurbsError, number=37, meaning="duplicate point on piecewise linear trimming curve"
):
    """A point of gluPwlCurve that equals the one before it. GLU: silent."""
