"""Other drivers, as far as Mesa can play them: OpenGL 4.1 as on macOS, 3.3 without tessellation."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from reparam.snapshot import Studio

HERE = Path(__file__).parent
CONTEXTS = {
    "native": {},
    "4.1": {"MESA_GL_VERSION_OVERRIDE": "4.1", "MESA_GLSL_VERSION_OVERRIDE": "410"},
    "3.3": {"GALLIUM_DRIVER": "softpipe", "LIBGL_ALWAYS_SOFTWARE": "1"},
}
SIZE = (160, 160)
SCRIPT = f"""
import sys
import numpy as np
from truth import errors, random_nets
from reparam.gpu.readback import read_points
from reparam.snapshot import Studio

studio, pictures = Studio(), []
has = studio.painter.capabilities
print(has.version, has.tessellation)
for evaluator in ("vertex", "tessellation")[: 1 + has.tessellation]:
    for patches in (3, 1500):
        nets = random_nets(np.random.default_rng(1), (2, 3), True, patches)
        worst = errors(nets, read_points(studio.painter, evaluator, nets, 3))
        print(evaluator, worst.point, worst.normal)
    studio.evaluator = evaluator
    pictures.append(studio.picture("fig5", {SIZE}, level=16))
print(studio.ctx.error)
np.save(sys.argv[1], pictures)
"""


def need_mesa(studio: Studio) -> None:
    if "Mesa" not in studio.painter.capabilities.driver:
        pytest.skip("only Mesa plays other drivers")


def run(context: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(HERE), *filter(None, sys.path)])
    ours = {name for settings in CONTEXTS.values() for name in settings}
    outer = {name: value for name, value in os.environ.items() if name not in ours}
    environment = outer | CONTEXTS[context] | {"PYTHONPATH": path}
    command = [sys.executable, *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True)


@pytest.mark.parametrize("context", CONTEXTS)
def test_accuracy_and_picture(studio: Studio, tmp_path: Path, context: str) -> None:
    if context != "native":
        need_mesa(studio)
    found = run(context, "-c", SCRIPT, str(tmp_path / "pictures.npy"))
    assert found.returncode == 0, found.stderr
    (version, tessellation), *measured, (error,) = (x.split() for x in found.stdout.splitlines())
    if context != "native":
        assert version == {"4.1": "410", "3.3": "330"}[context]
    evaluators = ["vertex", "tessellation"] if tessellation == "True" else ["vertex"]
    assert [evaluator for evaluator, _, _ in measured] == [e for e in evaluators for _ in range(2)]
    assert max(float(point) for _, point, _ in measured) < 4e-7
    assert max(float(normal) for _, _, normal in measured) < 1e-5
    assert error == "GL_NO_ERROR"
    expected = studio.picture("fig5", SIZE, level=16).astype(int)
    for picture in np.load(tmp_path / "pictures.npy"):
        different = np.abs(picture - expected).max(-1) > 16
        assert different.mean() < 0.02


def test_tessellation_where_there_is_none_is_one_clear_line(studio: Studio, tmp_path: Path) -> None:
    need_mesa(studio)
    output = tmp_path / "fig5.png"
    arguments = ["render", "fig5", "-o", str(output), "--evaluator", "tessellation"]
    found = run("3.3", "-m", "reparam", *arguments)
    assert found.returncode == 1
    assert found.stdout == ""
    assert found.stderr.startswith("reparam: --evaluator tessellation: expected OpenGL 4.0, found ")
    assert found.stderr.count("\n") == 1
    assert not output.exists()
