"""`reparam bench`: our frames against others', as ratios."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ReparamError, UsageError
from .options import Commands, print_json

if TYPE_CHECKING:
    from ..bench import Row, Skipped


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("bench", help="measure our frames against others', as ratios")
    command.add_argument("benchmarks", nargs="*", metavar="BENCHMARK")
    command.add_argument(
        "--pairs", type=int, default=41, help="of neighbouring runs; 41 if not given"
    )
    command.add_argument("--json", action="store_true")
    command.add_argument(
        "--into", metavar="FILE.md", help="bring the tables of a Markdown file up to date"
    )
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The benchmarks as a table, or JSON with the table as progress on stderr."""
    from ..bench import known, line, run

    if not 1 <= options.pairs <= 10_000:
        raise UsageError(f"--pairs: expected a number from 1 to 10000, found {options.pairs}")
    found: dict[str, list[Row | Skipped]] = {}
    for name in known(options.benchmarks):
        found[name] = []
        for row in run(name, options.pairs):
            found[name].append(row)
            print(line(row), file=sys.stderr if options.json else sys.stdout, flush=True)
        if options.into:
            _bring_up_to_date(Path(options.into), name, found[name])
    if options.json:
        print_json([row.as_json() for rows in found.values() for row in rows])
    return 0


def _bring_up_to_date(path: Path, name: str, rows: list[Row | Skipped]) -> None:
    """Benchmark by benchmark, so that hours are not lost with the last one."""
    from ..bench_report import machine, section, written_into

    try:
        written_into(path, {name: section(name, rows, machine())})
    except OSError as fault:
        raise ReparamError(f"--into {path}: expected a file to write, found {fault}") from fault
