"""How far drawn points are off: each fragment says where on which patch it lies (located.frag)."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.bernstein import bernstein
from ..geometry.camera import Camera
from ..geometry.evaluate import project
from ..geometry.net import Array
from ..scenes.layers import Patches
from .adaptive import Plan
from .evaluation import orders
from .painter import Painter
from .programs import Program
from .targets import check_size

CHUNK = 1 << 16  # fragments evaluated at a time


def deviations(
    painter: Painter,
    layer: Patches,
    camera: Camera,
    evaluator: str,
    plan: Plan,
    size: tuple[int, int],
) -> Array:
    """For each fragment of the layer, drawn alone as planned: pixels (k,) between its centre and
    the float64 surface point of its own patch and (u, v), projected."""
    places = located(painter, layer, camera, evaluator, plan, size)
    rows, columns = np.nonzero(places[..., 3] == 1.0)
    centers = np.stack([columns, rows], -1) + 0.5
    points = surface_points(layer.net, places[rows, columns])
    return np.asarray(np.linalg.norm(camera.pixels(points, *size) - centers, axis=-1))


def located(
    painter: Painter,
    layer: Patches,
    camera: Camera,
    evaluator: str,
    plan: Plan,
    size: tuple[int, int],
) -> NDArray[np.float32]:
    """(patch, u, v, 1) of each fragment of the layer, drawn alone as planned, 0 at the end where
    there is none: (height, width, 4), bottom row first."""
    ctx = painter.ctx
    check_size(*size, painter.capabilities)
    places, depth = ctx.texture(size, 4, dtype="f4"), ctx.depth_renderbuffer(size)
    framebuffer = ctx.framebuffer([places], depth)

    def set_common(program: Program) -> None:
        program.set(clip_from_model=camera.clip_from_model().T.astype(np.float32).tobytes())

    with ctx.scope(framebuffer, moderngl.DEPTH_TEST):
        framebuffer.clear(-1.0, 0.0, 0.0, 0.0, depth=1.0)
        painter.surfaces.adaptive.draw(
            layer, evaluator, plan, "located.frag", {"LOCATED": 1}, set_common
        )
        read = np.frombuffer(places.read(), np.float32).reshape(size[1], size[0], 4)
    for part in (framebuffer, places, depth):
        part.release()
    return read


def surface_points(net: Array, places: NDArray[np.float32]) -> Array:
    """Points (k, 3) of patches at places (k, 4), each (patch, u, v, ...)."""
    nets = net if net.ndim == 4 else net[None]
    degree_u, degree_v = orders(net)
    points = np.empty((len(places), 3))
    for first in range(0, len(places), CHUNK):
        chunk = slice(first, first + CHUNK)
        u, v = places[chunk, 1].astype(np.float64), places[chunk, 2].astype(np.float64)
        row, column = bernstein(degree_u, u), bernstein(degree_v, v)
        own = nets[places[chunk, 0].astype(int)]
        points[chunk] = project(np.einsum("ki,kj,kijc->kc", row, column, own, optimize=True))
    return points
