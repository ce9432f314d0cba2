"""`reparam accuracy`: how many pixels drawn points are off."""

from __future__ import annotations

import argparse

from .options import Commands, add_drawing_options, chosen_subject, parse_size, print_json


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("accuracy", help="measure how many pixels drawn points are off")
    command.add_argument("subject", metavar="SCENE|FILE")
    command.add_argument("--json", action="store_true")
    add_drawing_options(command, "512x512")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Pixels that drawn points are off; 1 if a tolerance is not kept."""
    from ..accuracy import measure
    from ..snapshot import Studio

    size, subject = parse_size(options.size), chosen_subject(options)
    found = []
    for accuracy in measure(Studio(options.evaluator), subject, size):
        found.append(accuracy)
        if not options.json:
            print(accuracy.line(), flush=True)
    if options.json:
        print_json([accuracy.row() for accuracy in found])
    elif not found:
        print(f"{options.subject} fills no patches or meshes: nothing to measure")
    return 0 if all(accuracy.ok for accuracy in found) else 1
