"""A user's own context with nothing bound: on this driver, and on OpenGL 3.3 alone."""

from __future__ import annotations

import pytest
from test_contexts import need_mesa, run

from reparam.snapshot import Studio

SCRIPT = """
import moderngl
import numpy as np
from reparam.evaluators import *
from reparam.geometry.evaluate import evaluate

ctx = moderngl.create_context(standalone=True, backend="egl")
gl = Evaluators(ctx)
net = np.random.default_rng(1).normal(size=(3, 4, 3))
gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, net)
gl.glEnable(GL_MAP2_VERTEX_3)
gl.glEnable(GL_AUTO_NORMAL)
gl.glMapGrid2f(5, 0, 1, 9, 0, 1)
gl.glEvalMesh2(GL_FILL, 0, 5, 0, 9)
recording = gl.take()
for evaluator in ("vertex", "tessellation")[: 1 + (ctx.version_code >= 400)]:
    (mesh,) = gl.read(recording, evaluator=evaluator)
    truth = evaluate(np.dstack([net.astype(np.float32), np.ones((3, 4))]), *mesh.parameters.T)
    lengths = np.linalg.norm(mesh.normals, axis=-1)
    print(np.abs(mesh.vertices - truth).max(), np.abs(lengths - 1.0).max())
(drawable,) = gl._painter.recordings.drawables.of(recording, on_the_spot=False)
kept = np.frombuffer(drawable.streams["vertex"][0].read(), np.float32).reshape(60, 7)
print(np.abs(kept[:, :4] - truth).max(), np.abs(kept[:, 4:] - mesh.normals).max())
assert ctx.error == "GL_NO_ERROR"
"""


@pytest.mark.parametrize("context", ["native", "3.3"])
def test_read_and_evaluated_without_a_framebuffer(studio: Studio, context: str) -> None:
    if context != "native":
        need_mesa(studio)
    found = run(context, "-c", SCRIPT)
    assert found.returncode == 0, found.stderr
    lines = [[float(word) for word in line.split()] for line in found.stdout.splitlines()]
    assert len(lines) == (3 if context == "native" else 2)
    assert max(map(max, lines)) < 2e-5, lines
