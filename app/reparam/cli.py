"""The command line: one short function a command; each imports what it needs when it needs it."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from . import __version__
from .errors import ReparamError, UsageError
from .files.progress import Progress, silent
from .viewer.keys import keys_text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .scenes.layers import Figure
    from .subject import Subject

LARGEST_SIDE = 16384
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


class _Parser(argparse.ArgumentParser):
    """Wrong words get one line, as all errors do."""

    def error(self, message: str) -> NoReturn:
        self.exit(
            UsageError.exit_code, f"{self.prog}: {message}; `{self.prog} --help` tells more\n"
        )


def parser() -> argparse.ArgumentParser:
    """All commands with their options."""
    top = _Parser(prog="reparam", description=ABOUT)
    top.add_argument("--version", action="version", version=f"reparam {__version__}")
    top.add_argument("--debug", action="store_true", help="show a traceback with an error")
    top.set_defaults(run=run_default)
    commands = top.add_subparsers(title="commands", metavar="COMMAND")

    view = commands.add_parser(
        "view",
        help="open the window",
        epilog="keys:\n" + keys_text(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    view.add_argument("subject", nargs="?", default="fig5", metavar="SCENE|FILE")
    _add_drawing_options(view, "1024x768")
    view.set_defaults(run=run_view)

    listing = commands.add_parser("list", help="scenes and their parameters")
    listing.add_argument("--json", action="store_true")
    listing.set_defaults(run=run_list)

    render = commands.add_parser("render", help="draw one picture, no screen needed")
    render.add_argument("subject", metavar="SCENE|FILE")
    render.add_argument(
        "-o", "--output", required=True, metavar="OUT.png", type=Path, help=".png, .svg or .pdf"
    )
    _add_drawing_options(render, "512x512")
    render.add_argument("--plain", action="store_true", help="the patch alone, centred")
    render.set_defaults(run=run_render)

    animate = commands.add_parser(
        "animate", help="a moving picture of a scene whose parameters change"
    )
    animate.add_argument("subject", metavar="SCENE|FILE")
    animate.add_argument(
        "-o", "--output", required=True, metavar="OUT.gif", type=Path, help=".gif, .webp or .png"
    )
    animate.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="NAME=FROM:TO",
        help="a number that goes from one value to another, or NAME=A,B,C of names; repeatable",
    )
    animate.add_argument("--frames", type=int, default=60, metavar="N", help="60 if not given")
    animate.add_argument(
        "--rate", type=float, default=25.0, metavar="R", help="frames a second; 25 if not given"
    )
    animate.add_argument("--back", action="store_true", help="there, and the same way back")
    _add_drawing_options(animate, "512x512")
    animate.set_defaults(run=run_animate)

    check = commands.add_parser("check", help="compute the claims of the scenes")
    check.add_argument("scenes", nargs="*", metavar="SCENE")
    check.add_argument("--json", action="store_true")
    check.set_defaults(run=run_check)

    accuracy = commands.add_parser("accuracy", help="measure how many pixels drawn points are off")
    accuracy.add_argument("subject", metavar="SCENE|FILE")
    accuracy.add_argument("--json", action="store_true")
    _add_drawing_options(accuracy, "512x512")
    accuracy.set_defaults(run=run_accuracy)

    bench = commands.add_parser("bench", help="measure our frames against others', as ratios")
    bench.add_argument("benchmarks", nargs="*", metavar="BENCHMARK")
    bench.add_argument(
        "--pairs", type=int, default=41, help="of neighbouring runs; 41 if not given"
    )
    bench.add_argument("--json", action="store_true")
    bench.set_defaults(run=run_bench)

    joining = commands.add_parser(
        "joins",
        help="how patches or curves meet: gaps, jumps, order G^k",
        description="Patches of a scene or a .bv file; the pieces of a curve, or a curve and the "
        "one that goes on where it ends, from .csv or .txt files as `reparam trace` reads them.",
    )
    joining.add_argument("subject", metavar="SCENE|FILE")
    joining.add_argument("following", metavar="CURVE", nargs="?", type=Path)
    joining.add_argument("--all", action="store_true", help="every join, not the worst alone")
    joining.add_argument("--json", action="store_true", help="with r's derivatives along each edge")
    joining.add_argument(
        "--tolerance",
        type=float,
        default=1e-6,
        metavar="T",
        help="largest gap, by the body's size, and jump that count as none; 1e-6 if not given",
    )
    _add_assignments(joining)
    joining.set_defaults(run=run_joins, views=[])

    trace = commands.add_parser(
        "trace",
        help="equally spaced points of a curve, with tangents",
        description="Points at equal arc length along a curve, as CSV: s, u, x, y, z and the unit "
        "tangent. FILE has a control point a line, x, y[, z[, weight]]; a line `degree 3` makes "
        "them a B-spline's, and one of `knots ...` gives its knots.",
    )
    trace.add_argument("file", metavar="FILE", type=Path)
    spacing = trace.add_mutually_exclusive_group(required=True)
    spacing.add_argument("--step", type=float, metavar="S", help="the length between two points")
    spacing.add_argument("--count", type=int, metavar="N", help="so many, both ends among them")
    trace.add_argument("-o", "--output", type=Path, metavar="OUT.csv", help="else it is printed")
    trace.set_defaults(run=run_trace)

    export = commands.add_parser("export", help="write what is seen: .bv, .obj, .stl, .ply, .glb")
    export.add_argument("subject", metavar="SCENE|FILE")
    export.add_argument(
        "-o", "--output", required=True, metavar="OUT.bv|obj|stl|ply|glb", type=Path
    )
    export.add_argument(
        "--level", type=int, metavar="N", help="steps in u and in v; the display's if not given"
    )
    _add_assignments(export)
    export.set_defaults(run=run_export, views=[])

    doctor = commands.add_parser("doctor", help="what OpenGL is here, and what mends it")
    doctor.add_argument("--json", action="store_true")
    doctor.set_defaults(run=run_doctor)
    return top


def _add_drawing_options(command: argparse.ArgumentParser, size: str) -> None:
    command.add_argument("--size", default=size, metavar="WxH", help=f"pixels; {size} if not given")
    _add_assignments(command)
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
        type=lambda text: f"tolerance={text}",
        action="append",
        dest="assignments",
        metavar="PX",
        help="so fine that no drawn point is off by more pixels; 0: the level decides",
    )


def _add_assignments(command: argparse.ArgumentParser) -> None:
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


def _subject(options: argparse.Namespace, progress: Progress = silent) -> Subject:
    from .subject import open_subject, without_bad_pictures

    subject = open_subject(options.subject, progress).assigned(options.assignments)
    if options.views:
        from .saving import parse_view, with_views

        subject = with_views(subject, dict(parse_view(text) for text in options.views))
    subject, warnings = without_bad_pictures(subject)
    for warning in warnings:
        print(f"reparam: {warning}", file=sys.stderr)
    return subject


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


def run_view(options: argparse.Namespace) -> int:
    """The window."""
    size = parse_size(options.size)
    from .viewer.window import show

    name = options.subject
    return show(name, lambda progress: _subject(options, progress), size, options.evaluator)


def run_render(options: argparse.Namespace) -> int:
    """One picture."""
    from .files.output import check_output, save_picture

    size = parse_size(options.size)
    output = check_output(options.output, (".png", ".svg", ".pdf"))
    subject = _subject(options)
    if output.suffix.lower() != ".png":
        return _render_vectors(options, subject, size, output)
    from .snapshot import Studio

    studio = Studio(options.evaluator)
    picture = studio.draw(subject, size, plain=options.plain)
    save_picture(picture, output)
    return 0


def _render_vectors(
    options: argparse.Namespace, subject: Subject, size: tuple[int, int], output: Path
) -> int:
    """One picture as SVG or PDF; OpenGL starts only for what must be embedded."""
    from .files.output import write_bytes
    from .files.vector import pdf, svg
    from .vectors import draw_vectors

    if options.plain or subject.display.compare:
        word = "--plain" if options.plain else "compare"
        raise UsageError(f"{word}: expected an --output ending in .png, found {str(output)!r}")

    def embedded(figure: Figure, size: tuple[int, int]) -> NDArray[np.uint8]:
        from .snapshot import Studio

        return Studio(options.evaluator).draw_figure(figure, subject, size)

    drawing = draw_vectors(subject, size, embedded)
    is_svg = output.suffix.lower() == ".svg"
    write_bytes(svg(drawing).encode() if is_svg else pdf(drawing), output)
    return 0


def run_animate(options: argparse.Namespace) -> int:
    """One moving picture."""
    from .animate import ENDINGS, MOST_PIXELS, ProgressBar, courses, save_animation
    from .files.output import check_output

    size, output = parse_size(options.size), check_output(options.output, ENDINGS)
    if not 1.0 <= options.rate <= 100.0:
        raise UsageError(f"--rate: expected a number from 1 to 100, found {options.rate:g}")
    frames = courses(_subject(options), options.vary, options.frames, options.back)
    if size[0] * size[1] * len(frames) > MOST_PIXELS:
        raise UsageError(
            f"--frames: expected at most {MOST_PIXELS // (size[0] * size[1])} of that size, "
            f"found {len(frames)}"
        )
    from .snapshot import Studio

    studio, bar = Studio(options.evaluator), ProgressBar(len(frames))
    save_animation(frames, lambda frame: studio.draw(frame, size), output, options.rate, bar.step)
    return 0


def run_list(options: argparse.Namespace) -> int:
    """Scenes with their parameters, then the display's, which all scenes share."""
    from .scenes.registry import file_scene, load_scene, scene_names
    from .subject import DISPLAY

    scenes = [*(load_scene(name) for name in scene_names()), file_scene()]
    if options.json:
        import json

        rows = [{"scene": s.name, "title": s.title, "figure": s.figure,
                 "parameters": [p.row() for p in (*s.parameters.values(), *DISPLAY.values())]}
                for s in scenes]  # fmt: skip
        print(json.dumps(rows, indent=2, ensure_ascii=False))
        return 0
    for scene in scenes:
        print(f"{'FILE' if scene.opens_files else scene.name}: {scene.title}")
        _print_parameters(scene.parameters.values())
    print("any scene:")
    _print_parameters(DISPLAY.values())
    return 0


def run_check(options: argparse.Namespace) -> int:
    """The claims as a table; 1 if one fails."""
    from .scenes.claims import judge
    from .scenes.registry import load_scene, scene_names
    from .snapshot import Studio

    scenes = [load_scene(name) for name in options.scenes or scene_names()]
    studio, verdicts = Studio(), []
    for scene in scenes:
        for claim in scene.claimed():
            verdict = judge(scene.name, claim, studio)
            verdicts.append(verdict)
            if not options.json:
                mark = "ok  " if verdict.ok else "FAIL"
                print(f"{mark} {scene.name:6} {verdict.equation:8} {verdict.statement}")
                print(f"       expected {verdict.expected}  measured {verdict.measured}"
                      f"  tolerance {verdict.tolerance:g}")  # fmt: skip
    if options.json:
        import json

        print(json.dumps([asdict(verdict) for verdict in verdicts], indent=2))
    return 0 if all(verdict.ok for verdict in verdicts) else 1


def run_accuracy(options: argparse.Namespace) -> int:
    """Pixels that drawn points are off; 1 if a tolerance is not kept."""
    from .accuracy import measure
    from .snapshot import Studio

    size, subject = parse_size(options.size), _subject(options)
    found = []
    for accuracy in measure(Studio(options.evaluator), subject, size):
        found.append(accuracy)
        if not options.json:
            print(accuracy.line(), flush=True)
    if options.json:
        import json

        print(json.dumps([accuracy.row() for accuracy in found], indent=2))
    return 0 if all(accuracy.ok for accuracy in found) else 1


def run_bench(options: argparse.Namespace) -> int:
    """The benchmarks as a table, or JSON with the table as progress on stderr."""
    from .bench import line, run

    if not 1 <= options.pairs <= 10_000:
        raise UsageError(f"--pairs: expected a number from 1 to 10000, found {options.pairs}")
    rows = []
    for row in run(options.benchmarks, options.pairs):
        rows.append(row)
        print(line(row), file=sys.stderr if options.json else sys.stdout, flush=True)
    if options.json:
        import json

        print(json.dumps([row.as_json() for row in rows], indent=2))
    return 0


def run_export(options: argparse.Namespace) -> int:
    """The patches that are seen, or their triangles, as a file."""
    from .exporting import export
    from .files.output import check_output

    endings = (".bv", ".obj", ".stl", ".ply", ".glb")
    output = check_output(options.output, endings)
    subject = _subject(options)
    if options.level is not None:
        subject = subject.assigned([f"level={options.level}"])
    export(subject, output)
    return 0


def run_joins(options: argparse.Namespace) -> int:
    """How patches or curves meet, as a table or as JSON."""
    from .files.curve import is_curve
    from .join_report import patches_of, report, table

    if not 0.0 < options.tolerance < 1.0:
        raise UsageError(
            f"--tolerance: expected a number between 0 and 1, found {options.tolerance:g}"
        )
    if options.following or is_curve(Path(options.subject)):
        return _run_curve_joins(options)
    found = report(patches_of(_subject(options).figure()), options.tolerance)
    if options.json:
        import json

        print(json.dumps(found))
    else:
        print(*table(options.subject, found, options.all), sep="\n")
    return 0


def _run_curve_joins(options: argparse.Namespace) -> int:
    from .curve_report import between, table, within
    from .files.curve import read_curve

    name, path = options.subject, read_curve(Path(options.subject))
    if options.following:
        name = f"{name}, {options.following}"
        rows = between(path, read_curve(options.following), options.tolerance)
    else:
        rows = within(path, options.tolerance)
    if options.json:
        import json

        print(json.dumps(rows))
    else:
        print(*table(name, rows), sep="\n")
    return 0


def run_trace(options: argparse.Namespace) -> int:
    """Equally spaced points of a curve."""
    from .files.curve import read_curve
    from .files.output import check_output, write_bytes
    from .trace_report import lengths, rows, table

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


def run_doctor(options: argparse.Namespace) -> int:
    """What is here; 1 if nothing can be drawn."""
    from .doctor import examine

    report = examine()
    if options.json:
        import json

        print(json.dumps(report, indent=2))
    else:
        for name, value in report.items():
            print(f"{name:24} {value}")
    return 0 if report["draws"] else 1


def _print_parameters(parameters) -> None:  # type: ignore[no-untyped-def]
    for p in parameters:
        default = p.text(p.default) if p.points else repr(p.default)
        print(f"  {p.name:10} {p.expected()}; default {default}   {p.help}")
