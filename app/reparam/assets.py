"""Finds shaders/ and textures/, in a checkout or in a wheel, and expands #include in shaders."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .errors import GraphicsError

FILE_LINES = 10_000  # #line counts file * FILE_LINES + line: Mesa forgets the file's own number
_INCLUDE = re.compile(r'\s*#include\s+"([^"]+)"\s*$')


@cache
def root() -> Path:
    """The folder that holds shaders/ and textures/: the package in a wheel, else the checkout."""
    package = Path(__file__).resolve().parent
    for folder in (package, package.parents[1]):
        if (folder / "shaders").is_dir():
            return folder
    raise GraphicsError(f"expected the folder shaders/ in {package} or two above, found none")


def texture_path(name: str) -> Path:
    """The picture textures/NAME.png."""
    return root() / "textures" / f"{name}.png"


@dataclass(frozen=True)
class ShaderSource:
    """One stage, expanded. `#line S * FILE_LINES + N` is line N of `files[S]`."""

    text: str
    files: tuple[str, ...]


def read_shaders() -> dict[str, str]:
    """The texts of all files in shaders/ by their names, as `lib/bernstein.glsl`."""
    folder = root() / "shaders"
    files = sorted(path for path in folder.rglob("*.*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in files}


def expand_shader(name: str, texts: Mapping[str, str], preamble: str = "") -> ShaderSource:
    """A file of `read_shaders`, each #include expanded once, after the preamble."""
    files: list[str] = []
    lines = [preamble.rstrip("\n")] if preamble else []
    _expand(name, texts, files, lines)
    return ShaderSource("\n".join(lines) + "\n", tuple(files))


def _expand(name: str, texts: Mapping[str, str], files: list[str], lines: list[str]) -> None:
    number = len(files)
    files.append(name)
    lines.append(f"#line {number * FILE_LINES + 1}")
    for i, line in enumerate(texts[name].splitlines(), start=1):
        include = _INCLUDE.match(line)
        if include is None:
            lines.append(line)
            continue
        target = posixpath.normpath(posixpath.join(posixpath.dirname(name), include[1]))
        if target not in texts:
            raise GraphicsError(f"{name}:{i}: expected a file to include, found no {include[1]}")
        if target not in files:
            _expand(target, texts, files, lines)
        lines.append(f"#line {number * FILE_LINES + i + 1}")
