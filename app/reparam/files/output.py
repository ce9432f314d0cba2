"""Writing pictures."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..errors import ReparamError, UsageError


def check_output(path: Path, endings: tuple[str, ...] = (".png",)) -> Path:
    """The path itself if a file can be written there: asked before the work is done."""
    if path.suffix.lower() not in endings:
        wanted = " or ".join(endings)
        raise UsageError(f"--output: expected a name ending in {wanted}, found {str(path)!r}")
    if not path.parent.is_dir():
        raise ReparamError(f"{path}: expected an existing folder, found no {path.parent}")
    if os.path.isdir(path) or not os.access(path if os.path.exists(path) else path.parent, os.W_OK):
        raise ReparamError(f"{path}: expected a file that may be written, found none")
    return path


def save_picture(picture: NDArray[np.uint8], path: Path) -> None:
    """Write (height, width, 3) as PNG."""
    write_whole(path, lambda part: Image.fromarray(picture).save(part, "PNG"))


def write_bytes(data: bytes, path: Path) -> None:
    """Write what is ready."""
    write_whole(path, lambda part: part.write_bytes(data))


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Have `write` write a file; what stood there stays until the new one is whole."""
    part = path.with_name(f".{path.name}.part")
    try:
        write(part)
        os.replace(part, path)
    except BaseException as error:
        with suppress(OSError):
            part.unlink()
        if isinstance(error, OSError):
            message = f"{path}: could not be written: {error.strerror or error}"
            raise ReparamError(message) from error
        raise
