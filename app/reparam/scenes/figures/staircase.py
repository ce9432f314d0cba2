"""A staircase that comes as close to the diagonal as one likes, and stays as long as 2.

Points converge, and the length does not: it is the directions that (5) adds up.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt
from typing import Annotated

import numpy as np

from ...geometry.arclength import polygon_length
from .. import palette
from ..claims import Claim
from ..drawing import words
from ..layers import Array, Dots, Figure, Polylines, Space, plane
from ..parameters import Range
from ..plots import Plot
from ..registry import scene

DIAGONAL = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
COUNTS = 2.0 ** np.arange(9)


@scene(
    "The staircase and the diagonal",
    animates="steps",
    plates=(("steps=2",), ("steps=16",)),
)
def staircase(
    steps: Annotated[float, Range(1, 128, 1), "steps of the staircase, whole"] = 2.0,
) -> Figure:
    n = round(steps)
    corners, title = stairs(n), f"{n} steps" if n > 1 else "1 step"
    green = palette.DERIVATIVE
    image = (
        Polylines(DIAGONAL, palette.ALONG_U, 2.0),
        Polylines(corners, palette.INK, 1.8),
        Dots(corners, palette.SAMPLES, max(0.0, 3.2 - n / 12.0)),
        words(title, (0.0, 1.0), offset=(0.0, 18.0), anchor=(0.0, 0.5)),
    )
    plot = Plot((1.0, 256.0), (1e-3, 10.0), "steps n", "", log=True, size=(1.0, 1.0))
    space = plot.space(
        plot.curve(plot.x, (sqrt(2.0), sqrt(2.0)), palette.ALONG_U, 1.2),
        plot.dots(COUNTS, np.full(len(COUNTS), 2.0), palette.INK, 3.0),
        plot.dots(COUNTS, 1.0 / (COUNTS * sqrt(2.0)), palette.DERIVATIVE, 3.0),
        plot.dots([n, n], [2.0, 1.0 / (n * sqrt(2.0))], palette.MOVING, 4.6),
        words("length 2", (0.05, 0.88), size=14.0, anchor=(0.0, 0.5)),
        words("√2", (1.0, 0.74), size=14.0, anchor=(1.0, 0.5), color=palette.ALONG_U),
        words("distance 1/(n√2)", (0.42, 0.55), size=14.0, anchor=(0.0, 0.5), color=green),
    )
    caption = (
        f"length {float(polygon_length(corners)):.12g}, however many steps; the diagonal's is √2",
        f"distance from the diagonal at most 1/(n√2) = {distance(corners):.6f}",
    )
    return Figure((Space("physical", plane(-0.08, -0.06, 1.08, 1.2), image), space), caption)


def stairs(n: int) -> Array:
    """Corners (2 n + 1, 3), first up, then right."""
    up, right = np.arange(2 * n + 1) // 2 + np.arange(2 * n + 1) % 2, np.arange(2 * n + 1) // 2
    return np.stack([right / n, up / n, 0.0 * up], -1)


def distance(corners: Array) -> float:
    """The largest from the diagonal."""
    return float(np.abs(corners[:, 0] - corners[:, 1]).max() / sqrt(2.0))


@staircase.claims
def claims() -> Iterator[Claim]:
    counts = [1, 2, 7, 100, 1024]
    lengths = [float(polygon_length(stairs(n))) for n in counts]
    yield Claim("(6)", "length of 1, 2, 7, 100, 1024 steps: 2", [2.0] * 5, lengths, 1e-12)
    far = [distance(stairs(n)) for n in counts]
    statement = "their distance from the diagonal: 1/(n√2)"
    yield Claim("(6)", statement, [1.0 / (n * sqrt(2.0)) for n in counts], far, 1e-15)
