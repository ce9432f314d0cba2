"""Where the time of one frame goes: 1000 biquadratic patches at level 8, lit, textured, 512 x 512.

`submit` is the frame of one patch at level 1: the same calls from Python and in the driver, next to
nothing for the GPU. `vertices` is what a frame costs more whose triangles are discarded before the
rasteriser, `triangles` what it costs more in a viewport of 16 x 16 pixels, `fragments` what it
costs more at full size. Of the frames, which are drawn in turn, the fastest count; the ratios are
shares of the whole frame, which finds its patches evaluated (`edit` and `edited` do not).
"""

from __future__ import annotations

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
PARTS = (  # what is measured: one frame less another
    ("submit", "few", None),
    ("vertices", "discarded", "few"),
    ("triangles", "tiny", "discarded"),
    ("fragments", "whole", "tiny"),
)


ACCOUNT = """
The calls from Python are a few hundredths of a frame; the rest is the driver's. On a software
rasteriser that is the transformation of the vertices, the set-up of their triangles, and the
fragments, all of which a static mesh of the same triangles needs as well (`static_mesh`): the
evaluated patches are such a mesh. What was tried and is not done: the degrees as uniforms instead
of constants of the program cost 2.4 times a static mesh; evaluating for every frame, as
tessellation must, costs a twentieth to a quarter of a frame more, and is for GPUs; all patches in
one draw is quadratic in llvmpipe's tessellator, so it gets 64 at a time; grids evaluated strip by
strip gave way to sums over local arrays, which the compiler unrolls.
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
                run()
                began = time.perf_counter()
                run()
                if turn >= WARM_UP:
                    times[name].append(time.perf_counter() - began)
    least = {name: 1e3 * min(seconds) for name, seconds in times.items()}
    whole = least["whole"]
    for name, more, less in PARTS:
        part = least[more] - (least[less] if less else 0.0)
        yield Row(f"one_frame/{name}", part / whole, part, whole, {"runs": pairs})


def textured(nets: Array) -> Patches:
    """Lit patches with a map of their own."""
    return Patches(nets, Texture(nets, Picture()), lit=True)


def _frames(
    studio: Studio, frame: Frame, layer: Patches, few: Patches
) -> dict[str, Callable[[], None]]:
    ctx, surfaces = studio.ctx, studio.painter.surfaces

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

    return {
        "few": frame(lambda: draw(few, 1)),
        "discarded": frame(discarded),
        "tiny": frame(tiny),
        "whole": frame(lambda: draw(layer)),
    }
