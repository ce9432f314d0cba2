"""Random trim regions in the parameter domain against what the real libGLU leaves of a plane."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import real_glu
from nurbs_outputs import areas, theirs_of
from trimmed_cases import covers

from reparam.geometry.net import Array
from reparam.geometry.trimming import trim_region
from trim_cases import SQUARE, Loop, blob, reverse

GLU = real_glu.library()
pytestmark = pytest.mark.skipif(GLU is None, reason="no libGLU here to compare with")

STEPS = 60  # of libGLU's polygons: their border is off the curve by some of a step's square
AREA = 2e-3
CLEAR = 0.01


def random_loops(random: np.random.Generator) -> list[Loop]:
    """The border of the domain, holes of all sorts of pieces, islands in some; or one loop."""
    if random.random() < 0.2:
        return [blob(random, (0.5, 0.5), 0.45)]
    side = int(random.integers(1, 4))
    loops = [SQUARE]
    for i in range(side):
        for j in range(side):
            center = (np.array([i, j]) + 0.5) / side
            loops.append(reverse(blob(random, center, 0.45 / side)))
            if side < 3 and random.random() < 0.5:
                loops.append(blob(random, center, 0.08 / side))
    return loops


def rounded(piece: Array) -> Array:
    """As float32 has it."""
    return piece.astype(np.float32).astype(np.float64)


def as_glu(piece: Array) -> tuple[Any, ...]:
    """A piece as gluPwlCurve or gluNurbsCurve takes it."""
    if piece.shape[1] == 2:
        return ("pwl", piece)
    order = len(piece)
    return ("nurbs", [0.0] * order + [1.0] * order, piece, order)


@pytest.mark.parametrize("seed", range(2))
def test_areas_and_sides(seed: int) -> None:
    compare(seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 45))
def test_many(seed: int) -> None:
    compare(seed)


def compare(seed: int) -> None:
    assert GLU is not None
    random = np.random.default_rng(seed)
    loops = [
        [piece.astype(np.float32).astype(float) for piece in loop] for loop in random_loops(random)
    ]
    region = trim_region(loops)
    plane = np.array([[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0)]], float)
    inputs = {
        "sknots": [0, 0, 1, 1], "tknots": [0, 0, 1, 1], "ctrl": plane, "sorder": 2, "torder": 2,
        "trims": [[as_glu(piece) for piece in loop] for loop in loops],
        "props": {"SAMPLING_METHOD": "DOMAIN_DISTANCE", "U_STEP": STEPS, "V_STEP": STEPS},
    }  # fmt: skip
    theirs = theirs_of(real_glu.run_real(GLU, "nurbs_surface", inputs))
    assert len(theirs.triangles), "libGLU draws nothing"
    uv = theirs.fields["uv"]
    found = np.abs(areas(uv, theirs.triangles)).sum()
    assert found == pytest.approx(region.area(), abs=AREA)
    samples = random.uniform(0.0, 1.0, (150, 2))
    samples = samples[np.abs(region.signed_distance(*samples.T)) > CLEAR]
    assert (covers(uv, theirs.triangles, samples) == region.inside(*samples.T)).all()
