"""How a frame grows with the number of patches: the time of one patch must stay flat or fall.

`ratio` is the time of a patch over that of a patch in the frame of the fewest; `exponent` in the
settings of the last row is the slope of log time over log patches.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.bench import Row, Rows
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

COUNTS = (100, 1_000, 10_000, 100_000)
LEVEL = 2
SIZE = (1024, 1024)
NET_BYTES = 9 * 16  # a biquadratic net as RGBA32F


def rows(pairs: int) -> Rows:
    """Biquadratic patches that tile the screen."""
    studio = Studio()
    evaluator = studio.painter.capabilities.evaluator(None)
    found: list[float] = []
    with frames(studio, SIZE) as frame:
        for count in COUNTS:
            layer = Patches(wavy_patches(count, 2))

            def draw(layer: Patches = layer) -> None:
                studio.painter.surfaces.draw(layer, FROM_ABOVE, evaluator, LEVEL)

            found.append(median_seconds(frame(draw), 3, min(pairs, 11)))
            settings = {"evaluator": evaluator, "level": LEVEL, "net_bytes_a_patch": NET_BYTES}
            if len(found) > 1:
                slope = np.polyfit(np.log(COUNTS[: len(found)]), np.log(found), 1)[0]
                settings["exponent"] = round(float(slope), 3)
            ratio = found[-1] / count / (found[0] / COUNTS[0])
            yield Row(f"scale/{count}", ratio, 1e3 * found[-1], 1e3 * found[0], settings, 1.0)
            studio.painter.surfaces.forget()


def median_seconds(frame: Callable[[], None], warm_up: int, times: int) -> float:
    """Of a frame, after some that do not count."""
    seconds = []
    for _ in range(warm_up + times):
        began = time.perf_counter()
        frame()
        seconds.append(time.perf_counter() - began)
    return statistics.median(seconds[warm_up:])
