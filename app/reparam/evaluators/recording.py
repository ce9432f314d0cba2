"""What evaluator calls leave behind: meshes and collections, plain data that gpu/ evaluates."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from .arguments import Quad
from .grids import CORNERS, DRAWN_AS, Grid, Indices, grid_pairs, mesh_indices
from .maps import FILL, Array, Attribute, Map, homogeneous

if TYPE_CHECKING:
    from ..geometry.trimming import TrimRegion

Single = NDArray[np.float32]
HAVE_CURRENT: tuple[Attribute, ...] = ("normal", "color", "texcoord", "index")


@dataclass(frozen=True)
class Current:
    """OpenGL's current values: what a vertex has where no map feeds it."""

    normal: Quad = FILL["normal"]
    color: Quad = FILL["color"]
    texcoord: Quad = FILL["texcoord"]
    index: Quad = FILL["index"]

    def value(self, attribute: Attribute) -> Quad:
        """The four numbers of one of HAVE_CURRENT."""
        found: Quad = getattr(self, attribute)
        return found


@dataclass(eq=False)  # as Map and Mesh: thousands are made
class Maps:
    """The maps of one dimension that were enabled, at most one for each attribute."""

    feeds: tuple[Map, ...]
    auto_normal: bool = False

    @cached_property
    def by_attribute(self) -> dict[Attribute, Map]:
        """The maps by what they feed."""
        return {feed.target.attribute: feed for feed in self.feeds}

    @property
    def makes_vertices(self) -> bool:
        """Whether there is a vertex map. It stands first."""
        return bool(self.feeds) and self.feeds[0].target.attribute == "vertex"

    @property
    def shape(self) -> object:
        """Meshes whose maps have equal shapes can be evaluated in one go."""
        return self.auto_normal, *[feed.shape for feed in self.feeds]


@dataclass(frozen=True, eq=False)
class Trim:
    """A region that decides, pixel by pixel, what stays of a mesh or collection; `low` and `high`
    (2,): where its parameters [0,1]^2 begin and end in the region's unit square."""

    region: TrimRegion
    low: Array
    high: Array


@dataclass(eq=False)
class Mesh:
    """One glEvalMesh."""

    maps: Maps
    grid: Grid
    mode: int  # GL_POINT, GL_LINE or GL_FILL
    current: Current
    trim: Trim | None = None

    @property
    def shape(self) -> object:
        """Meshes of equal shape, recorded one after another, are one draw."""
        region = None if self.trim is None else self.trim.region
        return self.maps.shape, self.grid, self.mode, self.current, region


@dataclass(frozen=True, eq=False)
class Collection:
    """What stood between glBegin and glEnd, vertex by vertex.

    `dimensions` (k,) says how each came about: 0 by glVertex, 1 or 2 by glEvalCoord1 or 2 (or
    glEvalPoint) at `parameters` (k, 2), with the maps of that dimension. `given` has the position
    that glVertex gave, and the current values of each vertex: (k, 4) each.
    """

    shape: ClassVar[None] = None  # each is a draw of its own

    mode: int  # GL_POINTS ... GL_POLYGON
    maps: dict[int, Maps]
    dimensions: NDArray[np.int8]
    parameters: Array
    given: dict[Attribute, Array]
    trim: Trim | None = None


@dataclass(frozen=True, eq=False)
class Feed:
    """One attribute's maps in a batch: a net (m, n, 4) for all, or (patches, m, n, 4)."""

    net: Array
    grid: Grid
    domain: Quad
    components: int

    @property
    def pairs(self) -> Array:
        """Where it is evaluated, in its own domain: (k, 4)."""
        return grid_pairs(self.grid, self.domain)


@dataclass(frozen=True, eq=False)
class Batch:
    """Meshes of one shape, evaluated and drawn together."""

    meshes: tuple[Mesh, ...]

    @property
    def first(self) -> Mesh:
        """What holds for all but the nets."""
        return self.meshes[0]

    @cached_property
    def feeds(self) -> dict[Attribute, Feed]:
        """What is to be evaluated."""
        found = {}
        for i, feed in enumerate(self.first.maps.feeds):
            maps = [mesh.maps.feeds[i] for mesh in self.meshes]
            if all(one is feed for one in maps):
                net = feed.net
            else:  # np.stack takes several times as long
                points = np.concatenate([one.points for one in maps])
                net = homogeneous(feed, points.reshape(-1, *feed.points.shape))
            found[feed.target.attribute] = Feed(
                net, self.first.grid, feed.rising, feed.target.components
            )
        return found

    @property
    def indices(self) -> Indices:
        """The primitives of one of the meshes."""
        return mesh_indices(self.first.grid.shape, self.first.mode, self.first.grid.turned)

    @property
    def primitive(self) -> int:
        """GL_POINTS, GL_LINES or GL_TRIANGLES."""
        return DRAWN_AS[self.first.mode]


@dataclass(frozen=True, eq=False)
class Recording:
    """A sequence of calls, kept: what a display list was. Drawn as often as one likes.

    `calls` is what the built-in program draws. Where trimmed surfaces are among them, whole there
    since it cuts them off by the curves themselves, `chords` makes the same calls with the
    triangles that the chords of the trims leave of them: for other programs, and to be read.
    """

    calls: tuple[Mesh | Collection, ...]
    chords: Callable[[], tuple[Mesh | Collection, ...]] | None = None

    @cached_property
    def items(self) -> tuple[Mesh | Collection, ...]:
        """The calls, with the triangles of trimmed surfaces: made when they are first wanted, for
        that can take a thousand times as long as the frame."""
        return self.calls if self.chords is None else self.chords()

    @cached_property
    def batches(self) -> tuple[Batch | Collection, ...]:
        """The items in as few draws as the order of the calls allows."""
        return self.drawn if self.chords is None else tuple(_grouped(self.items))

    @cached_property
    def drawn(self) -> tuple[Batch | Collection, ...]:
        """What the built-in program draws, in as few draws."""
        return tuple(_grouped(self.calls))


def _grouped(items: tuple[Mesh | Collection, ...]) -> Iterator[Batch | Collection]:
    for shape, alike in groupby(items, attrgetter("shape")):
        if shape is None:
            yield from alike  # type: ignore[misc]
        else:
            yield Batch(tuple(alike))  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False)
class Evaluated:
    """What one glEvalMesh, or one glBegin ... glEnd, made: read back from the GPU, float32.

    `vertices` (k, 4) homogeneous as the map gives them, `normals` (k, 3), `colors` (k, 4),
    `texcoords` (k, 4), `indices` (k,) of colours; where no map feeds them, the current values.
    `parameters` (k, 2) in the user's domain, NaN for a plain glVertex. `primitives` (p, 1), (p, 2)
    or (p, 3) number the vertices of points, lines, or triangles (counter-clockwise in (u,v) if
    they are a mesh's).
    """

    vertices: Single
    normals: Single
    colors: Single
    texcoords: Single
    indices: Single
    parameters: Array
    primitives: Indices

    @property
    def points(self) -> Single:
        """(x/w, y/w, z/w) of the vertices: shape (k, 3)."""
        return np.asarray(self.vertices[:, :3] / self.vertices[:, 3:])

    @property
    def mode(self) -> int:
        """GL_POINTS, GL_LINES or GL_TRIANGLES."""
        return {corners: mode for mode, corners in CORNERS.items()}[self.primitives.shape[1]]
