"""Moving pictures: a subject drawn again and again while parameters go their ways."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from .errors import UsageError
from .files.output import write_whole
from .scenes.parameters import Parameter, find
from .subject import Subject

Picture = NDArray[np.uint8]

ENDINGS = (".gif", ".webp", ".png")
MOST_FRAMES = 10_000
MOST_PIXELS = 1 << 31  # of all frames together
COLORS = 256
STUDIED = 6  # frames that a GIF's colours are chosen from
BAR = 30  # characters


def courses(
    subject: Subject, varied: Sequence[str], frames: int, there_and_back: bool = False
) -> list[Subject]:
    """The subject of each frame, from `NAME=FROM:TO` and `NAME=A,B,C`, all going at once.

    Numbers (and arrays of numbers) go evenly from one to the other; a clock, which begins again
    where it ends, stops a step before. Names take equal shares of the time. Raises UsageError.
    """
    if not 2 <= frames <= MOST_FRAMES:
        raise UsageError(f"--frames: expected a number from 2 to {MOST_FRAMES}, found {frames}")
    if not varied:
        raise UsageError("--vary: expected NAME=FROM:TO or NAME=A,B,C, found none")
    steps = list(range(frames))
    if there_and_back:
        steps += steps[-2:0:-1]
    subjects = [subject] * len(steps)
    for text in varied:
        name, equals, way = text.partition("=")
        if not equals:
            raise UsageError(f"--vary: expected NAME=FROM:TO or NAME=A,B,C, found {text!r}")
        parameter = find(subject.parameters(), name, "--vary")
        value = _course(parameter, way, frames)
        try:
            subjects = [s.changed(name, value(k)) for s, k in zip(subjects, steps, strict=True)]
        except ValueError as fault:
            raise UsageError(str(fault)) from None
    subjects[0].figure()
    for before, now in pairwise(subjects):
        if _words(now) != _words(before):  # a scene may refuse a text
            now.figure()
    return subjects


def _words(subject: Subject) -> list[Any]:
    return [value for value in subject.values.values() if isinstance(value, str)]


def _course(parameter: Parameter, way: str, frames: int) -> Callable[[int], Any]:
    """The value in frame k."""
    if parameter.points is None and parameter.type in (str, bool):
        values = [parameter.parse(word) for word in way.split(",")]
        return lambda k: values[k * len(values) // frames]
    start, colon, end = way.partition(":")
    if not colon:
        raise UsageError(f"--vary: {parameter.name}: expected FROM:TO, found {way!r}")
    low, high = parameter.parse(start), parameter.parse(end)
    if np.shape(low) != np.shape(high):
        raise UsageError(f"--vary: {parameter.name}: expected two arrays of one shape")
    clock = parameter.range is not None and parameter.range.clock
    last = frames if clock else frames - 1

    def value(k: int) -> Any:
        mixed = low + (high - low) * (k / last)
        return round(mixed) if parameter.type is int else mixed

    return value


def save_animation(
    frames: Sequence[Subject],
    draw: Callable[[Subject], Picture],
    path: Path,
    rate: float,
    drawn: Callable[[], None],
) -> None:
    """Write the frames, `rate` a second and round and round, as the name's ending says.

    `drawn` is told of each frame.
    """

    def images() -> Iterator[Image.Image]:
        for frame in frames:
            yield Image.fromarray(draw(frame))
            drawn()

    pictures = images()
    settings: dict[str, Any] = {"save_all": True, "duration": 1000.0 / rate, "loop": 0}
    form = {".gif": "GIF", ".webp": "WEBP", ".png": "PNG"}[path.suffix.lower()]
    if form == "GIF":
        step = max(1, len(frames) // STUDIED)
        colors = common_colors([draw(frame) for frame in frames[::step]])
        pictures = (p.quantize(palette=colors, dither=Image.Dither.NONE) for p in pictures)
        settings |= {"duration": max(20, round(100.0 / rate) * 10), "optimize": False}
    if form == "WEBP":
        settings |= {"lossless": True, "duration": round(1000.0 / rate)}
    first = next(pictures)
    others = list(pictures)  # Pillow goes over them twice
    write_whole(path, lambda part: first.save(part, form, append_images=others, **settings))


def common_colors(pictures: Sequence[Picture]) -> Image.Image:
    """One palette for all frames: what does not move does not flicker."""
    strip = Image.fromarray(np.concatenate(pictures))
    return strip.quantize(COLORS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


class ProgressBar:
    """A line on stderr that fills."""

    def __init__(self, total: int) -> None:
        self._total, self._done, self._out, self._shown = total, 0, sys.stderr, -1

    def step(self) -> None:
        """One more is done."""
        self._done += 1
        filled = BAR * self._done // self._total
        if filled != self._shown:
            bar = "#" * filled + "." * (BAR - filled)
            end = "\n" if self._done == self._total else ""
            self._out.write(f"\r[{bar}] {self._done}/{self._total}{end}")
            self._out.flush()
            self._shown = filled
