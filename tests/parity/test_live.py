"""Random cases, run by the real OpenGL and by ours in one process."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from real_opengl import Missing, RealOpenGL

import parity
from reparam.snapshot import Studio

COMPONENTS = {
    "VERTEX_3": 3, "VERTEX_4": 4, "NORMAL": 3, "COLOR_4": 4,
    "TEXTURE_COORD_1": 1, "TEXTURE_COORD_2": 2, "TEXTURE_COORD_3": 3, "TEXTURE_COORD_4": 4,
}  # fmt: skip
KINDS = ["map1", "map2", "map2", "map1_mesh", "map2_mesh"]


@pytest.fixture(scope="module")
def real() -> RealOpenGL:
    try:
        return RealOpenGL()
    except Missing as missing:
        pytest.skip(f"no real evaluators here: {missing}")


def random_domain(random: np.random.Generator, dyadic: bool) -> list[float]:
    """Dyadic ones have parameters that float32 maps to [0,1] without rounding. Others make the
    real one lose digits: it rounds (u - u1) / (u2 - u1), and a steep map multiplies that."""
    if dyadic:
        low, wide = random.integers(-32, 32) / 8, 2.0 ** random.integers(-1, 3)
    else:
        low, wide = random.uniform(-3, 3), random.uniform(0.3, 4)
    ends = [low, low + wide] if random.random() < 0.7 else [0.0, 1.0]
    return [float(np.float32(x)) for x in (ends if random.random() < 0.7 else ends[::-1])]


def random_map(
    random: np.random.Generator, name: str, orders: list[int], domains: list[list[float]]
) -> dict[str, Any]:
    """Control points scattered in a buffer that holds other numbers too."""
    count, dimension = COMPONENTS[name], len(orders)
    inner = int(count + random.integers(0, 5))
    strides = [inner]
    if dimension == 2:
        strides.insert(0, int(inner * orders[1] + random.integers(0, 5)))
        if random.random() < 0.3:  # as in the Red Book: u within v
            strides = [inner, int(inner * orders[0] + random.integers(0, 5))]
    offset = int(random.integers(0, 9))
    places = np.zeros(1, int)
    for stride, order in zip(strides, orders, strict=True):
        places = np.add.outer(places, stride * np.arange(order)).ravel()
    points = random.uniform(-2, 2, offset + places[-1] + count).astype(np.float32)
    if name == "VERTEX_4":
        points[offset + places + 3] = random.uniform(0.5, 2, places.size)
    given: dict[str, Any] = {"points": points.tolist(), "offset": offset}
    for i in range(dimension):
        prefix = "uv"[i] if dimension == 2 else ""
        given[f"{prefix}stride"] = strides[i]
        given[f"{prefix}order"] = orders[i]
        given[f"{prefix}domain"] = domains[i]
    return given


def along(random: np.random.Generator, domain: list[float], count: int) -> list[float]:
    """Parameters in a domain, at its ends, and a little outside."""
    t = np.concatenate([[0, 64], random.integers(-3, 67, count - 2)]) / 64
    return (domain[0] + t * (domain[1] - domain[0])).astype(np.float32).tolist()


def random_case(seed: int, orders: list[int], dyadic: bool) -> parity.Case:
    random = np.random.default_rng(seed)
    kind = KINDS[seed % len(KINDS)]
    dimension = int(kind[3])
    names = [str(random.choice(["VERTEX_3", "VERTEX_4"]))]
    names += [name for name in COMPONENTS if name not in names and random.random() < 0.25]
    domains = [random_domain(random, dyadic) for _ in range(dimension)]
    inputs: dict[str, Any] = {
        "maps": {
            name: random_map(random, name, random.choice(orders, dimension).tolist(), domains)
            for name in names
        },
        "auto_normal": dimension == 2 and bool(random.random() < 0.6),
    }
    if kind.endswith("mesh"):
        inputs |= random_mesh(random, domains)
    elif dimension == 1:
        inputs["u"] = along(random, domains[0], 12)
    else:
        columns = [along(random, domain, 16) for domain in domains]
        inputs["uv"] = [list(pair) for pair in zip(*columns, strict=True)]
    turned = inputs["auto_normal"] and sum(low > high for low, high in domains) == 1
    wrong = "normal: keeps the sign it has on [0,1]" if turned else None
    return {"kind": kind, "inputs": inputs, "known_wrong": wrong}


def random_mesh(random: np.random.Generator, domains: list[list[float]]) -> dict[str, Any]:
    grid: list[float] = []
    ranges: list[int] = []
    for domain in domains:
        segments = int(random.integers(1, 9))
        grid += [segments, *domain]
        start = int(random.integers(0, segments))
        ranges += [start, int(random.integers(start + 1, segments + 1))]
    modes = ["POINT", "LINE", "FILL"][: len(domains) + 1]
    place = {"rng": ranges} if len(domains) == 2 else {"i1": ranges[0], "i2": ranges[1]}
    return {"grid": grid, "mode": str(random.choice(modes)), **place}


def fed(case: parity.Case) -> set[str]:
    names, inputs = set(case["inputs"]["maps"]), case["inputs"]
    fields = {"pos"}
    if inputs.get("auto_normal") or "NORMAL" in names:
        fields.add("normal")
    if "COLOR_4" in names:
        fields.add("color")
    if any(name.startswith("TEX") for name in names):
        fields.add("tex")
    return fields


def rows(
    studio: Studio, real: RealOpenGL, seeds: range, orders: list[int], dyadic: bool = True
) -> list[parity.Row]:
    found, paths = [], studio.painter.capabilities.evaluators
    for seed in seeds:
        case = random_case(seed, orders, dyadic)
        with real.current():
            outputs = real.run(case["kind"], case["inputs"])
        case["outputs"] = {name: outputs[name].tolist() for name in fed(case)}
        name = f"{case['kind']} {seed}"
        found += [parity.run_case(studio, name, case, path) for path in paths]
    return found


def check(found: list[parity.Row]) -> None:
    failed = [row.line() for row in found if not row.ok]
    assert not failed, "\n".join([f"{len(failed)} of {len(found)}", *failed[:20]])


def test_random_cases(studio: Studio, real: RealOpenGL) -> None:
    """A few orders, each program compiled once."""
    check(rows(studio, real, range(64), [2, 4, 7]))


@pytest.mark.slow
def test_many_random_cases(studio: Studio, real: RealOpenGL) -> None:
    check(rows(studio, real, range(1000, 1400), list(range(2, 11))))


@pytest.mark.slow
def test_any_domain(studio: Studio, real: RealOpenGL) -> None:
    found = rows(studio, real, range(2000, 2100), list(range(2, 11)), dyadic=False)
    check(found)
