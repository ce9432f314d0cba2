"""The real GLU NURBS (libGLU.so.1) through ctypes, in tessellator mode: no OpenGL context needed.

The C calls under their own names, with what the callbacks hand back as arrays.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_float, c_int, c_uint, c_void_p
from ctypes.util import find_library
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Single = NDArray[np.float32]
Floats = POINTER(c_float)

GLU_AUTO_LOAD_MATRIX, GLU_NURBS_MODE, GLU_NURBS_TESSELLATOR = 100200, 100160, 100161
ERROR, BEGIN, VERTEX, NORMAL, COLOR, TEXTURE_COORD, END = 100103, *range(100164, 100170)
TRIM_2, TRIM_3 = 100210, 100211


def library() -> ctypes.CDLL | None:
    """libGLU, or None where it is not installed."""
    name = find_library("GLU")
    if name is None:
        return None
    glu = ctypes.CDLL(name)
    glu.gluNewNurbsRenderer.restype = c_void_p
    glu.gluErrorString.restype, glu.gluErrorString.argtypes = c_char_p, [c_uint]
    more: dict[str, list[Any]] = {
        "gluDeleteNurbsRenderer": [], "gluBeginCurve": [], "gluEndCurve": [],
        "gluBeginSurface": [], "gluEndSurface": [], "gluBeginTrim": [], "gluEndTrim": [],
        "gluNurbsProperty": [c_uint, c_float],
        "gluGetNurbsProperty": [c_uint, Floats],
        "gluNurbsCallback": [c_uint, c_void_p],
        "gluLoadSamplingMatrices": [Floats, Floats, POINTER(c_int)],
        "gluNurbsCurve": [c_int, Floats, c_int, Floats, c_int, c_uint],
        "gluPwlCurve": [c_int, Floats, c_int, c_uint],
        "gluNurbsSurface": [
            c_int, Floats, c_int, Floats, c_int, c_int, Floats, c_int, c_int, c_uint,
        ],
    }  # fmt: skip
    for call, arguments in more.items():
        function = getattr(glu, call)
        function.argtypes, function.restype = [c_void_p, *arguments], None
    return glu


@dataclass
class Primitive:
    """What came between two callbacks GLU_NURBS_BEGIN and GLU_NURBS_END."""

    mode: int
    vertices: list[list[float]] = field(default_factory=list)  # a surface's: x, y, z, u, v
    normals: list[list[float]] = field(default_factory=list)
    colors: list[list[float]] = field(default_factory=list)
    texcoords: list[list[float]] = field(default_factory=list)


class RealNurbs:
    """One GLUnurbs object that keeps what its callbacks are told.

    `call("gluNurbsSurface", ...)` passes arrays as float pointers. `floats` is how many numbers a
    vertex has: 5 of a surface; `texture` how many a texture coordinate has.
    """

    def __init__(self, glu: ctypes.CDLL, floats: int = 5, texture: int = 2) -> None:
        self._glu = glu
        self._nurbs = glu.gluNewNurbsRenderer()
        self._kept: list[Any] = []
        self._now: dict[str, list[float]] = {}
        self.primitives: list[Primitive] = []
        self.errors: list[int] = []
        self.call("gluNurbsProperty", GLU_NURBS_MODE, GLU_NURBS_TESSELLATOR)
        self.call("gluNurbsProperty", GLU_AUTO_LOAD_MATRIX, 0)
        self.load(np.eye(4), np.eye(4), (0, 0, 256, 256))
        begin, plain, values = CFUNCTYPE(None, c_uint), CFUNCTYPE(None), CFUNCTYPE(None, Floats)
        self._listen(BEGIN, begin(lambda mode: self.primitives.append(Primitive(mode))))
        self._listen(END, plain(lambda: None))
        self._listen(ERROR, begin(lambda code: self.errors.append(code)))
        self._listen(VERTEX, values(lambda p: self._vertex(p[:floats])))
        self._listen(NORMAL, values(lambda p: self._now.update(normals=p[:3])))
        self._listen(COLOR, values(lambda p: self._now.update(colors=p[:4])))
        self._listen(TEXTURE_COORD, values(lambda p: self._now.update(texcoords=p[:texture])))

    def _listen(self, which: int, function: Any) -> None:
        self._kept.append(function)
        self.call("gluNurbsCallback", which, ctypes.cast(function, c_void_p))

    def _vertex(self, values: list[float]) -> None:
        primitive = self.primitives[-1]
        primitive.vertices.append(values)
        for name, value in self._now.items():
            getattr(primitive, name).append(value)

    def call(self, name: str, *arguments: Any) -> None:
        getattr(self._glu, name)(self._nurbs, *(self._plain(a) for a in arguments))

    def _plain(self, argument: Any) -> Any:
        if not isinstance(argument, (list, np.ndarray)):
            return argument
        array = np.ascontiguousarray(argument, dtype=np.float32)
        self._kept.append(array)
        return array.ctypes.data_as(Floats)

    def load(self, modelview: ArrayLike, projection: ArrayLike, viewport: Sequence[int]) -> None:
        """gluLoadSamplingMatrices."""
        matrices = (np.asarray(modelview), np.asarray(projection))
        self.call("gluLoadSamplingMatrices", *matrices, (c_int * 4)(*viewport))

    def curve(self, knots: ArrayLike, points: Any, order: int, kind: int) -> None:
        """gluNurbsCurve of points (n, k)."""
        knots, points = np.asarray(knots), np.asarray(points)
        self.call("gluNurbsCurve", len(knots), knots, points.shape[1], points, order, kind)

    def surface(self, u_knots: Any, v_knots: Any, points: Any, orders: Any, kind: int) -> None:
        """gluNurbsSurface of points (m, n, k)."""
        u_knots, v_knots, points = np.asarray(u_knots), np.asarray(v_knots), np.asarray(points)
        strides = (points.shape[1] * points.shape[2], points.shape[2])
        self.call("gluNurbsSurface", len(u_knots), u_knots, len(v_knots), v_knots, *strides,
                  points, *orders, kind)  # fmt: skip

    def pwl(self, points: Any) -> None:
        """gluPwlCurve of points (n, 2 or 3)."""
        points = np.asarray(points)
        kind = TRIM_2 if points.shape[1] == 2 else TRIM_3
        self.call("gluPwlCurve", len(points), points, points.shape[1], kind)

    def properties(self, values: Mapping[int, float]) -> None:
        for name, value in values.items():
            self.call("gluNurbsProperty", name, value)

    def close(self) -> None:
        self.call("gluDeleteNurbsRenderer")


WIDTHS = {"VERTEX_3": 3, "VERTEX_4": 4, "COLOR_4": 4, "NORMAL": 3, "TEXTURE_COORD_1": 1,
          "TEXTURE_COORD_2": 2, "TEXTURE_COORD_3": 3, "TEXTURE_COORD_4": 4}  # fmt: skip


def run_real(glu: ctypes.CDLL, kind: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
    """The outputs of a case of kind "nurbs_curve" or "nurbs_surface", as libGLU has them."""
    surface = kind == "nurbs_surface"
    own = inputs.get("type", "VERTEX_3")
    texture = next((WIDTHS[e[0]] for e in inputs.get("extra", ()) if e[0][:3] == "TEX"), 2)
    nurbs = RealNurbs(glu, 5 if surface else WIDTHS[own], texture)
    nurbs.properties({PROPERTIES[k]: PROPERTIES.get(v, v) for k, v in inputs["props"].items()})
    if "view" in inputs:
        nurbs.load(*inputs["view"])
    names = ("sknots", "tknots", "ctrl", "sorder", "torder") if surface else (
        "knots", "ctrl", "order")  # fmt: skip
    maps = [*inputs.get("extra", ()), (own, *(inputs[name] for name in names))]
    nurbs.call("gluBeginSurface" if surface else "gluBeginCurve")
    for name, *data in maps:
        target = name if isinstance(name, int) else (0x0DB0 if surface else 0x0D90) + TARGETS[name]
        if surface:
            nurbs.surface(*data[:3], data[3:], target)
        else:
            nurbs.curve(*data, target)
    for loop in inputs.get("trims", ()):
        nurbs.call("gluBeginTrim")
        for form, *data in loop:
            if form == "pwl":
                nurbs.pwl(data[0])
            else:
                nurbs.curve(*data, TRIM_2 if np.shape(data[1])[1] == 2 else TRIM_3)
        nurbs.call("gluEndTrim")
    nurbs.call("gluEndSurface" if surface else "gluEndCurve")
    nurbs.close()
    return {"prims": [outputs_of(p, surface) for p in nurbs.primitives], "errors": nurbs.errors}


def outputs_of(primitive: Primitive, surface: bool) -> dict[str, Any]:
    vertices = primitive.vertices
    return {
        "mode": MODES[primitive.mode],
        "pos": [vertex[:3] if surface else vertex for vertex in vertices],
        "uv": [vertex[3:] for vertex in vertices] if surface else [],
        "normal": primitive.normals,
        "color": primitive.colors,
        "tex": primitive.texcoords,
    }


MODES = ("POINTS", "LINES", "LINE_LOOP", "LINE_STRIP", "TRIANGLES", "TRIANGLE_STRIP",
         "TRIANGLE_FAN", "QUADS", "QUAD_STRIP", "POLYGON")  # fmt: skip
TARGETS = {"COLOR_4": 0, "NORMAL": 2, "TEXTURE_COORD_1": 3, "TEXTURE_COORD_2": 4,
           "TEXTURE_COORD_3": 5, "TEXTURE_COORD_4": 6, "VERTEX_3": 7, "VERTEX_4": 8}  # fmt: skip
PROPERTIES = {"SAMPLING_METHOD": 100205, "SAMPLING_TOLERANCE": 100203,
              "PARAMETRIC_TOLERANCE": 100202, "U_STEP": 100206, "V_STEP": 100207,
              "CULLING": 100201, "DISPLAY_MODE": 100204, "PATH_LENGTH": 100215,
              "PARAMETRIC_ERROR": 100216, "DOMAIN_DISTANCE": 100217, "FILL": 100012,
              "OBJECT_PATH_LENGTH": 100209, "OBJECT_PARAMETRIC_ERROR": 100208,
              "OUTLINE_POLYGON": 100240, "OUTLINE_PATCH": 100241}  # fmt: skip
