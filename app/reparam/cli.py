"""The command line: `reparam COMMAND ...`; each command is a module of commands/."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from . import __version__
from .commands import (
    accuracy,
    animate,
    bench,
    check,
    doctor,
    export,
    joins,
    list_scenes,
    render,
    trace,
    view,
)
from .commands.options import Parser
from .errors import ReparamError

COMMANDS = (
    view,
    list_scenes,
    render,
    animate,
    check,
    accuracy,
    bench,
    joins,
    trace,
    export,
    doctor,
)
ABOUT = (
    "OpenGL's evaluators on today's GPU, and what a change of variables does to what they draw. "
    "Without a command: the window, or without a screen the figures as PNG into ./figures."
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command. The exit code: 0 good, 1 could not, 2 wrong words, 3 a bad file."""
    options = parser().parse_args(arguments)
    try:
        code = int(options.run(options))
        sys.stdout.flush()
        return code
    except ReparamError as error:
        if options.debug:
            raise
        print(f"reparam: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or exit complains again
        return 0


def parser() -> Parser:
    """All commands with their options."""
    top = Parser(prog="reparam", description=ABOUT)
    top.add_argument("--version", action="version", version=f"reparam {__version__}")
    top.add_argument("--debug", action="store_true", help="show a traceback with an error")
    top.set_defaults(run=run_default)
    commands = top.add_subparsers(title="commands", metavar="COMMAND")
    for command in COMMANDS:
        command.add(commands)
    return top


def run_default(options: argparse.Namespace) -> int:
    """The viewer; without a screen the figures as pictures."""
    from .viewer.screen import screen_missing

    missing = screen_missing()
    if missing is None:
        return main(["--debug", "view"] if options.debug else ["view"])
    from .gallery import write_figures

    folder = Path("figures")
    write_figures(folder, (1024, 768))
    print(f"{missing}; the figures are in {folder.resolve()}")
    return 0
