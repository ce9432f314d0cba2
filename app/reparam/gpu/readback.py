"""Points and normals handed back, by either evaluator."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .batches import grid
from .context import bound
from .evaluation import orders, patch_count
from .nets import NET_UNIT
from .painter import Painter
from .programs import degree_defines

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
    return _read_vertices(painter, net, grid(level), True)


def read_at(
    painter: Painter, evaluator: str, net: Array, parameters: Array, normals: bool = True
) -> Points:
    """The same at any list of parameters (k, 4), each (u, 1-u, v, 1-v); normals if asked for."""
    if painter.capabilities.evaluator(evaluator) == "tessellation":
        level = max(1, math.ceil(math.sqrt(len(parameters))) - 1)
        return _read_tessellated(painter, net, level, parameters)
    return _read_vertices(painter, net, parameters, normals)


def _read_vertices(painter: Painter, net: Array, parameters: Array, normals: bool) -> Points:
    values = painter.evaluation.read(net, parameters, normals=normals)
    shape = (patch_count(net), *parameters.shape)
    own = np.broadcast_to(parameters.astype(np.float32), shape)
    return Points(own, values[..., :4], values[..., 4:])


def _read_tessellated(
    painter: Painter, net: Array, level: int, listed: Array | None = None
) -> Points:
    """Each grid point is drawn as a point onto a texel of its own (patch.tese with PROBE)."""
    ctx, count, points = painter.ctx, patch_count(net), (level + 1) ** 2
    texels = count * points
    size = (PROBE_WIDTH, -(-texels // PROBE_WIDTH))
    program = painter.programs.get(
        "patch.tess.vert",
        "patch.tesc",
        "patch.tese",
        "probe.frag",
        defines={"PROBE": 1}
        | ({} if listed is None else {"LISTED": 1})
        | degree_defines(POSITION_=orders(net)),
    )
    layers = [ctx.texture(size, 4, dtype="f4") for _ in range(3)]
    framebuffer = ctx.framebuffer(layers)
    with bound(ctx, framebuffer):
        framebuffer.clear()
        painter.evaluation.texture(net).use(NET_UNIT)
        program.set(
            position_net=NET_UNIT, position_degree=orders(net), level=level, probe_size=size
        )
        if listed is not None:
            painter.evaluation.texture(listed).use(NET_UNIT - 1)
            program.set(parameter_list=NET_UNIT - 1, last_parameter=len(listed) - 1)
        painter.surfaces.tessellate(program, count, level)
    arrays = [np.frombuffer(layer.read(), np.float32).reshape(-1, 4)[:texels] for layer in layers]
    framebuffer.release()
    for layer in layers:
        layer.release()
    found = points if listed is None else len(listed)
    parameters, values, normals = (a.reshape(count, points, 4)[:, :found] for a in arrays)
    return Points(parameters, values, normals[..., :3])
