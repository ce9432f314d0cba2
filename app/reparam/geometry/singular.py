"""Ends of curves where the first derivative vanishes: how smooth is the image?

Jorg Peters, "Change of variables" (2012), after equation (11): that a derivative vanishes says
nothing about the image, which may have a corner, a cusp, or no fault at all. Near such an end
the curve is x(h) = v h^p + ..., h > 0 the distance of the parameter. Let s be the coordinate
along v, a power h^p (1 + ...) of h; then s^(1/p) is a regular change of variables, and in it

    x = v s + sum_j n_j s^(j/p),       n_j across v.

If n_j vanishes unless p divides j, the image is as smooth as any regular curve; else the first
other j spoils the derivatives from j/p on. Both sides of a joint, each with its own power, are
graphs over the same tangent, and joined as smoothly as the coefficients n agree.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import numpy as np

from .jets import Jet, Number, Numbers, exceeds


def leading(jet: Jet, tolerance: float) -> int:
    """The order of the first derivative that does not vanish; 0 if none is known."""
    for m in range(1, jet.order + 1):
        if exceeds(jet.derivatives[m], jet.sizes[m], tolerance):
            return m
    return 0


def image_order(
    f: Jet, g: Jet, exponents: tuple[int, int], order: int, tolerance: float
) -> tuple[int, str]:
    """The highest derivative, at most `order`, that the images of two pieces share at a joint.

    f arrives and g leaves in the same direction, with these powers. Returns the order and why
    it is not higher. Orders beyond what the jets know are not claimed.
    """
    p, q = exponents
    direction = g.derivatives[q] / factorial(q)
    before, before_sizes, stretch = graph(f, p, direction, arrives=True)
    after, after_sizes, _ = graph(g, q, direction, arrives=False)
    for m in range(1, order + 1):
        if m * p >= len(before) or m * q >= len(after):
            return m - 1, f"order {m} needs derivatives up to {m * max(p, q)}"
        for values, sizes, power in ((before, before_sizes, p), (after, after_sizes, q)):
            for j in range((m - 1) * power + 1, m * power):
                if exceeds(values[j], sizes[j], tolerance):
                    return m - 1, f"order {m} fails: the image bends like s^({j}/{power})"
        here = before[m * p] / stretch**m
        size = before_sizes[m * p] / abs(stretch) ** m + after_sizes[m * q]
        if exceeds(here - after[m * q], size, tolerance):
            return m - 1, f"order {m} of the image fails"
    return order, ""


def graph(jet: Jet, p: int, direction: Numbers, arrives: bool) -> tuple[Numbers, Numbers, Number]:
    """The curve as coefficients n_j across `direction`, of powers sigma^j.

    The coordinate along `direction` is stretch * sigma^p. Returns n (k + 1, d), the sizes of
    what each was computed from, and stretch, which is negative for a curve that arrives.
    By Lagrange's inversion, [sigma^n] h^j = j/n [h^(n-j)] (sigma/h)^(-n).
    """
    one = Fraction(1) if jet.exact else 1.0
    signs = [(-1) ** m if arrives else 1 for m in range(jet.order + 1)]
    scale = np.array([sign * one / factorial(m) for m, sign in enumerate(signs)])
    series = jet.derivatives * scale[:, None]
    sizes = jet.sizes * np.abs(scale)
    series[0] *= 0
    along = series @ direction / np.dot(direction, direction)
    stretch = along[p]
    unit = along[p:] / stretch
    across = series - along[:, None] * direction
    if not jet.exact:
        sizes = sizes * 2.0  # of what was taken away, too
    found, magnitudes = [series[0]] * p, [sizes[0] * 0] * p
    for n in range(p, jet.order + 1):
        powers = power(unit[: n - p + 1], -n * one / p)
        weights = [j * powers[n - j] / n for j in range(p, n + 1)]
        found.append(sum(w * across[j] for j, w in enumerate(weights, p)))
        magnitudes.append(sum(abs(w) * sizes[j] for j, w in enumerate(weights, p)))
    return np.array(found), np.array(magnitudes), stretch


def power(series: Numbers, exponent: Number) -> list[Number]:
    """The coefficients of (1 + a_1 h + ...)^exponent, as many as given.

    n b_n = sum_k (k exponent - n + k) a_k b_{n-k} (Euler; Knuth, TAOCP 2, section 4.7).
    """
    found: list[Number] = [series[0]]
    for n in range(1, len(series)):
        terms = ((k * exponent - n + k) * series[k] * found[n - k] for k in range(1, n + 1))
        found.append(sum(terms) / n)
    return found
