"""Our vertex path against the same triangles, evaluated beforehand into one vertex buffer.

    python tests/benchmarks/static_mesh.py [--pairs 41] [--samples 4]

Each row is the median of ratios of neighbouring frames, ours / static, 512 x 512, in one process
(times differ from machine to machine and from minute to minute; ratios hardly do). `steady`: the
net stays, as when a view is turned. `edited`: every control point has changed since the last
frame, so every vertex is evaluated anew. The static mesh is drawn with the same vertex layout,
the same shaders and one draw call.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import moderngl
import numpy as np
from numpy.typing import NDArray

from reparam.geometry.camera import Camera
from reparam.geometry.evaluate import evaluate, grid_parameters
from reparam.geometry.normal import surface_normal
from reparam.gpu.surfaces import triangle_indices
from reparam.gpu.targets import Target
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

Array = NDArray[np.float64]
SIZE = (512, 512)
CASES = [(1, 128), (1000, 8)]  # patches, level
DEGREES = [2, 3]


def wavy_patches(count: int, degree: int) -> Array:
    """Patches (count, d+1, d+1, 4) that tile the square, each with a bump of its own."""
    side = int(np.ceil(np.sqrt(count)))
    place = np.stack(np.divmod(np.arange(count), side), -1)[:, None, None, :]
    t = np.arange(degree + 1) / degree
    corner = np.stack(np.meshgrid(t, t, indexing="ij"), -1)
    nets = np.zeros((count, degree + 1, degree + 1, 4))
    nets[..., :2] = (place + corner) / side * 2.0 - 1.0
    nets[..., 2] = np.random.default_rng(1).normal(scale=0.2 / side, size=nets.shape[:3])
    nets[..., 3] = 1.0
    return nets


class StaticMesh:
    """The layer's triangles in one buffer, drawn by the project's own mesh shaders."""

    def __init__(self, studio: Studio, layer: Patches, level: int) -> None:
        assert layer.texture is not None
        ctx, painter = studio.ctx, studio.painter
        u, _, v, _ = grid_parameters(level).T
        points = evaluate(layer.net, u, v)
        maps = np.broadcast_to(evaluate(layer.texture.net, u, v), points.shape)
        normals = np.stack([surface_normal(net, u, v) for net in layer.net])
        columns = [points, normals, maps] if layer.lit else [points, maps]
        layout = "4f 3f 4f" if layer.lit else "4f 4f"
        names = ("point", "normal", "map") if layer.lit else ("point", "map")
        defines = {"TEXTURED": 1} | ({"LIT": 1} if layer.lit else {})
        vertices = np.concatenate(columns, -1).astype(np.float32)
        self._layer, self._level, self._surfaces = layer, level, painter.surfaces
        self._program = painter.programs.get("mesh.vert", "patch.frag", defines=defines)
        indices = triangle_indices(level, len(layer.net))
        self._mesh = ctx.vertex_array(
            self._program.gl,
            [(ctx.buffer(vertices.tobytes()), layout, *names)],
            ctx.buffer(indices.tobytes()),
        )

    def draw(self, camera: Camera) -> None:
        self._surfaces.set_common(self._program, self._layer, camera, self._layer.color)
        self._program.set(level=self._level)
        self._program.ready()
        self._mesh.render()


def median_ratio(ours: Callable[[], None], other: Callable[[], None], pairs: int) -> float:
    """Median over pairs of neighbouring runs."""
    for _ in range(3):
        ours(), other()
    ratios = []
    for _ in range(pairs):
        began = time.perf_counter()
        ours()
        between = time.perf_counter()
        other()
        ratios.append((between - began) / (time.perf_counter() - between))
    return statistics.median(ratios)


def measure(studio: Studio, layer: Patches, level: int, pairs: int, samples: int) -> list[float]:
    """Ratios [steady, edited]."""
    target = Target(studio.ctx, SIZE, samples, studio.painter.capabilities)
    camera = Camera(np.eye(3), np.zeros(3), 1.05, 1.05, 4.0)
    static, surfaces = StaticMesh(studio, layer, level), studio.painter.surfaces
    held = [layer]

    def frame(draw: Callable[[], None]) -> Callable[[], None]:
        def run() -> None:
            target.framebuffer.use()
            target.framebuffer.clear(1.0, 1.0, 1.0, depth=1.0)
            studio.ctx.enable(moderngl.DEPTH_TEST)
            draw()
            studio.ctx.finish()

        return run

    def edit() -> None:
        held[0] = Patches(layer.net.copy(), layer.texture, lit=layer.lit)
        surfaces.draw(held[0], camera, "vertex", level)
        surfaces.sweep()
        studio.painter.evaluation.sweep()

    steady = frame(lambda: surfaces.draw(layer, camera, "vertex", level))
    reference = frame(lambda: static.draw(camera))
    ratios = [median_ratio(run, reference, pairs) for run in (steady, frame(edit))]
    studio.ctx.disable(moderngl.DEPTH_TEST)
    studio.ctx.extra.use()
    target.release()
    return ratios


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--pairs", type=int, default=41)
    options.add_argument("--samples", type=int, default=0)
    chosen = options.parse_args()
    studio = Studio()
    print(studio.painter.capabilities.renderer)
    for count, level in CASES:
        for degree in DEGREES:
            nets = wavy_patches(count, degree)
            for lit in (False, True):
                layer = Patches(nets, Texture(nets, Picture()), lit=lit)
                steady, edited = measure(studio, layer, level, chosen.pairs, chosen.samples)
                name = (
                    f"static_mesh/vertex/{count}x{level}/degree{degree}/{'lit' if lit else 'unlit'}"
                )
                print(f"{name:48} steady {steady:.3f}   edited {edited:.3f}", flush=True)


if __name__ == "__main__":
    main()
