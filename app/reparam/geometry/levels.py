"""How finely a patch must be tessellated so that no drawn point is off by more than so many pixels.

Twin: shaders/lib/levels.glsl, same names. A triangle that spans hu x hv of the parameter square
differs from the surface, at the same parameter, by at most

    (hu^2 Muu + 2 hu hv Muv + hv^2 Mvv) / 8

with M the largest second derivatives (D. Filip, R. Magedson, R. Markot, Surface algorithms using
bounds on derivatives, CAGD 3, 1986), and these are at most the second differences of the control
net times du (du-1), du dv, dv (dv-1). The difference counts *at the same parameter*, so a texture
lies where it belongs (Y. Yeo, L. Bin, J. Peters, Efficient pixel-accurate rendering of curved
surfaces, I3D 2012). Clip coordinates of a rational patch, under any camera, are polynomial in
(u,v); the bound is for their quotient.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .net import Array

FINEST = 4096  # no level above
TWIST = 0.1  # see `balance`


def second_derivatives(nets: Array) -> tuple[Array, Array, Array]:
    """Control points of d2/du2, d2/dudv and d2/dv2 of nets (..., m, n, c), as they come."""
    m, n = nets.shape[-3] - 1, nets.shape[-2] - 1
    in_u, in_v = np.diff(nets, axis=-3), np.diff(nets, axis=-2)
    return (
        m * (m - 1) * np.diff(in_u, axis=-3),
        m * n * np.diff(in_u, axis=-2),
        n * (n - 1) * np.diff(in_v, axis=-2),
    )


def level_coefficients(nets: Array, scale: tuple[float, float], tolerance: float) -> Array:
    """(a, b, c) of each patch (..., 3): steps nu x nv are fine enough if

        a / nu^2 + 2 b / (nu nv) + c / nv^2 <= 1.

    `nets` (..., m, n, 4) in clip coordinates with `scale` the viewport's half width and height,
    or a texture map with `scale` the pixels of a unit of s and t; `tolerance` in pixels. With x
    measured from the patch's own middle and the deviations E of x, y and w, x/w is off by at most
    (E_x + |x/w| E_w) / (w - E_w), and |x/w| is at most the patch's half extent. Infinite where
    w <= 0.
    """
    least = nets[..., 3].min((-2, -1))
    safe = np.where(nets[..., 3:] > 0.0, nets[..., 3:], 1.0)
    places = nets[..., :2] / safe
    low, high = places.min((-3, -2)), places.max((-3, -2))
    centred = nets.copy()
    centred[..., :2] -= ((low + high) / 2.0)[..., None, None, :] * nets[..., 3:]
    reach = (high - low)[..., None, None, :] / 2.0
    off, w = [], []
    for bent in second_derivatives(centred):
        size = np.abs(bent)
        along = (size[..., :2] + reach * size[..., 3:]) * np.array(scale)
        off.append(_longest(along))
        w.append(size[..., 3].max((-2, -1), initial=0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        need = (np.stack(off, -1) + tolerance * np.stack(w, -1)) / (
            8.0 * tolerance * least[..., None]
        )
    return np.asarray(np.where(least[..., None] > 0.0, need, np.inf))


def pixels_a_unit(clip: Array, maps: Array, half: tuple[float, float]) -> Array:
    """About how many pixels a unit of a texture map is long, (...,): the larger of along u and v.

    By the longest legs of both nets; what the map is off by shows on the screen so much larger.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        seen = clip[..., :2] / clip[..., 3:] * np.array(half)
        sought = maps[..., :2] / maps[..., 3:]
        ratios = [
            (seen.shape[axis] - 1) * _longest(np.diff(seen, axis=axis))
            / ((sought.shape[axis] - 1) * _longest(np.diff(sought, axis=axis)))
            for axis in (-3, -2)
        ]  # fmt: skip
    return np.asarray(np.nan_to_num(np.maximum(*ratios), nan=0.0, posinf=0.0))


def _longest(legs: Array) -> Array:
    return np.asarray(np.hypot(legs[..., 0], legs[..., 1]).max((-2, -1), initial=0.0))


def balance(need: Array) -> NDArray[np.int64]:
    """The steps (..., 2) in u and v with about the fewest triangles that meet `need` (..., 3).

    The twist is shared out: 2 b / (nu nv) <= b (k / nu^2 + 1 / (k nv^2)) for every k, and is an
    equality at k = nu / nv. Then v gets what it needs if u takes as much, u what v left, and v
    what u left.
    """
    a, b, c = np.moveaxis(np.minimum(need, 1e12), -1, 0)
    share = np.sqrt((a + TWIST * b + 1e-30) / (c + TWIST * b + 1e-30))
    a, c = a + b * share, c + b / share
    nv = np.maximum(1.0, np.ceil(np.sqrt(2.0 * c)))
    nu = np.maximum(1.0, np.ceil(np.sqrt(a / (1.0 - c / nv**2))))
    room = 1.0 - a / nu**2
    with np.errstate(divide="ignore", invalid="ignore"):
        tight = np.where(room > 0.0, np.ceil(np.sqrt(c / room)), nv)
    nv = np.clip(tight, 1.0, nv)
    return np.asarray(np.minimum(np.stack([nu, nv], -1), FINEST).astype(np.int64))


def out_of_view(clip: Array) -> NDArray[np.bool_]:
    """Whether all control points of nets (..., m, n, 4) lie beyond one side of the view volume.

    Then the patch does too: with positive weights it lies in their convex hull.
    """
    w = clip[..., 3:]
    beyond = np.concatenate([clip[..., :3] > w, clip[..., :3] < -w], -1)
    return np.asarray(beyond.all((-3, -2)).any(-1) & (w > 0.0).all((-3, -2, -1)))


def edge_numbers(nets: Array) -> NDArray[np.int32]:
    """A number for each edge of the patches (P, m, n, 4), the same for the same curve: (P, 4).

    The edges u = 0, v = 0, u = 1, v = 1; a curve is the same read backwards too.
    """
    nets = nets + 0.0  # -0 is 0
    numbers = np.empty((len(nets), 4), np.int32)
    count = 0
    edges = [nets[:, 0], nets[:, :, 0], nets[:, -1], nets[:, :, -1]]
    groups = [(0, 1, 2, 3)] if nets.shape[1] == nets.shape[2] else [(0, 2), (1, 3)]
    for group in groups:
        curves = np.stack([edges[k] for k in group], 1).reshape(len(nets) * len(group), -1)
        backwards = curves.reshape(len(curves), -1, nets.shape[-1])[:, ::-1].reshape(curves.shape)
        first = np.take_along_axis(curves - backwards, (curves != backwards).argmax(1)[:, None], 1)
        canonical = np.ascontiguousarray(np.where(first <= 0.0, curves, backwards))
        rows = canonical.view(np.dtype((np.void, canonical.dtype.itemsize * canonical.shape[1])))
        _, found = np.unique(rows.ravel(), return_inverse=True)
        numbers[:, group] = count + found.reshape(len(nets), len(group))
        count += int(found.max()) + 1
    return numbers


def edge_levels(levels: NDArray[np.int64], numbers: NDArray[np.int32]) -> NDArray[np.int64]:
    """The level of each edge (P, 4): the most that a patch along it asks for in levels (P, 2).

    An edge as fine as the finest patch beside it keeps the bound in the triangles along it, and
    neighbours agree, so nothing cracks. (By the edge curve alone a straight edge of a bent patch
    would get one step, and the long triangles there would leave the surface.)
    """
    asked = levels[:, [1, 0, 1, 0]].ravel()
    finest = np.zeros(int(numbers.max(initial=0)) + 1, np.int64)
    np.maximum.at(finest, numbers.ravel(), asked)
    return np.maximum(finest[numbers], 1)


STEPS = np.unique([k << s for k in (2, 3) for s in range(14)] + [1])
"""1, 2, 3, 4, 6, 8, 12 ...: few enough levels that patches of one level are many."""


def grid_levels(
    levels: NDArray[np.int64], edges: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The same and finer, of `STEPS`: levels (P, 2) of grids that can snap to edges (P, 4).

    A vertex on an edge goes to the nearest of the edge's steps: a triangle there spans up to half
    a step of the edge and one of the grid, and may span one of `levels`. With as many steps in
    both it spans just one.
    """
    edges = STEPS[np.searchsorted(STEPS, edges)]
    along = edges[:, [[1, 3], [0, 2]]]  # patch, direction, side
    fine = STEPS[np.searchsorted(STEPS, np.maximum(levels, along.max(-1)))]
    for _ in range(2):  # what is made finer for one side may no longer be the other's
        snaps = along != fine[..., None]
        least = np.where(snaps, 1.0 / (1.0 / levels[..., None] - 0.5 / along), 1.0).max(-1)
        fine = STEPS[np.searchsorted(STEPS, np.maximum(fine, np.ceil(least - 1e-9)))]
    return fine, edges
