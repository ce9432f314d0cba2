"""`reparam joins`: how patches or curves meet."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..errors import UsageError
from .options import Commands, add_assignments, chosen_subject, print_json


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser(
        "joins",
        help="how patches or curves meet: gaps, jumps, order G^k",
        description="Patches of a scene or a .bv file, or of two of them together; the pieces of a "
        "curve, or a curve and the one that goes on where it ends, from .csv or .txt files as "
        "`reparam trace` reads them.",
    )
    command.add_argument("subject", metavar="SCENE|FILE")
    command.add_argument("following", metavar="CURVE|FILE", nargs="?", type=Path)
    command.add_argument("--all", action="store_true", help="every join, not the worst alone")
    command.add_argument("--json", action="store_true", help="with r's derivatives along each edge")
    command.add_argument(
        "--tolerance",
        type=float,
        default=1e-6,
        metavar="T",
        help="largest gap, by the body's size, and jump that count as none; 1e-6 if not given",
    )
    add_assignments(command)
    command.set_defaults(run=run, views=[])


def run(options: argparse.Namespace) -> int:
    """How patches or curves meet, as a table or as JSON."""
    from ..files.curve import is_curve
    from ..join_report import patches_of, report, table

    if not 0.0 < options.tolerance < 1.0:
        raise UsageError(
            f"--tolerance: expected a number between 0 and 1, found {options.tolerance:g}"
        )
    if is_curve(Path(options.subject)) or (options.following and is_curve(options.following)):
        return _run_curve_joins(options)
    figures, name = [chosen_subject(options).figure()], options.subject
    if options.following:
        from ..subject import open_subject

        figures.append(open_subject(str(options.following)).figure())
        name = f"{name}, {options.following}"
    found = report(patches_of(*figures), options.tolerance)
    if options.json:
        print_json(found, indent=None)
    else:
        print(*table(name, found, options.all), sep="\n")
    return 0


def _run_curve_joins(options: argparse.Namespace) -> int:
    from ..curve_report import between, table, within
    from ..files.curve import read_curve

    name, path = options.subject, read_curve(Path(options.subject))
    if options.following:
        name = f"{name}, {options.following}"
        rows = between(path, read_curve(options.following), options.tolerance)
    else:
        rows = within(path, options.tolerance)
    if options.json:
        print_json(rows, indent=None)
    else:
        print(*table(name, rows), sep="\n")
    return 0
