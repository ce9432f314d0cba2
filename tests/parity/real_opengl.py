"""The real evaluators: a compatibility-profile context without a window, by ctypes alone.

What glEvalCoord and glEvalMesh really make is captured by transform feedback of the untouched
attributes under GL_RASTERIZER_DISCARD: the driver's own floats, no matrices, no clipping.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from ctypes import POINTER, byref, c_char_p, c_double, c_float, c_int, c_uint, c_void_p
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reparam import evaluators

Single = NDArray[np.float32]

SURFACELESS = 0x31DD
OPENGL_API = 0x30A2
DRAW, READ = 0x3059, 0x305A
CONFIGURATION = (0x3033, 1, 0x3040, 8, 0x3024, 8, 0x3023, 8, 0x3022, 8, 0x3025, 24, 0x3038)
PROFILE_MASK, COMPATIBILITY = 0x9126, 2
VERTEX_SHADER, COMPILE_STATUS, LINK_STATUS = 0x8B31, 0x8B81, 0x8B82
FEEDBACK_BUFFER, INTERLEAVED, DYNAMIC_READ = 0x8C8E, 0x8C8C, 0x88E9
PRIMITIVES_WRITTEN, QUERY_RESULT, RASTERIZER_DISCARD = 0x8C88, 0x8866, 0x8C89
CORNERS = {evaluators.GL_POINTS: 1, evaluators.GL_LINES: 2, evaluators.GL_TRIANGLES: 3}
LARGEST = 1 << 24  # bytes captured

SHADER = b"""#version 150 compatibility
out vec4 pos; out vec4 normal; out vec4 color; out vec4 tex;
void main() {
    pos = gl_Vertex; normal = vec4(gl_Normal, 0.0); color = gl_Color; tex = gl_MultiTexCoord0;
    gl_Position = gl_Vertex;
}"""

FLOATS, POINTER_ARGUMENT = c_float, c_void_p
SIGNATURES: dict[str, tuple[Any, ...]] = {
    "glMap1f": (c_uint, c_float, c_float, c_int, c_int, c_void_p),
    "glMap2f": (c_uint, c_float, c_float, c_int, c_int, c_float, c_float, c_int, c_int, c_void_p),
    "glMapGrid1f": (c_int, c_float, c_float),
    "glMapGrid2f": (c_int, c_float, c_float, c_int, c_float, c_float),
    "glEvalCoord1f": (c_float,),
    "glEvalCoord2f": (c_float, c_float),
    "glEvalMesh1": (c_uint, c_int, c_int),
    "glEvalMesh2": (c_uint, c_int, c_int, c_int, c_int),
    "glBegin": (c_uint,),
    "glEnable": (c_uint,),
    "glDisable": (c_uint,),
    "glNormal3f": (c_float,) * 3,
    "glColor4f": (c_float,) * 4,
    "glTexCoord4f": (c_float,) * 4,
    "glRotatef": (c_float,) * 4,
    "glOrtho": (c_double,) * 6,
    "glClearColor": (c_float,) * 4,
    "glMaterialfv": (c_uint, c_uint, c_void_p),
    "glMaterialf": (c_uint, c_uint, c_float),
    "glLightfv": (c_uint, c_uint, c_void_p),
    "glLightModelfv": (c_uint, c_void_p),
    "glTexImage2D": (c_uint, *(c_int,) * 5, c_uint, c_uint, c_void_p),
    "glReadPixels": (c_int, c_int, c_int, c_int, c_uint, c_uint, c_void_p),
    "glLoadMatrixf": (c_void_p,),
    "glShaderSource": (c_uint, c_int, c_void_p, c_void_p),
    "glTransformFeedbackVaryings": (c_uint, c_int, c_void_p, c_uint),
    "glBufferData": (c_uint, ctypes.c_ssize_t, c_void_p, c_uint),
    "glGetBufferSubData": (c_uint, ctypes.c_ssize_t, ctypes.c_ssize_t, c_void_p),
}


class Missing(Exception):
    """There is no real thing here: no libEGL, no compatibility profile."""


class RealOpenGL:
    """A context of its own. `current` makes it current for a block, and gives back what was."""

    def __init__(self, size: tuple[int, int] = (256, 256)) -> None:
        try:
            self._egl = ctypes.CDLL("libEGL.so.1")
        except OSError as error:
            raise Missing(str(error)) from error
        self._functions: dict[str, Callable[..., Any]] = {}
        egl = self._egl
        for name in ("eglGetPlatformDisplay", "eglCreateContext", "eglCreatePbufferSurface",
                     "eglGetCurrentContext", "eglGetCurrentDisplay", "eglGetCurrentSurface",
                     "eglGetProcAddress"):  # fmt: skip
            getattr(egl, name).restype = c_void_p
        egl.eglGetProcAddress.argtypes = [c_char_p]
        egl.eglGetPlatformDisplay.argtypes = [c_uint, c_void_p, c_void_p]
        egl.eglInitialize.argtypes = [c_void_p] * 3
        egl.eglChooseConfig.argtypes = [c_void_p, c_void_p, c_void_p, c_int, c_void_p]
        egl.eglCreateContext.argtypes = [c_void_p] * 4
        egl.eglCreatePbufferSurface.argtypes = [c_void_p] * 3
        egl.eglMakeCurrent.argtypes = [c_void_p] * 4
        before = self._now()
        self._display = egl.eglGetPlatformDisplay(SURFACELESS, None, None)
        if not self._display or not egl.eglInitialize(self._display, None, None):
            raise Missing("no surfaceless EGL")
        egl.eglBindAPI(OPENGL_API)
        configuration, count = c_void_p(), c_int()
        wanted = (c_int * len(CONFIGURATION))(*CONFIGURATION)
        egl.eglChooseConfig(self._display, wanted, byref(configuration), 1, byref(count))
        # No attributes: the highest compatibility profile that the driver has.
        self._context = egl.eglCreateContext(self._display, configuration, None, None)
        surface = (c_int * 5)(0x3057, size[0], 0x3056, size[1], 0x3038)
        self._surface = egl.eglCreatePbufferSurface(self._display, configuration, surface)
        if not count.value or not self._context or not self._make_current():
            raise Missing("no context with a pbuffer")
        profile = c_int()
        self.glGetIntegerv(PROFILE_MASK, byref(profile))
        if not profile.value & COMPATIBILITY:
            self._put_back(before)
            raise Missing("no compatibility profile")
        self.renderer = ctypes.cast(self.function("glGetString", c_void_p)(0x1F01), c_char_p).value
        self._prepare_capture()
        self._put_back(before)

    @contextmanager
    def current(self) -> Iterator[RealOpenGL]:
        """Its context, for a block."""
        before = self._now()
        self._make_current()
        try:
            yield self
        finally:
            self.glFlush()
            self._put_back(before)

    def function(self, name: str, result: Any = None) -> Callable[..., Any]:
        """An OpenGL function by its name."""
        if name not in self._functions:
            address = self._egl.eglGetProcAddress(name.encode())
            assert address, name
            arguments = SIGNATURES.get(name)
            if arguments is None:  # integers and pointers go through as they are
                found = ctypes.CFUNCTYPE(result)(address)
            else:
                found = ctypes.CFUNCTYPE(result, *arguments)(address)
            self._functions[name] = found
        return self._functions[name]

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if not name.startswith("gl"):
            raise AttributeError(name)
        return self.function(name)

    def _now(self) -> tuple[Any, ...]:
        egl = self._egl
        surfaces = (egl.eglGetCurrentSurface(DRAW), egl.eglGetCurrentSurface(READ))
        return (egl.eglGetCurrentDisplay(), *surfaces, egl.eglGetCurrentContext())

    def _put_back(self, before: tuple[Any, ...]) -> None:
        if before[3]:
            self._egl.eglMakeCurrent(*before)
        else:
            self._egl.eglMakeCurrent(self._display, None, None, None)

    def _make_current(self) -> bool:
        surface, context = self._surface, self._context
        return bool(self._egl.eglMakeCurrent(self._display, surface, surface, context))

    def _prepare_capture(self) -> None:
        shader = self.function("glCreateShader", c_uint)(VERTEX_SHADER)
        self.glShaderSource(shader, 1, byref(c_char_p(SHADER)), None)
        self.glCompileShader(shader)
        self._program = self.function("glCreateProgram", c_uint)()
        self.glAttachShader(self._program, shader)
        names = (c_char_p * 4)(b"pos", b"normal", b"color", b"tex")
        self.glTransformFeedbackVaryings(self._program, 4, names, INTERLEAVED)
        self.glLinkProgram(self._program)
        linked = c_int()
        self.glGetProgramiv(self._program, LINK_STATUS, byref(linked))
        assert linked.value
        self._buffer, self._query = c_uint(), c_uint()
        self.glGenBuffers(1, byref(self._buffer))
        self.glBindBuffer(FEEDBACK_BUFFER, self._buffer)
        self.glBufferData(FEEDBACK_BUFFER, LARGEST, None, DYNAMIC_READ)
        self.glGenQueries(1, byref(self._query))

    def capture(self, draw: Callable[[], None], primitive: int) -> dict[str, Single]:
        """What `draw` makes, as separate points, lines or triangles: pos (n, 4), normal (n, 3),
        color (n, 4), tex (n, 4). 9 where nothing fed an attribute."""
        self.glUseProgram(self._program)
        self.glEnable(RASTERIZER_DISCARD)
        self.glBindBufferBase(FEEDBACK_BUFFER, 0, self._buffer)
        self.glNormal3f(9.0, 9.0, 9.0)
        self.glColor4f(9.0, 9.0, 9.0, 9.0)
        self.glTexCoord4f(9.0, 9.0, 9.0, 9.0)
        self.glBeginQuery(PRIMITIVES_WRITTEN, self._query)
        self.glBeginTransformFeedback(primitive)
        draw()
        self.glEndTransformFeedback()
        self.glEndQuery(PRIMITIVES_WRITTEN)
        written = c_uint()
        self.glGetQueryObjectuiv(self._query, QUERY_RESULT, byref(written))
        values = np.empty((written.value * CORNERS[primitive], 16), np.float32)
        assert values.nbytes < LARGEST
        if len(values):
            self.glGetBufferSubData(FEEDBACK_BUFFER, 0, values.nbytes, values.ctypes.data)
        self.glDisable(RASTERIZER_DISCARD)
        self.glUseProgram(0)
        error = self.function("glGetError", c_uint)()
        assert error == 0, f"the real OpenGL says 0x{error:04x}"
        fields = {"pos": (0, 4), "normal": (4, 7), "color": (8, 12), "tex": (12, 16)}
        return {name: values[:, a:b] for name, (a, b) in fields.items()}

    def run(self, kind: str, inputs: dict[str, Any]) -> dict[str, Single]:
        """The outputs of a case of one of the kinds map1, map2, map1_mesh, map2_mesh."""
        dimension = int(kind[3])
        self._define(dimension, inputs)
        if kind.endswith("mesh"):
            mode = getattr(evaluators, f"GL_{inputs['mode']}")
            primitive = {0x1B00: 0, 0x1B01: 1, 0x1B02: 4}[mode]
            if dimension == 1:
                self.glMapGrid1f(*inputs["grid"])
                ends = (inputs["i1"], inputs["i2"])
                return self.capture(lambda: self.glEvalMesh1(mode, *ends), primitive)
            self.glMapGrid2f(*inputs["grid"])
            return self.capture(lambda: self.glEvalMesh2(mode, *inputs["rng"]), primitive)
        return self.capture(lambda: self._points(dimension, inputs), evaluators.GL_POINTS)

    def _points(self, dimension: int, inputs: dict[str, Any]) -> None:
        self.glBegin(evaluators.GL_POINTS)
        if dimension == 1:
            for u in inputs["u"]:
                self.glEvalCoord1f(u)
        else:
            for u, v in inputs["uv"]:
                self.glEvalCoord2f(u, v)
        self.glEnd()

    def _define(self, dimension: int, inputs: dict[str, Any]) -> None:
        for target in range(0x0D90, 0x0D99):
            self.glDisable(target)
            self.glDisable(target + 0x20)
        auto = inputs.get("auto_normal", False)
        (self.glEnable if auto else self.glDisable)(evaluators.GL_AUTO_NORMAL)
        for name, given in inputs["maps"].items():
            target = getattr(evaluators, f"GL_MAP{dimension}_{name}")
            points = np.array(given["points"], np.float32)
            first = points.ctypes.data_as(POINTER(c_float))
            place = ctypes.cast(first, c_void_p).value + 4 * given["offset"]
            if dimension == 1:
                self.glMap1f(target, *given["domain"], given["stride"], given["order"], place)
            else:
                along_u = (*given["udomain"], given["ustride"], given["uorder"])
                along_v = (*given["vdomain"], given["vstride"], given["vorder"])
                self.glMap2f(target, *along_u, *along_v, place)
            self.glEnable(target)
