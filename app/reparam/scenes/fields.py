"""Fields on Omega = r(square): what is sought, and by which map it is attached to which patches.

    computed   (u,v) -- p --> value                  p a spline: the identity attaches it
    given      (u,v) -- r --> (x,y) -- g --> value   r attaches it, the formula is looked up

Either map may be replaced by one that is known at the corners of facets alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..geometry.evaluate import evaluate, project
from ..geometry.extraction import surface_to_bezier
from ..geometry.formula import Formula
from ..geometry.isogeometric import Solution, solve
from ..geometry.net import Array, control_net
from ..geometry.parsing import parse
from ..geometry.planar_maps import R
from .remember import remember

GIVEN = ("cos(2x) exp(y) + x y", "x", "x² − y²", "sin(4x) sin(4y)")
SAMPLES = 8  # steps in a facet where deviations are looked for
RANGE_SAMPLES = 64  # steps over the square where the extreme values are

Function = Callable[[Array, Array], Array]


@dataclass(frozen=True, eq=False)
class Omega:
    """The image of the square under a biquadratic map (3, 3, 4)."""

    net: Array

    def points(self, steps: int) -> tuple[Array, Array]:
        """x and y at so many equal steps in u and in v."""
        t = np.linspace(0.0, 1.0, steps + 1)
        points = project(evaluate(self.net, *np.meshgrid(t, t, indexing="ij")))
        return points[..., 0], points[..., 1]


OF_R = Omega(R)


@remember
def omega_of(points: Array) -> Omega:
    """Omega for the coefficients (13), (3, 3, 2), as they are or edited."""
    return OF_R if np.array_equal(points, R[..., :2]) else Omega(control_net(points))


@dataclass(frozen=True, eq=False)
class Problem:
    """-Laplace p = source on Omega, p = value on its rim; a given g is the value everywhere."""

    omega: Omega
    words: str
    source: Function
    value: Function
    formula: Formula | None = None
    slopes: tuple[Formula, Formula] | None = None

    def gradient(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Of a given g."""
        assert self.slopes is not None
        g_x, g_y = (slope(x=x, y=y) for slope in self.slopes)
        return g_x, g_y


@lru_cache(maxsize=4)
def torsion(omega: Omega = OF_R) -> Problem:
    """The torsion of a shaft with this cross-section."""
    words = "−Δp = 1,  p = 0 on the rim: the torsion of a shaft"
    return Problem(omega, words, lambda x, y: 1.0 + 0.0 * x * y, lambda x, y: 0.0 * x * y)


@lru_cache(maxsize=32)
def given(text: str, omega: Omega = OF_R) -> Problem:
    """g of x and y; it solves -Laplace p = -Laplace g.

    Raises ValueError where it is no formula, or has no value, or no second derivatives, on Omega.
    """
    try:
        formula = parse(text, ("x", "y"))
    except ValueError as fault:
        raise ValueError(f"g: {fault}") from None
    slopes = formula.derivative("x"), formula.derivative("y")
    bends = slopes[0].derivative("x"), slopes[1].derivative("y")

    def value(x: Array, y: Array) -> Array:
        return _finite(formula(x=x, y=y), "values", x, y)

    def source(x: Array, y: Array) -> Array:
        return _finite(-bends[0](x=x, y=y) - bends[1](x=x, y=y), "second derivatives", x, y)

    return Problem(omega, f"g(x, y) = {text}", source, value, formula, slopes)


def _finite(values: Array, what: str, x: Array, y: Array) -> Array:
    bad = ~np.isfinite(values)
    if bad.any():
        place = np.unravel_index(int(np.argmax(bad)), bad.shape)
        at = ", ".join(f"{np.broadcast_to(c, bad.shape)[place]:.4g}" for c in (x, y))
        raise ValueError(f"g: expected finite {what} on Ω, found {values[place]:g} at ({at})")
    return values


@lru_cache(maxsize=16)
def solution(problem: Problem, degree: int, spans: int) -> Solution:
    """The spline. Raises ValueError where r folds."""
    try:
        return solve(problem.omega.net, degree, spans, problem.source, problem.value)
    except ValueError as fault:
        raise ValueError(str(fault).replace("expected a map", "points: expected a map")) from None


COUNTS = (2, 4, 8, 16, 32)  # spans
DEGREES = (1, 2, 3)


@lru_cache(maxsize=4)
def convergence(problem: Problem) -> Array:
    """The L2 errors of the spline and of its gradient: (2, DEGREES, COUNTS)."""
    errors = [
        [solution(problem, d, n).errors(problem.value, problem.gradient) for n in COUNTS]
        for d in DEGREES
    ]
    return np.moveaxis(np.array(errors), -1, 0)


@dataclass(frozen=True, eq=False)
class Field:
    """A field attached to r: nets and maps over `pieces` x `pieces` parts of the square.

    The map leads to the value itself, (p, 0, 0, 1), or to where the formula is looked up; it is
    `exact` if it is to be evaluated at every point. `range` has the least and largest value.
    """

    omega: Omega
    net: Array
    map: Array
    pieces: int
    formula: Formula | None
    exact: bool
    range: tuple[float, float]

    def values(self, map_points: Array) -> Array:
        """What is shown where the map leads to these points (..., 4)."""
        x, y, _ = np.moveaxis(project(map_points), -1, 0)
        return x if self.formula is None else self.formula(x=x, y=y)

    def map_at(self, u: Array, v: Array) -> Array:
        """Points (k, l, 4) of the map at the parameters u (k,) and v (l,) of the square."""
        i, j = (np.minimum((t * self.pieces).astype(int), self.pieces - 1) for t in (u, v))
        maps = self.map.reshape(self.pieces, self.pieces, *self.map.shape[-3:])
        found = np.empty((len(u), len(v), 4))
        for a in np.unique(i):
            for b in np.unique(j):
                rows, columns = np.ix_(i == a, j == b)
                local = np.meshgrid(
                    u[i == a] * self.pieces - a, v[j == b] * self.pieces - b, indexing="ij"
                )
                found[rows, columns] = evaluate(maps[a, b], *local)
        return found


@lru_cache(maxsize=16)
def over_spans(problem: Problem, degree: int, spans: int) -> Field:
    """Computed, and attached by the identity."""
    nets, values = solution(problem, degree, spans).pieces()
    maps = np.zeros((*values.shape, 4))
    maps[..., 0], maps[..., 3] = values, 1.0
    field = Field(problem.omega, nets, maps, spans, None, True, (0.0, 0.0))
    extremes = _extremes(problem) if problem.formula else _seen(field)
    return replace(field, range=extremes)


@lru_cache(maxsize=16)
def attached_by_r(problem: Problem, spans: int = 1) -> Field:
    """Given, and attached by r: interpolated as (x,y) is, (s,t) equals it everywhere."""
    nets = pieces_of(problem.omega, spans)
    extremes = _extremes(problem)
    return Field(problem.omega, nets, nets, spans, problem.formula, False, extremes)


@lru_cache(maxsize=16)
def over_facets(field: Field, facets: int) -> Field:
    """The same where the map is known at the corners of facets, and linear in u and v between."""
    t = np.arange(facets + 1) / facets
    corners = field.map_at(t, t)
    a, b = corners[:-1, :-1], corners[:-1, 1:]
    c, d = corners[1:, :-1], corners[1:, 1:]
    maps = np.stack([np.stack([a, b], -2), np.stack([c, d], -2)], -3).reshape(-1, 2, 2, 4)
    nets = pieces_of(field.omega, facets)
    return replace(field, net=nets, map=maps, pieces=facets, exact=True)


def deviations(field: Field, facets: int) -> tuple[float, float]:
    """How far off the map of `over_facets` is at most, and the value that is shown."""
    t = np.arange(facets * SAMPLES + 1) / (facets * SAMPLES)
    true, linear = field.map_at(t, t), over_facets(field, facets).map_at(t, t)
    off = np.linalg.norm(project(linear) - project(true), axis=-1)
    return float(off.max()), float(np.abs(field.values(linear) - field.values(true)).max())


def deviation_words(field: Field, facets: int) -> str:
    """The same as a line."""
    place, value = deviations(field, facets)
    low, high = field.range
    share = f"{value / (high - low):.1%} of the range"
    if field.formula is None:
        return f"p is off by up to {value:.2g}: {share}"
    return f"(s, t) is off by up to {place:.2g}, g by {value:.2g}: {share}"


@lru_cache(maxsize=16)
def pieces_of(omega: Omega, pieces: int) -> Array:
    """r over the parts of the square: (pieces^2, 3, 3, 4)."""
    ends, cuts = np.repeat([0.0, 1.0], 3), np.arange(1, pieces) / pieces
    return surface_to_bezier((ends, ends), omega.net, (3, 3), (cuts, cuts)).patches()


def _extremes(problem: Problem) -> tuple[float, float]:
    """The least and largest given value on Omega."""
    return _apart(problem.value(*problem.omega.points(RANGE_SAMPLES)))


def _seen(field: Field) -> tuple[float, float]:
    t = np.linspace(0.0, 1.0, RANGE_SAMPLES + 1)
    return _apart(field.values(field.map_at(t, t)))


def _apart(values: Array) -> tuple[float, float]:
    """Two different numbers, for a constant field too."""
    low, high = float(values.min()), float(values.max())
    gap = 1e-6 * max(abs(low), abs(high), 1.0)
    return (low, high) if high - low > gap else (low - 0.5, high + 0.5)


@lru_cache(maxsize=16)
def square_pieces(pieces: int) -> Array:
    """The pieces of the parameter square, seen as r is: u down, v to the right."""
    t = np.arange(pieces + 1) / pieces
    corner = np.stack(np.meshgrid(1.0 - t, t, indexing="ij")[::-1], -1)
    a, b = corner[:-1, :-1], corner[:-1, 1:]
    c, d = corner[1:, :-1], corner[1:, 1:]
    return control_net(
        np.stack([np.stack([a, b], -2), np.stack([c, d], -2)], -3).reshape(-1, 2, 2, 2)
    )


@lru_cache(maxsize=16)
def square_domains(pieces: int) -> Array:
    """u0, u1, v0, v1 of the same pieces: (pieces^2, 4)."""
    t = np.arange(pieces + 1) / pieces
    i, j = np.divmod(np.arange(pieces * pieces), pieces)
    return np.stack([t[i], t[i + 1], t[j], t[j + 1]], -1)
