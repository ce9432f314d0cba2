"""Triangles of evenly spaced samples over those of samples spread by curvature, as accurate.

A change of variables inside each patch (Buchenau and Guthe, VMV 2021) puts grid lines closer where
the patch bends more. `inside`: edges stay evenly divided, so neighbours meet, and the rows and
columns between them go where the integral of sqrt(|p_uu| + |p_uv|), at its largest across the
patch, is equal:

    +-----+-----+-----+
    | \\    | /   /     |
    +---+--+-+---------+
    | /    | \\   \\     |
    +-----+-----+-----+

`edges`: all is spread, by one fraction-linear change for each edge that its own control points
tell, blended across. Both sides have for each patch the fewest cells whose two triangles are
nowhere off by more than TOLERANCE, found by trying. The renderer spaces evenly: its own bodies
gain too little, for nearly all their curves are quadratic, and p_uu of these is constant. Bicubic
patches of random heights, where it changes sign, are another matter.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from uniform import SIZE, bodies, look

from reparam.bench import Row, Rows
from reparam.geometry.bernstein import bernstein
from reparam.geometry.levels import out_of_view
from reparam.geometry.net import Array

PATCHES = 6  # of a body, at random
FINEST = 24
TOLERANCE = 2.0  # pixels
WITHIN = np.linspace(0.0, 1.0, 7)
FINE = np.linspace(0.0, 1.0, 33)
STEEPEST = 2.0  # of an edge's change, at its ends

Spacing = Callable[[int, int], tuple[Array, Array]]  # u and v of the corners of nu x nv cells


def rows(_: int) -> Rows:
    """Each body in both ways, then the geometric means."""
    random, ratios = np.random.default_rng(1), []
    for name, nets in {**bodies(), "random-bicubic": wavy()}.items():
        camera = look(nets, 1.0)
        clip = nets @ camera.clip_from_model().T
        seen = np.flatnonzero(~out_of_view(clip))
        chosen = random.choice(seen, min(PATCHES, len(seen)), replace=False)
        pixels = clip[chosen][..., [0, 1, 3]] * [SIZE[0] / 2.0, SIZE[1] / 2.0, 1.0]
        cells = np.array([[fewest(p, way(p)) for way in (evenly, inside, edges)] for p in pixels])
        cells = cells[cells.max(1) <= FINEST**2].sum(0)
        if not cells.all():
            continue
        ratios.append(cells[0] / cells[1:])
        for way, ratio in zip(("inside", "edges"), ratios[-1], strict=True):
            yield Row(f"variables/{way}/{name}", float(ratio), settings={"patches": len(chosen)})
    for way, found in zip(("inside", "edges"), np.transpose(ratios), strict=True):
        mean = float(np.exp(np.log(found[:-1]).mean()))  # of the project's own
        yield Row(f"variables/{way}/mean", mean, goal=1.1, at_least=True)


def wavy() -> Array:
    """Bicubic patches of random heights (25, 4, 4, 4), side by side."""
    height = np.random.default_rng(5).uniform(-0.5, 0.5, (25, 4, 4))
    i, j = np.divmod(np.arange(25), 5)
    t = np.linspace(0.0, 1.0, 4)
    x, y = (np.broadcast_to(a, height.shape) for a in (
        i[:, None, None] + t[:, None], j[:, None, None] + t))  # fmt: skip
    return np.stack([x, y, height, np.ones_like(height)], -1)


def evenly(_: Array) -> Spacing:
    """Both in equal steps."""
    return lambda nu, nv: (
        np.repeat(np.linspace(0.0, 1.0, nu + 1)[:, None], nv + 1, 1),
        np.repeat(np.linspace(0.0, 1.0, nv + 1)[None], nu + 1, 0),
    )


def inside(pixels: Array) -> Spacing:
    """Rows and columns spread by curvature, but for the edges."""
    step = 1e-3
    at = np.clip(FINE, step, 1.0 - step)
    here, by = points(pixels, *cross(at, at)), {}
    for du, dv in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
        by[du, dv] = points(pixels, *cross(at + du * step, at + dv * step))
    twist = by[1, 1] - by[1, -1] - by[-1, 1] + by[-1, -1]
    mixed = np.linalg.norm(twist, axis=-1) / 4.0
    bent = [np.linalg.norm(by[a] - 2.0 * here + by[b], axis=-1)
            for a, b in (((1, 0), (-1, 0)), ((0, 1), (0, -1)))]  # fmt: skip
    places = [spread((bent[axis] + mixed).max(1 - axis)) for axis in (0, 1)]

    def spacing(nu: int, nv: int) -> tuple[Array, Array]:
        u, v = evenly(pixels)(nu, nv)
        u[:, 1:-1] = places[0](nu)[:, None]
        v[1:-1] = places[1](nv)
        return u, v

    return spacing


def spread(bend: Array) -> Callable[[int], Array]:
    """Parameters that share the integral of the root of `bend` equally."""
    density = np.sqrt(bend)
    density = density + 0.02 * density.max() + 1e-12
    integral = np.append(0.0, np.cumsum(density[1:] + density[:-1]))
    return lambda n: np.interp(np.linspace(0.0, integral[-1], n + 1), integral, FINE)


def edges(pixels: Array) -> Spacing:
    """One ratio a to b for each edge, s -> s a / (s a + (1-s) b): slope a/b at 0, b/a at 1."""
    sides = (pixels[0], pixels[:, 0], pixels[-1], pixels[:, -1])
    low_v, low_u, high_v, high_u = np.log([ratio(side) for side in sides])

    def spacing(nu: int, nv: int) -> tuple[Array, Array]:
        s, t = evenly(pixels)(nu, nv)
        a, b = np.exp((1.0 - t) * low_u + t * high_u), np.exp((1.0 - s) * low_v + s * high_v)
        return s * a / (s * a + 1.0 - s), t * b / (t * b + 1.0 - t)

    return spacing


def ratio(side: Array) -> float:
    """The fourth root of how much more a curve (n, 3) is bent at its end than at its start."""
    places = side[:, :2] / side[:, 2:]
    bent = np.linalg.norm(np.diff(places, 2, axis=0), axis=-1)
    if not len(bent) or not bent.max() > 1e-9:
        return 1.0
    start, end = bent[[0, -1]] + 0.05 * bent.max()
    return float(np.clip((end / start) ** 0.25, 1.0 / STEEPEST, STEEPEST))


def fewest(pixels: Array, spacing: Spacing) -> int:
    """The fewest cells that keep the tolerance; more than FINEST^2 if none do."""
    best = FINEST**2 + 1
    for nu in range(1, FINEST + 1):
        low, high = 0, min(FINEST, (best - 1) // nu)
        if high < 1:
            break
        if most_off(pixels, *spacing(nu, high)) > TOLERANCE:
            continue
        while high - low > 1:
            middle = (low + high) // 2
            kept = most_off(pixels, *spacing(nu, middle)) <= TOLERANCE
            low, high = (low, middle) if kept else (middle, high)
        best = nu * high
    return best


def most_off(pixels: Array, u: Array, v: Array) -> float:
    """Pixels between the triangles over corners at u, v (nu + 1, nv + 1) and the patch."""
    exact = points(pixels, linear(u), linear(v))
    corners = points(pixels, u, v)
    drawn = np.stack([linear(corners[..., axis]) for axis in (0, 1)], -1)
    return float(np.linalg.norm(exact - drawn, axis=-1).max())


def linear(values: Array) -> Array:
    """Values at corners (nu + 1, nv + 1) within both triangles of each cell: (nu, nv, k, k)."""
    a, b, c, d = (
        corner[..., None, None]
        for corner in (values[:-1, :-1], values[1:, :-1], values[1:, 1:], values[:-1, 1:])
    )
    s, t = WITHIN[:, None], WITHIN
    return np.where(
        s >= t, a + (s - t) * (b - a) + t * (c - a), a + (t - s) * (d - a) + s * (c - a)
    )


def cross(u: Array, v: Array) -> tuple[Array, Array]:
    """All pairs."""
    first, second = np.meshgrid(u, v, indexing="ij")
    return first, second


def points(pixels: Array, u: Array, v: Array) -> Array:
    """Where a patch (m, n, 3), homogeneous in pixels, is seen at parameters of any shape."""
    row, column = bernstein(pixels.shape[0] - 1, u), bernstein(pixels.shape[1] - 1, v)
    point = np.einsum("...i,...j,ijc->...c", row, column, pixels, optimize=True)
    return np.asarray(point[..., :2] / point[..., 2:])
