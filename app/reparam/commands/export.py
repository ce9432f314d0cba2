"""`reparam export`: what is seen, as a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from .options import Commands, add_assignments, chosen_subject


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("export", help="write what is seen: .bv, .obj, .stl, .ply, .glb")
    command.add_argument("subject", metavar="SCENE|FILE")
    command.add_argument(
        "-o", "--output", required=True, metavar="OUT.bv|obj|stl|ply|glb", type=Path
    )
    command.add_argument(
        "--level", type=int, metavar="N", help="steps in u and in v; the display's if not given"
    )
    add_assignments(command)
    command.set_defaults(run=run, views=[])


def run(options: argparse.Namespace) -> int:
    """The patches that are seen, or their triangles, as a file."""
    from ..exporting import export
    from ..files.output import check_output

    endings = (".bv", ".obj", ".stl", ".ply", ".glb")
    output = check_output(options.output, endings)
    subject = chosen_subject(options)
    if options.level is not None:
        subject = subject.assigned([f"level={options.level}"])
    export(subject, output)
    return 0
