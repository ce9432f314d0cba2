"""Shader programs: assembled from shaders/, specialised by #define, compiled once, reloadable."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import moderngl

from ..assets import FILE_LINES, ShaderSource, expand_shader, read_shaders
from ..errors import GraphicsError
from ..geometry.curvature import REGULAR
from ..geometry.net import MAX_ORDER
from ..geometry.normal import SINGULAR_FACTOR, SINGULAR_SINE, SINGULAR_STEP
from ..scenes.layers import Color
from ..scenes.shading import (
    HIGH_COLOR,
    LEVEL_COLORS,
    LEVEL_FULL,
    LOW_COLOR,
    OVER_COLOR,
    ZEBRA_BANDS,
)
from .nets import NET_WIDTH

STAGES = {
    ".vert": "vertex_shader",
    ".tesc": "tess_control_shader",
    ".tese": "tess_evaluation_shader",
    ".frag": "fragment_shader",
}
SPECIALISED_DEGREE = 8  # up to here the degree is a constant of the program

# `precise` keeps a compiler from contracting a*b + c, so that edges read from both sides agree.
VERSIONS = {
    330: "#version 330 core\n#extension GL_ARB_gpu_shader5 : enable\n"
    "#extension GL_ARB_sample_shading : enable\n"
    "#ifdef GL_ARB_gpu_shader5\n#define PRECISE precise\n"
    "#else\n#define PRECISE\n#endif\n",
    400: "#version 400 core\n#define PRECISE precise\n",
}

Defines = Mapping[str, int | float | str]
Key = tuple[tuple[str, ...], tuple[tuple[str, int | float | str], ...], tuple[str, ...]]

_UNIFORM = re.compile(r"^\s*uniform\s+\w+\s+(\w+)", re.MULTILINE)


def degree_defines(**degrees: tuple[int, int]) -> dict[str, int]:
    """Defines for nets by prefix: DEGREE_U ..., or GENERIC_DEGREE where one is above 8."""
    highest = max(max(pair) for pair in degrees.values())
    if highest > SPECIALISED_DEGREE:
        return {"GENERIC_DEGREE": 1, "MAX_ORDER": MAX_ORDER}
    defines = {"MAX_ORDER": highest + 1}
    for prefix, (u, v) in degrees.items():
        defines |= {f"{prefix}DEGREE_U": u, f"{prefix}DEGREE_V": v}
    return defines


def stage_source(
    name: str, defines: Defines, version: int, texts: Mapping[str, str]
) -> ShaderSource:
    """shaders/NAME ready to compile, from the texts of `read_shaders`."""
    constants = {
        "NET_WIDTH": NET_WIDTH,
        "SINGULAR_SINE": SINGULAR_SINE,
        "SINGULAR_STEP": SINGULAR_STEP,
        "SINGULAR_FACTOR": SINGULAR_FACTOR,
        "REGULAR": REGULAR,
        "ZEBRA_BANDS": float(ZEBRA_BANDS),
        "LOW_COLOR": _numbers(LOW_COLOR),
        "HIGH_COLOR": _numbers(HIGH_COLOR),
        "OVER_COLOR": _numbers(OVER_COLOR),
        "LEVEL_COLORS": ", ".join(f"vec3({_numbers(color)})" for color in LEVEL_COLORS),
        "LEVEL_FULL": LEVEL_FULL,
        **defines,
    }
    if "LOCATED" in defines:
        from ..geometry.distortion import FARTHEST

        constants |= {"FARTHEST": FARTHEST}
    if "TRIMMED" in defines:
        from ..geometry.trimming.cells import DIVISION, MARGIN  # a plain picture starts without
        from ..geometry.trimming.cutting import BUMP_STEP, STEPS

        constants |= {"TRIM_DIVISION": DIVISION, "TRIM_MARGIN": MARGIN}
        constants |= {"TRIM_STEPS": STEPS, "TRIM_BUMP_STEP": BUMP_STEP}
    text = "".join(f"#define {key} {value}\n" for key, value in constants.items())
    return expand_shader(name, texts, VERSIONS[version] + text)


def _numbers(color: Color) -> str:
    return ", ".join(map(str, color))


class Program:
    """A compiled program whose uniforms are all set before it draws."""

    def __init__(
        self, gl: moderngl.Program, declared: frozenset[str], defines: frozenset[str]
    ) -> None:
        self.gl = gl
        self.defines = defines
        self._declared = declared
        members = {name: gl[name] for name in gl}
        self._active = {n: m for n, m in members.items() if isinstance(m, moderngl.Uniform)}
        self._unset = set(self._active)

    @property
    def uniforms(self) -> frozenset[str]:
        """Those that the compiler kept."""
        return frozenset(self._active)

    def set(self, **values: Any) -> Program:
        """Give uniforms their values. One that the compiler dropped is passed over."""
        for name, value in values.items():
            if name in self._active:
                uniform = self._active[name]
                uniform.write(value) if isinstance(value, bytes) else setattr(
                    uniform, "value", value
                )
                self._unset.discard(name)
            elif name not in self._declared:
                raise KeyError(f"no uniform {name} in this program")
        return self

    def ready(self) -> moderngl.Program:
        """The program, or AssertionError if a uniform was never set (it would silently be 0)."""
        assert not self._unset, f"uniforms never set: {', '.join(sorted(self._unset))}"
        return self.gl


class Programs:
    """All programs of a context, by stages and defines.

    The texts are read once, and again by `reload`: a file that is broken meanwhile harms nothing.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._texts = read_shaders()
        self._cache: dict[Key, Program] = {}

    def get(
        self, *stages: str, defines: Defines | None = None, varyings: tuple[str, ...] = ()
    ) -> Program:
        """The program of these stages (file names in shaders/), compiled at first use.

        `varyings` are captured by transform feedback. Raises GraphicsError naming file:line.
        """
        key = (stages, tuple(sorted((defines or {}).items())), varyings)
        if key not in self._cache:
            self._cache[key] = self._compile(key, self._texts)
        return self._cache[key]

    def reload(self) -> None:
        """Compile every program anew from the files. If one fails, all stay as they were.

        A new uniform is a failure too: nothing would set it. Raises GraphicsError naming
        file:line.
        """
        texts, fresh = read_shaders(), {}
        try:
            for key, old in self._cache.items():
                fresh[key] = self._compile(key, texts)
                added = sorted(fresh[key].uniforms - old.uniforms - self._declared(key))
                if added:
                    raise GraphicsError(f"{_place_of(added[0], texts)}: expected no new uniform")
        except GraphicsError:
            for program in fresh.values():
                program.gl.release()
            raise
        for old in self._cache.values():
            old.gl.release()
        self._texts, self._cache = texts, fresh

    def _declared(self, key: Key) -> frozenset[str]:
        return declared(stage.text for stage in self._sources(key, self._texts).values())

    def _sources(self, key: Key, texts: Mapping[str, str]) -> dict[str, ShaderSource]:
        stages, defines, _ = key
        version = 400 if any(name.endswith(".tese") for name in stages) else 330
        return {
            STAGES["." + name.rsplit(".", 1)[1]]: stage_source(name, dict(defines), version, texts)
            for name in stages
        }

    def _compile(self, key: Key, texts: Mapping[str, str]) -> Program:
        _, defines, varyings = key
        sources = self._sources(key, texts)
        stages: dict[str, Any] = {stage: source.text for stage, source in sources.items()}
        try:
            gl = self._ctx.program(**stages, varyings=varyings)
        except moderngl.Error as error:
            raise GraphicsError(locate(str(error), sources)) from error
        return Program(gl, declared(stages.values()), frozenset(dict(defines)))


def declared(texts: Iterable[str]) -> frozenset[str]:
    """The uniforms that shaders declare, used or not."""
    return frozenset(name for text in texts for name in _UNIFORM.findall(text))


def _place_of(uniform: str, texts: Mapping[str, str]) -> str:
    for name, text in texts.items():
        for number, line in enumerate(text.splitlines(), start=1):
            if uniform in _UNIFORM.findall(line):
                return f"{name}:{number}: uniform {uniform}"
    return f"uniform {uniform}"


# Mesa: `0:12(5): error: ...`   NVIDIA: `0(12) : error C0000: ...`   others: `ERROR: 0:12: ...`
_PLACE = re.compile(r"(WARNING:\s*)?\d+(?::(\d+)|\((\d+)\))[^:\n]*:(?!\s*warning)\s*(.+)")


def locate(log: str, sources: Mapping[str, ShaderSource]) -> str:
    """A compiler's log as one line, `file:line: message`, in terms of the files in shaders/."""
    stage = next((name for name in sources if name in log), None)
    place = next((found for found in _PLACE.finditer(log) if not found[1]), None)
    if stage is None or place is None:
        return "shader: " + " ".join(log.split())
    files = sources[stage].files
    number, line = divmod(int(place[2] or place[3]), FILE_LINES)
    name = files[number] if number < len(files) else stage
    return f"{name}:{line}: {place[4].strip()}"
