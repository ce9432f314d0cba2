"""Reading the user's curve: a table of control points, as any spreadsheet writes it.

    # a comment
    degree 3
    knots 0 0 0 0 1 2 2 2 2
    x, y, weight
    0, 0, 1
    1, 2, 0.5
    ...

Numbers stand between commas or blanks. `degree` makes the points those of a B-spline, clamped and
uniform if no `knots` are given; without it they are one Bezier curve. A row of names tells what
the columns are, of x, y, z and weight; without it they are x y, x y z, or x y z weight. Weights
are not multiplied into the points.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..errors import FileFormatError
from ..geometry.curve import curve_net
from ..geometry.net import MAX_ORDER
from ..geometry.paths import Path as CurvePath
from ..geometry.paths import bezier_path, spline_path

ENDINGS = (".csv", ".txt")
MAX_BYTES = 1 << 24
MAX_POINTS = 100_000
COLUMNS = {2: ("x", "y"), 3: ("x", "y", "z"), 4: ("x", "y", "z", "weight")}
SAME = {"w": "weight"}


def is_curve(path: Path) -> bool:
    """Whether a file's name says that it holds a curve."""
    return path.suffix.lower() in ENDINGS


def read_curve(path: Path) -> CurvePath:
    """The curve of a file. Raises FileFormatError: `file:line: expected ..., found ...`."""
    degree: int | None = None
    knots: list[float] | None = None
    names: tuple[str, ...] | None = None
    rows: list[list[float]] = []
    for line, words in _lines(path):
        where, word = f"{path}:{line}", words[0].lower()
        if word == "degree":
            degree = _degree(where, words)
        elif word == "knots":
            knots = _numbers(where, words[1:])
        elif names is None and not rows and _is_header(words):
            names = _columns(where, [w.lower() for w in words])
        else:
            row = _numbers(where, words)
            if names is None:
                names = COLUMNS.get(len(row))
            if names is None or len(row) != len(names):
                wanted = len(names) if names else "2, 3 or 4"
                raise FileFormatError(f"{where}: expected {wanted} numbers, found {len(row)}")
            rows.append(row)
            if len(rows) > MAX_POINTS:
                raise FileFormatError(f"{where}: expected at most {MAX_POINTS} points, found more")
    if len(rows) < 2:
        raise FileFormatError(f"{path}: expected two control points or more, found {len(rows)}")
    assert names is not None
    return _curve(path, names, np.array(rows), degree, knots)


def _curve(
    path: Path,
    names: tuple[str, ...],
    rows: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    degree: int | None,
    knots: list[float] | None,
) -> CurvePath:
    columns = dict(zip(names, rows.T, strict=True))
    points = np.stack([columns.get(name, np.zeros(len(rows))) for name in "xyz"], -1)
    if knots is not None and degree is None:
        degree = len(knots) - len(rows) - 1
    if degree is None and len(rows) > MAX_ORDER:
        raise FileFormatError(
            f"{path}: expected at most {MAX_ORDER} points of one Bézier curve, found {len(rows)}; "
            "a line `degree 3` makes them a B-spline"
        )
    try:
        weights = columns.get("weight")
        if weights is not None and not (weights > 0.0).all():
            raise ValueError(f"expected positive weights, found {weights.min():g}")
        net = curve_net(points[:, None], None if weights is None else weights[:, None])[:, 0]
        found = bezier_path(net) if degree is None else spline_path(net, degree, knots)
        if found.arc.length == 0.0:
            raise ValueError("expected a curve of some length, found a point")
    except ValueError as fault:
        raise FileFormatError(f"{path}: {fault}") from None
    return found


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """The words of each line that has any, with its number."""
    try:
        if not path.is_file():
            raise FileFormatError(f"{path}: expected a file of control points, found none")
        if path.stat().st_size > MAX_BYTES:
            size = path.stat().st_size
            raise FileFormatError(f"{path}: expected at most {MAX_BYTES} bytes, found {size}")
        text = path.read_text("utf-8-sig")
    except UnicodeDecodeError:
        raise FileFormatError(f"{path}: expected text, found other bytes") from None
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path}: expected a readable file, found {error}") from None
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        if words:
            found.append((number, words))
    return found


def _is_header(words: list[str]) -> bool:
    return all(word[0].isalpha() and word.lower() not in ("nan", "inf") for word in words)


def _columns(where: str, words: list[str]) -> tuple[str, ...]:
    names = tuple(SAME.get(word, word) for word in words)
    known = ("x", "y", "z", "weight")
    if len(set(names)) < len(names) or not {"x", "y"} <= set(names) <= set(known):
        raise FileFormatError(
            f"{where}: expected degree, knots, or columns x, y, z, weight, "
            f"found {' '.join(words)[:40]!r}"
        )
    return names


def _degree(where: str, words: list[str]) -> int:
    if len(words) != 2 or not words[1].isdecimal() or not 1 <= int(words[1][:3]) < MAX_ORDER:
        found = " ".join(words)[:40]
        raise FileFormatError(f"{where}: expected degree 1 to {MAX_ORDER - 1}, found {found!r}")
    return int(words[1])


def _numbers(where: str, words: list[str]) -> list[float]:
    numbers = []
    for word in words:
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise FileFormatError(f"{where}: expected a number, found {word[:40]!r}")
        numbers.append(number)
    return numbers
