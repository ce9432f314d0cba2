"""What the evaluators recorded: evaluated, then drawn as often as one likes."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import moderngl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..evaluators.arguments import Quad
from ..evaluators.constants import GL_POINTS, GL_TRIANGLES
from ..evaluators.errors import InvalidOperation
from ..evaluators.grids import Indices, chained, grid_pairs, mesh_indices, primitive_indices
from ..evaluators.light import Light
from ..evaluators.maps import Array, Attribute
from ..evaluators.recording import HAVE_CURRENT, Batch, Collection, Recording
from ..geometry.camera import Camera
from ..scenes.layers import Recorded
from .evaluated import SIZES, read_collection
from .programs import Program

if TYPE_CHECKING:
    from .painter import Painter

Single = NDArray[np.float32]

TEXTURE_UNIT = 0
MODES = {1: moderngl.POINTS, 2: moderngl.LINES, 3: moderngl.TRIANGLES}
ATTRIBUTES: dict[str, Attribute] = {  # names in a user's program; `in_` may stand before them
    "position": "vertex", "vert": "vertex",
    "normal": "normal", "norm": "normal",
    "color": "color",
    "texcoord": "texcoord", "texcoord_0": "texcoord", "text": "texcoord",
    "index": "index",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Shared:
    """Indices that many drawables use."""

    buffer: moderngl.Buffer


@dataclass(frozen=True)
class Drawable:
    """A batch or a collection on the GPU: buffers and formats of what differs from vertex to
    vertex, the values of what does not, and the primitives."""

    streams: dict[Attribute, tuple[moderngl.Buffer, str]]
    constants: dict[Attribute, Quad]
    indices: Shared
    mode: int
    count: int
    projective: bool  # texture coordinates have a fourth one
    owned: tuple[moderngl.Buffer, ...]

    def release(self) -> None:
        """Give the memory back; of the indices when nobody uses them any more."""
        for buffer in self.owned:
            buffer.release()


class Recordings:
    """Draws recordings, in the context of a painter."""

    def __init__(self, painter: Painter) -> None:
        self._painter = painter
        self._ctx = painter.ctx
        self._kept: weakref.WeakKeyDictionary[Recording, list[Drawable]]
        self._kept = weakref.WeakKeyDictionary()
        self._indices: weakref.WeakValueDictionary[Hashable, Shared]
        self._indices = weakref.WeakValueDictionary()
        self._dead: list[list[Drawable]] = []  # of recordings that are no more
        self._lost: list[moderngl.Buffer] = []  # indices that nobody uses any more

    def draw(self, recording: Recording, program: moderngl.Program) -> None:
        """Draw into the current framebuffer with a program whose vertex attributes are called
        position, normal, color, texcoord, index (or in_position ...), those that it wants.

        What was evaluated is kept as long as the recording is. Raises InvalidOperation for a
        program with other attributes.
        """
        for drawable in self._drawables(recording):
            self._render(drawable, program)

    def draw_built_in(
        self,
        recording: Recording,
        projection: Array,
        modelview: Array,
        light: Light | None,
        texture: moderngl.Texture | None,
        modes: Sequence[int] | None = None,
    ) -> None:
        """The same with recorded.vert and recorded.frag, in the place of fixed function.

        The matrices (4, 4) are for column vectors. A texture is bound to unit 0. `modes` are the
        primitives to be drawn, None for all.
        """
        if texture is not None:
            texture.use(TEXTURE_UNIT)
        for drawable in self._drawables(recording):
            if modes is not None and drawable.mode not in modes:
                continue
            defines = look_of(drawable, light, texture is not None)
            program = self._painter.programs.get("recorded.vert", "recorded.frag", defines=defines)
            program.set(projection=_column_major(projection), modelview=_column_major(modelview))
            if "COLORED" not in defines:
                program.set(vertex_color=drawable.constants["color"])
            if light is not None:
                inverse = np.asarray(np.linalg.pinv(modelview[:3, :3]), np.float64)
                program.set(normal_matrix=_column_major(inverse.T))
                _set_light(program, light)
            if texture is not None:
                program.set(image=TEXTURE_UNIT)
            self._render(drawable, program.ready())

    def _render(self, drawable: Drawable, program: moderngl.Program) -> None:
        content: list[tuple[moderngl.Buffer, str, str]] = []
        made = []
        for name, attribute in attributes_of(program).items():
            if attribute in drawable.streams:
                content.append((*drawable.streams[attribute], name))
            else:
                value = drawable.constants[attribute][: SIZES[attribute]]
                made.append(self._ctx.buffer(np.array(value, np.float32).tobytes()))
                content.append((made[-1], f"{len(value)}f /r", name))
        vertices = self._ctx.vertex_array(program, content, drawable.indices.buffer)
        vertices.render(drawable.mode, drawable.count)
        vertices.release()
        for buffer in made:
            buffer.release()

    def draw_layer(self, layer: Recorded, camera: Camera, unit: float) -> None:
        """A layer of a figure: triangles by the built-in program, lines and points as strokes."""
        modelview, projection = np.eye(4), camera.clip_from_model()
        modelview[:3, :3] = camera.rotation  # lights stand in eye coordinates
        projection[:, :3] = projection[:, :3] @ camera.rotation.T
        texture = None
        if layer.picture is not None:
            texture = self._painter.surfaces.pictures.use(layer.picture, TEXTURE_UNIT)
        matrices = (projection, modelview)
        modes = (moderngl.TRIANGLES,)
        self.draw_built_in(layer.recording, *matrices, layer.light, texture, modes)
        for item in layer.recording.batches:
            if isinstance(item, Batch):
                self._stroke_batch(item, layer, camera, unit)
            else:
                self._stroke_collection(item, layer, camera, unit)

    def _stroke_batch(self, batch: Batch, layer: Recorded, camera: Camera, unit: float) -> None:
        if batch.primitive == GL_TRIANGLES:
            return
        feed = batch.feeds["vertex"]

        def make() -> tuple[moderngl.Buffer, Array]:
            order, links = chained(_as_segments(batch.indices))
            patches = range(len(batch.meshes))
            points = self._painter.evaluation.run(feed.net, feed.pairs[order], patches)
            return points, np.tile(links, len(patches))

        key = (feed.net, (batch.first.grid, batch.first.mode))
        self._stroke(key, make, layer, camera, unit, batch.primitive, batch.first.current.color)

    def _stroke_collection(
        self, collection: Collection, layer: Recorded, camera: Camera, unit: float
    ) -> None:
        primitive, indices = primitive_indices(collection.mode, len(collection.dimensions))
        if primitive == GL_TRIANGLES:
            return

        def make() -> tuple[moderngl.Buffer, Array]:
            order, links = chained(_as_segments(indices))
            vertices = read_collection(self._painter, collection, "vertex").vertices[order]
            return self._ctx.buffer(vertices.astype(np.float32).tobytes()), links

        color = collection.given["color"][0]
        self._stroke((collection.parameters, None), make, layer, camera, unit, primitive, color)

    def _stroke(
        self,
        key: tuple[Array, Hashable],
        make: Callable[[], tuple[moderngl.Buffer, Array]],
        layer: Recorded,
        camera: Camera,
        unit: float,
        primitive: int,
        color: ArrayLike,
    ) -> None:
        """A point is a line without length. Lines that cross hide nothing of each other."""
        width = 2.0 * layer.radius if primitive == GL_POINTS else layer.width
        red, green, blue, _ = np.asarray(color, np.float64).tolist()
        self._ctx.fbo.depth_mask = False
        try:
            self._painter.strokes.draw_lines(key, make, (camera, unit, (red, green, blue), width))
        finally:
            self._ctx.fbo.depth_mask = True

    def _drawables(self, recording: Recording) -> list[Drawable]:
        """What was evaluated for a recording, kept as long as it is."""
        if recording not in self._kept:
            with self._ctx.scope(self._painter.nowhere, moderngl.NOTHING):
                made = [self._upload(item) for item in recording.batches]
            self._kept[recording] = made
            weakref.finalize(recording, self._dead.append, made).atexit = False
            self._painter.evaluation.sweep()
        for dead in self._dead:
            _release(dead)
        self._dead.clear()
        for buffer in self._lost:
            buffer.release()
        self._lost.clear()
        return self._kept[recording]

    def _upload(self, item: Batch | Collection) -> Drawable:
        return self._evaluate(item) if isinstance(item, Batch) else self._compose(item)

    def _evaluate(self, batch: Batch) -> Drawable:
        """All maps of all meshes, each into a buffer of its own that never leaves the GPU."""
        evaluation, grid, patches = self._painter.evaluation, batch.first.grid, len(batch.meshes)
        auto = batch.first.maps.auto_normal
        row = evaluation.strip_row(grid.shape[1], patches, grid.shape[0], auto)
        owned: list[moderngl.Buffer] = []
        streams: dict[Attribute, tuple[moderngl.Buffer, str]] = {}
        for attribute, feed in batch.feeds.items():
            normals = auto and attribute == "vertex"
            where = grid_pairs(grid, feed.domain, row)
            shape = (grid.shape[0], row)
            buffer = evaluation.run_grid(feed.net, where, shape, range(patches), normals=normals)
            owned.append(buffer)
            streams[attribute] = (buffer, layout(attribute, feed.components, normals))
            if normals:
                streams["normal"] = (buffer, "16x 3f")
        current = batch.first.current
        return Drawable(
            streams,
            {a: current.value(a) for a in HAVE_CURRENT if a not in streams},
            self._mesh_indices(batch, row),
            MODES[batch.indices.shape[1]],
            patches * batch.indices.size,
            "texcoord" in batch.feeds and batch.feeds["texcoord"].components == 4,
            tuple(owned),
        )

    def _mesh_indices(self, batch: Batch, row: int) -> Shared:
        grid, copies = batch.first.grid, 1 << (len(batch.meshes) - 1).bit_length()
        key = (grid.shape, batch.first.mode, grid.turned, row, copies)
        found = self._indices.get(key)
        if found is None:
            first = np.arange(copies, dtype=np.int32)[:, None, None] * (grid.shape[0] * row)
            found = self._shared(
                first + mesh_indices(grid.shape, batch.first.mode, grid.turned, row)
            )
            self._indices[key] = found
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
        return Drawable(streams, {}, indices, mode, count, projective, (buffer,))


def _as_segments(indices: Indices) -> Indices:
    """Points as segments without length."""
    return indices.repeat(2, 1) if indices.shape[1] == 1 else indices


def layout(attribute: Attribute, components: int, normals: bool) -> str:
    """The format of a captured vertex: the map's components, for what it lacks OpenGL fills in
    (0, 0, 0, 1) by itself."""
    size = min(components, SIZES[attribute])
    skipped = 16 - 4 * size + (12 if normals else 0)
    return f"{size}f {skipped}x" if skipped else f"{size}f"


def attributes_of(program: moderngl.Program) -> dict[str, Attribute]:
    """What feeds each vertex attribute of a program. Raises InvalidOperation for other names."""
    found = {}
    for name in program:
        if isinstance(program[name], moderngl.Attribute):
            plain = name.removeprefix("in_")
            if plain not in ATTRIBUTES:
                raise InvalidOperation(
                    f"program: attribute {name}: expected position, normal, color, texcoord or "
                    "index (or in_position ...)"
                )
            found[name] = ATTRIBUTES[plain]
    return found


def look_of(drawable: Drawable, light: Light | None, textured: bool) -> dict[str, int]:
    """What recorded.vert and recorded.frag are to be able to do."""
    wanted = {
        "COLORED": "color" in drawable.streams,
        "LIT": light is not None,
        "POSITIONAL": light is not None and light.position[3] != 0.0,
        "SHINY": light is not None and any(np.multiply(light.specular, light.material_specular)),
        "TEXTURED": textured,
        "PROJECTIVE": textured and drawable.projective,
    }
    return {name: 1 for name, on in wanted.items() if on}


def _set_light(program: Program, light: Light) -> None:
    program.set(
        light_position=light.position,
        light_ambient=tuple(np.add(light.ambient, light.model_ambient)),
        light_diffuse=light.diffuse,
        material_ambient=light.material_ambient,
        material_diffuse=light.material_diffuse,
        color_material=light.color_material,
    )
    if "SHINY" in program.defines:
        specular = tuple(np.multiply(light.specular, light.material_specular))
        program.set(specular=specular, shininess=light.shininess)


def _column_major(matrix: Array) -> bytes:
    return matrix.T.astype(np.float32).tobytes()


def _release(drawables: Iterable[Drawable]) -> None:
    for drawable in drawables:
        drawable.release()
