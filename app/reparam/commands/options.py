"""Options that several commands share, and what is made of them."""

from __future__ import annotations

import argparse
import re
import sys
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

from ..errors import UsageError
from ..files.progress import Progress, silent

if TYPE_CHECKING:
    from ..subject import Subject

LARGEST_SIDE = 16384


class Parser(argparse.ArgumentParser):
    """Wrong words get one line, as all errors do."""

    def error(self, message: str) -> NoReturn:
        """Exit with code 2."""
        self.exit(
            UsageError.exit_code, f"{self.prog}: {message}; `{self.prog} --help` tells more\n"
        )


Commands: TypeAlias = "argparse._SubParsersAction[Parser]"


def add_drawing_options(command: argparse.ArgumentParser, size: str) -> None:
    """How a picture is drawn: its size, parameters, views and evaluator."""
    command.add_argument("--size", default=size, metavar="WxH", help=f"pixels; {size} if not given")
    add_assignments(command)
    command.add_argument(
        "--view",
        action="append",
        default=[],
        metavar="SPACE=ZOOM,X,Y",
        dest="views",
        help="how a space is seen: zoom, pan, and ,AZIMUTH,ELEVATION of a spatial one",
    )
    command.add_argument(
        "--evaluator",
        choices=("vertex", "tessellation"),
        help="if not given: tessellation on a GPU that has it, vertex on software",
    )
    command.add_argument(
        "--tolerance",
        nargs="?",
        const="0.5",
        type=lambda text: f"tolerance={text}",
        action="append",
        dest="assignments",
        metavar="PX",
        help="so fine that no drawn point is off by more pixels, half a one if no number is given; "
        "0: the level decides",
    )


def add_assignments(command: argparse.ArgumentParser) -> None:
    """The parameters of a scene and of its display."""
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        dest="assignments",
        help="a parameter of the scene or of its display; `reparam list` names them",
    )


def parse_size(text: str) -> tuple[int, int]:
    """(width, height) of "640x480". Raises UsageError."""
    match = re.fullmatch(r"(\d{1,9})[xX](\d{1,9})", text)
    size = (int(match[1]), int(match[2])) if match else (0, 0)
    if not all(1 <= side <= LARGEST_SIDE for side in size):
        raise UsageError(
            f"--size: expected WIDTHxHEIGHT, each from 1 to {LARGEST_SIDE}, found {text!r}"
        )
    return size


def chosen_subject(options: argparse.Namespace, progress: Progress = silent) -> Subject:
    """The scene or file that the words name, with its parameters and views; warnings printed."""
    from ..subject import open_subject, without_bad_pictures

    subject = open_subject(options.subject, progress).assigned(options.assignments)
    if options.views:
        from ..saving import parse_view, with_views

        subject = with_views(subject, dict(parse_view(text) for text in options.views))
    subject, warnings = without_bad_pictures(subject)
    for warning in warnings:
        print(f"reparam: {warning}", file=sys.stderr)
    return subject


def print_json(found: Any, indent: int | None = 2) -> None:
    """For a program that reads along."""
    import json

    print(json.dumps(found, indent=indent))
