"""A patch trimmed by 10,000 pieces against the same patch untrimmed: a lit, textured frame.

`shores`: 64 holes with wavy borders, 156 or 157 cubics each. `dots`: 2500 round holes of four
arcs, whose borders are within a pixel of a quarter of all pixels. From above, in two closer views,
and as a body in perspective, the whole and a part of it.
"""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np
from frames import FROM_ABOVE, frames, wavy_patches

from reparam.bench import Rows, interleave
from reparam.geometry.camera import Camera
from reparam.geometry.net import Array, control_net
from reparam.geometry.trimming import TrimRegion, trim_region
from reparam.scenes.layers import Patches, Picture, Texture
from reparam.snapshot import Studio

SIZE = (512, 512)
LEVEL = 32
GOAL = 2.0
PIECES = 10_000
HALF = np.sqrt(0.5)
ARC = np.array([(1.0, 0.0, 1.0), (HALF, HALF, HALF), (0.0, 1.0, 1.0)])
IDENTITY = control_net([[(-1, -1), (-1, 1)], [(1, -1), (1, 1)]])


def shore(center: Array, radius: float, count: int, phase: float) -> list[Array]:
    """A wavy loop, clockwise, of cubics with common tangents."""
    angle = -np.linspace(0.0, 2.0 * np.pi, count + 1) + phase
    wave = 1.0 + 0.12 * np.sin(9.0 * (angle - phase)) + 0.05 * np.sin(23.0 * (angle - phase))
    slope = 1.08 * np.cos(9.0 * (angle - phase)) + 1.15 * np.cos(23.0 * (angle - phase))
    ray = np.exp(1j * angle)
    points, way = wave * ray, (slope + 1j * wave) * ray * (-2.0 * np.pi / count / 3.0)
    points[-1], way[-1] = points[0], way[0]
    places = radius * np.stack(
        [points[:-1], points[:-1] + way[:-1], points[1:] - way[1:], points[1:]], 1
    )
    nets = np.stack([places.real + center[0], places.imag + center[1], np.ones(places.shape)], -1)
    return list(nets)


def shores() -> TrimRegion:
    middles = (np.stack(np.divmod(np.arange(64), 8), -1) + 0.5) / 8.0
    counts = np.diff(np.linspace(0, PIECES, 65).astype(int))
    return trim_region(
        [
            shore(m, 0.047, int(n), 0.1 * k)
            for k, (m, n) in enumerate(zip(middles, counts, strict=True))
        ]
    )


def dots() -> TrimRegion:
    quarter = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    arcs = [ARC]
    for _ in range(3):
        arcs.append(arcs[-1] @ quarter)
    loops = []
    for k in range(PIECES // 4):
        u, v = (np.array(divmod(k, 50)) + 0.5) / 50.0
        place = np.array([[0.008, 0.0, 0.0], [0.0, 0.008, 0.0], [u, v, 1.0]])
        loops.append([(arc @ place)[::-1] for arc in arcs[::-1]])
    return trim_region(loops)


def tilted(half_width: float) -> Camera:
    """A body seen from above its front, in perspective."""
    c, s = np.cos(0.9), np.sin(0.9)
    rotation = np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    return Camera(rotation, np.zeros(3), half_width, half_width, 4.0, distance=4.0)


VIEWS = {
    "above": (FROM_ABOVE, False),
    "close": (Camera(np.eye(3), np.zeros(3), 0.4, 0.4, 4.0), False),
    "closer": (Camera(np.eye(3), np.zeros(3), 0.1, 0.1, 4.0), False),
    "space": (tilted(1.0), True),
    "space, close": (tilted(0.4), True),
}
"""Cameras, and whether what they show is spatial: then each of a pixel's samples is decided."""


def rows(pairs: int) -> Rows:
    """Each region in each view, on each evaluator that there is, with the samples of a picture and
    with one."""
    studio = Studio()
    net = wavy_patches(1, 3)
    texture = Texture(IDENTITY, Picture())
    whole = Patches(net, texture, lit=True)
    evaluators = ["vertex", *["tessellation"] * studio.painter.capabilities.tessellation]
    for name, region in (("shores", shores()), ("dots", dots())):
        trimmed = Patches(net, texture, lit=True, trim=region)
        for view, evaluator, samples in product(VIEWS, evaluators, (0, 1)):
            camera, spatial = VIEWS[view]
            draw = partial(studio.painter.surfaces.draw, by_sample=spatial)
            with frames(studio, SIZE, samples) as frame:
                ours, other = (
                    frame(partial(draw, layer, camera, evaluator, LEVEL))
                    for layer in (trimmed, whole)
                )
                times = interleave(ours, other, pairs)
            yield times.row(
                f"trims/{name}/{view}/{evaluator}/{'one sample' if samples else 'samples'}",
                goal=GOAL,
                evaluator=evaluator,
                level=LEVEL,
                pieces=PIECES,
            )
