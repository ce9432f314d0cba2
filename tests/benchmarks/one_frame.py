"""Where the time of one frame goes: 1000 biquadratic patches at level 8, lit and textured, 512 x 512.

`submit` is the frame of one patch at level 1: the same calls from Python and in the driver, nothing
to speak of for the GPU. `vertices` is what a frame costs more whose triangles are discarded before
the rasteriser; `triangles` what it costs more in a viewport of 16 x 16 pixels; `fragments` what it
costs more at full size. A frame without an edit finds its vertices evaluated; `evaluation` is what
it costs more if every patch has changed, `edit` if one has. Shares are of the frame without an edit.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from frames import FROM_ABOVE, Frame, frames, wavy_patches

from reparam.bench import Row, Rows
from reparam.geometry.net import Array
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

SIZE = (512, 512)
TINY = (0, 0, 16, 16)
LEVEL = 8
RASTERIZER_DISCARD = 0x8C89
WARM_UP = 3

ACCOUNT = """
On a software rasteriser a frame is triangles and fragments: the patches are evaluated once and kept,
so what is left of the vertices is their transformation, which a static mesh has as well. That is why
`static_mesh` is near 1 and cannot be below it, and why no evaluator, however fast, doubles a frame
against numpy (`edited`). What was tried for the vertices and did not help: evaluating for each
frame while drawing (each corner of a grid is then evaluated up to twice; with tessellation llvmpipe
does so for every frame, and is quadratic in the patches of a draw, so it gets 64 at a time),
degrees as uniforms instead of constants (2.4 times a static mesh), and one large draw instead of
batches (no faster, and a batch fits the cache).
"""


def rows(pairs: int) -> Rows:
    """Each part of the frame, in milliseconds and as a share of it."""
    studio = Studio()
    nets = wavy_patches(1000, 2)
    layer = textured(nets)
    few = textured(nets[:1])
    with frames(studio, SIZE) as frame:
        parts = _frames(studio, frame, layer, few)
        times: dict[str, list[float]] = {name: [] for name in parts}
        for turn in range(WARM_UP + pairs):
            for name, run in parts.items():
                began = time.perf_counter()
                run()
                if turn >= WARM_UP:
                    times[name].append(time.perf_counter() - began)
    found = {name: 1e3 * statistics.median(seconds) for name, seconds in times.items()}
    whole = found["whole"]
    for name, more, less in (
        ("submit", "few", None),
        ("vertices", "discarded", "few"),
        ("triangles", "tiny", "discarded"),
        ("fragments", "whole", "tiny"),
        ("evaluation", "all_edited", "whole"),
        ("edit", "one_edited", "whole"),
    ):
        part = found[more] - (found[less] if less else 0.0)
        yield Row(f"one_frame/{name}", part / whole, part, whole, {"runs": pairs})


def textured(nets: Array) -> Patches:
    """Lit patches with a map of their own."""
    return Patches(nets, Texture(nets, Picture()), lit=True)


def _frames(
    studio: Studio, frame: Frame, layer: Patches, few: Patches
) -> dict[str, Callable[[], None]]:
    ctx, surfaces = studio.ctx, studio.painter.surfaces
    edited = layer.net

    def draw(shown: Patches, level: int = LEVEL) -> None:
        surfaces.draw(shown, FROM_ABOVE, "vertex", level)
        surfaces.sweep()
        studio.painter.evaluation.sweep()

    def discarded() -> None:
        ctx.enable_direct(RASTERIZER_DISCARD)
        draw(layer)
        ctx.disable_direct(RASTERIZER_DISCARD)

    def tiny() -> None:
        ctx.viewport = TINY
        draw(layer)

    def all_edited() -> None:
        draw(Patches(layer.net * 1.0001, layer.texture, lit=True))

    def one_edited() -> None:
        nonlocal edited
        edited = edited.copy()
        edited[500, 1, 1, 2] += 1e-3
        draw(Patches(edited, layer.texture, lit=True))

    return {
        "few": frame(lambda: draw(few, 1)),
        "discarded": frame(discarded),
        "tiny": frame(tiny),
        "whole": frame(lambda: draw(layer)),
        "all_edited": frame(all_edited),
        "one_edited": frame(one_edited),
    }
