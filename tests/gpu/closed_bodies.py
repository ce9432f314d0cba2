"""Closed bodies whose patches meet in every way: u-edge with v-edge, forwards and backwards."""

from __future__ import annotations

from itertools import product

import numpy as np

from reparam.geometry.body import Body, Patch, body
from reparam.geometry.net import Array, raise_degree

ORDER = 4
FACES = [(axis, side) for axis in range(3) for side in (0, 1)]
TURNS = [0, 1, 2, 3, 1, 2]  # quarter turns of the faces' parameters


def lattice(axis: int, side: int, order: int) -> Array:
    """Integer points of a face of the cube [0, order-1]^3, p_u x p_v outwards."""
    k = np.arange(order)
    u, v = np.meshgrid(k, k, indexing="ij")
    first, second = (u, v) if side else (v, u)
    point = np.empty((order, order, 3), int)
    point[..., axis] = side * (order - 1)
    point[..., (axis + 1) % 3] = first
    point[..., (axis + 2) % 3] = second
    return point


def bulged_cube(seed: int, *, rational: bool, mixed: bool) -> Body:
    """Six faces, displaced at random: neighbours have the control points of their edge in common.

    With `mixed` every edge is quadratic, half of the faces are biquadratic and half bicubic.
    """
    random = np.random.default_rng(seed)
    order = 3 if mixed else ORDER
    nodes = {}
    for node in product(range(order), repeat=3):
        place = np.array(node) * 2.0 / (order - 1) - 1.0
        place = place / np.abs(place).sum() ** 0.5 if place.any() else place
        weight = random.uniform(0.5, 2.0) if rational else 1.0
        moved = place + random.uniform(-0.15, 0.15, 3)
        nodes[node] = np.array([*(weight * moved), weight])
    patches = []
    for number, ((axis, side), turn) in enumerate(zip(FACES, TURNS, strict=True)):
        points = lattice(axis, side, order)
        net = np.array([[nodes[tuple(node)] for node in row] for row in points.tolist()])
        if mixed and number % 2:
            net = raise_degree(net, 3, 3)
            net[1:-1, 1:-1, :3] += random.uniform(-0.2, 0.2, (2, 2, 3))
        patches.append(Patch(np.ascontiguousarray(np.rot90(net, turn))))
    return body(patches)


def edges(points: Array) -> list[Array]:
    """The four edges of grids (..., m, n, 4): u = 0, u = 1, v = 0, v = 1. Views, not copies."""
    rows, columns = points, points.swapaxes(-3, -2)
    return [rows[..., 0, :, :], rows[..., -1, :, :], columns[..., 0, :, :], columns[..., -1, :, :]]


def pairings(random: np.random.Generator, order: int) -> tuple[Array, list[tuple[int, int, bool]]]:
    """Nets 2k and 2k+1 have one edge in common: which of each, and whether it runs backwards."""
    kinds = list(product(range(4), range(4), (False, True)))
    nets = np.empty((2 * len(kinds), order, order, 4))
    nets[..., :3] = random.uniform(-1.0, 1.0, (*nets.shape[:-1], 3))
    nets[..., 3] = random.uniform(0.5, 2.0, nets.shape[:-1])
    for k, (one, other, backwards) in enumerate(kinds):
        edge = edges(nets[2 * k])[one]
        edges(nets[2 * k + 1])[other][...] = edge[::-1] if backwards else edge
    return nets, kinds
