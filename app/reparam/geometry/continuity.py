"""How smoothly two curves join: the highest G^k, and the derivatives of the change of variables.

Jorg Peters, "Change of variables" (2012), equations (7) to (11). A piece f that ends where a
piece g starts joins it G^k if a change of variables r, with r' > 0, makes the derivatives agree:

    f^(m) = (g o r)^(m) = sum_j B_{m,j}(r', r'', ...) g^(j),      m = 1 .. k,

B_{m,j} being the partial Bell polynomials (Faa di Bruno). Order m is linear in its one new
unknown r^(m), so they are found one after another, up to the first order without a solution.
Ends where a first derivative vanishes are judged by their image (`singular.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import atan2, comb, degrees, factorial

import numpy as np
from numpy.typing import ArrayLike

from .jets import Jet, Number, Numbers, Values, exceeds, rational_jet
from .singular import image_order, leading

TOLERANCE = 1e-9  # of floats, beside what was added up; fractions have none


@dataclass(frozen=True)
class Joint:
    """What was found where a piece f ends and a piece g starts.

    `order`: the largest k such that they join G^k, at most the one asked for; -1 if they do not
    meet. `derivatives`: r', r'', ... up to that order. `reason`: why the order is not higher;
    empty if all that was asked for holds. `turn`: the angle in degrees from the direction of
    arrival to that of departure. `exponents`: the powers of the parameter with which f arrives
    and g leaves; unless both are 1 the joint is not regular, there is no r to speak of, and
    `order` tells how smooth the image is.
    """

    order: int
    reason: str = ""
    derivatives: tuple[Number, ...] = ()
    turn: float = 0.0
    exponents: tuple[int, int] = (1, 1)

    @property
    def parametric(self) -> int:
        """The largest k such that the derivatives themselves agree: C^k, with r' = 1, r'' = 0 .."""
        wanted = (1, *[0] * len(self.derivatives))
        agree = [abs(x - y) < 1e-9 for x, y in zip(self.derivatives, wanted, strict=False)]
        return min(self.order, [*agree, False].index(False))

    @property
    def regular(self) -> bool:
        """Whether neither first derivative vanishes."""
        return self.exponents == (1, 1)

    def told(self) -> str:
        """What was found, in one line."""
        if self.order < 0:
            return f"the pieces do not meet: {self.reason}"
        found = "joined" if self.regular else "the image is"
        found += f" G{self.order}" + ("" if self.reason else " at least")
        if self.derivatives:
            values = ", ".join(_short(value) for value in self.derivatives)
            found += f": r′, r″, … = {values}"
        return f"{found}; {self.reason}" if self.reason else found


def join_curves(
    f: Values,
    g: Values,
    order: int = 5,
    tolerance: float = TOLERANCE,
    widths: tuple[Number, Number] = (1, 1),
) -> Joint:
    """The joint of two rational Bezier curves, f at its end with g at its start.

    Nets (m, d + 1) and (n, d + 1), premultiplied, the last coordinate the weight; `widths` are
    the lengths of their parameter intervals.
    """
    before, after = rational_jet(f, 1, order, widths[0]), rational_jet(g, 0, order, widths[1])
    exponents = leading(before, tolerance), leading(after, tolerance)
    enough = order * max(*exponents, 1)
    if enough > order:
        before = rational_jet(f, 1, enough, widths[0])
        after = rational_jet(g, 0, enough, widths[1])
    return join(before, after, order, tolerance)


def join(f: Jet, g: Jet, order: int = 5, tolerance: float = TOLERANCE) -> Joint:
    """The joint of a piece that arrives with jet f and one that leaves with jet g.

    Raises ValueError if a jet knows fewer derivatives than `order`, or lies in another space.
    """
    if min(f.order, g.order) < order:
        raise ValueError(f"expected jets of order {order}, found {f.order} and {g.order}")
    if f.derivatives.shape[1] != g.derivatives.shape[1]:
        found = f"{f.derivatives.shape[1]} and {g.derivatives.shape[1]}"
        raise ValueError(f"expected curves in one space, found dimensions {found}")
    if not (f.exact and g.exact):
        f, g = _floats(f), _floats(g)
    gap = f.derivatives[0] - g.derivatives[0]
    if exceeds(gap, f.sizes[1] + g.sizes[1], tolerance):
        return Joint(-1, f"the ends are {_length(gap):.3g} apart")
    p, q = leading(f, tolerance), leading(g, tolerance)
    if not p or not q:
        return Joint(0, "a piece is a single point as far as its derivatives tell", (), 0.0, (p, q))
    arrival, departure = f.derivatives[p] * (-1) ** (p - 1), g.derivatives[q]
    turn = angle(arrival, departure)
    aligned = not exceeds(
        _across(arrival, departure), f.sizes[p] + _stretch(f, g, p, q) * g.sizes[q], tolerance
    )
    if not aligned or np.dot(arrival, departure) < 0:
        turned = f"the direction turns by {turn:.6g} degrees"
        reason = "the tangents are opposed: a cusp" if aligned else turned
        return Joint(0, reason, (), turn, (p, q))
    if (p, q) == (1, 1):
        return _regular(f, g, order, tolerance)
    known, reason = image_order(f, g, (p, q), order, tolerance)
    return Joint(known, reason, (), 0.0, (p, q))


def _regular(f: Jet, g: Jet, order: int, tolerance: float) -> Joint:
    tangent = g.derivatives[1]
    change: list[Number] = []
    for m in range(1, order + 1):
        row = bell([*change, 0], m)
        rest = f.derivatives[m] - sum(row[j] * g.derivatives[j] for j in range(2, m + 1))
        newest = np.dot(rest, tangent) / np.dot(tangent, tangent)
        newest = newest if f.exact else float(newest)
        size = f.sizes[m] + abs(newest) * g.sizes[1]
        size += sum(abs(row[j]) * g.sizes[j] for j in range(2, m + 1))
        missed = rest - newest * tangent
        if exceeds(missed, size, tolerance):
            reason = f"order {m} fails, by {_length(missed):.3g} across the tangent"
            return Joint(m - 1, reason, tuple(change))
        change.append(newest)
    return Joint(order, "", tuple(change))


def composed(g: Jet, change: Sequence[Number]) -> Jet:
    """The jet of g o r from r', r'', .., as many as g has: series put into each other (Horner)."""
    one = Fraction(1) if g.exact else 1.0
    count = g.order + 1
    r = np.array([0 * one] + [one * x / factorial(m) for m, x in enumerate(change, 1)])[:count]
    columns = []
    for column in g.derivatives.T:
        coefficients = [x * one / factorial(m) for m, x in enumerate(column)]
        total = np.array([0 * one])
        for coefficient in reversed(coefficients):
            total = np.convolve(total, r)[:count]
            total[0] += coefficient
        columns.append([x * factorial(m) for m, x in enumerate(total)])
    values = np.array(columns).T
    return Jet(values, np.abs(values).max(1))


def bell(derivatives: list[Number], m: int) -> list[Number]:
    """Partial Bell polynomials B_{m,j}(x_1, x_2, ..), j = 0..m, of at least m numbers x.

    B_{m,j} = sum_i C(m-1, i-1) x_i B_{m-i, j-1}: what g^(j) is multiplied by in (g o r)^(m).
    """
    rows: list[list[Number]] = [[1]]
    for n in range(1, m + 1):
        row: list[Number] = [0]
        for j in range(1, n + 1):
            terms = range(1, n - j + 2)
            row.append(
                sum(comb(n - 1, i - 1) * derivatives[i - 1] * rows[n - i][j - 1] for i in terms)
            )
        rows.append(row)
    return rows[m]


def angle(a: ArrayLike, b: ArrayLike) -> float:
    """Degrees between two directions, accurate for the smallest: 2 atan2(|a' - b'|, |a' + b'|)."""
    first, second = (np.asarray(x, dtype=np.float64) for x in (a, b))
    first, second = first / _length(first), second / _length(second)
    return degrees(2.0 * atan2(_length(first - second), _length(first + second)))


def _across(a: Numbers, b: Numbers) -> Numbers:
    """What of a is not along b."""
    return np.asarray(a - np.dot(a, b) / np.dot(b, b) * b)


def _stretch(f: Jet, g: Jet, p: int, q: int) -> Number:
    return _length(f.derivatives[p]) / _length(g.derivatives[q])


def _length(vector: Numbers) -> float:
    return float(np.linalg.norm(np.asarray(vector, dtype=np.float64)))


def _floats(jet: Jet) -> Jet:
    return Jet(jet.derivatives.astype(np.float64), jet.sizes.astype(np.float64))


def _short(value: Number) -> str:
    if isinstance(value, Fraction):
        return str(value)
    return "0" if abs(value) < 1e-9 else f"{value:.6g}".replace("-", "−")
