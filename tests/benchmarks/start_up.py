"""Where the time of a cold `reparam render fig5 --plain` goes, phase by phase.

Each run is a process of its own; the medians of its phases, and each one's share of the whole.
`python` is the interpreter until the first line of ours; `imports` are numpy, moderngl, Pillow and
our own modules; `compiling` is the driver's work on the GLSL; `drawing` waits for the first
frame, for which software drivers compile machine code; what remains is argparse, the scene and
our own Python.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
import time

from reparam.bench import Row, Rows

PHASES = """
import json
import sys
import time

began = float(sys.argv[1])
seconds = {"python": time.time() - began}
last = time.perf_counter()


def lap(name):
    global last
    now = time.perf_counter()
    seconds[name] = seconds.get(name, 0.0) + now - last
    last = now


import numpy
lap("imports/numpy")
import moderngl
import _moderngl
import glcontext
lap("imports/moderngl")
import PIL.Image
lap("imports/pillow")
import reparam.cli
import reparam.commands.render
import reparam.files.output
import reparam.snapshot
import reparam.scenes.figures.fig5
from reparam.gpu import context, painter, pictures, programs, targets
lap("imports/reparam")

inside = []


def timed(owner, method, name, finish=None):
    original = getattr(owner, method)

    def wrapped(*arguments, **named):
        inside.append(0.0)
        start = time.perf_counter()
        try:
            result = original(*arguments, **named)
            if finish:
                finish(*arguments)
            return result
        finally:
            whole = time.perf_counter() - start
            seconds[name] = seconds.get(name, 0.0) + whole - inside.pop()
            if inside:
                inside[-1] += whole
            else:
                outermost.append(whole)

    setattr(owner, method, wrapped)


outermost = []
timed(reparam.snapshot, "create_headless", "context")
timed(programs.Programs, "_compile", "compiling")
timed(pictures.Pictures, "use", "texture")
timed(painter.Painter, "draw", "drawing", lambda self, *rest: self.ctx.finish())
timed(targets.Target, "pixels", "reading")
timed(reparam.files.output, "save_picture", "png")
last = time.perf_counter()
code = reparam.cli.main(["render", "fig5", "--plain", "-o", sys.argv[2]])
seconds["remaining"] = time.perf_counter() - last - sum(outermost)
print(json.dumps(seconds))
raise SystemExit(code)
"""

ACCOUNT = """
Half of the time is spent before a line of ours runs: the interpreter, numpy, moderngl and Pillow
are what a bare program needs too, and so are the context and the driver's two compilations. What
helped, in the order of what it gave: modules that a plain picture does not need are imported where
they are used (strokes, labels, trims, the panel, GLU's part), a scene is found without importing
the others, set-up compiles the package, shader texts are read once, and the texture's mip maps
are made by the driver. What did not: compiling the two stages at once (the driver takes one after
the other), a smaller picture (its share is a few milliseconds), a lower level for plain pictures.
"""


def rows(pairs: int) -> Rows:
    """The share of each phase, the largest last."""
    runs: list[dict[str, float]] = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(min(pairs, 21) + 2):
            command = [sys.executable, "-c", PHASES, str(time.time()), f"{folder}/ours.png"]
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            runs.append(json.loads(done.stdout))
    runs = runs[2:]  # the driver's shader cache is full now
    whole = statistics.median(sum(run.values()) for run in runs)
    for name in runs[0]:
        phase = statistics.median(run[name] for run in runs)
        yield Row(f"start_up/{name}", phase / whole, 1e3 * phase, 1e3 * whole, {"runs": len(runs)})
