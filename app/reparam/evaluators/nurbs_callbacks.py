"""GLU_NURBS_BEGIN .. _END: a tessellation handed to callbacks, vertex by vertex, as GLU does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from . import glu_constants as k
from .tessellations import Tessellation

Callbacks = Mapping[int, Callable[..., None]]


def call_back(
    tessellation: Tessellation, curve: bool, components: int, callbacks: Callbacks, data: Any
) -> None:
    """For each strip BEGIN, its vertices, END; for each vertex what it has: texture coordinate,
    colour, normal, then the vertex itself.

    A surface's vertex is x, y, z, u, v, divided by w; a curve's has the `components` of its map,
    VERTEX_4 undivided. Where a ..._DATA callback is set, it is called, with the data, instead of
    the plain one.
    """

    def caller(name: str) -> Callable[..., None] | None:
        with_data = callbacks.get(getattr(k, f"GLU_NURBS_{name}_DATA"))
        if with_data is None:
            return callbacks.get(getattr(k, f"GLU_NURBS_{name}"))
        return lambda *arguments: with_data(*arguments, data)

    positions = tessellation.vertices[:, :components]
    if not curve:
        parameters = tessellation.parameters.astype(np.float32)
        positions = np.concatenate([tessellation.points, parameters], 1)
    streams = [
        (call, values)
        for name, values in (
            ("TEXTURE_COORD", tessellation.texcoords),
            ("COLOR", tessellation.colors),
            ("NORMAL", tessellation.normals),
            ("VERTEX", positions),
        )
        if (call := caller(name)) is not None and values is not None
    ]
    begin, end = caller("BEGIN"), caller("END")
    for strip in tessellation.strips:
        if begin is not None:
            begin(strip.mode)
        for vertex in strip.vertices.tolist():
            for call, values in streams:
                call(values[vertex])
        if end is not None:
            end()
