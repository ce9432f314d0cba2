"""Our evaluators against the same triangles, evaluated beforehand into one vertex buffer.

`steady`: the net stays, as when a view is turned. `edited`: every control point has changed since
the last frame, so every vertex is evaluated anew, which the static mesh is not. It is drawn with
the same vertex layout, the same shaders and one draw call.
"""

from __future__ import annotations

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.bench import Rows, Skipped, interleave
from reparam.geometry.camera import Camera
from reparam.geometry.evaluate import evaluate, grid_parameters
from reparam.geometry.normal import surface_normal
from reparam.gpu.looks import Look
from reparam.gpu.meshes import triangle_indices
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

SIZE = (512, 512)
CASES = ((1, 128), (1000, 8))  # patches, level
DEGREES = (2, 3)
GOALS = {("vertex", False): 1.05, ("vertex", True): 1.15}  # evaluator, lit
GOALS |= {("tessellation", lit): 1.5 for lit in (False, True)}


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
        vertices = np.concatenate(columns, -1).astype(np.float32)
        self._layer, self._level, self._surfaces = layer, level, painter.surfaces
        self._look = Look(layer.color)
        defines = painter.surfaces.looks.defines(layer, self._look)
        self._program = painter.programs.get("mesh.vert", "patch.frag", defines=defines)
        indices = triangle_indices(level, len(layer.net))
        self._mesh = ctx.vertex_array(
            self._program.gl,
            [(ctx.buffer(vertices.tobytes()), layout, *names)],
            ctx.buffer(indices.tobytes()),
        )

    def draw(self, camera: Camera) -> None:
        """As `Surfaces.draw` does, but for the evaluation."""
        self._surfaces.looks.set(self._program, self._layer, camera, self._look)
        self._program.set(level=self._level)
        self._program.ready()
        self._mesh.render()


def rows(pairs: int) -> Rows:
    """Each evaluator, each case, lit and unlit; for the vertex evaluator edited frames too."""
    studio = Studio()
    for count, level in CASES:
        for degree in DEGREES:
            nets = wavy_patches(count, degree)
            for lit in (False, True):
                layer = Patches(nets, Texture(nets, Picture()), lit=lit)
                yield from _measure(studio, layer, level, pairs)


def _measure(studio: Studio, layer: Patches, level: int, pairs: int) -> Rows:
    static, surfaces = StaticMesh(studio, layer, level), studio.painter.surfaces
    look = f"degree{layer.net.shape[1] - 1}/{'lit' if layer.lit else 'unlit'}"
    case = f"{len(layer.net)}x{level}/{look}"

    def edit() -> None:
        fresh = Patches(layer.net.copy(), layer.texture, lit=layer.lit)
        surfaces.draw(fresh, FROM_ABOVE, "vertex", level)
        surfaces.sweep()
        studio.painter.evaluation.sweep()

    with frames(studio, SIZE) as frame:
        frame.check_alike(edit, lambda: static.draw(FROM_ABOVE))
        reference = frame(lambda: static.draw(FROM_ABOVE))
        for evaluator in ("vertex", "tessellation"):
            name = f"static_mesh/{evaluator}/{case}"
            if evaluator == "tessellation" and not studio.painter.capabilities.tessellation:
                yield Skipped(name, "tessellation needs OpenGL 4.0")
                continue
            steady = frame(lambda e=evaluator: surfaces.draw(layer, FROM_ABOVE, e, level))
            goal = GOALS[evaluator, layer.lit]
            yield interleave(steady, reference, pairs).row(name, goal=goal, size="512x512")
        name = f"static_mesh/vertex/{case}/edited"
        yield interleave(frame(edit), reference, pairs).row(name, size="512x512")
