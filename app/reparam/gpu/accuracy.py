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
    rows, columns = np.nonzero(read[..., 3] == 1.0)
    centers = np.stack([columns, rows], -1) + 0.5
    found = [
        surface_points(layer.net, read[rows[i : i + CHUNK], columns[i : i + CHUNK]])
        for i in range(0, len(rows), CHUNK)
    ]
    points = np.concatenate([np.zeros((0, 3)), *found])
    return np.asarray(np.linalg.norm(camera.pixels(points, *size) - centers, axis=-1))


def surface_points(net: Array, places: NDArray[np.float32]) -> Array:
    """Points (k, 3) of patches at places (k, 4), each (patch, u, v, ...)."""
    nets = net if net.ndim == 4 else net[None]
    degree_u, degree_v = orders(net)
    u, v = places[:, 1].astype(np.float64), places[:, 2].astype(np.float64)
    row, column = bernstein(degree_u, u), bernstein(degree_v, v)
    own = nets[places[:, 0].astype(int)]
    return project(np.einsum("ki,kj,kijc->kc", row, column, own, optimize=True))
