"""How finely each patch of a layer is to be drawn in a view (levels.vert), asked on the GPU."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..scenes.layers import Patches
from .evaluation import Evaluation, orders, patch_count
from .nets import MAP_UNIT, NET_UNIT
from .programs import Programs, degree_defines


class Fineness:
    """Runs the bound of geometry/levels.py over all patches of a layer at once."""

    def __init__(self, ctx: moderngl.Context, programs: Programs, evaluation: Evaluation) -> None:
        self._ctx = ctx
        self._programs = programs
        self._evaluation = evaluation

    def run(
        self,
        layer: Patches,
        camera: Camera,
        viewport: tuple[int, int],
        tolerance: float,
        one_way: bool,
    ) -> moderngl.Buffer:
        """Steps in u and v of each patch and whether its diagonals are to fall, float32 (patches,
        3); steps (0, 0) for one out of view, or one of a solid body that faces away."""
        # By its own position a map is off as much as the point is: the picture stays in place. What
        # fragments look up by themselves is not off at all.
        texture = layer.texture
        sought = layer.net if texture is None or texture.exact else texture.net
        textured = sought is not layer.net
        wanted = {"TEXTURED": textured, "SOLID": layer.solid, "ONE_WAY": one_way}
        defines = {name: 1 for name, on in wanted.items() if on}
        nets = {"POSITION_": layer.net} | ({"TEXTURE_": sought} if textured else {})
        defines |= degree_defines(**{name: orders(net) for name, net in nets.items()})
        program = self._programs.get("levels.vert", defines=defines, varyings=("steps",))
        self._evaluation.texture(layer.net).use(NET_UNIT)
        program.set(
            clip_from_model=camera.clip_from_model().T.astype(np.float32).tobytes(),
            half_size=(viewport[0] / 2.0, viewport[1] / 2.0),
            tolerance=tolerance,
            position_net=NET_UNIT,
            position_degree=orders(layer.net),
        )
        if textured:
            self._evaluation.texture(sought).use(MAP_UNIT)
            program.set(
                texture_net=MAP_UNIT,
                texture_degree=orders(sought),
                texture_stride=0 if patch_count(sought) == 1 else 1,
            )
        count = patch_count(layer.net)
        numbers = self._ctx.buffer(np.arange(count, dtype=np.int32).tobytes())
        vertices = self._ctx.vertex_array(program.ready(), [(numbers, "1i", "patch_index")])
        captured = self._ctx.buffer(reserve=12 * count)
        vertices.transform(captured, moderngl.POINTS, count)
        vertices.release()
        numbers.release()
        return captured

    def read(
        self,
        layer: Patches,
        camera: Camera,
        viewport: tuple[int, int],
        tolerance: float,
        one_way: bool = False,
    ) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """The same handed back: (patches, 2) and (patches,). `one_way` is for cells that are all
        cut along diagonals that rise, or all along such that fall."""
        captured = self.run(layer, camera, viewport, tolerance, one_way)
        found = np.frombuffer(captured.read(), np.float32).reshape(-1, 3)
        captured.release()
        return found[:, :2].astype(np.int64), found[:, 2] > 0.0
