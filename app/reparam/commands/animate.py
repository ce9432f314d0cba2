"""`reparam animate`: a moving picture."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..errors import UsageError
from .options import Commands, add_drawing_options, chosen_subject, parse_size


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser(
        "animate", help="a moving picture of a scene whose parameters change"
    )
    command.add_argument("subject", metavar="SCENE|FILE")
    command.add_argument(
        "-o", "--output", required=True, metavar="OUT.gif", type=Path, help=".gif, .webp or .png"
    )
    command.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="NAME=FROM:TO",
        help="a number that goes from one value to another, or NAME=A,B,C of names; repeatable",
    )
    command.add_argument("--frames", type=int, default=60, metavar="N", help="60 if not given")
    command.add_argument(
        "--rate", type=float, default=25.0, metavar="R", help="frames a second; 25 if not given"
    )
    command.add_argument("--back", action="store_true", help="there, and the same way back")
    add_drawing_options(command, "512x512")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """One moving picture."""
    from ..animate import ENDINGS, MOST_PIXELS, ProgressBar, courses, save_animation
    from ..files.output import check_output

    size, output = parse_size(options.size), check_output(options.output, ENDINGS)
    if not 1.0 <= options.rate <= 100.0:
        raise UsageError(f"--rate: expected a number from 1 to 100, found {options.rate:g}")
    frames = courses(chosen_subject(options), options.vary, options.frames, options.back)
    if size[0] * size[1] * len(frames) > MOST_PIXELS:
        raise UsageError(
            f"--frames: expected at most {MOST_PIXELS // (size[0] * size[1])} of that size, "
            f"found {len(frames)}"
        )
    from ..snapshot import Studio

    studio, bar = Studio(options.evaluator), ProgressBar(len(frames))
    save_animation(frames, lambda frame: studio.draw(frame, size), output, options.rate, bar.step)
    return 0
