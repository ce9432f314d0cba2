"""Makes the pictures of this folder: `python textures/make_textures.py`."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).parent
DARK, LIGHT = (0, 128, 196), (255, 252, 245)


def checkerboard(cell: int = 256) -> Image.Image:
    """2 x 2 squares, dark at the lower left: repeated, a checkerboard."""
    image = Image.new("RGB", (2 * cell, 2 * cell), LIGHT)
    image.paste(DARK, (0, cell, cell, 2 * cell))
    image.paste(DARK, (cell, 0, 2 * cell, cell))
    return image


def corners(cell: int = 64) -> Image.Image:
    """Four colours, to tell every turn and reflection apart: red upper left, green upper right,
    blue lower left, yellow lower right."""
    image = Image.new("RGB", (2 * cell, 2 * cell))
    image.paste((213, 40, 40), (0, 0, cell, cell))
    image.paste((0, 158, 80), (cell, 0, 2 * cell, cell))
    image.paste((30, 80, 200), (0, cell, cell, 2 * cell))
    image.paste((240, 228, 66), (cell, cell, 2 * cell, 2 * cell))
    return image


def waves(size: int = 64) -> Image.Image:
    """The picture of texturesurf.c (OpenGL Programming Guide): three waves, one a colour; the
    first index of its array runs upwards."""
    t = 2.0 * math.pi * np.arange(size) / size
    i, j = np.meshgrid(t, t, indexing="ij")
    channels = [1.0 + np.sin(i), 1.0 + np.cos(2.0 * j), 1.0 + np.cos(i + j)]
    pixels = (127.0 * np.stack(channels, -1)).astype(np.uint8)
    return Image.fromarray(pixels[::-1].copy())


def ramp(length: int = 256, height: int = 4) -> Image.Image:
    """From dark violet over green to yellow, left to right: the colours of a field (viridis)."""
    anchors = [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)]
    at = np.linspace(0.0, len(anchors) - 1.0, length)
    rows = [np.interp(at, np.arange(len(anchors)), channel) for channel in np.transpose(anchors)]
    pixels = np.round(np.stack(rows, -1)).astype(np.uint8)
    return Image.fromarray(np.broadcast_to(pixels, (height, length, 3)).copy())


if __name__ == "__main__":
    for make in (checkerboard, corners, ramp, waves):
        make().save(FOLDER / f"{make.__name__}.png", optimize=True)
