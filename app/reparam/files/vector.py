"""Pictures as vectors: what there is to draw, and how SVG and PDF say it.

Lengths are pixels, y up from the lower left. A path is a list of pieces: a start point and Bezier
segments of degree 1 to 3, each given by the points after the one before.
"""

from __future__ import annotations

import base64
import io
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..scenes.layers import Color

Array = NDArray[np.float64]
Box = tuple[float, float, float, float]  # left, bottom, width, height

POINTS_PER_PIXEL = 0.75  # of PDF: a pixel is 1/96 of an inch


@dataclass(frozen=True)
class Piece:
    """A start (2,), and segments (k, 2): one point a line, two a quadratic, three a cubic."""

    start: Array
    segments: tuple[Array, ...]
    closed: bool = False


@dataclass(frozen=True)
class Shape:
    """Pieces that are stroked with round joins and caps as wide as `width`, or filled if it is 0.

    `words` is the text that filled outlines show, for those who read a file and do not see it.
    """

    pieces: tuple[Piece, ...]
    color: Color
    width: float = 0.0
    words: str = ""


@dataclass(frozen=True)
class Raster:
    """An embedded picture (rows, columns, 3), top row first."""

    pixels: NDArray[np.uint8]
    box: Box


@dataclass(frozen=True)
class Group:
    """What is drawn within a box, and nowhere else."""

    box: Box
    items: tuple[Shape | Raster, ...]


@dataclass(frozen=True)
class Drawing:
    """A picture of width x height pixels on a plain ground."""

    width: int
    height: int
    ground: Color
    groups: tuple[Group, ...]


def hexadecimal(color: Color) -> str:
    """#RRGGBB."""
    return "#" + "".join(f"{round(255 * c):02x}" for c in color)


def number(value: float) -> str:
    """With three decimals, no more than needed."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


# SVG ----------------------------------------------------------------------------------------


def svg(drawing: Drawing) -> str:
    """The drawing as an SVG file."""
    width, height = drawing.width, drawing.height
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        f'<rect width="{width}" height="{height}" fill="{hexadecimal(drawing.ground)}"/>',
    ]
    for i, group in enumerate(drawing.groups):
        left, bottom, wide, high = group.box
        top = number(height - bottom - high)
        lines += [
            f'<clipPath id="box{i}"><rect x="{number(left)}" y="{top}" width="{number(wide)}" '
            f'height="{number(high)}"/></clipPath>',
            f'<g clip-path="url(#box{i})">',
            *(_svg_item(item, height) for item in group.items),
            "</g>",
        ]
    return "\n".join([*lines, "</svg>", ""])


def _svg_item(item: Shape | Raster, height: int) -> str:
    if isinstance(item, Raster):
        left, bottom, wide, high = item.box
        data = base64.b64encode(_png(item.pixels)).decode()
        return (
            f'<image x="{number(left)}" y="{number(height - bottom - high)}" '
            f'width="{number(wide)}" height="{number(high)}" preserveAspectRatio="none" '
            f'xlink:href="data:image/png;base64,{data}"/>'
        )
    path = " ".join(_svg_piece(piece, height) for piece in item.pieces)
    color = hexadecimal(item.color)
    if item.width:
        return (
            f'<path d="{path}" fill="none" stroke="{color}" stroke-width="{number(item.width)}" '
            'stroke-linecap="round" stroke-linejoin="round"/>'
        )
    label = f' role="img" aria-label="{_escaped(item.words)}"' if item.words else ""
    return f'<path d="{path}" fill="{color}"{label}/>'


def _svg_piece(piece: Piece, height: int) -> str:
    def pair(point: Array) -> str:
        return f"{number(point[0])},{number(height - point[1])}"

    words = [f"M{pair(piece.start)}"]
    words += [" LQC"[len(s)] + " ".join(map(pair, s)) for s in piece.segments]
    return "".join(words) + "Z" * piece.closed


def _escaped(text: str) -> str:
    for sign, name in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ('"', "&quot;")):
        text = text.replace(sign, name)
    return text


def _png(pixels: NDArray[np.uint8]) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "PNG", optimize=True)
    return stream.getvalue()


# PDF ----------------------------------------------------------------------------------------


def pdf(drawing: Drawing) -> bytes:
    """The drawing as a PDF file of one page (PDF 1.4, ISO 32000-1)."""
    rasters: list[Raster] = []
    content = [
        f"{POINTS_PER_PIXEL} 0 0 {POINTS_PER_PIXEL} 0 0 cm 1 J 1 j",
        f"{_pdf_color(drawing.ground)} rg 0 0 {drawing.width} {drawing.height} re f",
    ]
    for group in drawing.groups:
        content.append(f"q {' '.join(map(number, group.box))} re W n")
        for item in group.items:
            if isinstance(item, Raster):
                left, bottom, wide, high = map(number, item.box)
                content.append(f"q {wide} 0 0 {high} {left} {bottom} cm /I{len(rasters)} Do Q")
                rasters.append(item)
            else:
                content += _pdf_shape(item)
        content.append("Q")
    width, height = (number(POINTS_PER_PIXEL * side) for side in (drawing.width, drawing.height))
    images = " ".join(f"/I{i} {5 + i} 0 R" for i in range(len(rasters)))
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width} {height}] /Contents 4 0 R "
        f"/Resources << /XObject << {images} >> >> >>".encode(),
        _pdf_stream("", "\n".join(content).encode()),
        *(_pdf_image(raster) for raster in rasters),
    ]
    return _pdf_file(objects)


def _pdf_color(color: Color) -> str:
    return " ".join(map(number, color))


def _pdf_shape(shape: Shape) -> Iterator[str]:
    color = _pdf_color(shape.color)
    yield f"{color} RG {number(shape.width)} w" if shape.width else f"{color} rg"
    for piece in shape.pieces:
        yield f"{_pdf_points(piece.start[None])} m"
        at = piece.start
        for segment in piece.segments:
            if len(segment) == 1:
                yield f"{_pdf_points(segment)} l"
            else:
                yield f"{_pdf_points(_cubic(at, segment))} c"
            at = segment[-1]
        if piece.closed:
            yield "h"
    yield "S" if shape.width else "f"


def _cubic(start: Array, segment: Array) -> Array:
    """The three points after the start of the same curve with degree 3."""
    if len(segment) == 3:
        return segment
    control, end = segment
    return np.stack([start + 2 / 3 * (control - start), end + 2 / 3 * (control - end), end])


def _pdf_points(points: Array) -> str:
    return " ".join(number(value) for value in points.ravel())


def _pdf_stream(entries: str, data: bytes) -> bytes:
    packed = zlib.compress(data)
    head = f"<< {entries} /Filter /FlateDecode /Length {len(packed)} >>\nstream\n"
    return head.encode() + packed + b"\nendstream"


def _pdf_image(raster: Raster) -> bytes:
    height, width = raster.pixels.shape[:2]
    entries = (
        f"/Type /XObject /Subtype /Image /Width {width} /Height {height} "
        "/ColorSpace /DeviceRGB /BitsPerComponent 8"
    )
    return _pdf_stream(entries, raster.pixels.tobytes())


def _pdf_file(objects: Sequence[bytes]) -> bytes:
    out, places = bytearray(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"), []
    for i, content in enumerate(objects, start=1):
        places.append(len(out))
        out += f"{i} 0 obj\n".encode() + content + b"\nendobj\n"
    start = len(out)
    out += f"xref\n0 {len(objects) + 1}\n0000000000 65535 f \n".encode()
    for place in places:
        out += f"{place:010d} 00000 n \n".encode()
    out += f"trailer\n<< /Size {len(objects) + 1} /Root 1 0 R >>\n".encode()
    return bytes(out + f"startxref\n{start}\n%%EOF\n".encode())
