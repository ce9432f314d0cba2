"""Where the time of a cold `reparam render fig5 --plain` goes, phase by phase.

Each run is a process of its own; of each phase the fastest counts, and its share of the whole.
`python` is the interpreter until the first line of ours; `imports` are numpy, moderngl, Pillow and
our own modules; `compiling` is the driver's work on the GLSL; `drawing` waits for the first
frame, for which software drivers compile machine code; what remains is argparse, the scene and
our own Python.
"""

from __future__ import annotations

import json
import tempfile
import time

from frames import python

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
numpy, moderngl, the context, the texture's mip maps and the first frame, for both of which the
driver compiles machine code, are most of it, and a bare program that computes with numpy needs them
too (`cold_start`). What helped: a plain picture imports neither strokes and labels nor trims,
fields, the window or the evaluators' names; of all scenes only the one that is drawn is imported;
set-up compiles the package, without which our own imports take several times as long. What did not:
a picture of 128 x 128 instead of 512 x 512, one sample a pixel instead of four, or level 4 instead
of 32 save a tenth of the whole each, for the first frame is mostly compilation.
"""


def rows(pairs: int) -> Rows:
    """The share of each phase, in their order."""
    runs: list[dict[str, float]] = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(min(pairs, 21) + 2):
            found = python("-c", PHASES, str(time.time()), f"{folder}/ours.png")
            runs.append(json.loads(found))
    runs = runs[2:]  # the driver's shader cache is full now
    least = {name: 1e3 * min(run[name] for run in runs) for name in runs[0]}
    whole = sum(least.values())
    for name, phase in least.items():
        yield Row(f"start_up/{name}", phase / whole, phase, whole, {"runs": len(runs)})
