"""What the evaluators recorded: evaluated, then drawn as often as one likes."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import TYPE_CHECKING, Any

import moderngl
import numpy as np
from numpy.typing import ArrayLike

from ..evaluators.constants import GL_POINTS, GL_TRIANGLES
from ..evaluators.errors import InvalidOperation
from ..evaluators.grids import Indices, chained, primitive_indices
from ..evaluators.light import Light
from ..evaluators.maps import Array, Attribute
from ..evaluators.recording import Batch, Collection, Recording
from ..geometry.camera import Camera
from ..scenes.layers import Recorded
from .drawables import Drawable, Drawables, Spot
from .evaluated import SIZES, read_collection
from .programs import Program
from .trims import Edges, trim_defines

if TYPE_CHECKING:
    from .painter import Painter

TEXTURE_UNIT = 0
SPOT_ATTRIBUTES = ("parameters", "control")  # of recorded.vert, where it evaluates
TRIM_ATTRIBUTE = "trim_place"  # and where it is trimmed
TRIM_UNIT = 1
ATTRIBUTES: dict[str, Attribute] = {  # names in a user's program; `in_` may stand before them
    "position": "vertex", "vert": "vertex",
    "normal": "normal", "norm": "normal",
    "color": "color",
    "texcoord": "texcoord", "texcoord_0": "texcoord", "text": "texcoord",
    "index": "index",
}  # fmt: skip


class Recordings:
    """Draws recordings, in the context of a painter."""

    def __init__(self, painter: Painter) -> None:
        self._painter = painter
        self._ctx = painter.ctx
        self.drawables = Drawables(painter)

    def draw(self, recording: Recording, program: moderngl.Program) -> None:
        """Draw into the current framebuffer with a program whose vertex attributes are called
        position, normal, color, texcoord, index (or in_position ...), those that it wants.

        What was evaluated is kept as long as the recording is. Raises InvalidOperation for a
        program with other attributes.
        """
        for drawable in self.drawables.of(recording, on_the_spot=False):
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
        for drawable in self.drawables.of(recording, on_the_spot=True):
            if modes is not None and drawable.mode not in modes:
                continue
            defines = look_of(drawable, light, texture is not None)
            if drawable.trimming is not None:
                edges: Edges = "samples" if self._ctx.fbo.samples > 1 else "pixels"
                defines |= trim_defines(drawable.trimming.region, edges)
            program = self._painter.programs.get("recorded.vert", "recorded.frag", defines=defines)
            program.set(projection=_column_major(projection), modelview=_column_major(modelview))
            if "COLORED" not in defines:
                program.set(vertex_color=drawable.constants["color"])
            if light is not None:
                program.set(normal_matrix=_column_major(_inverse(modelview[:3, :3]).T))
                _set_light(program, light)
            if texture is not None:
                program.set(image=TEXTURE_UNIT)
            if drawable.trimming is not None:
                region = drawable.trimming.region
                self._painter.surfaces.trims.bind_region(program, region, TRIM_UNIT)
            self._render(drawable, program.ready())

    def _render(self, drawable: Drawable, program: moderngl.Program) -> None:
        content: list[tuple[moderngl.Buffer, str, str]] = []
        made = []
        own: tuple[str, ...] = ()
        if drawable.spot is not None:
            own, content = SPOT_ATTRIBUTES, self._on_the_spot(drawable.spot, program)
        if drawable.trimming is not None:
            own = (*own, TRIM_ATTRIBUTE)
            content.append((*drawable.trimming.places, TRIM_ATTRIBUTE))
        for name, attribute in attributes_of(program, own).items():
            if attribute in drawable.streams:
                content.append((*drawable.streams[attribute], name))
            else:
                value = drawable.constants[attribute][: SIZES[attribute]]
                made.append(self._ctx.buffer(np.array(value, np.float32).tobytes()))
                content.append((made[-1], f"{len(value)}f /r", name))
        vertices = self._ctx.vertex_array(program, content, drawable.indices.buffer)
        vertices.render(drawable.mode, drawable.count, instances=drawable.instances)
        vertices.release()
        for buffer in made:
            buffer.release()

    def _on_the_spot(
        self, spot: Spot, program: moderngl.Program
    ) -> list[tuple[moderngl.Buffer, str, str]]:
        """What the program's evaluator needs."""
        parameters = self._painter.evaluation.parameters(spot.parameters)
        content = [(spot.carried.buffer, spot.carried.layout, "control")]
        if "parameters" in program:  # a constant map needs none
            content.append((parameters, "4f", "parameters"))
        return content

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
        for item in layer.recording.drawn:
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


def _as_segments(indices: Indices) -> Indices:
    """Points as segments without length."""
    return indices.repeat(2, 1) if indices.shape[1] == 1 else indices


def attributes_of(program: moderngl.Program, own: Sequence[str] = ()) -> dict[str, Attribute]:
    """What feeds each vertex attribute of a program, but for the evaluator's own. Raises
    InvalidOperation for other names."""
    found = {}
    for name in program:
        if isinstance(program[name], moderngl.Attribute) and name not in own:
            plain = name.removeprefix("in_")
            if plain not in ATTRIBUTES:
                raise InvalidOperation(
                    f"program: attribute {name}: expected position, normal, color, texcoord or "
                    "index (or in_position ...)"
                )
            found[name] = ATTRIBUTES[plain]
    return found


def look_of(drawable: Drawable, light: Light | None, textured: bool) -> dict[str, Any]:
    """What recorded.vert and recorded.frag are to be able to do."""
    wanted = {
        "COLORED": "color" in drawable.streams,
        "LIT": light is not None,
        "COLOR_MATERIAL": light is not None and light.color_material,
        "ONE_SIDED": light is not None and not light.two_sided,
        "POSITIONAL": light is not None and light.position[3] != 0.0,
        "SHINY": light is not None and any(np.multiply(light.specular, light.material_specular)),
        "TEXTURED": textured,
        "PROJECTIVE": textured and drawable.projective,
    }
    found = {name: 1 for name, on in wanted.items() if on}
    return found | (drawable.spot.defines if drawable.spot is not None else {})


def _set_light(program: Program, light: Light) -> None:
    """Products that are the same for all fragments are made here."""
    position = np.array(light.position)
    if position[3] == 0.0:
        position[:3] /= np.linalg.norm(position[:3]) or 1.0
    ambient, diffuse = np.add(light.ambient, light.model_ambient), np.array(light.diffuse)
    if not light.color_material:
        ambient, diffuse = ambient * light.material_ambient, diffuse * light.material_diffuse
    program.set(light_position=tuple(position), ambient=tuple(ambient), diffuse=tuple(diffuse))
    if "SHINY" in program.defines:
        specular = tuple(np.multiply(light.specular, light.material_specular))
        program.set(specular=specular, shininess=light.shininess)


def _inverse(matrix: Array) -> Array:
    """The inverse, or where there is none what is like it: normals must not be NaN."""
    try:
        return np.asarray(np.linalg.inv(matrix))  # in a twentieth of the time
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrix), np.float64)


def _column_major(matrix: Array) -> bytes:
    return matrix.T.astype(np.float32).tobytes()
