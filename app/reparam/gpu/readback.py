"""Points and normals handed back, by either evaluator."""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from .evaluation import orders, patch_count
from .painter import Painter
from .programs import degree_defines
from .surfaces import grid

Array = NDArray[np.float64]
PROBE_WIDTH = 1024


@dataclass(frozen=True)
class Points:
    """What the GPU evaluated, float32: `parameters` (patches, k, 4) as (u, 1-u, v, 1-v), `points`
    (patches, k, 4) homogeneous, `normals` (patches, k, 3); k = (level + 1)^2, u slowest."""

    parameters: NDArray[np.float32]
    points: NDArray[np.float32]
    normals: NDArray[np.float32]


def read_points(painter: Painter, evaluator: str, net: Array, level: int) -> Points:
    """A net's patches on the grid of a level, by "vertex" or "tessellation".

    Raises GraphicsError if the context has not that evaluator.
    """
    if painter.capabilities.evaluator(evaluator) == "tessellation":
        return _read_tessellated(painter, net, level)
    parameters = grid(level)
    values = painter.evaluation.read(net, parameters, normals=True)
    shape = (patch_count(net), *parameters.shape)
    own = np.broadcast_to(parameters.astype(np.float32), shape)
    return Points(own, values[..., :4], values[..., 4:])


def _read_tessellated(painter: Painter, net: Array, level: int) -> Points:
    """Each grid point is drawn as a point onto a texel of its own (patch.tese with PROBE)."""
    ctx, count = painter.ctx, patch_count(net)
    texels = count * (level + 1) ** 2
    size = (PROBE_WIDTH, -(-texels // PROBE_WIDTH))
    layers = [ctx.texture(size, 4, dtype="f4") for _ in range(3)]
    framebuffer = ctx.framebuffer(layers)
    framebuffer.use()
    framebuffer.clear()
    program = painter.programs.get(
        "patch.tess.vert",
        "patch.tesc",
        "patch.tese",
        "probe.frag",
        defines={"PROBE": 1} | degree_defines(POSITION_=orders(net)),
    )
    painter.evaluation.texture(net).use(0)
    program.set(position_net=0, position_degree=orders(net), level=level, probe_size=size)
    ctx.disable(moderngl.BLEND)
    painter.surfaces.tessellate(program, count, level)
    arrays = [np.frombuffer(layer.read(), np.float32).reshape(-1, 4)[:texels] for layer in layers]
    ctx.extra.use()
    framebuffer.release()
    for layer in layers:
        layer.release()
    parameters, points, normals = (a.reshape(count, (level + 1) ** 2, 4) for a in arrays)
    return Points(parameters, points, normals[..., :3])
