"""The layers that are made of lines, as Bezier paths.

Curves of degree up to 3 without weights are the very curves; others are cubic pieces that are
nowhere further off than TOLERANCE.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .files.vector import Piece, Shape
from .geometry.bernstein import bernstein
from .geometry.curve import curve_derivatives, restrict
from .geometry.evaluate import project
from .geometry.paths import hermite
from .gpu.arrangement import Panel
from .gpu.polylines import curve_links, net_legs
from .gpu.strokes import ARROW_SIZE, HANDLE_RINGS
from .scenes.layers import (
    Color,
    ControlNet,
    Curves,
    Dots,
    Handles,
    IsoLines,
    Layer,
    Parametric,
    Polylines,
    Traced,
)

Array = NDArray[np.float64]

TOLERANCE = 0.02  # pixels between a path and the curve it stands for
FLANK = 0.364  # of an arrow head: the tangent of 20 degrees
CIRCLE = 4.0 / 3.0 * np.tan(np.pi / 8.0)  # handles of a quarter circle as a cubic: off by 2.7e-4
MOST_PIECES = 1024


class LinePaths:
    """The layers that are made of lines, in the pixels of a panel."""

    def __init__(self, panel: Panel, unit: float) -> None:
        self._panel, self._unit = panel, unit

    def shapes(self, layer: Layer) -> Iterator[Shape]:
        """From the back to the front."""
        match layer:
            case Curves():
                yield from self._curves(layer.net, layer)
            case IsoLines():
                yield from self._curves(iso_curves(layer), layer)
            case Polylines():
                yield from self._polylines(layer)
            case Dots():
                yield from self._dots(layer.at, layer.color, layer.radius)
            case Traced():
                at = traced_points(layer)
                yield from self._dots(at, layer.color, layer.radius)
            case Parametric():
                u = layer.at
                at = np.stack([layer.x(u=u, w=layer.w), layer.y(u=u, w=layer.w), 0.0 * u], -1)
                if layer.width:
                    yield from self._polylines(Polylines(at, layer.color, layer.width))
                if layer.radius:
                    yield from self._dots(at, layer.color, layer.radius)
            case ControlNet():
                points, links = net_legs(layer.net)
                lines = np.split(project(points), np.flatnonzero(links == 0.0)[1:])
                for line in lines:
                    yield from self._polylines(Polylines(line, layer.color, layer.width))
                controls = layer.net.reshape(-1, 4)
                dots = project(controls[controls[:, 3] > 0.0])
                yield from self._dots(dots, layer.color, layer.dot)
            case Handles():
                for ring, color in (*HANDLE_RINGS, (0.0, layer.color)):
                    yield from self._dots(layer.at, color, layer.radius + ring)

    def _pixels(self, points: Array) -> Array:
        region = self._panel.region
        at = self._panel.camera.pixels(points, region.width, region.height)
        return np.asarray(at + np.array([region.left, region.bottom]))

    def _curves(self, net: Array, layer: Curves | IsoLines) -> Iterator[Shape]:
        nets = restrict(net.reshape(-1, *net.shape[-2:]), *layer.span)
        if not len(nets):
            return
        runs_on = curve_links(nets, 2).reshape(-1, 2)[:, 0] > 0.0
        pieces: list[Piece] = []
        for curve, joined_on in zip(nets, runs_on, strict=True):
            segments = tuple(self._segments(curve))
            start = self._pixels(project(curve[:1]))[0]
            if joined_on and pieces:
                pieces[-1] = replace(pieces[-1], segments=pieces[-1].segments + segments)
            else:
                pieces.append(Piece(start, segments))
        yield Shape(tuple(pieces), layer.color, layer.width * self._unit)
        if layer.arrow:
            ends = project(restrict(nets, 0.999, 1.0)[:, [0, -1]])
            yield from self._arrows(ends, layer.color)

    def _segments(self, net: Array) -> Iterator[Array]:
        """The path of one Bezier curve, after its start."""
        weights = net[:, 3]
        if len(net) <= 4 and np.ptp(weights) <= 1e-14 * weights.max():
            points = self._pixels(project(net))
            yield points[1:] if len(points) > 1 else points
            return
        count = 1
        while True:
            pieces = list(self._cubics(net, count))
            if count >= MOST_PIECES or self._off(net, pieces) <= TOLERANCE:
                break
            count *= 2
        yield from (piece[1:] for piece in pieces)

    def _cubics(self, net: Array, count: int) -> Iterator[Array]:
        """Cubics (4, 2) with the curve's points and derivatives at both ends, in pixels."""
        t = np.arange(count + 1) / count
        at, slope = curve_derivatives(net, t, 1)
        low = self._pixels(at - slope / (3.0 * count))
        here, high = self._pixels(at), self._pixels(at + slope / (3.0 * count))
        for k in range(count):
            yield np.stack([here[k], high[k], low[k + 1], here[k + 1]])

    def _off(self, net: Array, pieces: list[Array]) -> float:
        t = (np.arange(len(pieces))[:, None] + np.array([0.25, 0.5, 0.75])) / len(pieces)
        exact = self._pixels(curve_derivatives(net, t.ravel(), 0)[0]).reshape(*t.shape, 2)
        found = np.einsum("sb,kbc->ksc", bernstein(3, [0.25, 0.5, 0.75]), np.stack(pieces))
        return float(np.linalg.norm(found - exact, axis=-1).max())

    def _polylines(self, layer: Polylines) -> Iterator[Shape]:
        lines = layer.points.reshape(-1, *layer.points.shape[-2:])
        pieces = []
        for line in lines:
            pixels = self._pixels(line)
            pieces.append(Piece(pixels[0], tuple(pixels[1:, None]), layer.closed))
        if pieces:
            yield Shape(tuple(pieces), layer.color, layer.width * self._unit)
        if layer.arrow and pieces:
            yield from self._arrows(lines[:, -2:], layer.color)

    def _arrows(self, ends: Array, color: Color) -> Iterator[Shape]:
        """Heads at the second of two points (k, 2, 3) each."""
        pixels = self._pixels(ends)
        way = pixels[:, 1] - pixels[:, 0]
        length = np.linalg.norm(way, axis=-1, keepdims=True)
        ahead = np.divide(way, length, out=np.zeros_like(way), where=length > 0.0)
        side = np.stack([-ahead[:, 1], ahead[:, 0]], -1)
        size, at = ARROW_SIZE * self._unit, pixels[:, 1]
        back = at - size * ahead
        flank = 2.0 * size * FLANK * side
        corners = np.stack([at + size * ahead, back + flank, back - flank], 1)
        pieces = [Piece(three[0], tuple(three[1:, None]), True) for three in corners]
        yield Shape(tuple(pieces), color)

    def _dots(self, at: Array, color: Color, radius: float) -> Iterator[Shape]:
        size = radius * self._unit
        quarter = size * np.array(
            [[[1, CIRCLE], [CIRCLE, 1], [0, 1]], [[-CIRCLE, 1], [-1, CIRCLE], [-1, 0]],
             [[-1, -CIRCLE], [-CIRCLE, -1], [0, -1]], [[CIRCLE, -1], [1, -CIRCLE], [1, 0]]]
        )  # fmt: skip
        pieces = [
            Piece(pixel + quarter[-1, -1], tuple(pixel + part for part in quarter), True)
            for pixel in self._pixels(at.reshape(-1, 3))
        ]
        if pieces and size > 0.0:
            yield Shape(tuple(pieces), color)


def iso_curves(layer: IsoLines) -> Array:
    """The curves u = const and v = const as Bezier nets (curves, n, 4), raised to one order."""
    nets = layer.net.reshape(-1, *layer.net.shape[-3:])
    along_v = [np.einsum("i,pijc->pjc", bernstein(nets.shape[1] - 1, u), nets) for u in layer.u]
    along_u = [np.einsum("j,pijc->pic", bernstein(nets.shape[2] - 1, v), nets) for v in layer.v]
    order = max(nets.shape[1:3])
    curves = [_raised(curve, order) for curve in (*along_v, *along_u)]
    return np.concatenate(curves) if curves else np.zeros((0, order, 4))


def _raised(curves: Array, order: int) -> Array:
    while curves.shape[1] < order:
        n = curves.shape[1]
        share = (np.arange(1, n) / n)[:, None]
        inner = share * curves[:, :-1] + (1.0 - share) * curves[:, 1:]
        curves = np.concatenate([curves[:, :1], inner, curves[:, -1:]], 1)
    return curves


def traced_points(layer: Traced) -> Array:
    """What trace.vert computes, in float64."""
    nets = layer.net.reshape(-1, *layer.net.shape[-2:])
    u = hermite(layer.table, layer.at)
    piece = np.clip(np.floor(u).astype(int), 0, len(nets) - 1)
    basis = bernstein(nets.shape[1] - 1, np.clip(u - piece, 0.0, 1.0))
    return project(np.einsum("kn,knc->kc", basis, nets[piece]))
