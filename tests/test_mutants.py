"""Small faults put into a copy of the project: a few of the quick tests must see each of them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
QUICK = (
    "tests/test_orientation.py::test_u_runs_along_the_first_index",
    "tests/test_orientation.py::test_a_picture_goes_with_each_patch",
    "tests/test_pictures.py::test_the_rim_is_four_parabolas",
    "tests/test_pictures.py::test_under_r_every_fragment_is_the_checker_at_x_y",
    "tests/test_pictures.py::test_area_covered",
    "tests/test_cli.py::test_check[fig4]",
    "tests/test_cli.py::test_check[fig5]",
)
CHOICE = "test_check or vertex"  # one evaluator is enough
MUTANTS = {  # file, what it says, what it shall say
    "none": ("README.md", "", ""),
    "control point moved by 0.001": (
        "app/reparam/geometry/planar_maps.py",
        "[(-2, 0), (0, 0), (2, 0)]",
        "[(-2, 0), (0, 0), (2.001, 0)]",
    ),
    "1.99 for 2 in GLSL": (
        "shaders/lib/bernstein.glsl",
        "float entry = carry + t.y * above;",
        "float entry = (carry + t.y * above) * (k == 2 && i == 1 ? 1.99 / 2.0 : 1.0);",
    ),
    "1.99 for 2 in Python": (
        "app/reparam/geometry/bernstein.py",
        "basis[i] = carry + s * above",
        "basis[i] = (carry + s * above) * (1.99 / 2.0 if k == 2 and i == 1 else 1.0)",
    ),
    "texture scale + 0.5 %": (
        "app/reparam/scenes/attachments.py",
        "scale=checks / 4,",
        "scale=checks / 4 * 1.005,",
    ),
    "the identity for r": (
        "app/reparam/scenes/figures/fig5.py",
        '"r": r}',
        '"r": ALIGNED_IDENTITY}',
    ),
    "u and v swapped in the evaluator": (
        "shaders/lib/evaluate.glsl",
        "vec4 evaluate(sampler2D net, int patch_index, ivec2 degree, vec4 uv) {",
        "vec4 evaluate(sampler2D net, int patch_index, ivec2 degree, vec4 uv) { uv = uv.zwxy;",
    ),
    "u and v swapped in the evaluator of normals": (
        "shaders/lib/normal.glsl",
        "evaluate_derivatives(net, patch_index, degree, inside, along_u, along_v);",
        "evaluate_derivatives(net, patch_index, degree, inside.zwxy, along_u, along_v);",
    ),
    "u and v swapped in a file": (
        "app/reparam/files/bv.py",
        "_points(numbers, m * n, 3).reshape(m, n, 3)",
        "_points(numbers, m * n, 3).reshape(n, m, 3).swapaxes(0, 1)",
    ),
    "u and v swapped in a texture map": (
        "app/reparam/scenes/figures/surface.py",
        "u, v = body.domains[..., 0], body.domains[..., 1]",
        "v, u = body.domains[..., 0], body.domains[..., 1]",
    ),
    "level 16 for 32": (
        "app/reparam/scenes/display.py",
        'steps in u and in v"] = 32',
        'steps in u and in v"] = 16',
    ),
    "a tenth of a pixel to the right": (
        "app/reparam/geometry/camera.py",
        "    scale /= view.zoom\n",
        "    scale /= view.zoom\n    center = center - rotation[0] * 0.2 * scale\n",
    ),
}


OTHERS = (
    "1.99 for 2 in Python",
    "u and v swapped in the evaluator of normals",
    "u and v swapped in a file",
    "u and v swapped in a texture map",
)
FIRST = tuple(name for name in MUTANTS if name not in (*OTHERS, "none"))


def outcome(name: str, folder: Path) -> tuple[int, str]:
    """Exit code and output of the quick tests on a copy with that fault."""
    for part in ("app", "shaders", "textures", "tests"):
        ignored = shutil.ignore_patterns("__pycache__", "golden", "report")
        shutil.copytree(ROOT / part, folder / part, ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", folder)
    if name != "none":
        file, says, shall_say = MUTANTS[name]
        text = (folder / file).read_text(encoding="utf-8")
        assert text.count(says) == 1, f"{file} does not say {says!r} once"
        (folder / file).write_text(text.replace(says, shall_say), encoding="utf-8")
    words = ["-q", "-x", "-k", CHOICE, "-p", "no:cacheprovider", "-p", "no:xdist", *QUICK]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(folder / "app"), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize(
    "names",
    [pytest.param(FIRST, id="first"), pytest.param(OTHERS, id="others", marks=pytest.mark.slow)],
)
def test_the_quick_tests_see_every_fault(tmp_path: Path, names: Sequence[str]) -> None:
    names = ("none", *names)
    folders = [tmp_path / str(number) for number in range(len(names))]
    with ThreadPoolExecutor(2) as pool:
        outcomes = dict(zip(names, pool.map(outcome, names, folders), strict=True))
    code, text = outcomes.pop("none")
    assert code == 0, f"without a fault:\n{text[-2000:]}"
    not_seen = [f"{name}: exit code {code}" for name, (code, _) in outcomes.items() if code != 1]
    assert not_seen == []
