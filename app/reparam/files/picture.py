"""Reading the user's pictures."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from PIL import Image, ImageOps

from ..assets import texture_path
from ..errors import FileFormatError

LARGEST_SIDE = 16384
MOST_PIXELS = 1 << 27
LONGEST_NAME = 100  # of a picture in textures/; the system raises on very long ones


@dataclass(frozen=True)
class Pixels:
    """8-bit RGB, bottom row first, as OpenGL wants it."""

    size: tuple[int, int]
    data: bytes


@contextmanager
def _quiet() -> Iterator[None]:
    """Pillow warns of large pictures and odd EXIF tags, which are not the user's concern."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def png_bytes(pixels: Pixels) -> bytes:
    """The picture as PNG."""
    upside_down = Image.frombytes("RGB", pixels.size, pixels.data)
    stream = io.BytesIO()
    upside_down.transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(stream, "PNG", optimize=True)
    return stream.getvalue()


def find_picture(source: str) -> Path:
    """The picture of that name in textures/; if there is none, a file."""
    if source.isidentifier() and len(source) < LONGEST_NAME and texture_path(source).is_file():
        return texture_path(source)
    return Path(source)


def is_picture(path: Path) -> bool:
    """Whether the name ends as those of pictures do."""
    return path.suffix.lower() in Image.registered_extensions()


@lru_cache(maxsize=4)
def read_picture(path: Path) -> Pixels:
    """Any picture that Pillow reads, turned upright by its EXIF tag, on white where transparent.

    Raises FileFormatError if there is none at `path`, it is corrupt, or larger than
    LARGEST_SIDE or MOST_PIXELS in all: the size is known before memory is taken.
    """
    try:
        with _quiet(), Image.open(path) as image:
            width, height = image.size
            if max(width, height) > LARGEST_SIDE or width * height > MOST_PIXELS:
                raise FileFormatError(
                    f"{path}: expected a picture of at most {LARGEST_SIDE} pixels a side and "
                    f"{MOST_PIXELS} in all, found {width} x {height}"
                )
            upright = ImageOps.exif_transpose(image)
            if upright.has_transparency_data:
                upright = upright.convert("RGBA")
                ground = Image.new("RGBA", upright.size, "white")
                upright = Image.alpha_composite(ground, upright)
            rgb = upright.convert("RGB")
    except FileFormatError:
        raise
    except FileNotFoundError:
        raise FileFormatError(f"{path}: expected a picture, found no such file") from None
    except Exception as error:  # Pillow's readers raise what they like
        raise FileFormatError(f"{path}: expected a picture, found {error}") from None
    flipped = rgb.transpose(Image.Transpose.FLIP_TOP_BOTTOM)
    return Pixels(flipped.size, flipped.tobytes())
