"""`reparam bench`: ratios between our frames and what others would draw, each in one run.

The benchmarks themselves are the modules of tests/benchmarks that define `rows(pairs)`; they hold
the peers' hand-written OpenGL, so they come with the sources and not with a wheel.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from .assets import root
from .errors import ReparamError, UsageError

Run = Callable[[], object]

WARM_UP = 3


@dataclass(frozen=True)
class Row:
    """One measured ratio: the median over pairs, with the medians of both times.

    `goal` is the ratio aimed at, with `at_least` or else at most; None where there is none.
    """

    name: str
    ratio: float
    ours_ms: float | None = None  # where times are compared
    other_ms: float | None = None
    settings: dict[str, Any] = field(default_factory=dict)
    goal: float | None = None
    at_least: bool = False

    def reached(self) -> bool | None:
        """Whether the goal is reached; None without one."""
        if self.goal is None:
            return None
        return self.ratio >= self.goal if self.at_least else self.ratio <= self.goal

    def as_json(self) -> dict[str, Any]:
        """The row for `--json`."""
        return {**asdict(self), "reached": self.reached()}


@dataclass(frozen=True)
class Skipped:
    """A row that could not be measured here, and why."""

    name: str
    reason: str

    def as_json(self) -> dict[str, Any]:
        """The row for `--json`."""
        return {"name": self.name, "skipped": self.reason}


Rows = Iterator[Row | Skipped]


@dataclass(frozen=True)
class Pairs:
    """Times of neighbouring runs, in seconds."""

    ours: list[float]
    other: list[float]

    def row(
        self,
        name: str,
        *,
        inverse: bool = False,
        goal: float | None = None,
        **settings: Any,
    ) -> Row:
        """ours / other, or with `inverse` other / ours, of which more is better."""
        ratios = [ours / other for ours, other in zip(self.ours, self.other, strict=True)]
        return Row(
            name,
            statistics.median(1.0 / ratio if inverse else ratio for ratio in ratios),
            1e3 * statistics.median(self.ours),
            1e3 * statistics.median(self.other),
            {"pairs": len(self.ours), **settings},
            goal,
            inverse,
        )


def interleave(ours: Run, other: Run, pairs: int, warm_up: int = WARM_UP) -> Pairs:
    """Run both in turn: what disturbs the machine disturbs both, and the ratio hardly moves."""
    for _ in range(warm_up):
        ours()
        other()
    times = Pairs([], [])
    for _ in range(pairs):
        began = time.perf_counter()
        ours()
        between = time.perf_counter()
        other()
        times.ours.append(between - began)
        times.other.append(time.perf_counter() - between)
    return times


def folder() -> Path:
    """Where the benchmarks are. Raises ReparamError in a wheel."""
    path = root() / "tests" / "benchmarks"
    if not path.is_dir():
        raise ReparamError(f"expected the benchmarks of the sources in {path}, found none")
    return path


def names() -> list[str]:
    """All benchmarks: the modules of the folder that define `rows`."""
    files = folder().glob("*.py")
    return sorted(file.stem for file in files if "\ndef rows(" in file.read_text("utf-8"))


def known(chosen: Sequence[str]) -> list[str]:
    """The chosen benchmarks, or all. Raises UsageError for an unknown name."""
    there = names()
    for name in chosen:
        if name not in there:
            raise UsageError(f"expected a benchmark ({', '.join(there)}), found {name!r}")
    return list(chosen) or there


def module(name: str) -> ModuleType:
    """The module of a benchmark."""
    sys.path.insert(0, str(folder()))
    try:
        return import_module(name)
    finally:
        sys.path.remove(str(folder()))


def run(name: str, pairs: int) -> Rows:
    """The rows of a benchmark as they come."""
    found: Rows = module(name).rows(pairs)
    return found


def line(row: Row | Skipped) -> str:
    """A row of the table."""
    if isinstance(row, Skipped):
        return f"{row.name:46} skipped: {row.reason}"
    goal = ""
    if row.goal is not None:
        sign, verdict = ">=" if row.at_least else "<=", "" if row.reached() else "  MISSED"
        goal = f"   goal {sign} {row.goal:g}{verdict}"
    times = " " * 37
    if row.ours_ms is not None:
        times = f"ours {row.ours_ms:9.3f} ms   other {row.other_ms:9.3f} ms"
    return f"{row.name:46} {row.ratio:8.3f}   {times}{goal}"
