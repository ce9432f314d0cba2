"""Figure 7: parts of two tori kept, the rest redesigned by moving points of one control net."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ...geometry.evaluate import evaluate, project, sample_surface
from ...geometry.patch_joins import joins
from ...geometry.torus import FREE, A, B, RingNet, torus_distance, two_halves
from .. import palette
from ..claims import Claim
from ..layers import Array, Dots, Figure, Handles, Kind, Layer, Patches, Polylines, Space
from ..legend import legend
from ..parameters import Points
from ..registry import scene
from ..remember import remember
from ..splines import polylines

RING = two_halves()
COLUMNS, ROWS = RING.points.shape[:2]
DEFAULT_FREE = np.array([[column, row] for column in FREE for row in range(ROWS)], float)
EDITED = np.array([[4, 2, 0.0, 0.4, 0.9], [5, 2, 0.0, 0.4, 0.9], [10, 1, 0.0, -0.8, 0.5]])
for _array in (DEFAULT_FREE, EDITED):
    _array.flags.writeable = False
KEPT_A, KEPT_B, TRANSITION, MODIFIED = range(4)
REGIONS = {
    KEPT_A: (palette.rgb("D9534A"), "kept"),
    KEPT_B: (palette.rgb("4CAF7A"), "kept"),
    TRANSITION: (palette.rgb("BDBDBD"), "transition"),
    MODIFIED: (palette.rgb("E69F00"), "modified"),
}
Marked = Annotated[Array, Points((None, 2), "net points marked to be modified: column, row")]
Moves = Annotated[Array, Points((None, 5), "net points moved: column, row, dx, dy, dz")]


@scene(
    "Two torus halves: kept to the last bit where marked, smooth where redesigned",
    figure=7,
    plates=((), ("perspective=60",)),
)
def fig7(
    marked: Marked = DEFAULT_FREE,
    moves: Moves = EDITED,
    control: Annotated[bool, "the net of the rational pieces"] = True,
) -> Figure:
    free = marks(marked)
    ring = edited(moves)
    nets = patches_of(ring)
    region = regions(free)
    layers: list[Layer] = []
    for kind, (color, words) in REGIONS.items():
        if (region == kind).any():
            part = chosen(nets, region, kind)
            layers.append(Patches(part, color=color, lit=True, kind=Kind(color, words)))
    layers.append(Polylines(outlines(nets), palette.INK, 0.5))
    points = project(ring.points)
    if control:
        layers += [
            Polylines(np.concatenate([points, points[:1]]).swapaxes(0, 1), palette.INK, 0.6),
            Polylines(points, palette.INK, 0.6, closed=True),
            Dots(points[free], REGIONS[MODIFIED][0], 2.6),
        ]
    bounds = np.concatenate([sampled(nets), points.reshape(-1, 3)])
    layers.append(handles(ring, free))
    body = Space("body", bounds, tuple(layers), True, below=True)
    counts = np.bincount(region.ravel(), minlength=4)
    entries = [(c, f"{words} {n}") for (c, words), n in zip(REGIONS.values(), counts, strict=True)]
    kept = counts[KEPT_A] + counts[KEPT_B]
    caption = (
        f"{kept} of {region.size} rational biquadratic patches lie on two tori, bit for bit",
        "a patch changes only with its own 3 × 3 net points; all joins stay G1",
    )
    return Figure((legend("words", "", entries), body), caption)


def marks(marked: Array) -> NDArray[np.bool_]:
    """Which net points are to be modified, (12, 6). Raises ValueError for one that is not there."""
    free = np.zeros((COLUMNS, ROWS), bool)
    for column, row in marked:
        free[_place("marked", column, row)] = True
    return free


@remember
def edited(moves: Array) -> RingNet:
    """The net with points moved."""
    ring = RING
    for column, row, *by in moves:
        ring = ring.moved(_place("moves", column, row), np.array(by))
    return ring


def _place(name: str, column: float, row: float) -> tuple[int, int]:
    if column not in range(COLUMNS) or row not in range(ROWS):
        expected = f"expected a column from 0 to {COLUMNS - 1} and a row from 0 to {ROWS - 1}"
        raise ValueError(f"{name}: {expected}, found {column:g}, {row:g}")
    return int(column), int(row)


@remember
def patches_of(ring: RingNet) -> Array:
    """The nets (72, 3, 3, 4), column after column."""
    return ring.patches().reshape(-1, 3, 3, 4)


sampled = remember(sample_surface)


@remember
def outlines(nets: Array) -> Array:
    """The patches' edges, each once."""
    return polylines(np.concatenate([nets[:, -1], nets[:, :, -1]]))


def regions(free: NDArray[np.bool_]) -> NDArray[np.intp]:
    """What becomes of each patch, (12, 6): kept if it lies on a torus and no point of its 3 x 3
    is free; modified if its own is free; else transition."""
    near = np.zeros_like(free)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            near |= np.roll(free, (i, j), (0, 1))
    on_a, on_b = on_tori(patches_of(RING))
    region = np.full(free.shape, TRANSITION)
    region[free] = MODIFIED
    region[~near & on_a] = KEPT_A
    region[~near & on_b] = KEPT_B
    return region


@remember
def on_tori(nets: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which patches (12, 6) lie on A, which on B."""
    far = torus_distances(nets)
    return far[0] < 1e-12, far[1] < 1e-12


def torus_distances(nets: Array) -> Array:
    """Largest distance (2, 12, 6) of each patch from A and from B."""
    t = np.linspace(0.0, 1.0, 17)
    points = project(evaluate(nets, *np.meshgrid(t, t, indexing="ij")))
    far = [np.abs(torus_distance(points, *torus)).max((1, 2)) for torus in (A, B)]
    return np.stack(far).reshape(2, COLUMNS, ROWS)


def chosen(nets: Array, region: NDArray[np.intp], kind: int) -> Array:
    """The patches of one region."""
    return np.asarray(nets[region.ravel() == kind])


def handles(ring: RingNet, free: NDArray[np.bool_]) -> Handles:
    """A handle at each free net point; dragging it goes into `moves`."""
    places = np.argwhere(free)
    at = project(ring.points[free])
    start = project(RING.points[free])

    def drag(values: Mapping[str, Any], index: int, point: Array) -> Mapping[str, Any]:
        place = tuple(places[index].tolist())
        rows = {tuple(map(int, row[:2])): row for row in values["moves"]}
        rows[place] = np.array([*place, *(point - start[index])])
        return {"moves": np.array([*rows.values()])}

    names = tuple(f"net point {i}, {j}" for i, j in places)
    return Handles(at, drag, names)


@fig7.claims
def claims() -> Iterator[Claim]:
    plain, moved = patches_of(RING), edited(EDITED).patches().reshape(-1, 3, 3, 4)
    kept = regions(marks(DEFAULT_FREE)) <= KEPT_B
    statement = "patches on the torus R = 3, r = 1, on the torus R = 2.4, r = .8, in all"
    counts = [int(on.sum()) for on in on_tori(plain)]
    yield Claim("Fig. 7", statement, [12, 12, 72], [*counts, len(plain)], 0)
    far = torus_distances(moved).min(0)[kept]
    statement = "largest distance of the 24 kept patches from their torus, after editing"
    yield Claim("Fig. 7", statement, 0.0, float(far.max()), 1e-14)
    same = (plain == moved).all((1, 2, 3)).reshape(kept.shape)
    statement = "kept patches that editing changed in any bit"
    yield Claim("Fig. 7", statement, 0, int((~same[kept]).sum()), 0)
    for words, nets in (("as printed", plain), ("after editing", moved)):
        report = joins(nets, highest=1)
        statement = f"{words}: joins; largest normal jump in degrees, largest gap"
        measured = [len(report.patches), float(report.angles.max()), float(report.gaps.max())]
        yield Claim("Fig. 7", statement, [144.0, 0.0, 0.0], measured, 1e-8)
