"""What the evaluators recorded, brought to the GPU: kept as long as the recording is."""

from __future__ import annotations

import weakref
from collections import deque
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..evaluators.arguments import Quad
from ..evaluators.grids import grid_pairs, grid_points, mesh_indices
from ..evaluators.maps import Array, Attribute
from ..evaluators.recording import HAVE_CURRENT, Batch, Collection, Recording, Trim
from .context import bound
from .evaluated import SIZES, read_collection
from .evaluation import Carried, orders, patch_count
from .programs import degree_defines

if TYPE_CHECKING:
    from ..geometry.trimming import TrimRegion
    from .painter import Painter

Single = NDArray[np.float32]
Stream = tuple[moderngl.Buffer, str]  # values from vertex to vertex, and their format

RECENT, RECENT_BYTES = 4, 1 << 20  # indices held for a recording that is made anew in each frame
MODES = {1: moderngl.POINTS, 2: moderngl.LINES, 3: moderngl.TRIANGLES}


@dataclass(frozen=True, eq=False)
class Shared:
    """Indices that many drawables use."""

    buffer: moderngl.Buffer


@dataclass(frozen=True)
class Spot:
    """A vertex map that the drawing program evaluates itself, on the spot: an instance a patch."""

    parameters: Array
    carried: Carried
    defines: dict[str, int]


@dataclass(frozen=True)
class Trimming:
    """What decides about the fragments, and where they lie in that region's unit square: (u, v) of
    each vertex, or (u0, v0, u1, v1) of each instance."""

    region: TrimRegion
    places: Stream


@dataclass(frozen=True)
class Drawable:
    """A batch or a collection on the GPU: what differs from vertex to vertex, the values of what
    does not, and the primitives of one instance."""

    streams: dict[Attribute, Stream]
    constants: dict[Attribute, Quad]
    indices: Shared
    mode: int
    count: int
    projective: bool  # texture coordinates have a fourth one
    owned: tuple[moderngl.Buffer, ...]
    spot: Spot | None = None
    instances: int = 1
    trimming: Trimming | None = None

    def release(self) -> None:
        """Give the memory back; of the indices when nobody uses them any more."""
        for buffer in self.owned:
            buffer.release()


class Drawables:
    """Makes and keeps them, in the context of a painter.

    Those for the built-in program are evaluated as they are drawn, in each frame, where the net
    of a patch fits into attributes and all else is the same for every patch. On software
    rasterisers too that costs next to nothing beside what is drawn, and takes no memory.
    """

    def __init__(self, painter: Painter) -> None:
        self._painter = painter
        self._ctx = painter.ctx
        self._kept: weakref.WeakKeyDictionary[Recording, dict[bool, list[Drawable]]]
        self._kept = weakref.WeakKeyDictionary()
        self._indices: weakref.WeakValueDictionary[Hashable, Shared]
        self._indices = weakref.WeakValueDictionary()
        self._recent: deque[Shared] = deque(maxlen=RECENT)
        self._dead: list[dict[bool, list[Drawable]]] = []  # of recordings that are no more
        self._lost: list[moderngl.Buffer] = []  # indices that nobody uses any more

    def of(self, recording: Recording, *, on_the_spot: bool) -> list[Drawable]:
        """The drawables of a recording, kept as long as it is."""
        if recording not in self._kept:
            self._kept[recording] = {}
            weakref.finalize(recording, self._dead.append, self._kept[recording]).atexit = False
        kept = self._kept[recording]
        if on_the_spot not in kept:
            with bound(self._ctx, self._painter.nowhere):
                items = recording.drawn if on_the_spot else recording.batches
                kept[on_the_spot] = [self._make(item, on_the_spot) for item in items]
            self._painter.evaluation.sweep()
            self._painter.surfaces.trims.sweep()
        for dead in self._dead:
            _release(dead)
        self._dead.clear()
        for buffer in self._lost:
            buffer.release()
        self._lost.clear()
        return kept[on_the_spot]

    def _make(self, item: Batch | Collection, on_the_spot: bool) -> Drawable:
        if isinstance(item, Collection):
            return self._compose(item)
        spot = self._spot(item) if on_the_spot else None
        return self._evaluate(item, spot)

    def _spot(self, batch: Batch) -> Spot | None:
        """How the vertex map is evaluated on the spot, if it can be."""
        feed = batch.feeds["vertex"]
        others = (other for attribute, other in batch.feeds.items() if attribute != "vertex")
        if any(patch_count(other.net) > 1 for other in others):
            return None
        carried = self._painter.evaluation.carry(feed.net, feed.components)
        if carried is None:
            return None
        defines = carried.defines | degree_defines(**{"": orders(feed.net)})
        if batch.first.maps.auto_normal:
            defines |= {"AUTO_NORMAL": 1}
        return Spot(grid_pairs(batch.first.grid, feed.domain), carried, defines)

    def _evaluate(self, batch: Batch, spot: Spot | None) -> Drawable:
        """The maps of all meshes, each into a buffer of its own that never leaves the GPU."""
        grid, patches = batch.first.grid, len(batch.meshes)
        auto, copies = batch.first.maps.auto_normal, patches if spot is None else 1
        owned: list[moderngl.Buffer] = [] if spot is None else [spot.carried.buffer]
        streams: dict[Attribute, Stream] = {}
        for attribute, feed in batch.feeds.items():
            if spot is not None and attribute == "vertex":
                continue
            normals = auto and attribute == "vertex"
            where = grid_pairs(grid, feed.domain)
            buffer = self._painter.evaluation.run_map(
                feed.net, feed.components, where, copies, normals=normals
            )
            owned.append(buffer)
            streams[attribute] = (buffer, layout(attribute, feed.components, normals))
            if normals:
                streams["normal"] = (buffer, "16x 3f")
        current = batch.first.current
        trims = [mesh.trim for mesh in batch.meshes]
        trimming = self._trimming(trims, None if spot is not None else grid_points(grid))
        return Drawable(
            streams,
            {a: current.value(a) for a in HAVE_CURRENT if a not in streams},
            self._mesh_indices(batch, copies),
            MODES[batch.indices.shape[1]],
            copies * batch.indices.size,
            "texcoord" in batch.feeds and batch.feeds["texcoord"].components == 4,
            tuple(owned) if trimming is None else (*owned, trimming.places[0]),
            spot,
            patches // copies,
            trimming,
        )

    def _trimming(self, trims: Sequence[Trim | None], parameters: Array | None) -> Trimming | None:
        """An instance each, or, for each, vertices with these parameters (k, 2)."""
        if trims[0] is None:
            return None
        low, high = (np.stack([getattr(trim, name) for trim in trims]) for name in ("low", "high"))
        if parameters is None:
            where, layout = np.concatenate([low, high], -1), "4f /i"
        else:
            where, layout = low[:, None] + (high - low)[:, None] * parameters, "2f"
        places = self._ctx.buffer(where.astype(np.float32).tobytes())
        return Trimming(trims[0].region, (places, layout))

    def _mesh_indices(self, batch: Batch, patches: int) -> Shared:
        """The primitives of at least so many patches."""
        grid, copies = batch.first.grid, 1 << (patches - 1).bit_length()
        key = (grid.shape, batch.first.mode, grid.turned, copies)
        found = self._indices.get(key)
        if found is None:
            first = np.arange(copies, dtype=np.int32)[:, None, None] * (
                grid.shape[0] * grid.shape[1]
            )
            found = self._shared(first + mesh_indices(grid.shape, batch.first.mode, grid.turned))
            self._indices[key] = found
        if found.buffer.size <= RECENT_BYTES and found not in self._recent:
            self._recent.append(found)
        return found

    def _shared(self, indices: NDArray[np.int32]) -> Shared:
        buffer = self._ctx.buffer(indices.astype(np.int32).tobytes())
        shared = Shared(buffer)
        weakref.finalize(shared, self._lost.append, buffer).atexit = False
        return shared

    def _compose(self, collection: Collection) -> Drawable:
        """Evaluated and plain vertices in one buffer."""
        found = read_collection(self._painter, collection, "vertex")
        columns: dict[Attribute, Single] = {
            "vertex": found.vertices,
            "normal": found.normals,
            "color": found.colors,
            "texcoord": found.texcoords,
            "index": found.indices[:, None],
        }
        buffer = self._ctx.buffer(np.concatenate(list(columns.values()), -1).tobytes())
        total, before = sum(SIZES.values()), 0
        streams: dict[Attribute, tuple[moderngl.Buffer, str]] = {}
        for attribute in columns:
            size = SIZES[attribute]
            after = total - before - size
            parts = (f"{4 * before}x" * bool(before), f"{size}f", f"{4 * after}x" * bool(after))
            streams[attribute] = (buffer, " ".join(part for part in parts if part))
            before += size
        mode, count = MODES[found.primitives.shape[1]], found.primitives.size
        projective = bool(np.any(found.texcoords[:, 3] != 1.0))
        indices = self._shared(found.primitives)
        trimming = self._trimming([collection.trim], collection.parameters)
        owned = (buffer,) if trimming is None else (buffer, trimming.places[0])
        return Drawable(streams, {}, indices, mode, count, projective, owned, trimming=trimming)


def layout(attribute: Attribute, components: int, normals: bool) -> str:
    """The format of a captured vertex: the map's components, for what it lacks OpenGL fills in
    (0, 0, 0, 1) by itself."""
    size = min(components, SIZES[attribute])
    skipped = 16 - 4 * size + (12 if normals else 0)
    return f"{size}f {skipped}x" if skipped else f"{size}f"


def _release(drawables: dict[bool, list[Drawable]]) -> None:
    for drawable in (one for kept in drawables.values() for one in kept):
        drawable.release()
