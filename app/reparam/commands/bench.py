"""`reparam bench`: our frames against others', as ratios."""

from __future__ import annotations

import argparse
import sys

from ..errors import UsageError
from .options import Commands, print_json


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("bench", help="measure our frames against others', as ratios")
    command.add_argument("benchmarks", nargs="*", metavar="BENCHMARK")
    command.add_argument(
        "--pairs", type=int, default=41, help="of neighbouring runs; 41 if not given"
    )
    command.add_argument("--json", action="store_true")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The benchmarks as a table, or JSON with the table as progress on stderr."""
    from ..bench import line, run

    if not 1 <= options.pairs <= 10_000:
        raise UsageError(f"--pairs: expected a number from 1 to 10000, found {options.pairs}")
    rows = []
    for row in run(options.benchmarks, options.pairs):
        rows.append(row)
        print(line(row), file=sys.stderr if options.json else sys.stdout, flush=True)
    if options.json:
        print_json([row.as_json() for row in rows])
    return 0
