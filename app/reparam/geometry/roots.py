"""Roots in [0,1] of polynomials in Bernstein form, many at once."""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEPTH = 44  # halvings: roots come within 2^-45


def multiply(a: Array, b: Array) -> Array:
    """Bernstein coefficients (..., m+n+1) of the product of (..., m+1) and (..., n+1)."""
    m, n = a.shape[-1] - 1, b.shape[-1] - 1
    product = np.zeros((*np.broadcast_shapes(a.shape[:-1], b.shape[:-1]), m + n + 1))
    for i in range(m + 1):
        for j in range(n + 1):
            share = comb(m, i) * comb(n, j) / comb(m + n, i + j)
            product[..., i + j] += share * a[..., i] * b[..., j]
    return product


def halve(coefficients: Array) -> tuple[Array, Array]:
    """The same polynomials (..., d+1) over [0,1/2] and over [1/2,1], by de Casteljau."""
    row = coefficients
    left, right = [row[..., 0]], [row[..., -1]]
    while row.shape[-1] > 1:
        row = (row[..., :-1] + row[..., 1:]) / 2.0
        left.append(row[..., 0])
        right.append(row[..., -1])
    return np.stack(left, -1), np.stack(right[::-1], -1)


def sign_changes(coefficients: Array) -> NDArray[np.intp]:
    """How often (..., d+1) changes sign, zeros left out: by Descartes at least as many as roots."""
    signs = np.sign(coefficients)
    last = signs[..., 0]
    changes = np.zeros(signs.shape[:-1], dtype=np.intp)
    for i in range(1, signs.shape[-1]):
        here = signs[..., i]
        changes += last * here < 0.0
        last = np.where(here != 0.0, here, last)
    return changes


def bernstein_roots(coefficients: Array) -> tuple[NDArray[np.intp], Array]:
    """All roots strictly inside (0,1) of polynomials (n, d+1): their rows, and the parameters.

    Intervals are halved as long as Descartes' rule allows a root in them, so none is lost, be
    they as close as they like; a root of several fold may come several times. A polynomial that
    vanishes up to rounding has none. (Lane and Riesenfeld, BIT 21, 1981.)
    """
    scale = np.abs(coefficients).max(-1, initial=0.0)
    rows = np.flatnonzero(scale > 0.0)
    active = coefficients[rows] / scale[rows, None]
    active[np.abs(active) < 1e-15] = 0.0
    start = np.zeros(len(rows))
    width = 1.0
    found_rows, found = [], []
    for _ in range(DEPTH):
        alive = sign_changes(active) > 0
        rows, start = rows[alive], start[alive]
        left, right = halve(active[alive])
        width /= 2.0
        middle = left[:, -1] == 0.0
        found_rows.append(rows[middle])
        found.append(start[middle] + width)
        active = np.concatenate([left, right])
        rows, start = np.tile(rows, 2), np.concatenate([start, start + width])
    alive = sign_changes(active) > 0
    found_rows.append(rows[alive])
    found.append(start[alive] + width / 2.0)
    row, t = np.concatenate(found_rows), np.concatenate(found)
    inside = (t > 0.0) & (t < 1.0)
    order = np.lexsort((t[inside], row[inside]))
    return row[inside][order], t[inside][order]
