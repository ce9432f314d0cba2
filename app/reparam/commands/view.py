"""`reparam view`: the window."""

from __future__ import annotations

import argparse

from ..viewer.keys import keys_text
from .options import Commands, add_drawing_options, chosen_subject, parse_size


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser(
        "view",
        help="open the window",
        epilog="keys:\n" + keys_text(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    command.add_argument("subject", nargs="?", default="fig5", metavar="SCENE|FILE")
    add_drawing_options(command, "1024x768")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The window."""
    size = parse_size(options.size)
    from ..viewer.window import show

    name = options.subject
    return show(name, lambda progress: chosen_subject(options, progress), size, options.evaluator)
