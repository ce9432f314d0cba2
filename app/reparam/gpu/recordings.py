"""What the evaluators recorded: evaluated, then drawn or handed back."""

from __future__ import annotations

import weakref
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..evaluators.errors import InvalidOperation
from ..evaluators.grids import Indices, grid_points, pairs, primitive_indices
from ..evaluators.light import Light
from ..evaluators.maps import FILL, Array, Attribute
from ..evaluators.recording import HAVE_CURRENT, Batch, Collection, Evaluated, Recording
from .painter import Painter
from .programs import Program
from .readback import read_at

Single = NDArray[np.float32]
Content = tuple[moderngl.Buffer, str, Attribute]

TEXTURE_UNIT = 0
MODES = {1: moderngl.POINTS, 2: moderngl.LINES, 3: moderngl.TRIANGLES}
SIZES: dict[Attribute, int] = {"vertex": 4, "normal": 3, "color": 4, "texcoord": 4, "index": 1}
ATTRIBUTES: dict[str, Attribute] = {  # names in a user's program; `in_` may stand before them
    "position": "vertex", "vert": "vertex",
    "normal": "normal", "norm": "normal",
    "color": "color",
    "texcoord": "texcoord", "texcoord_0": "texcoord", "text": "texcoord",
    "index": "index",
}  # fmt: skip


@dataclass(frozen=True)
class Drawable:
    """A batch or a collection on the GPU: each attribute's buffer, its format and its number of
    floats, and the primitives."""

    streams: dict[Attribute, tuple[moderngl.Buffer, str]]
    indices: moderngl.Buffer
    mode: int
    count: int
    owned: tuple[moderngl.Buffer, ...]

    def release(self) -> None:
        """Give the memory back."""
        for buffer in self.owned:
            buffer.release()


class Recordings:
    """Reads recordings back and draws them, in the context of a painter."""

    def __init__(self, painter: Painter) -> None:
        self._painter = painter
        self._ctx = painter.ctx
        self._kept: weakref.WeakKeyDictionary[Recording, list[Drawable]]
        self._kept = weakref.WeakKeyDictionary()
        self._dead: list[list[Drawable]] = []  # of recordings that are no more
        self._indices: dict[object, moderngl.Buffer] = {}

    # Reading back ----------------------------------------------------------------------------

    def read(self, recording: Recording, evaluator: str | None = None) -> list[Evaluated]:
        """What each glEvalMesh and each glBegin ... glEnd made, in their order.

        `evaluator` is "vertex", the default, or "tessellation". Raises GraphicsError if the
        context has not that one.
        """
        found: list[Evaluated] = []
        for item in recording.batches:
            if isinstance(item, Batch):
                found.extend(self._read_batch(item, evaluator or "vertex"))
            else:
                found.append(self._read_collection(item, evaluator or "vertex"))
        self._painter.evaluation.sweep()
        return found

    def _read_batch(self, batch: Batch, evaluator: str) -> Iterator[Evaluated]:
        parameters = grid_points(batch.first.grid)
        arrays: dict[Attribute, Single] = {
            attribute: np.broadcast_to(
                np.array(batch.first.current.value(attribute)[: SIZES[attribute]], np.float32),
                (len(batch.meshes), len(parameters), SIZES[attribute]),
            )
            for attribute in HAVE_CURRENT
        }
        for attribute, feed in batch.feeds.items():
            normals = attribute == "vertex" and batch.first.maps.auto_normal
            read = read_at(self._painter, evaluator, feed.net, feed.pairs, normals)
            shape = (len(batch.meshes), *read.points.shape[1:])
            arrays[attribute] = np.broadcast_to(
                exact(read.points, feed.components, attribute), shape
            )[..., : SIZES[attribute]]
            if normals:
                arrays["normal"] = np.broadcast_to(read.normals, (*shape[:-1], 3))
        for i in range(len(batch.meshes)):
            yield evaluated({a: array[i] for a, array in arrays.items()}, parameters, batch.indices)

    def _read_collection(self, collection: Collection, evaluator: str) -> Evaluated:
        arrays: dict[Attribute, Single] = {
            attribute: value[:, : SIZES[attribute]].astype(np.float32)
            for attribute, value in collection.given.items()
        }
        for dimension, maps in collection.maps.items():
            which = collection.dimensions == dimension
            for attribute, feed in maps.by_attribute.items():
                where = pairs(collection.parameters[which], feed.rising)
                normals = attribute == "vertex" and maps.auto_normal
                read = read_at(self._painter, evaluator, feed.net, where, normals)
                points = exact(read.points[0], feed.target.components, attribute)
                arrays[attribute][which] = points[:, : SIZES[attribute]]
                if normals:
                    arrays["normal"][which] = read.normals[0]
        _, indices = primitive_indices(collection.mode, len(collection.dimensions))
        return evaluated(arrays, collection.parameters, indices)

    # Drawing ---------------------------------------------------------------------------------

    def draw(self, recording: Recording, program: moderngl.Program) -> None:
        """Draw into the current framebuffer with a program whose vertex attributes are called
        position, normal, color, texcoord, index (or in_position ...), those that it wants.

        What was evaluated is kept as long as the recording is. Raises InvalidOperation for a
        program with other attributes.
        """
        names = attributes_of(program)
        for dead in self._dead:
            _release(dead)
        self._dead.clear()
        if recording not in self._kept:
            self._kept[recording] = made = [self._upload(item) for item in recording.batches]
            weakref.finalize(recording, self._dead.append, made).atexit = False
            self._painter.evaluation.sweep()
        for drawable in self._kept[recording]:
            content = [(*drawable.streams[attribute], name) for name, attribute in names.items()]
            vertices = self._ctx.vertex_array(program, content, drawable.indices)
            vertices.render(drawable.mode, drawable.count)
            vertices.release()

    def draw_built_in(
        self,
        recording: Recording,
        projection: Array,
        modelview: Array,
        light: Light | None,
        texture: moderngl.Texture | None,
    ) -> None:
        """The same with recorded.vert and recorded.frag, in the place of fixed function.

        The matrices (4, 4) are for column vectors. A texture is bound to unit 0.
        """
        defines = ({"LIT": 1} if light else {}) | ({"TEXTURED": 1} if texture else {})
        program = self._painter.programs.get("recorded.vert", "recorded.frag", defines=defines)
        program.set(projection=_column_major(projection), modelview=_column_major(modelview))
        if light is not None:
            inverse = np.asarray(np.linalg.pinv(modelview[:3, :3]), np.float64)
            program.set(normal_matrix=_column_major(inverse.T))
            _set_light(program, light)
        if texture is not None:
            texture.use(TEXTURE_UNIT)
            program.set(image=TEXTURE_UNIT)
        self.draw(recording, program.ready())

    def _upload(self, item: Batch | Collection) -> Drawable:
        return self._evaluate(item) if isinstance(item, Batch) else self._compose(item)

    def _evaluate(self, batch: Batch) -> Drawable:
        """All maps of all meshes, each into a buffer of its own that never leaves the GPU."""
        patches = range(len(batch.meshes))
        owned: list[moderngl.Buffer] = []
        streams: dict[Attribute, tuple[moderngl.Buffer, str]] = {}
        for attribute, feed in batch.feeds.items():
            normals = attribute == "vertex" and batch.first.maps.auto_normal
            buffer = self._painter.evaluation.run(feed.net, feed.pairs, patches, normals=normals)
            owned.append(buffer)
            streams[attribute] = (buffer, layout(attribute, feed.components, normals))
            if normals:
                streams["normal"] = (buffer, "16x 3f")
        for attribute in HAVE_CURRENT:
            if attribute not in streams:
                value = np.array(batch.first.current.value(attribute), np.float32)
                constant = self._ctx.buffer(value.tobytes())
                owned.append(constant)
                size = SIZES[attribute]
                streams[attribute] = (constant, f"{size}f {16 - 4 * size}x/r".replace(" 0x", ""))
        indices = self._mesh_indices(batch)
        count = len(batch.meshes) * batch.indices.size
        return Drawable(streams, indices, MODES[batch.indices.shape[1]], count, tuple(owned))

    def _mesh_indices(self, batch: Batch) -> moderngl.Buffer:
        grid, copies = batch.first.grid, 1 << (len(batch.meshes) - 1).bit_length()
        key = (grid.shape, batch.first.mode, grid.turned, copies)
        if key not in self._indices:
            vertices = grid.shape[0] * grid.shape[1]
            first = np.arange(copies, dtype=np.int32)[:, None, None] * vertices
            self._indices[key] = self._ctx.buffer((first + batch.indices).tobytes())
        return self._indices[key]

    def _compose(self, collection: Collection) -> Drawable:
        """Evaluated and plain vertices in one buffer."""
        found = self._read_collection(collection, "vertex")
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
        indices = self._ctx.buffer(found.primitives.astype(np.int32).tobytes())
        mode = MODES[found.primitives.shape[1]]
        return Drawable(streams, indices, mode, found.primitives.size, (buffer, indices))


def exact(points: Single, components: int, attribute: Attribute) -> Single:
    """Points (..., 4) with the components that the map lacks exactly as OpenGL has them."""
    filled = points.copy()
    filled[..., components:] = FILL[attribute][components:]
    return filled


def layout(attribute: Attribute, components: int, normals: bool) -> str:
    """The format of a captured vertex: the map's components, for what it lacks OpenGL fills in
    (0, 0, 0, 1) by itself."""
    size = min(components, SIZES[attribute])
    skipped = 16 - 4 * size + (12 if normals else 0)
    return f"{size}f {skipped}x" if skipped else f"{size}f"


def evaluated(arrays: dict[Attribute, Single], parameters: Array, indices: Indices) -> Evaluated:
    """All arrays of one mesh together."""
    return Evaluated(
        arrays["vertex"],
        arrays["normal"],
        arrays["color"],
        arrays["texcoord"],
        arrays["index"][:, 0],
        parameters,
        indices,
    )


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


def _set_light(program: Program, light: Light) -> None:
    program.set(
        light_position=light.position,
        light_ambient=tuple(np.add(light.ambient, light.model_ambient)),
        light_diffuse=light.diffuse,
        specular=tuple(np.multiply(light.specular, light.material_specular)),
        material_ambient=light.material_ambient,
        material_diffuse=light.material_diffuse,
        shininess=light.shininess,
        color_material=light.color_material,
    )


def _column_major(matrix: Array) -> bytes:
    return matrix.T.astype(np.float32).tobytes()


def _release(drawables: Iterable[Drawable]) -> None:
    for drawable in drawables:
        drawable.release()
