"""10,000 cubic curves of 64 segments (1,000 on software) against a static buffer of the points.

`steady`: nothing changes; `turned`: the view does, and the points are brought onto the pixels
anew; `edited`: every control point has changed, and every point is evaluated anew. The other side
draws the same segments with the same shaders from points that were uploaded once. `by-bound`:
turned, in as many segments as half a pixel asks for, against the same 64.
"""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from unittest.mock import patch

import numpy as np
from frames import FROM_ABOVE, frames
from numpy.typing import NDArray

from reparam.bench import Rows, interleave
from reparam.geometry.curve import curve_net, curve_points
from reparam.geometry.curve_levels import Bends
from reparam.geometry.net import Array
from reparam.scenes.layers import Curves, Polylines
from reparam.scenes.shading import HALF_A_PIXEL
from reparam.snapshot import Studio

SEGMENTS = 64
SIZE = (512, 512)
GOAL = 1.15
WIDTH = 1.0


def small_curves(count: int) -> Array:
    """Cubic nets (count, 4, 4), each in its own cell of [-1,1]^2."""
    side = int(np.ceil(np.sqrt(count)))
    place = np.stack(np.divmod(np.arange(count), side), -1)[:, None]
    inside = np.random.default_rng(4).uniform(0.1, 0.9, (count, 4, 2))
    return curve_net((place + inside) / side * 2.0 - 1.0)


def rows(pairs: int) -> Rows:
    """Ratios ours / static."""
    studio = Studio()
    software = studio.painter.capabilities.software
    count, most, warm_up = (1_000, 7, 1) if software else (10_000, 41, 3)
    nets = small_curves(count)
    static = Polylines(curve_points(nets, np.linspace(0.0, 1.0, SEGMENTS + 1)), width=WIDTH)
    strokes, turns = studio.painter.strokes, [0]
    held = [Curves(nets, width=WIDTH)]

    def draw(layer: Curves | Polylines, turned: bool, tolerance: float = 0.0) -> None:
        turns[0] += turned
        camera = replace(FROM_ABOVE, half_width=1.05 + 1e-6 * turns[0])
        strokes.draw(layer, camera, 1.0, tolerance)
        strokes.sweep()
        studio.painter.evaluation.sweep()

    def edit() -> None:
        held[0] = Curves(nets.copy(), width=WIDTH)
        draw(held[0], False)

    cases = {
        "steady": (lambda: draw(held[0], False), lambda: draw(static, False)),
        "turned": (lambda: draw(held[0], True), lambda: draw(static, True)),
        "edited": (edit, lambda: draw(static, False)),
        "by-bound": (lambda: draw(held[0], True, HALF_A_PIXEL), lambda: draw(static, True)),
    }
    with frames(studio, SIZE) as frame:
        for name, (ours, other) in cases.items():
            goal = None if name == "edited" else GOAL
            with nullcontext() if name == "by-bound" else patch.object(Bends, "steps", all_alike):
                times = interleave(frame(ours), frame(other), min(pairs, most), warm_up)
            yield times.row(
                f"curves/{count}x{SEGMENTS}/{name}", goal=goal, degree=3, size="512x512"
            )


def all_alike(bends: Bends, *_: object) -> NDArray[np.int64]:
    """As many segments for each curve."""
    return np.full(len(bends.off), SEGMENTS)
