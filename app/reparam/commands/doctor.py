"""`reparam doctor`: what OpenGL is here."""

from __future__ import annotations

import argparse

from .options import Commands, print_json


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("doctor", help="what OpenGL is here, and what mends it")
    command.add_argument("--json", action="store_true")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """What is here; 1 if nothing can be drawn."""
    from ..doctor import examine

    report = examine()
    if options.json:
        print_json(report)
    else:
        for name, value in report.items():
            print(f"{name:24} {value}")
    return 0 if report["draws"] else 1
