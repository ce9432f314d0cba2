"""Pythagorean-hodograph curves: polynomial curves whose speed is a polynomial too.

Jorg Peters, "Change of variables" (2012), on arc length; R. T. Farouki, "Pythagorean-Hodograph
Curves" (2008). The plane is taken for the complex numbers: if the derivative is a square,

    x' + i y' = w(u)^2,    then    |x'| = |w|^2,

so speed, arc length and length are polynomials in closed form. w linear gives cubics, w
quadratic gives quintics, four of which fit any end points and end derivatives.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise, product
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import bernstein, bernstein_derivative

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Polynomial = list[Fraction]  # coefficients of 1, u, u^2, ..; the last one is not zero

NODES = 64  # of Gauss-Legendre for the bending energy


@dataclass(frozen=True, eq=False)
class PythagoreanCurve:
    """A curve x' + i y' = w^2 from `start` on; `preimage`: Bernstein coefficients of w."""

    preimage: Complex
    start: complex = 0.0

    @cached_property
    def points(self) -> Array:
        """Its Bezier points (2 m + 2, 2), m the degree of w."""
        hodograph = multiply(self.preimage, self.preimage)
        steps = np.cumsum(hodograph / len(hodograph))
        points = self.start + np.concatenate([[0.0], steps])
        return np.stack([points.real, points.imag], -1)

    @cached_property
    def speed(self) -> Array:
        """Bernstein coefficients (2 m + 1,) of the speed |w|^2."""
        return np.asarray(multiply(self.preimage, self.preimage.conj()).real)

    @property
    def length(self) -> float:
        """The length: the mean of the speed's coefficients."""
        return float(self.speed.mean())

    def arc_length(self, t: ArrayLike) -> Array:
        """The length from 0 to t, a polynomial of degree 2 m + 1, exact up to rounding."""
        sums = np.concatenate([[0.0], np.cumsum(self.speed)]) / len(self.speed)
        return np.asarray(bernstein(len(self.speed), t) @ sums)

    def bending(self) -> float:
        """The integral of curvature^2 over the arc length; infinite where the curve stops."""
        if self._stops():
            return np.inf
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        t, degree = (nodes + 1.0) / 2.0, len(self.preimage) - 1
        w = bernstein(degree, t) @ self.preimage
        slope = bernstein_derivative(degree, t) @ self.preimage
        turning, size = (w.conj() * slope).imag, np.abs(w)
        return float(weights / 2.0 @ (4.0 * turning**2 / size**6))  # curvature 2 turning / size^4

    def _stops(self) -> bool:
        """Whether w vanishes on the way."""
        degree = len(self.preimage) - 1
        powers = [comb(degree, k) * np.diff(self.preimage, k)[0] for k in range(degree + 1)]
        zeros = np.roots(powers[::-1])
        near = (np.abs(zeros.imag) <= 1e-9) & (zeros.real >= -1e-9) & (zeros.real <= 1 + 1e-9)
        return bool(near.any())


def multiply(a: ArrayLike, b: ArrayLike) -> Complex:
    """The Bernstein coefficients of a product of two polynomials given by theirs."""
    a, b = np.asarray(a, dtype=np.complex128), np.asarray(b, dtype=np.complex128)
    m, n = len(a) - 1, len(b) - 1
    scaled = np.convolve(
        a * [comb(m, i) for i in range(m + 1)], b * [comb(n, j) for j in range(n + 1)]
    )
    return np.asarray(scaled / [comb(m + n, k) for k in range(m + n + 1)])


def hermite_solutions(
    start: complex, end: complex, leaves: complex, arrives: complex
) -> Iterator[PythagoreanCurve]:
    """The four quintics with these end points and end derivatives (complex numbers).

    w_0^2 = leaves, w_2^2 = arrives, and 4 w_1 = -3 (w_0 + w_2) +- sqrt(120 (end - start) -
    15 (w_0^2 + w_2^2) + 10 w_0 w_2), up to a common sign. (Farouki and Neff, Hermite
    interpolation by Pythagorean hodograph quintics, 1995.) Raises ValueError if an end
    derivative vanishes.
    """
    if not leaves or not arrives:
        raise ValueError(f"expected end derivatives other than 0, found {leaves} and {arrives}")
    for first, root in product((1, -1), (1, -1)):
        w0, w2 = first * np.sqrt(complex(leaves)), np.sqrt(complex(arrives))
        inside = 120.0 * (end - start) - 15.0 * (w0 * w0 + w2 * w2) + 10.0 * w0 * w2
        w1 = (-3.0 * (w0 + w2) + root * np.sqrt(complex(inside))) / 4.0
        yield PythagoreanCurve(np.array([w0, w1, w2]), start)


def hermite(start: complex, end: complex, leaves: complex, arrives: complex) -> PythagoreanCurve:
    """The one of the four quintics that bends least."""
    return min(hermite_solutions(start, end, leaves, arrives), key=lambda curve: curve.bending())


def exact_points(preimage: Sequence[tuple[int | Fraction, int | Fraction]]) -> list[list[Fraction]]:
    """The Bezier points, from the origin on, for Bernstein coefficients (re, im) of w: exactly."""
    degree = len(preimage) - 1
    sums = [[Fraction(0), Fraction(0)] for _ in range(2 * degree + 1)]
    for (i, (a, b)), (j, (c, d)) in product(enumerate(preimage), enumerate(preimage)):
        share = Fraction(comb(degree, i) * comb(degree, j), comb(2 * degree, i + j))
        sums[i + j][0] += share * (a * c - b * d)
        sums[i + j][1] += share * (a * d + b * c)
    points = [[Fraction(0), Fraction(0)]]
    for x, y in sums:
        points.append([points[-1][0] + x / len(sums), points[-1][1] + y / len(sums)])
    return points


def is_pythagorean(points: Sequence[Sequence[int | Fraction]]) -> bool:
    """Whether the Bezier curve of rational points (n, 2) has a polynomial speed: a proof.

    It has if and only if every factor of x'^2 + y'^2 has an even multiplicity.
    """
    factors = multiplicities(squared_speed(points))
    return all(degree == 0 or index % 2 == 0 for index, degree in enumerate(factors, 1))


def squared_speed(points: Sequence[Sequence[int | Fraction]]) -> Polynomial:
    """x'^2 + y'^2 of a Bezier curve with rational points (n, 2), in powers of u."""
    total: Polynomial = []
    for axis in zip(*points, strict=True):
        steps = [Fraction(b) - Fraction(a) for a, b in pairwise(axis)]
        degree = len(steps) - 1
        slope = []
        for m in range(degree + 1):
            differences = sum((-1) ** (m - i) * comb(m, i) * steps[i] for i in range(m + 1))
            slope.append((degree + 1) * comb(degree, m) * Fraction(differences))
        square = [Fraction(0)] * (2 * degree + 1)
        for (i, a), (j, b) in product(enumerate(slope), enumerate(slope)):
            square[i + j] += a * b
        total = [a + b for a, b in zip(total or [Fraction(0)] * len(square), square, strict=True)]
    return _trimmed(total)


def multiplicities(polynomial: Polynomial) -> list[int]:
    """The degree of the product of all factors of multiplicity 1, 2, ..: Yun's algorithm (1976).

    [4] is square-free of degree 4, [0, 2] the square of two factors or of one of degree 2.
    """
    if not polynomial:
        raise ValueError("expected a polynomial other than 0")
    slope = _derivative(polynomial)
    common = _gcd(polynomial, slope)
    rest, other = _divide(polynomial, common)[0], _divide(slope, common)[0]
    degrees = []
    while len(rest) > 1:
        other = _subtract(other, _derivative(rest))
        factor = _gcd(rest, other)
        degrees.append(len(factor) - 1)
        rest, other = _divide(rest, factor)[0], _divide(other, factor)[0]
    return degrees


def _trimmed(p: Polynomial) -> Polynomial:
    while p and not p[-1]:
        p = p[:-1]
    return p


def _derivative(p: Polynomial) -> Polynomial:
    return [i * x for i, x in enumerate(p)][1:]


def _subtract(a: Polynomial, b: Polynomial) -> Polynomial:
    size = max(len(a), len(b))
    first, second = (p + [Fraction(0)] * (size - len(p)) for p in (a, b))
    return _trimmed([x - y for x, y in zip(first, second, strict=True)])


def _divide(a: Polynomial, b: Polynomial) -> tuple[Polynomial, Polynomial]:
    quotient = [Fraction(0)] * max(len(a) - len(b) + 1, 0)
    while len(a) >= len(b):
        shift = len(a) - len(b)
        quotient[shift] = a[-1] / b[-1]
        a = _subtract(a, [Fraction(0)] * shift + [quotient[shift] * x for x in b])
    return quotient, a


def _gcd(a: Polynomial, b: Polynomial) -> Polynomial:
    while b:
        a, b = b, _divide(a, b)[1]
    return [x / a[-1] for x in a]
