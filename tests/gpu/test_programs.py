"""Programs: every variant passes a strict validator, errors name file:line, uniforms are set."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from truth import errors, random_nets

from reparam import assets
from reparam.assets import read_shaders
from reparam.errors import GraphicsError
from reparam.gpu.nets import instance_defines
from reparam.gpu.painter import Painter
from reparam.gpu.programs import Programs, degree_defines, locate, stage_source
from reparam.gpu.readback import read_points
from reparam.snapshot import Studio

LOOKS: list[dict[str, Any]] = [
    {},
    {"LIT": 1},
    {"TEXTURED": 1},
    {"TEXTURED": 1, "LIT": 1},
    {"TEXTURED": 1, "MIRRORED": 1},
    {"TEXTURED": 1, "MIRRORED": 1, "LIT": 1},
]
MEASURED = [{"LOCATED": 1, name: 1, **lit} for name in ("LEVEL", "ERROR") for lit in LOOKS[:2]]
RECORDED = [
    [],
    ["COLORED"],
    ["LIT", "POSITIONAL", "COLOR_MATERIAL"],
    ["LIT", "ONE_SIDED", "SHINY", "TEXTURED"],
    ["LIT", "SHINY", "POSITIONAL", "COLORED", "TEXTURED", "PROJECTIVE"],
    ["TEXTURED"],
    ["TEXTURED", "PROJECTIVE"],
]
TESSELLATION = ("patch.tess.vert", "patch.tesc", "patch.tese")
EVALUATE = degree_defines(**{"": (3, 1)}) | {"NORMALS": 1}
ON_THE_SPOT = degree_defines(**{"": (3, 2)}) | instance_defines((3, 2), 3)
LOW = degree_defines(POSITION_=(2, 3), TEXTURE_=(1, 1))
HIGH = degree_defines(POSITION_=(2, 9), TEXTURE_=(1, 1))
ADAPTIVE = {"ADAPTIVE": 1}
LOCATED = {"LOCATED": 1} | degree_defines(POSITION_=(2, 3)) | ADAPTIVE
VARIANTS: list[tuple[tuple[str, ...], dict[str, Any]]] = [
    *((("mesh.vert", "patch.frag"), look) for look in LOOKS),
    *(((*TESSELLATION, "patch.frag"), look | LOW) for look in LOOKS),
    *(((*TESSELLATION, "patch.frag"), look | HIGH) for look in LOOKS),
    ((*TESSELLATION, "probe.frag"), {"PROBE": 1} | degree_defines(POSITION_=(0, 8))),
    ((*TESSELLATION, "probe.frag"), {"PROBE": 1} | degree_defines(POSITION_=(31, 1))),
    ((*TESSELLATION, "probe.frag"), {"PROBE": 1, "LISTED": 1} | degree_defines(POSITION_=(2, 1))),
    *((("recorded.vert", "recorded.frag"), dict.fromkeys(look, 1)) for look in RECORDED),
    *((("adaptive.vert", "patch.frag"), look | LOW | ADAPTIVE) for look in LOOKS),
    (("adaptive.vert", "patch.frag"), LOOKS[3] | HIGH | ADAPTIVE),
    *((("mesh.vert", "patch.frag"), look | LOW) for look in MEASURED),
    *((("adaptive.vert", "patch.frag"), look | LOW | ADAPTIVE) for look in MEASURED),
    *(((*TESSELLATION, "patch.frag"), look | HIGH) for look in MEASURED),
    (("located.vert", "located.frag"), {"LOCATED": 1}),
    (("located.vert", "patch.frag"), {}),
    *(((*TESSELLATION, "patch.frag"), look | LOW | ADAPTIVE) for look in MEASURED),
    *(((*TESSELLATION, "patch.frag"), look | LOW | ADAPTIVE) for look in LOOKS),
    (("adaptive.vert", "located.frag"), LOCATED),
    ((*TESSELLATION, "located.frag"), LOCATED),
    (("adaptive.vert", "located.frag"), LOCATED | LOW | {"TEXTURED": 1}),
    (("levels.vert",), {"ONE_WAY": 1} | LOW),
    (("levels.vert",), {"TEXTURED": 1, "SOLID": 1} | HIGH),
    *((("recorded.vert", "recorded.frag"), look | ON_THE_SPOT) for look in LOOKS[:4]),
    (("recorded.vert", "recorded.frag"), {"LIT": 1, "AUTO_NORMAL": 1} | ON_THE_SPOT),
    (("evaluate.vert",), EVALUATE | instance_defines((3, 1), 4)),
    (("evaluate.vert",), degree_defines(**{"": (0, 0)})),
    (("evaluate.vert",), EVALUATE),
    (("evaluate.vert",), degree_defines(**{"": (9, 1)})),
    (("evaluate.vert",), degree_defines(**{"": (1, 31)}) | {"NORMALS": 1}),
    (("stroke.vert", "stroke.frag"), {}),
    (("flatten.vert",), {}),
    (("group.vert",), {}),
    (("parametric.vert",), {"FORMULA_X(u, w)": "sine(u)", "FORMULA_Y(u, w)": "arctangent(w)"}),
    (("trace.vert",), degree_defines(**{"": (3, 0)})),
    (("trace.vert",), degree_defines(**{"": (9, 0)})),
    (("reach.vert",), {}),
    (("marker.vert", "marker.frag"), {}),
    (("label.vert", "label.frag"), {}),
    (("label.vert", "compare.frag"), {}),
    (("widgets.vert", "widgets.frag"), {}),
]
MARKED: tuple[tuple[str, ...], dict[str, Any]] = (("marker.vert", "marker.frag"), {})


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of shaders/ that the programs are made from."""
    copy = tmp_path / "shaders"
    shutil.copytree(assets.root() / "shaders", copy)
    monkeypatch.setattr(assets, "root", lambda: tmp_path)
    return copy


def break_line(file: Path, line: int, text: str) -> None:
    lines = file.read_text().splitlines()
    lines[line - 1] = text
    file.write_text("\n".join(lines) + "\n")


def place(text: str, wanted: str) -> tuple[int, int]:
    """Source string and line of a line, as #line makes a compiler count."""
    string = number = 0
    for line in text.splitlines():
        if directive := re.match(r"#line (\d+)(?: (\d+))?$", line):
            number, string = int(directive[1]), int(directive[2] or string)
        elif wanted in line:
            break
        else:
            number += 1
    return string, number


def validate(folder: Path, stages: tuple[str, ...], defines: dict[str, Any]) -> str:
    """What glslangValidator says against the stages, each alone and linked; nothing if good.

    It knows `precise` from GLSL 4.00 on, not by the extension that drivers offer it by.
    """
    version = 400 if "patch.tese" in stages else 330
    files = [folder / name for name in stages]
    for file in files:
        text = stage_source(file.name, defines, version, read_shaders()).text
        file.write_text(text.replace("PRECISE precise", "PRECISE") if version < 400 else text)
    found = subprocess.run(["glslangValidator", "-l", *files], capture_output=True, text=True)
    return "" if found.returncode == 0 else found.stdout + found.stderr


@pytest.mark.parametrize(("stages", "defines"), VARIANTS)
def test_every_variant_is_valid(
    tmp_path: Path, stages: tuple[str, ...], defines: dict[str, Any]
) -> None:
    assert validate(tmp_path, stages, defines) == ""


def test_the_validator_would_say_so(tmp_path: Path, tree: Path) -> None:
    break_line(tree / "marker.frag", 3, "uniform vec3 color;")
    assert "ERROR" in validate(tmp_path, *MARKED)


def test_no_shader_is_left_out() -> None:
    files = {path.name for path in (assets.root() / "shaders").glob("*.*")}
    assert files == {name for stages, _ in VARIANTS for name in stages}


@pytest.mark.parametrize(
    ("file", "line", "text"),
    [
        ("lib/normal.glsl", 7, "vec3 safe_normalize(vec3 v) { undeclared = v;"),
        ("lib/bernstein.glsl", 17, "    basis[0] = vec2(1.0);"),
        ("lib/net.glsl", 6, "    return )"),
        ("evaluate.vert", 31, "    int patch_index = first_patch + missing(gl_InstanceID);"),
    ],
)
def test_an_error_names_file_and_line(
    studio: Studio, tree: Path, file: str, line: int, text: str
) -> None:
    break_line(tree / file, line, text)
    with pytest.raises(GraphicsError, match=rf"^{file}:{line}: \S.*\Z"):
        Programs(studio.ctx).get("evaluate.vert", defines=EVALUATE)


def test_a_warning_before_the_error_is_not_taken_for_it(studio: Studio, tree: Path) -> None:
    break_line(tree / "lib/net.glsl", 1, "float unset() { float x; return x; }")
    break_line(tree / "lib/normal.glsl", 3, "float used = unset() + undeclared;")
    with pytest.raises(GraphicsError, match=r"^lib/normal\.glsl:3: "):
        Programs(studio.ctx).get("evaluate.vert", defines=EVALUATE)


@pytest.mark.parametrize(
    "message",
    [
        "%d:%d(5): error: `x' undeclared",
        "%d(%d) : error C1503: undefined variable x",
        "ERROR: %d:%d: 'x' : undeclared identifier",
    ],
    ids=["Mesa", "NVIDIA", "Apple"],
)
def test_drivers_messages(message: str) -> None:
    source = stage_source("evaluate.vert", {}, 330, read_shaders())
    said = message % place(source.text, "// sum_j basis[j]")
    log = f"GLSL Compiler failed\n\nvertex_shader\n=============\n{said}\n"
    assert locate(log, {"vertex_shader": source}).startswith("lib/evaluate.glsl:21: ")


def test_a_missing_include_names_file_and_line(tree: Path) -> None:
    break_line(tree / "lib" / "evaluate.glsl", 14, '#include "missing.glsl"')
    with pytest.raises(GraphicsError, match=r"^lib/evaluate.glsl:14: expected a file to include"):
        stage_source("evaluate.vert", {}, 330, read_shaders())


def test_reload_keeps_the_last_good_programs(studio: Studio, tree: Path) -> None:
    painter = Painter(studio.ctx)
    nets = random_nets(np.random.default_rng(1), (1, 2), True)
    before = painter.programs.get(*MARKED[0], defines=MARKED[1])
    assert errors(nets, read_points(painter, "vertex", nets, 3)).point < 4e-7
    good = (tree / "lib" / "net.glsl").read_text()
    break_line(tree / "lib" / "net.glsl", 5, "vec4 control_point(sampler2D net, int index {")
    with pytest.raises(GraphicsError, match=r"^lib/net.glsl:5: "):
        painter.reload_shaders()
    assert painter.programs.get(*MARKED[0], defines=MARKED[1]) is before
    assert errors(nets, read_points(painter, "vertex", nets, 3)).point < 4e-7
    (tree / "lib" / "net.glsl").write_text(good.replace(", 0);", ", 0) * 2.0;"))
    painter.reload_shaders()
    assert painter.programs.get(*MARKED[0], defines=MARKED[1]) is not before
    points = read_points(painter, "vertex", nets, 3).points
    assert (points[:, 0] == 2.0 * nets[:, 0, 0].astype(np.float32)).all()


def test_a_reload_refuses_a_uniform_that_nothing_sets(studio: Studio, tree: Path) -> None:
    painter = Painter(studio.ctx)
    before = painter.programs.get("label.vert", "label.frag")
    break_line(tree / "label.frag", 2, "uniform float gain;")
    lines = (tree / "label.frag").read_text()
    (tree / "label.frag").write_text(lines.replace("color.a *", "gain * color.a *"))
    with pytest.raises(GraphicsError, match=r"^label.frag:2: uniform gain: expected no new"):
        painter.reload_shaders()
    assert painter.programs.get("label.vert", "label.frag") is before


def test_programs_are_compiled_once(studio: Studio) -> None:
    programs = Programs(studio.ctx)
    assert programs.get(*MARKED[0]) is programs.get(*MARKED[0])
    assert programs.get("mesh.vert", "patch.frag") is not programs.get(
        "mesh.vert", "patch.frag", defines={"LIT": 1}
    )


def test_uniforms(studio: Studio) -> None:
    program = Programs(studio.ctx).get("label.vert", "label.frag")
    with pytest.raises(KeyError, match="no uniform colour"):
        program.set(colour=(0.0, 0.0, 0.0, 1.0))
    program.set(viewport=(10, 10), box=(0, 0, 1, 1), coverage=0)
    with pytest.raises(AssertionError, match=r"uniforms never set: color$"):
        program.ready()
    assert program.set(color=(0.0, 0.0, 0.0, 1.0)).ready() is program.gl


def test_a_uniform_that_the_compiler_dropped_is_passed_over(studio: Studio) -> None:
    programs = Programs(studio.ctx)
    low, high = (degree_defines(**{"": (degree, degree)}) for degree in (0, 9))
    program = programs.get("evaluate.vert", defines=low, varyings=("point",))
    program.set(net=0, first_patch=0).ready()
    generic = programs.get("evaluate.vert", defines=high, varyings=("point",))
    with pytest.raises(AssertionError, match="never set: degree, first_patch, net"):
        generic.ready()
