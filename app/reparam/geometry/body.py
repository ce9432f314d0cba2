"""A body: many patches of one degree, ready for drawing, and how other pieces become patches.

Triangular patches and the faces of polyhedra become tensor patches exactly, so that one
evaluator draws everything.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from .net import Array, check_net, raise_degree

MAX_PATCHES = 1 << 19
MAX_POINTS = 16 * MAX_PATCHES  # of all nets together: 256 MiB, every patch a bicubic

TRIANGLE = np.array([[0, 0], [1, 2]])  # corner [iu, iv] of the patch -> corner of the face
QUAD = np.array([[0, 3], [1, 2]])
SQUARE_DOMAIN = np.stack(np.meshgrid([0.0, 1.0], [0.0, 1.0], indexing="ij"), -1)
TRIANGLE_DOMAIN = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])[TRIANGLE]
SQUARE_DOMAIN.flags.writeable = TRIANGLE_DOMAIN.flags.writeable = False

FLAT_TURN = -1e-12  # a quad that bends back no more than this, in the unit square, is convex


@dataclass(frozen=True, eq=False)
class Patch:
    """One patch: net (m, n, 4), its own parameters (u, v) at the corners [iu, iv], its group."""

    net: Array
    domain: Array = field(default_factory=lambda: SQUARE_DOMAIN)
    group: str = ""

    def __post_init__(self) -> None:
        if self.net.ndim != 3 or self.domain.shape != (2, 2, 2):
            shapes = f"{self.net.shape} and {self.domain.shape}"
            raise ValueError(f"expected a net (m, n, 4) and a domain (2, 2, 2), found {shapes}")


@dataclass(frozen=True, eq=False)
class Polyhedron:
    """Vertices (V, 3) and faces, lists of indices counter-clockwise from outside; not checked.

    Of a file: its name, where the first vertex has the number `first`, and the line of a face.
    """

    vertices: Array
    faces: Sequence[Sequence[int]]
    source: str = ""
    first: int = 0
    line: Callable[[int], int] = lambda _: 0


@dataclass(frozen=True, eq=False)
class Body:
    """Patches of one degree.

    nets (P, m, m, 4), domains (P, 2, 2, 2), groups (P,) as indices of `names`; the polyhedron
    that some of the patches are the faces of.
    """

    nets: Array
    domains: Array
    groups: NDArray[np.intp]
    names: tuple[str, ...]
    polyhedron: Polyhedron | None = None


def body(patches: Sequence[Patch], polyhedron: Polyhedron | None = None) -> Body:
    """The patches in their order, raised to the largest degree that occurs, in u and in v.

    With one degree for both directions an edge evaluates to the same bits whether it is a
    u-edge here or a v-edge there. Raises ValueError for no patches, for too many, and for a
    net that `check_net` refuses.
    """
    if not patches:
        raise ValueError("expected at least one patch, found none")
    order = max(max(patch.net.shape[:2]) for patch in patches)
    if len(patches) * order**2 > MAX_POINTS:
        found = f"{len(patches)} patches of {order} x {order}"
        raise ValueError(f"expected at most {MAX_POINTS} control points, found {found}")
    same_shape = defaultdict(list)
    for index, patch in enumerate(patches):
        same_shape[patch.net.shape].append(index)
    nets = np.empty((len(patches), order, order, 4))
    for members in same_shape.values():
        nets[members] = raise_degree(_stack(patches, members), order - 1, order - 1)
    names = {name: i for i, name in enumerate(dict.fromkeys(p.group for p in patches))}
    return Body(
        nets=nets,
        domains=np.stack([patch.domain for patch in patches]).astype(np.float64),
        groups=np.array([names[patch.group] for patch in patches]),
        names=tuple(names),
        polyhedron=polyhedron,
    )


def _stack(patches: Sequence[Patch], members: list[int]) -> Array:
    try:
        return check_net(np.stack([patches[index].net for index in members]))
    except ValueError:
        for index in members:  # one by one is slow, but now the offender wants its number
            try:
                check_net(patches[index].net)
            except ValueError as fault:
                raise ValueError(f"patch {index}: {fault}") from None
        raise


def with_points(nets: Array, moved: Array) -> Array:
    """A copy of nets (P, m, n, 4) with control points moved, their weights kept.

    Each row of `moved` (k, 6) is patch, row, column, x, y, z. Raises ValueError for a place that
    is not in the nets and for what `check_net` refuses.
    """
    places = moved[:, :3].astype(int)
    inside = (places == moved[:, :3]) & (places >= 0) & (places < nets.shape[:3])
    if not inside.all():
        row = int(np.argwhere(~inside)[0, 0])
        limits = " x ".join(map(str, nets.shape[:3]))
        found = ", ".join(f"{value:g}" for value in moved[row, :3])
        raise ValueError(f"moved[{row}]: expected a place among {limits}, found {found}")
    nets = nets.copy()
    patch, i, j = places.T
    nets[patch, i, j, :3] = nets[patch, i, j, 3:] * moved[:, 3:]
    return check_net(nets)


def homogeneous(points: Array) -> Array:
    """Points (..., 3) as (..., 4) of weight 1."""
    return np.concatenate([points, np.ones((*points.shape[:-1], 1))], -1)


def triangle_to_tensor(points: Array, degree: int) -> Array:
    """A triangular Bezier patch as the same surface, a degenerate net (..., d+1, d+1, 4).

    `points` (..., (d+1)(d+2)/2, 3) in rows from the base A to B up to the apex C. The change of
    variables to barycentric coordinates (1-U, U(1-V), UV) for (A, B, C) blows A up to the edge
    U = 0 and keeps the orientation. Raises ValueError for another number of points.
    Source: S.-M. Hu, Conversion between triangular and rectangular Bezier patches, CAGD 18
    (2001), 667-671.
    """
    count = (degree + 1) * (degree + 2) // 2
    if points.ndim < 2 or points.shape[-2:] != (count, 3):
        raise ValueError(f"expected points (..., {count}, 3), found {points.shape}")
    net = _triangle_matrix(degree) @ points
    return homogeneous(net.reshape(*points.shape[:-2], degree + 1, degree + 1, 3))


@cache
def _triangle_matrix(degree: int) -> Array:
    """((d+1)^2, (d+1)(d+2)/2): row m of the net is the m-th row seen from A, raised to d.

    Edges of the patch are rows of the identity here: they stay what they were, bit for bit.
    """
    start = np.cumsum([0, *range(degree + 1, 0, -1)])  # of the rows of constant k
    unit = np.eye(start[-1])
    rows = []
    for m in range(degree + 1):
        k = np.arange(m + 1)
        away_from_a = unit[start[k] + m - k]  # i = d - m, j = m - k
        rows.append(raise_degree(away_from_a[None], 0, degree)[0])
    return np.concatenate(rows)


def face_patches(vertices: Array, faces: Sequence[Sequence[int]], group: str = "") -> list[Patch]:
    """Bilinear patches for the faces of a polyhedron, in their order and orientation.

    `vertices` (V, 3); a face is a list of at least three indices, counter-clockwise from
    outside. Triangles become degenerate patches, quads that are convex in their Newell plane
    one patch; other polygons are cut into triangles whose domains lie together in the bounding
    square of the face, so that one texture covers it.
    """
    result: list[list[Patch]] = [[] for _ in faces]
    same_size = defaultdict(list)
    for index, face in enumerate(faces):
        same_size[len(face)].append(index)
    for size, members in same_size.items():
        corners = vertices[np.array([faces[index] for index in members])]
        if size == 3:
            nets = homogeneous(corners[:, TRIANGLE])
            for index, net in zip(members, nets, strict=True):
                result[index] = [Patch(net, TRIANGLE_DOMAIN, group)]
            continue
        positions = _positions_in_plane(corners)
        whole = _convex(positions) & (size == 4)
        nets = homogeneous(corners[:, QUAD])
        for row, index in enumerate(members):
            if whole[row]:
                result[index] = [Patch(nets[row], SQUARE_DOMAIN, group)]
            else:
                result[index] = list(_polygon_patches(corners[row], positions[row], group))
    return list(chain.from_iterable(result))


def _polygon_patches(corners: Array, positions: Array, group: str) -> Iterator[Patch]:
    net = homogeneous(corners)
    # The texture takes s = 2v - 1 to the right and t = 1 - 2u upwards.
    domain = np.stack([1.0 - positions[:, 1], positions[:, 0]], -1)
    for triangle in triangulate(positions):
        index = np.array(triangle)[TRIANGLE]
        yield Patch(net[index], domain[index], group)


def _positions_in_plane(corners: Array) -> Array:
    """(right, up) of the corners (F, k, 3) in the bounding square of their face: (F, k, 2).

    The plane is Newell's: its normal is the sum of the cross products of successive corners,
    which also tells the orientation. Up is z, or y on faces that are nearly level.
    """
    points = corners - corners.mean(1, keepdims=True)
    size = np.abs(points).max((1, 2), keepdims=True)
    points /= np.where(size > 0.0, size, 1.0)
    normal = np.cross(points, np.roll(points, -1, 1)).sum(1)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = np.where(length > 0.0, normal / np.where(length > 0.0, length, 1.0), [0.0, 0.0, 1.0])
    upright = np.abs(normal[:, 2:]) < 0.9
    right = np.cross(np.where(upright, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]), normal)
    right /= np.linalg.norm(right, axis=-1, keepdims=True)
    frame = np.stack([right, np.cross(normal, right)], -1)
    flat = points @ frame
    low, high = flat.min(1, keepdims=True), flat.max(1, keepdims=True)
    side = (high - low).max(-1, keepdims=True)
    return np.asarray((flat - (low + high) / 2.0) / np.where(side > 0.0, side, 1.0) + 0.5)


def _convex(positions: Array) -> NDArray[np.bool_]:
    """Whether no corner of the polygons (F, k, 2) turns right; F booleans."""
    edge = np.roll(positions, -1, 1) - positions
    after = np.roll(edge, -1, 1)
    turn = edge[..., 0] * after[..., 1] - edge[..., 1] * after[..., 0]
    return np.asarray((turn >= FLAT_TURN).all(1))


def triangulate(positions: Array) -> list[tuple[int, int, int]]:
    """Triangles of a simple polygon (k, 2), as indices with the polygon's orientation.

    Every edge of the polygon is an edge of a triangle: where earcut leaves a corner out since
    it lies on a straight line, a flat triangle fills in, else a neighbouring face that has
    this corner too would show a crack.
    """
    from mapbox_earcut import triangulate_float64  # needed by few files, so imported late

    count = len(positions)
    ears = triangulate_float64(positions, np.array([count], dtype=np.uint32)).reshape(-1, 3)
    # The corners of a triangle in the order of the boundary turn as the boundary does.
    triangles: list[tuple[int, int, int]] = [(a, b, c) for a, b, c in np.sort(ears, 1).tolist()]
    edges = {edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))}
    boundary = sorted((a, b) for a, b in edges if (b, a) not in edges)
    boundary = boundary or [(0, count - 1), (count - 1, 0)]  # no area, no ears: a fan
    if sum((b - a) % count for a, b in boundary) == count:  # once round: not self-intersecting
        for a, b in boundary:
            for corner in range(a + 1, a + (b - a) % count):
                triangles.append((a, corner % count, (corner + 1) % count))
    return triangles
