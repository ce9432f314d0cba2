"""GLU's NURBS calls, under their own names. They record; gpu/ evaluates what they recorded.

    nurb = gluNewNurbsRenderer()
    gluNurbsProperty(nurb, GLU_SAMPLING_TOLERANCE, 25.0)
    gluBeginSurface(nurb)
    gluNurbsSurface(nurb, 8, knots, 8, knots, 4 * 3, 3, points, 4, 4, GL_MAP2_VERTEX_3)
    gluEndSurface(nurb)
    surfaces = nurb.take()

Numbers are rounded to float32 when they come in, as GLU's are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from . import glu_constants as k
from .glu_arguments import curve_argument, pwl_argument, surface_argument
from .glu_errors import (
    BeginCurveMissing,
    BeginSurfaceMissing,
    BeginTrimMissing,
    CurveNotDrawable,
    CurveOutsideTrim,
    EndCurveMissing,
    EndSurfaceMissing,
    EndTrimMissing,
    EndTrimOverdue,
    GeometryMissing,
    GluError,
    ImproperTrimType,
    NurbsError,
    NurbsThenPwl,
    PwlThenNurbs,
    TrimCurveMissing,
    TrimOutsideSurface,
)
from .glu_trims import check_trims
from .nurbs_callbacks import call_back
from .nurbs_properties import View
from .nurbs_settings import NurbsSettings
from .splines import Nurbs, NurbsTrim, PwlTrim, Spline, TrimCurve
from .tessellations import Read, read_float64, tessellate


@dataclass
class _Open:
    """Between Begin and End of a surface, or of a curve."""

    view: View
    alone: bool  # begun by the map itself, which ends it too
    splines: list[Spline] = field(default_factory=list)
    trims: list[tuple[TrimCurve, ...]] = field(default_factory=list)
    pwl: list[PwlTrim] = field(default_factory=list)  # of a curve
    nurbs: list[NurbsTrim] = field(default_factory=list)
    sound: bool = True  # libGLU draws nothing of a thing that had an error in it
    refused: bool = False  # a map was left out for its knots


class NurbsRenderer(NurbsSettings):
    """A GLUnurbs object.

    `read` evaluates for the tessellator mode: `Recordings(painter).read` on the GPU, or by
    default float64 without any OpenGL. `matrices` is what GLU_AUTO_LOAD_MATRIX asks at each
    Begin; without it the matrices loaded last hold.

    Errors are raised, and a call that raises changes nothing (but an End ends); where a
    GLU_NURBS_ERROR callback is set, it gets the code instead, and things go on as libGLU does.
    """

    def __init__(
        self, read: Read = read_float64, matrices: Callable[[], View] | None = None
    ) -> None:
        super().__init__(matrices)
        self._read = read
        self._surface: _Open | None = None
        self._curve: _Open | None = None
        self._trim: list[TrimCurve] | None = None
        self._ended: list[Nurbs] = []

    def take(self) -> tuple[Nurbs, ...]:
        """The curves and surfaces that ended since the last time, to be drawn or read."""
        ended, self._ended = tuple(self._ended), []
        return ended

    # Surfaces --------------------------------------------------------------------------------

    def gluBeginSurface(self) -> None:
        """Raises NurbsError 27 inside a surface."""
        self._begin_surface(alone=False)

    def _begin_surface(self, alone: bool) -> None:
        if self._surface is not None:
            self._fail(EndSurfaceMissing("gluBeginSurface twice"))
            self.gluEndSurface()
        self._surface = _Open(self._current_view(), alone)

    def gluNurbsSurface(self, *arguments: Any) -> None:
        """A map: C's arguments, those without the counts, or (sknots, tknots, points, type).

        Alone it is a whole surface. Raises NurbsError 1-5 and 32 for its knots, 34-36 for stride,
        type and missing points, GluInvalidValue for an array that cannot be used.
        """
        try:
            spline = surface_argument(*arguments)
        except GluError as error:
            self._refuse(self._surface, error)
            return
        if self._surface is None:
            self._begin_surface(alone=True)
        assert self._surface is not None
        self._surface.splines.append(spline)
        if self._surface.alone:
            self.gluEndSurface()

    def gluEndSurface(self) -> None:
        """Records the surface; in tessellator mode calls back.

        Raises NurbsError 8 without a vertex map or with two, 12 with a trim open, 13 outside a
        surface, 28, 29, 31 for its trims.
        """
        if self._trim is not None:
            self._fail(EndTrimMissing("gluEndSurface: a trim is open"))
            self.gluEndTrim()
        if self._surface is None:
            self._fail(BeginSurfaceMissing("gluEndSurface outside a surface"))
            return
        surface, self._surface = self._surface, None
        self._end(surface, "gluEndSurface")

    # Curves ----------------------------------------------------------------------------------

    def gluBeginCurve(self) -> None:
        """Raises NurbsError 6 inside a curve."""
        self._begin_curve(alone=False)

    def _begin_curve(self, alone: bool) -> None:
        if self._curve is not None:
            self._fail(EndCurveMissing("gluBeginCurve twice"))
            self.gluEndCurve()
        self._curve = _Open(self._current_view(), alone)

    def gluNurbsCurve(self, *arguments: Any) -> None:
        """A map, or in a trim a trim curve: C's arguments, those without the count, or (knots,
        points, type).

        Raises NurbsError 1-5 and 32 for its knots, 14 in a trim for a type that is none of a
        trim's, 24 after gluPwlCurve, 34-36 for stride, type and missing points, GluInvalidValue
        for an array that cannot be used.
        """
        opened = self._surface if self._trim is not None else self._curve
        try:
            curve = curve_argument(*arguments)
            if self._trim is not None and isinstance(curve, Spline):
                found = curve.target.name
                raise ImproperTrimType(f"gluNurbsCurve: type: expected a trim's, found {found}")
            if self._curve is not None and self._curve.pwl:
                raise PwlThenNurbs("gluNurbsCurve after gluPwlCurve")
        except GluError as error:
            self._refuse(opened, error)
            return
        if self._curve is None:
            self._begin_curve(alone=True)
        assert self._curve is not None
        if isinstance(curve, NurbsTrim):
            self._curve.nurbs.append(curve)
        else:
            self._curve.splines.append(curve)
        if self._curve.alone:
            self.gluEndCurve()

    def gluEndCurve(self) -> None:
        """Records the curve, or adds it to its trim; in tessellator mode calls back.

        Raises NurbsError 7 outside a curve, 8 without a vertex map or with two, 9 if it is empty.
        """
        if self._curve is None:
            self._fail(BeginCurveMissing("gluEndCurve outside a curve"))
            return
        curve, self._curve = self._curve, None
        if self._trim is not None:
            self._trim.extend(curve.nurbs or curve.pwl)
        elif curve.sound and not (curve.splines or curve.nurbs):
            self._fail(CurveNotDrawable("gluEndCurve: the curve is empty"))
        else:
            self._end(curve, "gluEndCurve")

    # Trims -----------------------------------------------------------------------------------

    def gluBeginTrim(self) -> None:
        """Raises NurbsError 15 outside a surface, 16 inside a trim."""
        if self._surface is None:
            self._fail(TrimOutsideSurface("gluBeginTrim outside a surface"))
            self._begin_surface(alone=True)
        if self._trim is not None:
            self._fail(EndTrimOverdue("gluBeginTrim twice"))
            self.gluEndTrim()
        self._trim = []

    def gluPwlCurve(self, *arguments: Any) -> None:
        """A trim curve of straight lines: (count, points, stride, type) as in C, or (points, type).

        Raises NurbsError 19 outside a trim, 21 after gluNurbsCurve, 22 for a type that is none of
        a trim's, 33-37 for count, stride, type, missing and doubled points.
        """
        try:
            curve = pwl_argument(*arguments)
            if self._trim is not None and self._curve is not None and self._curve.nurbs:
                raise NurbsThenPwl("gluPwlCurve after gluNurbsCurve")
        except GluError as error:
            self._refuse(self._surface, error)
            return
        if self._trim is None:
            self._fail(CurveOutsideTrim("gluPwlCurve outside a trim"))
            return
        if self._curve is None:
            self._trim.append(curve)
        else:
            self._curve.pwl.append(curve)

    def gluEndTrim(self) -> None:
        """Closes the loop. Raises NurbsError 17 outside a trim, 18 if there is nothing in it."""
        if self._trim is None:
            self._fail(BeginTrimMissing("gluEndTrim outside a trim"))
            return
        assert self._surface is not None
        if self._curve is not None:
            self._fail(EndCurveMissing("gluEndTrim: a curve is open"))
            self.gluEndCurve()
        loop, self._trim = tuple(self._trim), None
        if loop:
            self._surface.trims.append(loop)
        else:
            self._refuse(self._surface, TrimCurveMissing("gluEndTrim: the trim is empty"))

    # What is common to both ------------------------------------------------------------------

    def _refuse(self, opened: _Open | None, error: GluError) -> None:
        self._fail(error)
        if opened is not None:
            bad_knots = isinstance(error, NurbsError) and error.number in (1, 2, 3, 4, 5, 32)
            opened.refused |= bad_knots
            opened.sound &= bad_knots

    def _end(self, opened: _Open, call: str) -> None:
        if not opened.sound:
            return
        vertex = sum(spline.target.attribute == "vertex" for spline in opened.splines)
        if vertex != 1:
            if not opened.refused:
                self._fail(GeometryMissing(f"{call}: expected one vertex map, found {vertex}"))
            return
        nurbs = Nurbs(tuple(opened.splines), self.properties, opened.view, tuple(opened.trims))
        try:
            check_trims(nurbs)
        except GluError as error:
            self._fail(error)
            return
        self._ended.append(nurbs)
        if self.properties.mode == k.GLU_NURBS_TESSELLATOR and self._callbacks:
            curve, components = call == "gluEndCurve", nurbs.vertex.target.components
            tessellation = tessellate(nurbs, self._read)
            call_back(tessellation, curve, components, self._callbacks, self._data)
