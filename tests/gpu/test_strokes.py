"""Thick lines against a truth of 16 x 16 points a pixel: joins, caps and cusps included."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.camera import Camera
from reparam.geometry.curve import circular_arc, curve_net, curve_points
from reparam.gpu import curve_parts
from reparam.gpu.pen import Lines, Pen, Screen
from reparam.gpu.polylines import curve_links, joined, segments
from reparam.gpu.strokes import Strokes
from reparam.gpu.targets import Target
from reparam.scenes.layers import Curves, Dots, Polylines, Stroked
from reparam.snapshot import Studio

Array = NDArray[np.float64]

SIDE, POINTS = 96, 16
BLACK = (0.0, 0.0, 0.0)


def coverage(
    studio: Studio, *layers: Stroked, samples: int = 4, tolerance: float = 0.0, deep: bool = False
) -> Array:
    """How much of each pixel black layers cover, bottom row first; model units are pixels."""
    studio.ctx.__enter__()  # current, should there be another
    target = Target(studio.ctx, (SIDE, SIDE), samples, studio.painter.capabilities)
    camera = Camera(np.eye(3), np.array([SIDE / 2, SIDE / 2, 0.0]), SIDE / 2, SIDE / 2, 100.0)
    target.framebuffer.use()
    studio.ctx.viewport = (0, 0, SIDE, SIDE)
    target.framebuffer.clear(1.0, 1.0, 1.0, 1.0, depth=1.0)
    studio.ctx.enable_only(moderngl.BLEND | (moderngl.DEPTH_TEST if deep else 0))
    studio.ctx.blend_func = (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA)
    for layer in layers:
        studio.painter.strokes.draw(layer, camera, 1.0, tolerance)
    target.resolve()
    picture = target.pixels()[::-1, :, 0]
    studio.ctx.extra.use()
    target.release()
    return 1.0 - picture / 255.0


def true_coverage(lines: Array, radius: float) -> Array:
    """The share of each pixel's 16 x 16 points that lie within `radius` of polylines."""
    at = (np.arange(SIDE * POINTS) + 0.5) / POINTS
    inside = np.zeros((len(at), len(at)), bool)
    for line in lines:
        for a, b in zip(line[:-1, :2], line[1:, :2], strict=True):
            low = np.floor((np.minimum(a, b) - radius) * POINTS).astype(int)
            high = np.ceil((np.maximum(a, b) + radius) * POINTS).astype(int) + 1
            columns, rows = slice(max(low[0], 0), high[0]), slice(max(low[1], 0), high[1])
            x, y = at[columns] - a[0], at[rows, None] - a[1]
            way = b - a
            t = np.clip((x * way[0] + y * way[1]) / max(way @ way, 1e-30), 0.0, 1.0)
            inside[rows, columns] |= (x - t * way[0]) ** 2 + (y - t * way[1]) ** 2 <= radius**2
    return np.asarray(inside.reshape(SIDE, POINTS, SIDE, POINTS).mean((1, 3)))


def compare(found: Array, truth: Array) -> None:
    touched = (found > 0.0) | (truth > 0.0)
    off = np.abs(found - truth)[touched] * 255.0
    assert off.mean() < 1.0
    assert off.max() <= 4.0


SHAPES = {
    "smooth": [[10, 18], [33, 91], [63, 4], [86, 78]],
    "cusp": [[10, 18], [86, 78], [10, 78], [86, 18]],
    "near a cusp": [[10, 18], [84, 78], [12, 78], [86, 18]],
    "loop": [[10, 18], [108, 82], [-12, 82], [86, 18]],
    "hairpin": [[10, 18], [140, 78.2], [10, 21]],
    "straight": [[10, 18.3], [86, 60.7]],
    "a pixel": [[48, 48], [49, 50], [48, 50], [49, 48]],
    "a point": [[40.3, 50.6], [40.3, 50.6], [40.3, 50.6]],
}


@pytest.mark.parametrize("width", [0.8, 2.3, 9.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_curves(studio: Studio, shape: str, width: float) -> None:
    net = curve_net(SHAPES[shape])
    exact = curve_points(net, np.linspace(0.0, 1.0, 513))
    compare(coverage(studio, Curves(net, BLACK, width)), true_coverage(exact[None], width / 2.0))


def test_a_rational_curve_of_many_pieces_has_no_seams(studio: Studio) -> None:
    corners = np.array([0.0, 1.3, 2.9, 4.4, 2.0 * pi])
    arcs = np.stack([circular_arc(33.3, *pair) for pair in pairwise(corners)])
    arcs[..., :2] += arcs[..., 3:] * (SIDE / 2)
    angle = np.linspace(0.0, 2.0 * pi, 721)
    exact = 33.3 * np.stack([np.cos(angle), np.sin(angle)], -1) + SIDE / 2
    found = coverage(studio, Curves(arcs, BLACK, 3.0))
    compare(found, true_coverage(exact[None], 1.5))


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("samples", [1, 4])
def test_sharp_turns(studio: Studio, closed: bool, samples: int) -> None:
    star = [[20, 20], [80, 70], [15, 65], [75.5, 15], [50, 90], [50, 90]]
    points = np.array([[*point, 0.0] for point in star], float)
    line = np.concatenate([points, points[:1]]) if closed else points
    found = coverage(studio, Polylines(points, BLACK, 6.0, closed), samples=samples)
    compare(found, true_coverage(line[None], 3.0))


def test_a_line_longer_than_the_window_closes(studio: Studio) -> None:
    """A cog wheel, whose teeth are drawn each by itself."""
    angle = np.linspace(0.0, 2.0 * pi, 601)[:-1]
    points = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], -1)
    points[::2] *= 0.8
    points = points * 37.7 + [48.2, 47.9, 0.0]
    found = coverage(studio, Polylines(points, BLACK, 0.6, closed=True))
    compare(found, true_coverage(np.concatenate([points, points[:1]])[None], 0.3))


def test_a_line_that_is_all_within_its_own_window_closes(studio: Studio) -> None:
    angle = np.linspace(0.0, 2.0 * pi, 41)[:-1]
    points = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], -1) * 2.7 + [48.2, 47.9, 0.0]
    found = coverage(studio, Polylines(points, BLACK, 2.5, closed=True))
    compare(found, true_coverage(np.concatenate([points, points[:1]])[None], 1.25))


def test_more_turns_than_a_window_has_segments(studio: Studio) -> None:
    """A line that comes back after 1000 segments is drawn once where it lies on itself."""
    angle = np.linspace(0.0, 14.0 * pi, 7001)
    points = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], -1) * 5.3 + [48.2, 47.9, 0.0]
    found = coverage(studio, Polylines(points, BLACK, 2.5))
    compare(found, true_coverage(points[None, :1001], 1.25))


def group_sizes(studio: Studio, points: list[tuple[float, float, float]]) -> list[int]:
    """How many segments of a line are drawn together."""
    pen = Pen(studio.ctx, studio.painter.programs)
    at, links = joined(np.array(points))
    lines = Lines.linked(studio.ctx, studio.ctx.buffer(at.astype(np.float32).tobytes()), links)
    camera = Camera(np.eye(3), np.array([SIDE / 2, SIDE / 2, 0.0]), SIDE / 2, SIDE / 2, 100.0)
    with studio.ctx.scope(studio.painter.nowhere):
        pen._flatten(lines, Screen(camera, (0, 0, SIDE, SIDE), 1.0)).use(0)
        grouped = pen._group(lines, 1.0)
    texels = np.frombuffer(grouped.groups.read(), np.float32).reshape(-1, 4)
    circles = texels[: 2 * len(points) : 2]
    assert np.abs(circles[:, 3]).sum() == (circles[circles[:, 3] > 0, 3] ** 2).sum()
    return [int(count) for count in circles[:, 3] if count > 0]


def test_groups(studio: Studio) -> None:
    """Short segments are drawn together where they go on straight, in space too."""
    x = np.arange(67) * 0.2 + 10.0
    assert group_sizes(studio, [(a, 20.0, 0.0) for a in x]) == [32, 32, 2]
    assert group_sizes(studio, [(50.0 * a - 490.0, 20.0, 0.0) for a in x[:7]]) == [4, 2]
    assert group_sizes(studio, [(40.0 * k, 90.0 * (k % 2), 0.0) for k in range(5)]) == [1, 1, 1, 1]
    assert group_sizes(studio, [(a, 20.0, 20.0 * (k % 2)) for k, a in enumerate(x[:5])]) == [
        1,
        1,
        1,
        1,
    ]
    assert group_sizes(studio, [(30.0, 20.0, 0.0)] * 2) == [1]


def test_a_hook_on_the_way(studio: Studio) -> None:
    """A group whose cap reaches further than where its line goes on."""
    hook = [[0, 0], [3, 0], [3, 1], [3, 2], [2, 2]]
    tail = [[10, 10], [14, 6], [20, 12], [14, 18]]
    points = np.array([[2.3 * x + 10.0, 2.3 * y + 10.0, 0.0] for x, y in hook + tail])
    found = coverage(studio, Polylines(points, BLACK, 8.0))
    compare(found, true_coverage(points[None], 4.0))


def test_arcs_that_touch_where_their_chords_do_not(studio: Studio) -> None:
    """Two groups of 8 segments, ) and (, with 8 of the way from one to the other between them."""
    t = np.linspace(-1.0, 1.0, 9)[:, None]
    arc = np.concatenate([1.5 * (1.0 - t**2), 7.0 * t, 0.0 * t], -1)
    other = arc * [-1.0, 1.0, 1.0] + [3.7, 0.0, 0.0]
    way = [[0, 20], [20, 30], [40, 30], [40, 0], [40, -30], [20, -40], [4, -30]]
    points = np.concatenate([arc, np.pad(np.array(way, float), ((0, 0), (0, 1))), other])
    points += np.array([40.0, 45.0, 0.0])
    found = coverage(studio, Polylines(points, BLACK, 0.7))
    compare(found, true_coverage(points[None], 0.35))


def test_what_a_line_does_not_cover_it_does_not_hide(studio: Studio) -> None:
    near, far = ([[x, 10, z], [x, 80, z]] for x, z in ((20, 1.0), (22, 0.0)))
    both = np.array([near, far], float)
    compare(coverage(studio, Polylines(both, BLACK, 2.0), deep=True), true_coverage(both, 1.0))


def test_dots(studio: Studio) -> None:
    at = np.array([[12.2, 13.7, 0.0], [50.0, 50.5, 0.0], [83.9, 20.1, 0.0]])
    for radius in (0.6, 2.0, 7.5):
        compare(
            coverage(studio, Dots(at, BLACK, radius)),
            true_coverage(at[:, None].repeat(2, 1), radius),
        )


def test_several_lines_do_not_join(studio: Studio) -> None:
    lines = np.array([[[10, 20, 0], [80, 20, 0]], [[80, 60, 0], [10, 75, 0]]], float)
    compare(coverage(studio, Polylines(lines, BLACK, 4.0)), true_coverage(lines, 2.0))


def test_links() -> None:
    _, links = joined(np.zeros((2, 3, 3)))
    assert links.tolist() == [0, 1, 1, 0, 1, 1]
    assert segments(links)[:, :3].tolist() == [[1, 2, 0]] * 3 + [[4, 5, 0]] * 3
    assert segments(links)[:, 3].tolist() == [0, 1, 2, 3, 4, 5]
    points, links = joined(np.arange(9.0).reshape(3, 3), closed=True)
    assert links.tolist() == [-3, 1, 1, 4]
    assert segments(links)[:, :3].tolist() == [[1, 3, 1]] * 4
    assert points[0].tolist() == points[-1].tolist()
    chain = curve_net([[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[5, 5], [6, 6]]])
    assert curve_links(chain, 3).tolist() == [0, 1, 1, 1, 1, 1, 0, 1, 1]
    chain = curve_net([[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 0]]])
    assert curve_links(chain, 2).tolist() == [-5, 1, 1, 1, 1, 6]


def waves(count: int) -> Array:
    """Chains of two cubics side by side, the last one much larger: (2 count, 4, 4)."""
    wave = np.array([[0, 0], [1, 3], [2, -3], [3, 0]])
    small = [wave + np.array([3, 0]) * k for k in (0, 1)]
    places = np.stack([np.arange(count) % 8 * 11 + 4, np.arange(count) // 8 * 5 + 6], -1)
    nets = (np.array(small) + places[:, None, None]).reshape(-1, 4, 2)
    nets[-2:] = (np.array(small) * 13.0) + [6.0, 60.0]
    return curve_net(nets)


@pytest.mark.parametrize("count", [1, 2, 300])
def test_without_a_tolerance_curves_are_as_smooth_however_many(studio: Studio, count: int) -> None:
    """An 80th of a pixel: 5 grey levels of 255 at most. Curves are in one cell each, or alone."""
    wave = np.array([[0.0, 0.0], [0.1, 1.6], [0.9, -0.6], [1.0, 1.0]])
    side = int(np.ceil(np.sqrt(count)))
    places = np.stack(np.divmod(np.arange(count), side), -1)[:, None]
    net = curve_net((places + 0.1 + 0.8 * wave) * (SIDE / side))
    smooth = coverage(studio, Curves(net, BLACK, 1.6))
    exact = coverage(studio, Curves(net.copy(), BLACK, 1.6), tolerance=1e-4)
    rough = coverage(studio, Curves(net.copy(), BLACK, 1.6), tolerance=0.5)
    assert np.abs(smooth - exact).max() <= 5.0 / 255.0
    assert np.abs(rough - exact).max() > 20.0 / 255.0


def test_segments_are_counted_once_a_view(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    counted: list[int] = []
    steps = curve_parts.Bends.steps

    def spy(bends: curve_parts.Bends, *view: object) -> NDArray[np.int64]:
        counted.append(len(bends.off))
        return steps(bends, *view)  # type: ignore[arg-type]

    monkeypatch.setattr(curve_parts.Bends, "steps", spy)
    layer = Curves(waves(3), BLACK, 1.6)
    for tolerance in (0.0, 0.0, 0.25, 0.25, 0.0):
        coverage(studio, layer, tolerance=tolerance)
    assert counted == [6, 6]
    coverage(studio, Curves(waves(3), BLACK, 1.6))
    assert counted == [6, 6, 6]


def test_curves_in_parts_look_the_same(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """Few segments for the small, many for the large one; chains stay whole."""
    net = waves(60)
    whole = coverage(studio, Curves(net, BLACK, 1.6))
    monkeypatch.setattr(curve_parts, "WORTH", 0)
    segments: list[tuple[int, int]] = []
    draw_part = Strokes._draw_part

    def spy(self: Strokes, layer: Curves, part: Array, steps: int, screen: Screen) -> None:
        segments.append((steps, len(part)))
        draw_part(self, layer, part, steps, screen)

    monkeypatch.setattr(Strokes, "_draw_part", spy)
    parts = coverage(studio, Curves(net, BLACK, 1.6))
    assert [count for _, count in segments] == [118, 2]
    assert segments[0][0] < segments[1][0]
    assert np.abs(parts - whole).max() <= 4.0 / 255.0
    exact = segments[0][0]
    segments.clear()
    coverage(studio, Curves(net.copy(), BLACK, 1.6), tolerance=0.5)
    assert segments[0][0] < exact / 4
