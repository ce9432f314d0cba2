"""A field on Omega = r(square): computed in the functions that parameterise it, shown on both.

A computed field is a spline on the square, so the identity attaches it; a given one is a function
of (x, y), so r does. Both pictures of the same field are the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Annotated, Literal

import numpy as np

from ...geometry.isogeometric import Solution, solve
from ...geometry.net import Array, control_net
from ...geometry.planar_maps import R
from .. import palette
from ..claims import Claim, Measure
from ..layers import Color, Figure, IsoLines, Label, Layer, Patches, Picture, Space, Texture, plane
from ..parameters import Range
from ..registry import scene

Field = Literal["torsion", "wave", "x"]
RAMP = Picture("ramp", scale=1.0, offset=0.0, wrap="mirror")
GRID: Color = (0.35, 0.35, 0.35)
WORDS = {
    "torsion": "−Δp = 1,  p = 0 on the rim: the torsion of a shaft",
    "wave": "−Δp = 3 cos(2x) exp(y),  whose solution is cos(2x) exp(y) + xy",
    "x": "p = x",
}


def wave(x: Array, y: Array) -> Array:
    return np.asarray(np.cos(2.0 * x) * np.exp(y) + x * y)


def wave_source(x: Array, y: Array) -> Array:
    return np.asarray(3.0 * np.cos(2.0 * x) * np.exp(y))


def wave_gradient(x: Array, y: Array) -> tuple[Array, Array]:
    return -2.0 * np.sin(2.0 * x) * np.exp(y) + y, np.cos(2.0 * x) * np.exp(y) + x


Function = Callable[[Array, Array], Array]
PROBLEMS: dict[str, tuple[Function, Function]] = {  # source, values on the rim
    "torsion": (lambda x, y: 1.0 + 0.0 * x * y, lambda x, y: 0.0 * x * y),
    "wave": (wave_source, wave),
    "x": (lambda x, y: 0.0 * x * y, lambda x, y: x + 0.0 * y),
}


@scene(
    "A field on Ω = r(square), by the functions that parameterise it",
    plates=(("field=torsion",), ("field=wave",)),
)
def domain(
    field: Annotated[Field, "what is solved for, or x itself"] = "torsion",
    attach: Annotated[
        Literal["identity", "r"], "the computed field by the identity, or (x alone) the given by r"
    ] = "identity",
    degree: Annotated[int, Range(1, 5), "of the splines that the field is sought in"] = 2,
    spans: Annotated[int, Range(1, 32), "pieces of the square in u and in v"] = 8,
    lines: Annotated[bool, "the pieces' edges"] = True,
) -> Figure:
    if attach == "r" and field != "x":
        raise ValueError(f"attach: expected identity, since {field} is computed; r needs field=x")
    nets, values = solved(field, degree, spans)
    low, high = float(values.min()), float(values.max())
    if attach == "r":
        low, high = -1.5, 1.5
        maps = ramp_net(nets[..., 0], low, high)
    else:
        if field == "x":
            low, high = -1.5, 1.5
        maps = ramp_net(values, low, high)
    square = squares(spans)
    rim = IsoLines(square, u=(0.0, 1.0), v=(0.0, 1.0), color=GRID, width=0.6)
    edges = IsoLines(nets, u=(0.0, 1.0), v=(0.0, 1.0), color=GRID, width=0.6)
    outline = IsoLines(R, u=(0.0, 1.0), v=(0.0, 1.0), color=palette.INK, width=1.8)
    spaces = (
        Space("domain", plane(-0.02, -0.02, 1.02, 1.02),
              (Patches(square, Texture(maps, RAMP)), *([rim] if lines else [])),
              title="on the square: a spline", width=0.8),
        Space("bar", plane(-0.04, -0.13, 1.04, 0.06), bar(low, high), height=0.16, below=True),
        Space("physical", plane(-1.5, -1.5, 1.5, 1.5),
              (Patches(nets, Texture(maps, RAMP)), *([edges] if lines else []), outline),
              title="on Ω = r(square)"),
    )  # fmt: skip
    size = spans + degree
    return Figure(spaces, (WORDS[field], f"{size} × {size} splines of degree {degree}"))


@lru_cache(maxsize=16)
def solution(field: str, degree: int, spans: int) -> Solution:
    """The spline."""
    return solve(R, degree, spans, *PROBLEMS[field])


@lru_cache(maxsize=16)
def solved(field: str, degree: int, spans: int) -> tuple[Array, Array]:
    """r and the field over each pair of spans."""
    return solution(field, degree, spans).pieces()


def ramp_net(values: Array, low: float, high: float) -> Array:
    """Texture nets that take a field from `low` to `high` across the ramp of colours."""
    net = np.zeros((*values.shape, 4))
    net[..., 0] = (values - low) / (high - low if high > low else 1.0) * 0.996 + 0.002
    net[..., 1], net[..., 3] = 0.5, 1.0
    return net


@lru_cache(maxsize=16)
def squares(spans: int) -> Array:
    """The pieces of the parameter square, seen as r is: u down, v to the right."""
    t = np.arange(spans + 1) / spans
    corner = np.stack(np.meshgrid(1.0 - t, t, indexing="ij")[::-1], -1)
    a, b = corner[:-1, :-1], corner[:-1, 1:]
    c, d = corner[1:, :-1], corner[1:, 1:]
    return control_net(
        np.stack([np.stack([a, b], -2), np.stack([c, d], -2)], -3).reshape(-1, 2, 2, 2)
    )


def bar(low: float, high: float) -> tuple[Layer, ...]:
    """The ramp with its numbers."""
    ramp = control_net([[(0.0, 0.05), (1.0, 0.05)], [(0.0, 0.0), (1.0, 0.0)]])
    across = ramp_net(np.array([[low, high], [low, high]]), low, high)
    marks = ((0.0, low), (0.5, (low + high) / 2.0), (1.0, high))
    return (
        Patches(ramp, Texture(across, RAMP)),
        *(
            Label(f"{value:.3g}".replace("-", "−"), (x, -0.02, 0.0), anchor=(x, 1.0), size=13.0)
            for x, value in marks
        ),
    )


@domain.claims
def claims() -> Iterator[Claim]:
    for degree in (1, 2, 3):
        errors = np.array(
            [solution("wave", degree, n).errors(wave, wave_gradient) for n in (16, 32)]
        )
        rates = np.log2(errors[0] / errors[1]).tolist()
        statement = f"degree {degree}, 16 to 32 spans: rates of the L2 and of the gradient's error"
        yield Claim("Ω", statement, [degree + 1.0, float(degree)], rates, 0.08)
    centre = solution("torsion", 2, 16).at(0.5, 0.5)
    yield Claim("Ω", "torsion, degree 2, 16 spans: p in the centre", 0.52870, centre, 1e-5)
    linear = solve(R, 2, 4, PROBLEMS["x"][0], lambda x, y: 2.0 * x - 3.0 * y + 1.0)
    off = linear.errors(
        lambda x, y: 2.0 * x - 3.0 * y + 1.0, lambda x, y: (2.0 + 0.0 * x, -3.0 + 0.0 * y)
    )
    statement = "p = 2x − 3y + 1 is among the splines of degree 2: errors of p and of its gradient"
    yield Claim("Ω", statement, [0.0, 0.0], list(off), 1e-12)
    statement = (
        "p = x computed, by the identity, and given, by r: largest difference of a grey level"
    )
    yield Claim("Ω", statement, 0.0, attached_both_ways, 4.0)


def attached_both_ways(measure: Measure) -> float:
    pictures = [
        measure.picture("domain", (192, 192), field="x", attach=attach).astype(int)
        for attach in ("identity", "r")
    ]
    return float(np.abs(pictures[0] - pictures[1]).max())
