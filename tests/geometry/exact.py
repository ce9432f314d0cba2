"""The same mathematics in rational numbers: what the float64 code is compared with."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import comb

import numpy as np

from reparam.geometry.net import Array

Point = list[Fraction]


def bernstein(degree: int, t: Fraction) -> Point:
    return [comb(degree, i) * t**i * (1 - t) ** (degree - i) for i in range(degree + 1)]


def bernstein_derivative(degree: int, t: Fraction) -> Point:
    """By the product rule, not by the degree below."""
    values = []
    for i in range(degree + 1):
        rising = i * t ** max(i - 1, 0) * (1 - t) ** (degree - i)
        falling = (degree - i) * t**i * (1 - t) ** max(degree - i - 1, 0)
        values.append(comb(degree, i) * (rising - falling))
    return values


def de_casteljau(points: list[Point], t: Fraction) -> Point:
    while len(points) > 1:
        points = [
            [(1 - t) * a + t * b for a, b in zip(p, q, strict=True)] for p, q in pairwise(points)
        ]
    return points[0]


def evaluate(net: Array, u: Fraction, v: Fraction) -> Point:
    """The homogeneous point of a net (m, n, 4): rows first, then the column of their points."""
    rows = [[[Fraction(x) for x in point] for point in row] for row in net.tolist()]
    return de_casteljau([de_casteljau(row, v) for row in rows], u)


def random_net(random: np.random.Generator, degree_u: int, degree_v: int, *patches: int) -> Array:
    """A rational net without any symmetry, weights from 1/2 to 2."""
    net = random.uniform(-1.0, 1.0, (*patches, degree_u + 1, degree_v + 1, 4))
    net[..., 3] = random.uniform(0.5, 2.0, net.shape[:-1])
    return net
