"""Scenes as the user left them: small JSON files that people can read and edit.

    {
      "reparam": 1,
      "scene": "fig5",
      "parameters": {
        "texture": "r"
      },
      "display": {
        "net": true
      },
      "views": {
        "physical": {"zoom": 2, "pan": [0.5, 0]}
      }
    }

`file` stands instead of `scene` for a surface: its path, seen from the folder of this file. What is
left out has its default.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import FileFormatError, ReparamError

FORMAT = 1
LARGEST = 1 << 26  # bytes
WIDE = 88  # characters of a value on one line
SECTIONS = ("parameters", "display", "views")
WORDS = ("reparam", "scene", "file", *SECTIONS)


@dataclass(frozen=True)
class Saved:
    """What such a file says: `scene` or `file`, and the sections by name."""

    path: Path
    text: str
    scene: str
    file: str
    sections: Mapping[str, Mapping[str, Any]]

    def error(self, word: str, complaint: str) -> FileFormatError:
        """`file:line: complaint`, with the line where the word stands as a key."""
        return FileFormatError(f"{self.path}:{_line_of(self.text, word)}: {complaint}")


def is_saved(path: Path) -> bool:
    """Whether the name is that of a saved scene."""
    return path.suffix.lower() == ".json"


def read_saved(path: Path) -> Saved:
    """Read and check the frame; what the values mean is for the scene to say.

    Raises FileFormatError, `file:line: expected ..., found ...`.
    """
    text = _read(path)
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        expected = error.msg.removeprefix("Expecting ")
        expected = expected if expected != error.msg else f"JSON ({error.msg})"
        rest = text[error.pos :].split("\n")[0][:30].strip()
        found = f"{rest!r}" if rest else "the end of the line"
        message = f"{path}:{error.lineno}: expected {expected}, found {found}"
        raise FileFormatError(message) from None
    except RecursionError:
        raise FileFormatError(f"{path}:1: expected a saved scene, found too deep a nest") from None
    if not isinstance(content, dict) or content.get("reparam") != FORMAT:
        found = repr(content.get("reparam", "none")) if isinstance(content, dict) else "no object"
        line = _line_of(text, "reparam")
        raise FileFormatError(f'{path}:{line}: expected "reparam": {FORMAT}, found {found}')
    sections = {name: content.get(name, {}) for name in SECTIONS}
    saved = Saved(path, text, content.get("scene", ""), content.get("file", ""), sections)
    for word, value in content.items():
        if word not in WORDS:
            raise saved.error(word, f"expected one of {', '.join(WORDS)}, found {word!r}")
        if word in SECTIONS and not isinstance(value, dict):
            raise saved.error(word, f"expected an object with names and values, found {value!r}")
    names = [name for name in (saved.scene, saved.file) if name]
    if len(names) != 1 or not isinstance(names[0], str):
        found = "both" if len(names) == 2 else repr(names[0]) if names else "neither"
        raise saved.error("scene", f"expected the name of a scene or of a file, found {found}")
    return saved


def write_saved(path: Path, content: Mapping[str, Any]) -> None:
    """Write a new file; one that is there stays, and is a ReparamError."""
    lines = ",\n".join(f"  {json.dumps(word)}: {_written(content[word], 2)}" for word in content)
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(f"{{\n{lines}\n}}\n")
    except OSError as error:
        raise ReparamError(f"{path}: could not be written: {error.strerror or error}") from None


def _written(value: Any, indent: int) -> str:
    """JSON, on one line where that is wide enough for it; a mapping has a line for each name."""
    line = json.dumps(value, ensure_ascii=False)
    inner, outer = " " * (indent + 2), " " * indent
    if isinstance(value, dict) and value and (indent == 2 or len(line) > WIDE):
        rows = [f"{json.dumps(k)}: {_written(v, indent + 2)}" for k, v in value.items()]
        return f"{{\n{inner}" + f",\n{inner}".join(rows) + f"\n{outer}}}"
    if isinstance(value, list) and len(line) > WIDE:
        rows = [_written(part, indent + 2) for part in value]
        return f"[\n{inner}" + f",\n{inner}".join(rows) + f"\n{outer}]"
    return line


def _read(path: Path) -> str:
    try:
        if not path.is_file():
            found = "a directory" if path.is_dir() else "no file"
            raise FileFormatError(f"{path}: expected a saved scene, found {found}")
        if path.stat().st_size > LARGEST:
            raise FileFormatError(f"{path}: expected at most {LARGEST} bytes, found more")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise FileFormatError(f"{path}: expected a saved scene, found {error.strerror}") from None
    except UnicodeDecodeError as error:
        message = f"{path}:1: expected UTF-8 text, found the byte 0x{error.object[error.start]:02x}"
        raise FileFormatError(message) from None


def _line_of(text: str, word: str) -> int:
    key = re.search(rf'"{re.escape(word)}"\s*:', text)
    return text.count("\n", 0, key.start()) + 1 if key else 1
