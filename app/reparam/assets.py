"""Finds shaders/ and textures/, in a checkout or in a wheel, and expands #include in shaders."""

from __future__ import annotations

import re
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
    files: tuple[Path, ...]


def expand_shader(name: str, preamble: str = "") -> ShaderSource:
    """shaders/NAME with each #include expanded once, after `preamble` (#version, #define)."""
    files: list[Path] = []
    lines = [preamble.rstrip("\n")] if preamble else []
    _expand(root() / "shaders" / name, files, lines)
    return ShaderSource("\n".join(lines) + "\n", tuple(files))


def _expand(path: Path, files: list[Path], lines: list[str]) -> None:
    number = len(files)
    files.append(path)
    lines.append(f"#line {number * FILE_LINES + 1}")
    for i, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        include = _INCLUDE.match(line)
        if include is None:
            lines.append(line)
            continue
        target = (path.parent / include[1]).resolve()
        if not target.is_file():
            raise GraphicsError(
                f"{path.name}:{i}: expected a file to include, found no {include[1]}"
            )
        if target not in files:
            _expand(target, files, lines)
        lines.append(f"#line {number * FILE_LINES + i + 1}")
