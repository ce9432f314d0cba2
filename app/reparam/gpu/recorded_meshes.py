"""What glEvalMesh2 filled, to be measured: as it is drawn, but without its colours and trims."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..evaluators.constants import GL_TRIANGLES
from ..evaluators.recording import Batch, Recording
from ..geometry.camera import Camera
from ..geometry.curve import restrict
from ..geometry.net import Array
from .accuracy import Floats, Ints, Measurable
from .context import bound
from .evaluated import exact
from .painter import Painter
from .plans import SetCommon
from .readback import read_at


@dataclass(frozen=True)
class RecordedMeshes(Measurable):
    """Meshes of one shape, drawn in a view of so many pixels; their patches are what the grid
    covers of the maps."""

    painter: Painter
    batch: Batch
    points: Floats  # (patches, k, 4): its vertices as the GPU evaluates them
    camera: Camera
    size: tuple[int, int]

    @cached_property
    def nets(self) -> Array:
        """Of the part of each map, in its own parameters, that the grid covers."""
        (u0, v0), (u1, v1) = self._ends
        net = self.batch.feeds["vertex"].net
        nets = (net if net.ndim == 4 else net[None]).astype(np.float64)
        in_v = restrict(nets, v0, v1)
        return np.asarray(restrict(in_v.swapaxes(-3, -2), u0, u1).swapaxes(-3, -2))

    @property
    def steps(self) -> Ints:
        """Those of the grid."""
        return np.full(len(self.nets), max(self.batch.first.grid.shape) - 1)

    @property
    def triangles(self) -> int:
        """Of all meshes."""
        return len(self.nets) * len(self.batch.indices)

    @property
    def _ends(self) -> Array:
        """Where the grid begins and ends: ((u, v), (u, v))."""
        return self.batch.feeds["vertex"].pairs[[0, -1]][:, [0, 2]]

    def draw(self, fragment: str, defines: Mapping[str, int | str], set_common: SetCommon) -> None:
        """By located.vert."""
        ctx, (patches, count) = self.painter.ctx, self.points.shape[:2]
        low, high = self._ends
        pairs = self.batch.feeds["vertex"].pairs
        places = np.tile((pairs[:, [0, 2]] - low) / (high - low), (patches, 1))
        first = np.arange(patches, dtype=np.int32)[:, None, None] * count
        program = self.painter.programs.get("located.vert", fragment, defines=dict(defines))
        set_common(program)
        content = [(ctx.buffer(self.points.tobytes()), "4f", "point")]
        if "LOCATED" in defines:
            program.set(vertices=count)
            content.append((ctx.buffer(places.astype(np.float32).tobytes()), "2f", "place"))
        indices = ctx.buffer((first + self.batch.indices).astype(np.int32).tobytes())
        array = ctx.vertex_array(program.ready(), content, indices)
        array.render()
        array.release()
        for buffer in (indices, *(buffer for buffer, _, _ in content)):
            buffer.release()


def recorded_meshes(
    painter: Painter, recording: Recording, camera: Camera, size: tuple[int, int]
) -> Iterator[RecordedMeshes]:
    """What of a recording is filled meshes; trimmed ones are whole."""
    for item in recording.drawn:
        if isinstance(item, Batch) and item.primitive == GL_TRIANGLES and item.indices.size:
            feed, normals = item.feeds["vertex"], item.first.maps.auto_normal
            with bound(painter.ctx, painter.nowhere):
                read = read_at(painter, "vertex", feed.net, feed.pairs, normals)
            points = np.ascontiguousarray(exact(read.points, feed.components, "vertex"))
            yield RecordedMeshes(painter, item, points, camera, size)
