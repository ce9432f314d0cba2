"""`reparam render`: one picture, no screen needed."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import UsageError
from .options import Commands, add_drawing_options, chosen_subject, parse_size

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..scenes.layers import Figure
    from ..subject import Subject


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("render", help="draw one picture, no screen needed")
    command.add_argument("subject", metavar="SCENE|FILE")
    command.add_argument(
        "-o", "--output", required=True, metavar="OUT.png", type=Path, help=".png, .svg or .pdf"
    )
    add_drawing_options(command, "512x512")
    command.add_argument("--plain", action="store_true", help="the patch alone, centred")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """One picture."""
    from ..files.output import check_output, save_picture

    size = parse_size(options.size)
    output = check_output(options.output, (".png", ".svg", ".pdf"))
    subject = chosen_subject(options)
    if output.suffix.lower() != ".png":
        return _render_vectors(options, subject, size, output)
    from ..snapshot import Studio

    studio = Studio(options.evaluator)
    picture = studio.draw(subject, size, plain=options.plain)
    save_picture(picture, output)
    return 0


def _render_vectors(
    options: argparse.Namespace, subject: Subject, size: tuple[int, int], output: Path
) -> int:
    """One picture as SVG or PDF; OpenGL starts only for what must be embedded."""
    from ..files.output import write_bytes
    from ..files.vector import pdf, svg
    from ..vectors import draw_vectors

    if options.plain or subject.display.compare:
        word = "--plain" if options.plain else "compare"
        raise UsageError(f"{word}: expected an --output ending in .png, found {str(output)!r}")

    def embedded(figure: Figure, size: tuple[int, int]) -> NDArray[np.uint8]:
        from ..snapshot import Studio

        return Studio(options.evaluator).draw_figure(figure, subject, size)

    drawing = draw_vectors(subject, size, embedded)
    is_svg = output.suffix.lower() == ".svg"
    write_bytes(svg(drawing).encode() if is_svg else pdf(drawing), output)
    return 0
