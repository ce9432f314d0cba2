"""How a frame grows with the number of patches: the time of one patch must stay flat or fall.

Each row is the time of a patch over that of a patch in the frame of a tenth as many, the two frames
in turn; `exponent` is that step's own slope of log time over log patches (below 1: the cost of a
patch falls), `overall` the slope over all rows so far. The bytes of a patch are those of its net in
the texture and of its evaluated vertices; resident ones what the process has grown by in the first
frame, where graphics memory is the process's own.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from math import log10
from pathlib import Path

import numpy as np
from frames import FROM_ABOVE, Frame, frames, wavy_patches

from reparam.bench import Row, Rows, interleave
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000)
MOST_PAIRS = {1_000_000: 3}
LEVEL = 2
SIZE = (1024, 1024)
NET_BYTES = 9 * 16  # a biquadratic net as RGBA32F
VERTEX_BYTES = {"vertex": (LEVEL + 1) ** 2 * 16, "tessellation": 0}
NOISE = 1.1
STATM = Path("/proc/self/statm")


ACCOUNT = """
The cost of a patch falls up to a million: a frame has fixed costs, and triangles that shrink
towards a pixel have fewer fragments. Resident memory is more than the patch's bytes since the
driver bins the triangles of a frame before it fills them.
"""


def rows(pairs: int) -> Rows:
    """Biquadratic patches that tile the screen, ten times as many in each row."""
    studio = Studio()
    evaluators = ["vertex", "tessellation"][: 1 + studio.painter.capabilities.tessellation]
    for evaluator in evaluators:
        with frames(studio, SIZE) as frame:
            yield from _grow(studio, evaluator, frame, pairs)
        studio.painter.surfaces.forget()


def _grow(studio: Studio, evaluator: str, frame: Frame, pairs: int) -> Rows:
    found: list[float] = []

    def drawing(count: int) -> Callable[[], None]:
        layer = Patches(wavy_patches(count, 2))

        def draw() -> None:
            studio.painter.surfaces.draw(layer, FROM_ABOVE, evaluator, LEVEL)
            studio.painter.surfaces.sweep()
            studio.painter.evaluation.sweep()

        return frame(draw)

    fewer = drawing(COUNTS[0])
    for count in COUNTS[1:]:
        more = drawing(count)
        before = resident()
        more()
        grown = resident() - before
        times = interleave(more, fewer, min(pairs, MOST_PAIRS.get(count, 11)), 1)
        row = times.row(f"scale/{evaluator}/{count}", evaluator=evaluator, level=LEVEL)
        assert row.ours_ms is not None
        assert row.other_ms is not None
        found = [*(found or [row.other_ms]), row.ours_ms]
        overall = np.polyfit(np.log10(COUNTS[: len(found)]), np.log10(found), 1)[0]
        settings = row.settings | {
            "exponent": round(log10(row.ratio), 3),
            "overall": round(float(overall), 3),
            "bytes_a_patch": NET_BYTES + VERTEX_BYTES[evaluator],
        }
        if studio.painter.capabilities.software and count >= 100_000:
            settings["resident_bytes_a_patch"] = round(grown / count)
        yield Row(row.name, row.ratio / 10, row.ours_ms, row.other_ms, settings, NOISE)
        fewer = more


def resident() -> int:
    """Memory of this process in bytes; 0 where it is not told."""
    if not STATM.exists():
        return 0
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
