"""The words of a .bv file: runs of numbers between group lines, each word with its line.

Numbers are converted a chunk at a time by numpy; where a word stands in the file is worked out
only when an error has to say so.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from itertools import islice, takewhile
from math import inf, isfinite
from pathlib import Path

import numpy as np

from ..errors import FileFormatError
from ..geometry.net import LARGEST, Array
from .progress import Progress, silent

MAX_BYTES = 1 << 28
CHUNK = 1 << 20  # bytes whose words are Python objects at one time

ODD = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")  # control characters that no text holds
BLANK = re.compile(rb"\s")
WORD = re.compile(rb"\S+")
GROUP = re.compile(rb"[Gg]roup(?<!\S[Gg]roup)(?!\S)[^\n]*")  # the letters first: they are rare


def read_text(path: Path, kind: str = ".bv") -> bytes:
    """The file without byte order mark and blanks at its end, its lines ended by newlines.

    Raises FileFormatError for what cannot be read, is larger than MAX_BYTES, or is not text.
    """
    try:
        if not path.is_file():
            found = "a directory" if path.is_dir() else "a device" if path.exists() else "no file"
            raise FileFormatError(f"{path}: expected a readable {kind} file, found {found}")
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise FileFormatError(f"{path}: expected at most {MAX_BYTES} bytes, found {size}")
        data = path.read_bytes()
    except OSError as error:
        found = error.strerror or "an error"
        raise FileFormatError(f"{path}: expected a readable {kind} file, found {found}") from None
    data = data.removeprefix(b"\xef\xbb\xbf").replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    if odd := ODD.search(data):
        place = f"{path}:{_line(data, odd.start())}"
        raise FileFormatError(f"{place}: expected text, found the byte 0x{odd[0][0]:02x}")
    return data.rstrip()


def runs(path: Path, data: bytes, progress: Progress = silent) -> Iterator[tuple[str, Numbers]]:
    """What stands between the group lines of `read_text(path)`, each with its group's name.

    Numbers before the first group line belong to the group "". Raises FileFormatError for a
    group line without colour number or name.
    """
    name, start = "", 0
    for group in GROUP.finditer(data):
        yield name, Numbers(path, data, start, group.start(), progress)
        words = group[0].split()
        if len(words) < 3 or not re.fullmatch(rb"[+-]?\d+", words[1]):
            place = f"{path}:{_line(data, group.start())}"
            raise FileFormatError(
                f"{place}: expected Group, a colour number and a name, found {_quote(group[0])}"
            )
        name, start = words[2].decode("utf-8", "replace"), group.end()
    yield name, Numbers(path, data, start, len(data), progress)


class Numbers:
    """The numbers of one run, handed out in order; `position` is the index of the next."""

    def __init__(
        self, path: Path, data: bytes, start: int, stop: int, progress: Progress = silent
    ) -> None:
        self.position = 0
        self._path = path
        self._data = data
        self._start = start
        self._stop = stop
        self._first_words: list[int] = []  # of the chunks, as indices in the run
        self._starts: list[int] = []  # of the chunks, as offsets in the file
        self._blocked = False  # by a word that is no usable number
        self._values = self._convert(start, progress)

    def _convert(self, start: int, progress: Progress) -> Array:
        """The usable numbers, up to the end or to the first word that is none."""
        parts: list[Array] = [np.zeros(0)]
        count = 0
        while start < self._stop and not self._blocked:
            progress(self._share(0.5 * (start - self._start) / (self._stop - self._start)))
            blank = BLANK.search(self._data, min(start + CHUNK, self._stop), self._stop)
            end = blank.start() if blank else self._stop
            values, whole = _usable_numbers(self._data[start:end])
            parts.append(values)
            self._first_words.append(count)
            self._starts.append(start)
            self._blocked = not whole
            count += len(values)
            start = end
        return np.concatenate(parts)

    def share(self) -> float:
        """How much of the file's work is done, nearly: half is reading its words as numbers."""
        way = 0.5 + 0.5 * self.position / max(1, len(self._values))
        return self._share(way)

    def _share(self, way: float) -> float:
        return (self._start + way * (self._stop - self._start)) / max(1, len(self._data))

    def at_end(self) -> bool:
        """Whether the run has no more words, of whatever kind."""
        return self.position == len(self._values) and not self._blocked

    def take(self, count: int, expected: str) -> Array:
        """The next `count` numbers, as a view: finite and not larger than LARGEST.

        Whether they are there is looked up before memory is taken. Raises FileFormatError with
        the line of the odd word, or of the header that promised more than there is.
        """
        remaining = len(self._values) - self.position
        if count > remaining:
            if self._blocked:
                raise self.error(len(self._values), _objection(self._word(len(self._values))[1]))
            if remaining:
                raise self.error(self.position - 1, expected, str(remaining))
            raise self.error(self.position, expected)
        self.position += count
        return self._values[self.position - count : self.position]

    def integers(self, count: int, expected: str, low: int, high: float = inf) -> list[int]:
        """The next `count` numbers, integers from `low` to `high`, else FileFormatError."""
        first = self.position
        values = self.take(count, expected).tolist()
        for index, value in enumerate(values, first):
            if not (low <= value <= high and value.is_integer()):
                limits = f"from {low} to {high}" if isfinite(high) else f"of at least {low}"
                raise self.error(index, f"{expected} {limits}")
        return [int(value) for value in values]

    def integer(self, expected: str, low: int, high: float = inf) -> int:
        """The next number, an integer from `low` to `high`, else FileFormatError."""
        return self.integers(1, expected, low, high)[0]

    def line(self, index: int) -> int:
        """The line of the file in which word `index` of the run stands."""
        return _line(self._data, self._word(index)[0])

    def error(self, index: int, expected: str, found: str = "") -> FileFormatError:
        """The error `file:line: expected ..., found ...` for word `index` of the run."""
        offset, word = self._word(index)
        end = "the end of the file" if self._stop == len(self._data) else "a group line"
        found = found or (_quote(word) if word else end)
        place = f"{self._path}:{_line(self._data, offset)}"
        return FileFormatError(f"{place}: expected {expected}, found {found}")

    def _word(self, index: int) -> tuple[int, bytes]:
        """Offset and text of a word; past the last one, the end of the run and no text."""
        chunk = bisect_right(self._first_words, index) - 1
        if chunk >= 0:
            words = WORD.finditer(self._data, self._starts[chunk], self._stop)
            for word in islice(words, index - self._first_words[chunk], None):
                return word.start(), word[0]
        return self._stop, b""


def _usable_numbers(text: bytes) -> tuple[Array, bool]:
    """The values of the leading usable words, and whether these are all words of the text."""
    words = text.split()
    if text.isascii() and b"_" not in text:  # Python reads 1_000 and Arabic digits, C does not
        try:
            values = np.array(words, dtype=np.float64)
        except ValueError:
            pass
        else:
            if (np.abs(values) <= LARGEST).all():
                return values, True
    usable = [float(word) for word in takewhile(lambda word: not _objection(word), words)]
    return np.array(usable, dtype=np.float64), len(usable) == len(words)


def _objection(word: bytes) -> str:
    """What was expected instead of this word; nothing if it is a usable number."""
    try:
        value = float(word)
    except ValueError:
        return "a number"
    if b"_" in word:
        return "a number"
    if not isfinite(value):
        return "a finite number"
    return "" if abs(value) <= LARGEST else f"a number of size up to {LARGEST:g}"


def _line(data: bytes, offset: int) -> int:
    return data.count(b"\n", 0, offset) + 1


def _quote(word: bytes) -> str:
    """A piece of the file, short and printable."""
    text = word[:200].decode("utf-8", "replace")
    return ascii(text if len(text) <= 40 else text[:37] + "...")
