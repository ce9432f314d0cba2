"""Parity with the real OpenGL and GLU: cases whose outputs the real ones computed.

    python tests/parity/parity.py [FOLDER]

runs every case of a folder (default: cases/) through our evaluators, on both paths, and prints a
table. Exit code 1 if one fails or there is none.

A case is a JSON object: name, kind, inputs, outputs, and known_wrong, the words that say what the
real one does against the specification (then float64 stands in for its outputs). KINDS says who
compares which kind.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import evaluator_cases
import numpy as np
import nurbs_cases

from reparam.errors import ReparamError
from reparam.snapshot import Studio

CASES = Path(__file__).parent / "cases"
COLUMNS = ("position", "normal", "colour", "texture")

Case = dict[str, Any]


@dataclass
class Row:
    """How a case came out on one path: the largest error in each column, and what it may be."""

    case: str
    evaluator: str
    rows: int = 0
    errors: dict[str, float] = field(default_factory=dict)
    tolerances: dict[str, float] = field(default_factory=dict)
    complaint: str = ""  # what failed beyond numbers

    def record(self, column: str, errors: Any, tolerances: Any) -> None:
        """Take into account, of some errors, the one largest beside its tolerance (one for all, or
        each its own). NaN is a failure."""
        errors, tolerances = np.broadcast_arrays(np.asarray(errors, float), tolerances)
        values = np.where(np.isnan(errors), np.inf, errors).ravel()
        if not len(values):
            values, tolerances = np.zeros(1), np.ones(1)
        worst = int(np.argmax(values / tolerances.ravel()))
        error, tolerance = float(values[worst]), float(tolerances.ravel()[worst])
        before = self.errors.get(column, 0.0) / self.tolerances.get(column, 1.0)
        if column not in self.errors or error / tolerance >= before:
            self.errors[column], self.tolerances[column] = error, tolerance

    @property
    def ok(self) -> bool:
        """Something was compared, and nothing is off."""
        within = all(error <= self.tolerances[c] for c, error in self.errors.items())
        return not self.complaint and self.rows > 0 and bool(self.errors) and within

    def line(self) -> str:
        """The row of the table."""
        cells = [
            f"{self.errors[c]:8.1e} <={self.tolerances[c]:8.1e}" if c in self.errors else " " * 18
            for c in COLUMNS
        ]
        verdict = "ok" if self.ok else f"FAILED {self.complaint}"
        return f"{self.case:36} {self.evaluator:13}{self.rows:6}  {'  '.join(cells)}  {verdict}"


Comparer = Callable[[Studio, Case, str, Row], None]
KINDS: dict[str, Comparer] = {
    "map1": evaluator_cases.compare_points,
    "map2": evaluator_cases.compare_points,
    "map1_mesh": evaluator_cases.compare_mesh,
    "map2_mesh": evaluator_cases.compare_mesh,
    "nurbs_curve": nurbs_cases.compare_curve,
    "nurbs_surface": nurbs_cases.compare_surface,
}


def read_cases(folder: Path) -> dict[str, Case]:
    """All cases of a folder by their file's name."""
    return {
        path.stem: json.loads(path.read_text("utf-8")) for path in sorted(folder.glob("*.json"))
    }


def run_case(studio: Studio, name: str, case: Case, evaluator: str) -> Row:
    """One case on one path."""
    row = Row(name, evaluator)
    try:
        compare = KINDS[case["kind"]]
    except (KeyError, TypeError):
        row.complaint = f"expected a kind of {', '.join(KINDS)}"
        return row
    try:
        compare(studio, case, evaluator, row)
    except (ReparamError, KeyError, ValueError, TypeError) as error:
        row.complaint = f"{type(error).__name__}: {error}"
    return row


def run(studio: Studio, cases: dict[str, Case]) -> Iterator[Row]:
    """All cases on the paths that the context has."""
    for name, case in cases.items():
        for evaluator in studio.painter.capabilities.evaluators:
            yield run_case(studio, name, case, evaluator)


def main(arguments: list[str], studio: Studio | None = None) -> int:
    """The table; 1 if a case fails or there is none."""
    folder = Path(arguments[0]) if arguments else CASES
    try:
        cases = read_cases(folder)
    except (OSError, ValueError) as error:
        print(f"{folder}: expected cases in JSON, found {error}", file=sys.stderr)
        return 1
    if not cases:
        print(f"{folder}: expected cases, NAME.json, found none", file=sys.stderr)
        return 1
    heads = "  ".join(f"{column:18}" for column in COLUMNS)
    print("the largest error in each column, and its tolerance")
    print(f"{'case':36} {'evaluator':13}{'rows':>6}  {heads}")
    failed = count = 0
    studio = studio or Studio()
    for row in run(studio, cases):
        print(row.line(), flush=True)
        count += 1
        failed += not row.ok
    paths = " and ".join(studio.painter.capabilities.evaluators)
    print(f"{count - failed} of {count} rows ok, {len(cases)} cases by {paths}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
