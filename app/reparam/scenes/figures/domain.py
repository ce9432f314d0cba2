"""A field on Omega = r(square): computed in the functions that parameterise it, shown on both.

A computed field is a spline on the square, so the identity attaches it; a given one is a function
of (x, y), so r does. Where r is known at the corners of facets alone, neither is what it was.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Literal

import numpy as np

from ...geometry.distortion import distortions
from ...geometry.net import control_net
from ...geometry.planar_maps import R
from .. import palette
from ..claims import Claim, Measure
from ..drawing import words
from ..fields import (
    COUNTS,
    DEGREES,
    GIVEN,
    Field,
    Omega,
    attached_by_r,
    convergence,
    deviation_words,
    deviations,
    given,
    omega_of,
    over_facets,
    over_spans,
    solution,
    square_domains,
    square_pieces,
    torsion,
)
from ..handles import COEFFICIENTS, Coefficients, net_handles
from ..layers import (
    Array,
    Color,
    ControlNet,
    Figure,
    IsoLines,
    Label,
    Layer,
    Patches,
    Ramp,
    Space,
    Texture,
    including,
    plane,
)
from ..parameters import Presets, Range
from ..plots import Plot
from ..registry import scene
from ..remember import remember
from ..shading import SQUARE

GRID: Color = (0.35, 0.35, 0.35)
WAVE = GIVEN[0]
EXACT = 1e-11  # errors below are those of arithmetic


@scene(
    "A field on Ω = r(square), by the functions that parameterise it",
    plates=(
        ("field=torsion",),
        ("field=given", "attach=r"),
        ("show=facets",),
        ("shading=area", "lines=0"),
    ),
)
def domain(
    field: Annotated[
        Literal["torsion", "given"], "−Δp = 1, or the p that has −Δp = −Δg and is g on the rim"
    ] = "torsion",
    g: Annotated[str, Presets(GIVEN), "the given field, a formula in x and y"] = WAVE,
    attach: Annotated[
        Literal["identity", "r"], "the computed field by the identity, or the given one by r"
    ] = "identity",
    show: Annotated[
        Literal["field", "facets", "rates"],
        "square and Ω; or Ω with the map linear over facets, and exact; or errors over spans",
    ] = "field",
    degree: Annotated[int, Range(1, 5), "of the splines that the field is sought in"] = 2,
    spans: Annotated[int, Range(1, 32), "pieces of the square in u and in v"] = 8,
    facets: Annotated[int, Range(1, 32), "facets in u and in v"] = 4,
    contours: Annotated[int, Range(0, 64, 2), "lines of equal values, and one"] = 12,
    lines: Annotated[bool, "the edges of pieces and facets"] = True,
    points: Coefficients = COEFFICIENTS,
) -> Figure:
    if field == "torsion" and (attach == "r" or show == "rates"):
        name, expected = (
            ("show", "field or facets") if attach == "identity" else ("attach", "identity")
        )
        needs = show if name == "show" else attach
        raise ValueError(
            f"{name}: expected {expected}, since torsion is computed; {needs} needs field=given"
        )
    omega = omega_of(points)
    other = given(g, omega)  # a formula that is none is refused at once
    sought = torsion(omega) if field == "torsion" else other
    seen = (
        over_spans(sought, degree, spans) if attach == "identity" else attached_by_r(sought, spans)
    )
    ramp = Ramp(*seen.range, seen.formula, contours)
    whole = (
        *on_omega(seen, ramp, lines),
        ControlNet(omega.net, palette.CONTROL_NET),
        net_handles("points", omega.net),
    )
    if show == "facets":
        faceted = on_omega(over_facets(seen, facets), ramp, lines)
        return Figure(facets_beside(seen, facets, faceted, whole), (sought.words,))
    told = f"{spans + degree} × {spans + degree} splines of degree {degree}"
    if attach == "r":
        told = "given, and attached by r"
    elif field == "given":
        off = solution(sought, degree, spans).errors(sought.value, sought.gradient)
        told += f":  ‖p − g‖ = {off[0]:.1e},  ‖grad p − grad g‖ = {off[1]:.1e}"
    on_the_right = Space("physical", room_for(omega), whole, title="on Ω = r(square)")
    if show == "rates":
        spaces = (*rates(convergence(sought), degree, spans), on_the_right)
    else:
        spaces = (*on_the_square(seen, ramp, lines), on_the_right)
    return Figure(spaces, (sought.words, told))


def on_the_square(seen: Field, ramp: Ramp, lines: bool) -> tuple[Space, Space]:
    """The field on its parameters, and beneath it what its colours mean."""
    square = square_pieces(seen.pieces)
    rim = IsoLines(square, u=(0.0, 1.0), v=(0.0, 1.0), color=GRID, width=0.6)
    patches = Patches(square, Texture(seen.map, ramp, exact=True))
    bounds = plane(-0.02, -0.02, 1.02, 1.02)
    layers: tuple[Layer, ...] = (patches, *([rim] if lines else []))
    return Space("domain", bounds, layers, title="on the square", width=0.8), bar(*seen.range)


def facets_beside(
    seen: Field, facets: int, faceted: tuple[Layer, ...], whole: tuple[Layer, ...]
) -> tuple[Space, ...]:
    """Omega by the map over facets and by the map itself, and how far the first is off."""
    number = Label(deviation_words(seen, facets), (0.5, 0.5, 0.0), size=15.0)
    title = f"the map linear over {facets} × {facets} facets"
    return (
        Space("words", plane(0.0, 0.0, 1.0, 1.0), (number,), height=0.16),
        Space("physical facets", room_for(seen.omega), faceted, title=title, below=True),
        replace(bar(*seen.range), below=False),
        Space("physical", room_for(seen.omega), whole, title="the map as it is", below=True),
    )


def rates(errors: Array, degree: int, spans: int) -> tuple[Space, Space]:
    """Errors over the number of spans, for each degree; the one that is shown is marked."""
    plots: list[Space] = []
    errors = np.maximum(errors, 1e-16)
    range_of_both = (float(errors.min()) / 3.0, 3.0 * float(errors.max()))
    for name, one in zip(("‖p − g‖", "‖grad p − grad g‖"), errors, strict=True):
        plot = Plot((1.0, 100.0), range_of_both, "spans", name, log=True, size=(1.0, 1.0))
        layers: list[Layer] = []
        for line, color in zip(one, palette.PIECES, strict=True):
            layers += [plot.curve(COUNTS, line, color), plot.dots(COUNTS, line, color)]
        exact = int(np.count_nonzero(one[:, -1] < EXACT))  # and so are the degrees above
        for d, line in zip(DEGREES[: len(DEGREES) + 1 - max(exact, 1)], one, strict=False):
            at = plot.at([COUNTS[-1]], [line[-1]])[0]
            rate = np.log2(line[-2] / line[-1])
            text = f"degree {d}:  {rate:.2f}" if line[-1] > EXACT else f"degree ≥ {d}:  exact"
            layers.append(words(text, at, offset=(6.0, 0.0), anchor=(0.0, 0.5), size=13.0))
        if degree in DEGREES and spans in COUNTS:
            here = one[DEGREES.index(degree), COUNTS.index(spans)]
            layers.append(plot.dots([spans], [here], palette.MOVING, 5.0))
        plots.append(plot.space(*layers, name=f"plot {len(plots)}"))
    return plots[0], plots[1]


@remember
def room_for(omega: Omega) -> Array:
    """The bounds of r's own image, and of an edited one if it is larger."""
    return including(plane(-1.5, -1.5, 1.5, 1.5), omega.net)


def on_omega(seen: Field, ramp: Ramp, lines: bool) -> tuple[Layer, ...]:
    """The field on Omega, with the edges of its pieces if asked."""
    edges = IsoLines(seen.net, u=(0.0, 1.0), v=(0.0, 1.0), color=GRID, width=0.6)
    outline = IsoLines(seen.omega.net, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.8)
    patches = Patches(
        seen.net, Texture(seen.map, ramp, seen.exact), domains=square_domains(seen.pieces)
    )
    return (patches, *([edges] if lines and seen.pieces > 1 else []), outline)


def bar(low: float, high: float) -> Space:
    """The ramp with its numbers."""
    strip = control_net([[(0.0, 0.05), (1.0, 0.05)], [(0.0, 0.0), (1.0, 0.0)]])
    ends = (
        Label(f"{value:.3g}".replace("-", "−"), (x, -0.02, 0.0), anchor=(x, 1.0), size=13.0)
        for x, value in ((0.0, low), (1.0, high))
    )
    layers: tuple[Layer, ...] = (Patches(strip, Texture(strip, Ramp(0.0, 1.0))), *ends)
    return Space("bar", plane(-0.04, -0.13, 1.04, 0.06), layers, height=0.16, below=True)


@domain.claims
def claims() -> Iterator[Claim]:
    wave = given(WAVE)
    for degree in (1, 2, 3):
        errors = np.array(
            [solution(wave, degree, n).errors(wave.value, wave.gradient) for n in (16, 32)]
        )
        rates = np.log2(errors[0] / errors[1]).tolist()
        statement = f"degree {degree}, 16 to 32 spans: rates of the L2 and of the gradient's error"
        yield Claim("Ω", statement, [degree + 1.0, float(degree)], rates, 0.08)
    centre = solution(torsion(), 2, 16).at(0.5, 0.5)
    yield Claim("Ω", "torsion, degree 2, 16 spans: p in the centre", 0.52870, centre, 1e-5)
    inner = COEFFICIENTS.copy()
    inner[1, 1] = 0.33, -0.25
    largest = over_spans(torsion(omega_of(inner)), 2, 16).range[1]
    statement = "c11 moved, another r of the same Ω: the largest p, by samples"
    yield Claim("Ω", statement, 0.52870, largest, 2e-4)
    linear = given("2x − 3y + 1")
    off = solution(linear, 2, 4).errors(linear.value, linear.gradient)
    statement = "p = 2x − 3y + 1 is among the splines of degree 2: errors of p and of its gradient"
    yield Claim("Ω", statement, [0.0, 0.0], list(off), 1e-12)
    statement = (
        "p = x computed, by the identity, and given, by r: largest difference of a grey level"
    )
    yield Claim("Ω", statement, 0.0, attached_both_ways, 2.0)
    fall = tuple(deviations(attached_by_r(given("x")), n)[1] for n in (1, 2, 4, 8))
    statement = "x by the map linear over n × n facets, n = 1, 2, 4, 8: off by 1/(2n²)"
    yield Claim("Ω", statement, [0.5, 0.125, 0.03125, 0.0078125], list(fall), 1e-12)
    fall = tuple(deviations(over_spans(torsion(), 2, 16), n)[1] for n in (8, 16))
    statement = "torsion over 8 × 8 and 16 × 16 facets: the deviation falls by the factor"
    yield Claim("Ω", statement, 4.0, fall[0] / fall[1], 0.3)
    u, v = np.array([0.5, 0.0, 0.5]), np.array([0.5, 0.5, 1.0])
    areas = np.exp2(distortions(R, SQUARE, u, v)[..., 0]).tolist()
    statement = "the Jacobian's area in the middle of the square and of two of its sides"
    yield Claim("Ω", statement, [9.0, 6.0, 6.0], areas, 1e-12)


def attached_both_ways(measure: Measure) -> float:
    pictures = [
        measure.picture("domain", (192, 192), field="given", g="x", attach=attach, contours=0)
        for attach in ("identity", "r")
    ]
    return float(np.abs(pictures[0].astype(int) - pictures[1]).max())
