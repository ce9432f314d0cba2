"""A subject as a file, as a command line, and back."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from .errors import ReparamError, UsageError
from .files.saved import FORMAT, Saved, read_saved, write_saved
from .geometry.camera import View, check_view
from .subject import DISPLAY, Subject

VIEW_TEXT = "SPACE=ZOOM,X,Y[,AZIMUTH,ELEVATION[,PIVOT_X,PIVOT_Y,PIVOT_Z,DISTANCE]]"


def differences(subject: Subject) -> dict[str, Any]:
    """The parameters that have not their default, in the order of the scene."""
    parameters = subject.parameters()
    return {
        name: subject.value(name)
        for name, parameter in parameters.items()
        if not np.array_equal(subject.value(name), parameter.default)
    }


def save(subject: Subject, path: Path) -> None:
    """Write the subject as a file that `open_saved` reads. Raises ReparamError."""
    plain = {name: subject.parameters()[name].plain(v) for name, v in differences(subject).items()}
    if subject.source:
        start = {"file": Path(os.path.relpath(subject.source, path.parent)).as_posix()}
    else:
        start = {"scene": subject.scene.name}
    sections = {
        "parameters": {name: v for name, v in plain.items() if name not in DISPLAY},
        "display": {name: v for name, v in plain.items() if name in DISPLAY},
        "views": {name: _plain_view(view) for name, view in subject.views.items()},
    }
    filled = {name: section for name, section in sections.items() if section}
    write_saved(path, {"reparam": FORMAT, **start, **filled})


def open_saved(path: Path, open_named: Callable[[str], Subject]) -> Subject:
    """The subject that a file holds; `open_named` opens scenes and surfaces by name.

    Raises FileFormatError, `file:line: expected ..., found ...`.
    """
    saved = read_saved(path)
    subject = _opened(saved, open_named)
    for section in ("parameters", "display"):
        known = DISPLAY if section == "display" else subject.scene.parameters
        for name, value in saved.sections[section].items():
            if name not in known:
                expected = f"expected one of {', '.join(known)}"
                raise saved.error(name, f"{expected}, found {name!r}")
            try:
                subject = subject.changed(name, known[name].accept(value))
            except ValueError as fault:
                raise saved.error(name, str(fault)) from None
    views = {name: _view(saved, name, value) for name, value in saved.sections["views"].items()}
    try:
        return with_views(subject, views)
    except ReparamError as fault:
        raise saved.error(next(iter(views), "parameters"), str(fault)) from None


def _opened(saved: Saved, open_named: Callable[[str], Subject]) -> Subject:
    if saved.file:
        return open_named(str(saved.path.parent / saved.file))
    try:
        return open_named(saved.scene)
    except UsageError as fault:
        raise saved.error("scene", str(fault)) from None


def with_views(subject: Subject, views: Mapping[str, View]) -> Subject:
    """The subject seen so. Raises UsageError for a space that it has not."""
    names = [space.name for space in subject.figure().spaces]
    for name in views:
        if name not in names:
            raise UsageError(f"view: expected one of {', '.join(names)}, found {name!r}")
    return replace(subject, views={**subject.views, **views})


def parse_view(text: str) -> tuple[str, View]:
    """The space and its view of "physical=2,0.1,-0.5". Raises UsageError."""
    name, _, numbers = text.partition("=")
    try:
        values = [float(number) for number in numbers.split(",")]
        if len(values) not in (3, 5, 9) or not name:
            raise ValueError("as many numbers")
        angles = dict(zip(("azimuth", "elevation"), values[3:5], strict=False))
        pan, pivot = (values[1], values[2]), tuple(values[5:])
        return name, check_view(View(values[0], pan, pivot=pivot, **angles))
    except ValueError:
        raise UsageError(f"--view: expected {VIEW_TEXT}, found {text!r}") from None


def view_text(name: str, view: View) -> str:
    """The text that `parse_view` takes for a view, bit for bit."""
    numbers = [view.zoom, *view.pan]
    if (view.azimuth, view.elevation, view.pivot) != (View.azimuth, View.elevation, ()):
        numbers += [view.azimuth, view.elevation, *view.pivot]
    return f"{name}=" + ",".join(f"{number!r}".removesuffix(".0") for number in numbers)


def command(subject: Subject, size: tuple[int, int], evaluator: str | None, output: str) -> str:
    """The command line that draws this picture without a window, quoted for a shell."""
    words = ["reparam", "render", subject.source or subject.scene.name, "-o", output]
    words += ["--size", f"{size[0]}x{size[1]}"]
    for name, value in differences(subject).items():
        words += ["--set", f"{name}={subject.parameters()[name].text(value)}"]
    for name, view in subject.views.items():
        words += ["--view", view_text(name, view)]
    words += ["--evaluator", evaluator] if evaluator else []
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def _plain_view(view: View) -> dict[str, Any]:
    start = asdict(View())
    found = {name: v for name, v in asdict(view).items() if v != start[name]}
    return {name: list(v) if isinstance(v, tuple) else v for name, v in found.items()}


def _view(saved: Saved, name: str, content: Any) -> View:
    try:
        if not isinstance(content, dict) or not content.keys() <= asdict(View()).keys():
            raise ValueError
        x, y = map(float, content.get("pan", (0.0, 0.0)))
        pivot = tuple(map(float, content.get("pivot", ())))
        places = ("pan", "pivot")
        numbers = {key: float(value) for key, value in content.items() if key not in places}
        return check_view(View(**numbers, pan=(x, y), pivot=pivot))
    except (TypeError, ValueError):
        expected = "expected zoom, pan [x, y], azimuth, elevation, pivot [x, y, z, distance]"
        raise saved.error(name, f"{expected}, found {content!r}") from None
