"""How far off drawn points are: each fragment says where on which patch it lies (located.frag)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.bernstein import bernstein, bernstein_derivative
from ..geometry.camera import Camera
from ..geometry.net import Array
from ..geometry.silhouette import distances, outline
from ..scenes.layers import Patches
from .context import bound
from .evaluation import patch_count
from .painter import Painter
from .plans import Plan, SetCommon
from .programs import Program
from .targets import check_size

CHUNK = 1 << 20  # control points gathered at a time
REGULAR = 1e-9  # a map's least sine between its tangents where it can be told how far it is off
FINER, FINEST_SIDE = 8, 4096  # pixels in one, to find the drawn outline; of its picture at most
TIPS = 1e-3  # share of the exact curves

Floats = NDArray[np.float32]
Ints = NDArray[np.int64]


class Measurable(ABC):
    """Patches drawn alone in a view of so many pixels."""

    painter: Painter
    camera: Camera
    size: tuple[int, int]

    @property
    @abstractmethod
    def nets(self) -> Array:
        """Their nets, (patches, m, n, 4)."""

    @property
    @abstractmethod
    def steps(self) -> Ints:
        """In how many steps each is drawn, the larger way, (patches,); 0 for one out of view."""

    @abstractmethod
    def draw(self, fragment: str, defines: Mapping[str, int | str], set_common: SetCommon) -> None:
        """Draw with a fragment shader and the uniforms that `set_common` gives it."""


@dataclass(frozen=True)
class Drawn(Measurable):
    """A layer drawn as planned."""

    painter: Painter
    layer: Patches
    camera: Camera
    evaluator: str
    plan: Plan
    size: tuple[int, int]

    @property
    def nets(self) -> Array:
        """The layer's."""
        return self.layer.net if self.layer.net.ndim == 4 else self.layer.net[None]

    @property
    def steps(self) -> Ints:
        """As planned."""
        steps = np.zeros(patch_count(self.layer.net), np.int64)
        steps[self.plan.patches] = self.plan.inner.max(-1)
        return steps

    def draw(self, fragment: str, defines: Mapping[str, int | str], set_common: SetCommon) -> None:
        """By its evaluator."""
        self.painter.surfaces.adaptive.draw(
            self.layer, self.evaluator, self.plan, fragment, defines, set_common
        )


def deviations(drawn: Measurable) -> Array:
    """For each fragment: pixels (k,) between its centre and the float64 surface point of its own
    patch and (u, v), projected."""
    places, _ = located(drawn)
    rows, columns = np.nonzero(places[..., 3] == 1.0)
    points, _ = _points_and_slopes(pixel_nets(drawn), places[rows, columns])
    return np.asarray(np.linalg.norm(points - _centers(rows, columns), axis=-1))


def picture_deviations(drawn: Drawn) -> Array:
    """For each fragment: pixels (k,) between its centre and where, to first order, the float64
    surface shows what the fragment shows of its picture, looked up by a map of its own.

    A fragment at x whose surface point is S and whose map is t, where its exact map would be T,
    shows what belongs at  S - S' T'^-1 (T - t).  Left out where T' is singular.
    """
    texture = drawn.layer.texture
    assert texture is not None
    places, maps = located(drawn, textured=True)
    rows, columns = np.nonzero(places[..., 3] == 1.0)
    place = places[rows, columns]
    points, slopes = _points_and_slopes(pixel_nets(drawn), place)
    nets = texture.net if texture.net.ndim == 4 else texture.net[None]
    own = place if len(nets) > 1 else place * np.array([0.0, 1.0, 1.0, 1.0], np.float32)
    sought, map_slopes = _points_and_slopes(nets[..., [0, 1, 3]], own)
    (a, b), (c, d) = np.moveaxis(map_slopes, 0, -1)
    determinant = a * d - b * c
    regular = np.abs(determinant) > REGULAR * (a * a + b * b + c * c + d * d)
    safe = np.where(regular, determinant, 1.0)
    miss = sought - maps[rows, columns, :2]
    in_u, in_v = (d * miss[:, 0] - b * miss[:, 1]) / safe, (a * miss[:, 1] - c * miss[:, 0]) / safe
    shown = points - slopes[..., 0] * in_u[:, None] - slopes[..., 1] * in_v[:, None]
    return np.asarray(np.linalg.norm(shown - _centers(rows, columns), axis=-1)[regular])


def silhouette(drawn: Measurable) -> float:
    """Pixels between the drawn outline and the exact one, whichever way is longer:

    from where drawing and ground meet, on a grid of eighths of a pixel, to the nearest curve on
    which the exact outline may lie (geometry/silhouette.py); and from where such a curve leaves the
    drawing, to it, but for the TIPS that are thinner than the grid. 0 if nothing is seen.
    """
    size = drawn.size
    times = int(np.clip(FINEST_SIDE // max(size), 1, FINER))
    mask = covered(drawn, (size[0] * times, size[1] * times))
    # One such eighth alone is no outline: softpipe, whose edges are floats, leaves some out.
    mask[1:-1, 1:-1] |= mask[:-2, 1:-1] & mask[2:, 1:-1] & mask[1:-1, :-2] & mask[1:-1, 2:]
    across, up = np.nonzero(mask[:, 1:] != mask[:, :-1]), np.nonzero(mask[1:] != mask[:-1])
    rim = np.concatenate(
        [
            np.stack([across[1] + 1.0, across[0] + 0.5], -1),
            np.stack([up[1] + 0.5, up[0] + 1.0], -1),
        ]
    )
    exact = outline(drawn.nets, pixel_nets(drawn), 4 * drawn.steps)
    ends = exact.reshape(-1, 2)
    ends = ends[((ends > 0.0) & (ends < np.array(size))).all(-1)]
    if not len(rim) or not len(ends):
        return 0.0
    rim /= times
    column, row = (ends * times).astype(int).T
    left = np.zeros(len(ends))
    outside = ~mask[row, column]
    left[outside] = distances(ends[outside], np.stack([rim, rim], 1))
    return float(max(distances(rim, exact).max(), np.quantile(left, 1.0 - TIPS)))


def located(drawn: Measurable, textured: bool = False) -> tuple[Floats, Floats]:
    """(patch, u, v, 1) of each fragment, 0 at the end where there is none: (height, width, 4),
    bottom row first; and, if asked for, (s, t, ...) of its map."""
    ctx, size = drawn.painter.ctx, drawn.size
    check_size(*size, drawn.painter.capabilities)
    images = [ctx.texture(size, 4, dtype="f4") for _ in range(1 + textured)]
    depth = ctx.depth_renderbuffer(size)
    framebuffer = ctx.framebuffer(images, depth)
    with bound(ctx, framebuffer, moderngl.DEPTH_TEST):
        framebuffer.clear(-1.0, 0.0, 0.0, 0.0, depth=1.0)
        defines = {"LOCATED": 1} | ({"TEXTURED": 1} if textured else {})
        _draw(drawn, "located.frag", defines)
        read = [
            np.frombuffer(image.read(), np.float32).reshape(size[1], size[0], 4) for image in images
        ]
    framebuffer.release()
    depth.release()
    for image in images:
        image.release()
    return read[0], read[-1]


def covered(drawn: Measurable, size: tuple[int, int]) -> NDArray[np.bool_]:
    """Which pixels of a picture of another size the same triangles cover: (height, width)."""
    ctx = drawn.painter.ctx
    check_size(*size, drawn.painter.capabilities)
    image = ctx.renderbuffer(size, 1)
    framebuffer = ctx.framebuffer([image])
    with bound(ctx, framebuffer):
        framebuffer.clear()
        _draw(drawn, "patch.frag", {})
        read = np.frombuffer(framebuffer.read(components=1, alignment=1), np.uint8)
    framebuffer.release()
    image.release()
    return np.asarray(read.reshape(size[1], size[0]) > 0)


def _draw(drawn: Measurable, fragment: str, defines: dict[str, int]) -> None:
    matrix = drawn.camera.clip_from_model().T.astype(np.float32).tobytes()

    def set_common(program: Program) -> None:
        program.set(clip_from_model=matrix)
        if fragment == "patch.frag":
            program.set(color=(1.0, 1.0, 1.0, 1.0))
        if "TEXTURED" in program.defines:
            program.set(image_from_map=(1.0, 1.0, 0.0, 0.0))

    drawn.draw(fragment, defines, set_common)


def pixel_nets(drawn: Measurable) -> Array:
    """The patches as they are seen, in homogeneous pixels (x w, y w, w): (patches, m, n, 3)."""
    clip = drawn.nets @ drawn.camera.clip_from_model().T
    seen = (clip[..., :2] + clip[..., 3:]) / 2.0 * np.array(drawn.size)
    return np.concatenate([seen, clip[..., 3:]], -1)


def surface_points(drawn: Measurable, places: Floats) -> Array:
    """Pixels (k, 2) of exact surface points at places (k, 4), each (patch, u, v, ...)."""
    return _points_and_slopes(pixel_nets(drawn), places)[0]


def _points_and_slopes(nets: Array, places: Floats) -> tuple[Array, Array]:
    """Points (k, 2) of patches (P, m, n, 3), homogeneous in the plane, and their derivatives
    (k, 2, 2), the last axis being d/du, d/dv, at places (k, 4)."""
    degree_u, degree_v = nets.shape[1] - 1, nets.shape[2] - 1
    points, slopes = np.empty((len(places), 2)), np.empty((len(places), 2, 2))
    step = max(1, CHUNK // (nets.shape[1] * nets.shape[2]))
    for first in range(0, len(places), step):
        chunk = slice(first, first + step)
        u, v = places[chunk, 1].astype(np.float64), places[chunk, 2].astype(np.float64)
        row, column = bernstein(degree_u, u), bernstein(degree_v, v)
        own = nets[places[chunk, 0].astype(int)]
        curve = np.einsum("kj,kijc->kic", column, own, optimize=True)
        slope = np.einsum("kj,kijc->kic", bernstein_derivative(degree_v, v), own, optimize=True)
        point = np.einsum("ki,kic->kc", row, curve)
        along_u = np.einsum("ki,kic->kc", bernstein_derivative(degree_u, u), curve)
        along_v = np.einsum("ki,kic->kc", row, slope)
        weight = point[:, 2:]
        points[chunk] = point[:, :2] / weight
        for axis, along in enumerate((along_u, along_v)):
            slopes[chunk, :, axis] = (along[:, :2] - along[:, 2:] * points[chunk]) / weight
    return points, slopes


def _centers(rows: NDArray[np.intp], columns: NDArray[np.intp]) -> Array:
    return np.asarray(np.stack([columns, rows], -1) + 0.5)
