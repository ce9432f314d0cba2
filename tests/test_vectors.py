"""SVG and PDF: exact curves, text as outlines, surfaces embedded, and files that readers accept."""

from __future__ import annotations

import re
import zlib
from math import pi
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.cli import main
from reparam.files.vector import Drawing, Group, Raster, Shape, pdf, svg
from reparam.geometry.bernstein import bernstein
from reparam.geometry.curve import circular_arc, curve_net, curve_points, restrict
from reparam.line_paths import TOLERANCE, LinePaths, iso_curves, traced_points
from reparam.scenes.layers import Curves, Dots, Figure, IsoLines, Polylines, Space, plane
from reparam.subject import open_subject
from reparam.vectors import draw_vectors

SVG = "{http://www.w3.org/2000/svg}"
SIZE = (400, 300)


def nothing_embedded(*_: object) -> NDArray[np.uint8]:
    raise AssertionError("nothing here is to be embedded")


def drawn(*layers: object) -> list[Shape]:
    """Shapes of layers in a space where a model unit is a pixel, the origin at the lower left."""
    from reparam.geometry.camera import Camera
    from reparam.gpu.arrangement import Panel
    from reparam.gpu.region import Region

    camera = Camera(np.eye(3), np.array([200.0, 150.0, 0.0]), 200.0, 150.0, 10.0)
    region = Region(0, 0, *SIZE)
    panel = Panel(Space("p", plane(0, 0, 1, 1), ()), region, camera, region)
    return [shape for layer in layers for shape in LinePaths(panel, 1.0).shapes(layer)]  # type: ignore[arg-type]


def flattened(shape: Shape, samples: int = 64) -> list[NDArray[np.float64]]:
    """The points of each piece."""
    t, lines = np.linspace(0.0, 1.0, samples), []
    for piece in shape.pieces:
        at, points = piece.start, [piece.start[None]]
        for segment in piece.segments:
            net = np.concatenate([at[None], segment])
            points.append(bernstein(len(segment), t) @ net)
            at = segment[-1]
        lines.append(np.concatenate(points))
    return lines


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_low_degrees_are_the_very_curves(degree: int) -> None:
    points = np.random.default_rng(degree).uniform(10.0, 290.0, (degree + 1, 2))
    (shape,) = drawn(Curves(curve_net(points)))
    (piece,) = shape.pieces
    (segment,) = piece.segments
    assert np.abs(np.concatenate([piece.start[None], segment]) - points).max() < 1e-12


@pytest.mark.parametrize("degree", [4, 9])
def test_higher_degrees_are_close(degree: int) -> None:
    net = curve_net(np.random.default_rng(degree).uniform(10.0, 290.0, (degree + 1, 2)))
    (shape,) = drawn(Curves(net))
    exact = curve_points(net, np.linspace(0.0, 1.0, 20_001))[:, :2]
    (line,) = flattened(shape, 4)
    distances = np.linalg.norm(line[:, None] - exact, axis=-1).min(1)
    assert distances.max() < 1.5 * TOLERANCE


def test_circles_are_round_and_one_path() -> None:
    arcs = np.stack([circular_arc(100.0, k * pi / 2, (k + 1) * pi / 2) for k in range(4)])
    arcs[..., :2] += arcs[..., 3:] * 150.0
    (shape,) = drawn(Curves(arcs))
    (line,) = flattened(shape)
    assert np.abs(np.linalg.norm(line - 150.0, axis=-1) - 100.0).max() < TOLERANCE
    (dot,) = drawn(Dots(np.array([[50.0, 60.0, 0.0]]), radius=5.0))
    (line,) = flattened(dot)
    assert np.abs(np.linalg.norm(line - [50.0, 60.0], axis=-1) - 5.0).max() < 2e-3


def test_spans_arrows_and_closed_lines() -> None:
    net = curve_net([[0, 0], [100, 0], [100, 100]])
    line, head = drawn(Curves(net, span=(0.25, 0.75), arrow=True))
    (points,) = flattened(line)
    ends = curve_points(net, [0.25, 0.75])[:, :2]
    assert np.abs(points[[0, -1]] - ends).max() < 1e-12
    assert head.width == 0.0
    assert np.abs(head.pieces[0].start - ends[1] - 4.5 * np.array([1, 3]) / 10**0.5).max() < 0.01
    (triangle,) = drawn(Polylines(np.array([[0.0, 0, 0], [9, 0, 0], [9, 9, 0]]), closed=True))
    assert triangle.pieces[0].closed


def test_iso_curves() -> None:
    net = np.random.default_rng(5).uniform(0.5, 2.0, (2, 3, 4, 4))
    curves = iso_curves(IsoLines(net, u=(0.3,), v=(0.0, 0.6)))
    assert curves.shape == (6, 4, 4)
    from reparam.geometry.evaluate import evaluate, project

    t = np.linspace(0.0, 1.0, 7)
    for k in range(2):
        expected = project(evaluate(net[k], 0.3 + 0.0 * t, t))
        assert np.abs(curve_points(curves[k], t) - expected).max() < 1e-13
        expected = project(evaluate(net[k], t, 0.6 + 0.0 * t))
        assert np.abs(curve_points(curves[4 + k], t) - expected).max() < 1e-13


def test_restricted_curves() -> None:
    net = curve_net([[0, 0], [1, 2], [3, 1], [4, 4]], [1.0, 2.0, 0.5, 1.0])
    part, t = restrict(net, 0.2, 0.7), np.linspace(0.0, 1.0, 9)
    assert np.abs(curve_points(part, t) - curve_points(net, 0.2 + 0.5 * t)).max() < 1e-14
    assert restrict(net, 0.0, 1.0) is net


def test_traced_points_are_where_newton_puts_them() -> None:
    subject = open_subject("trace")
    figure: Figure = subject.figure()
    traced = figure.spaces[1].layers[2]
    assert type(traced).__name__ == "Traced"
    from reparam.geometry.paths import bezier_path

    path = bezier_path(traced.net)  # type: ignore[union-attr]
    exact = path.points(path.arc.u(np.arange(17) / 16 * path.arc.length))
    assert np.abs(traced_points(traced) - exact).max() < 1e-7  # type: ignore[arg-type]


@pytest.mark.parametrize("scene", ["fig1", "fig2", "trace", "length", "staircase"])
def test_svg(scene: str) -> None:
    subject = open_subject(scene)
    drawing = draw_vectors(subject, SIZE, nothing_embedded)
    root = ElementTree.fromstring(svg(drawing))
    assert (root.get("width"), root.get("height")) == ("400", "300")
    words = [path.get("aria-label") for path in root.iter(f"{SVG}path")]
    for line in subject.figure().caption:
        assert line in words
    for path in root.iter(f"{SVG}path"):
        numbers = [float(n) for n in re.findall(r"-?[\d.]+", path.get("d") or "")]
        assert numbers
        assert np.isfinite(numbers).all()
        assert path.get("stroke") or path.get("fill")


def content(data: bytes) -> str:
    start = data.index(b"stream\n") + len(b"stream\n")
    return zlib.decompress(data[start : data.index(b"\nendstream", start)]).decode()


def test_pdf() -> None:
    drawing = draw_vectors(open_subject("fig2"), SIZE, nothing_embedded)
    data = pdf(drawing)
    assert data.startswith(b"%PDF-1.4\n")
    assert b"/MediaBox [0 0 300 225]" in data
    start = int(data[data.rindex(b"startxref\n") + 10 :].split()[0])
    assert data[start:].startswith(b"xref\n0 5\n")
    for i, line in enumerate(data[start:].split(b"\n")[3:7], start=1):
        assert data[int(line[:10]) :].startswith(b"%d 0 obj\n" % i)
    text = content(data)
    operators = {line.rsplit(" ", 1)[-1] for line in text.splitlines()}
    assert operators == {"j", "f", "n", "w", "m", "c", "l", "h", "S", "rg"} | {"Q"}
    assert text.count("q ") == text.count("Q")


def test_embedded_pictures() -> None:
    pixels = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)
    raster = Raster(pixels, (10.0, 20.0, 60.0, 40.0))
    drawing = Drawing(100, 100, (1.0, 1.0, 1.0), (Group((0.0, 0.0, 100.0, 100.0), (raster,)),))
    image = ElementTree.fromstring(svg(drawing)).find(f".//{SVG}image")
    assert image is not None
    assert (image.get("x"), image.get("y")) == ("10", "40")
    data = pdf(drawing)
    assert b"/Width 6 /Height 4" in data
    assert pixels.tobytes() == zlib.decompress(data.rsplit(b"stream\n", 2)[1].split(b"\nend")[0])


def test_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for ending in ("svg", "pdf"):
        out = tmp_path / f"fig5.{ending}"
        assert main(["render", "fig5", "-o", str(out), "--size", "96x96"]) == 0
        assert b"image" in out.read_bytes() or b"/Image" in out.read_bytes()
    assert main(["render", "fig5", "-o", str(tmp_path / "a.svg"), "--plain"]) == 2
    assert main(["render", "fig5", "-o", str(tmp_path / "a.eps")]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert "--plain: expected an --output ending in .png" in lines[0]
    assert "expected a name ending in .png or .svg or .pdf, found" in lines[1]
