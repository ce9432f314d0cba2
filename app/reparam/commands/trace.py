"""`reparam trace`: equally spaced points of a curve."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .options import Commands


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser(
        "trace",
        help="equally spaced points of a curve, with tangents",
        description="Points at equal arc length along a curve, as CSV: s, u, x, y, z and the unit "
        "tangent. FILE has a control point a line, x, y[, z[, weight]]; a line `degree 3` makes "
        "them a B-spline's, and one of `knots ...` gives its knots.",
    )
    command.add_argument("file", metavar="FILE", type=Path)
    spacing = command.add_mutually_exclusive_group(required=True)
    spacing.add_argument("--step", type=float, metavar="S", help="the length between two points")
    spacing.add_argument("--count", type=int, metavar="N", help="so many, both ends among them")
    command.add_argument("-o", "--output", type=Path, metavar="OUT.csv", help="else it is printed")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Equally spaced points of a curve."""
    from ..files.curve import read_curve
    from ..files.output import check_output, write_bytes
    from ..trace_report import lengths, rows, table

    output = check_output(options.output, (".csv", ".txt")) if options.output else None
    path = read_curve(options.file)
    s = lengths(path, options.step, options.count)
    text = table(rows(path, s))
    if output is None:
        sys.stdout.write(text)
    else:
        write_bytes(text.encode(), output)
    rest = path.arc.length - float(s[-1])
    left = f", {rest:.6g} left over at the end" if rest > 1e-9 * path.arc.length else ""
    print(f"length {path.arc.length:.12g}, {len(s)} points{left}", file=sys.stderr)
    return 0
