"""Handles under the mouse: found in pixels, dragged, put back bit for bit. No window in here."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.camera import View, frame
from reparam.gpu.arrangement import arrange
from reparam.scenes.layers import Figure, Handles, Space
from reparam.subject import open_subject
from reparam.viewer.hand import Hand, fine, rounded, snap_step
from reparam.viewer.state import State

SIZE = (640, 480)
MIDDLE = 4  # of the nine control points of r


class Table:
    """A hand above a scene, drawn whenever something changed."""

    def __init__(self, *assignments: str, scene: str = "fig5") -> None:
        self.state = State(open_subject(scene).assigned(assignments), ("vertex",), "vertex")
        self.hand = Hand(self.state)
        self.draw()

    def draw(self) -> None:
        self.hand.steady()
        figure, display = self.state.subject.figure(), self.state.subject.display
        views = self.state.views
        self.hand.see(arrange(figure, SIZE, views, False, display.net, display.perspective))

    def points(self) -> np.ndarray:
        return np.array(self.state.subject.value("points"))

    def pixel(self, index: int) -> np.ndarray:
        for panel in self.hand.panels:
            for layer in panel.space.layers:
                if isinstance(layer, Handles):
                    region = panel.region
                    pixels = panel.camera.pixels(layer.at[index], region.width, region.height)
                    return pixels + np.array([region.left, region.bottom])
        raise AssertionError("no handles")

    def drag(self, index: int, way: tuple[float, float], snap: bool = False) -> None:
        start = self.pixel(index)
        assert self.hand.take(*start, 1.0)
        for part in (0.3, 0.7, 1.0):
            self.hand.drag(*(start + part * np.array(way)), 1.0, snap)
            self.draw()
        self.hand.release()


def test_the_handle_under_the_mouse() -> None:
    table = Table()
    for index in (0, MIDDLE, 8):
        x, y = table.pixel(index)
        table.hand.point_at(x + 5.0, y - 5.0, 1.0)
        assert table.hand.over is not None
        assert table.hand.over.index == index
        table.hand.point_at(x + 8.0, y - 8.0, 1.0)
        assert table.hand.over is None
        table.hand.point_at(x + 8.0, y - 8.0, 2.0)  # a screen of twice as many pixels
        assert table.hand.over is not None


@pytest.mark.parametrize("morph", ["1", "0.4"])
@pytest.mark.parametrize("scene", ["fig4", "fig5"])
def test_dragging_moves_exactly_that_point(scene: str, morph: str) -> None:
    table = Table(f"morph={morph}", scene=scene)
    before, start = table.points(), table.pixel(MIDDLE)
    table.drag(MIDDLE, (40.0, 25.0))
    after = table.points()
    moved = (after != before).any(-1)
    assert np.argwhere(moved).tolist() == [[1, 1]]
    assert np.abs(table.pixel(MIDDLE) - start - (40.0, 25.0)).max() <= 0.5
    assert table.state.notice.startswith("c11 = (")


def test_a_click_moves_nothing() -> None:
    table = Table()
    before = table.state.subject
    table.drag(MIDDLE, (1.5, 0.0))
    assert table.state.subject is before
    table.state.undo()
    assert table.state.notice == "nothing to undo"


def test_a_whole_drag_is_one_step_and_comes_back_bit_for_bit() -> None:
    table = Table("net=1")
    before, views = table.points(), dict(table.state.views)
    table.drag(1, (0.0, 40.0))
    first = table.points()
    table.drag(MIDDLE, (-40.0, 3.0))
    second, seen = table.points(), dict(table.state.views)
    table.state.undo()
    assert table.points().tobytes() == first.tobytes()
    table.state.undo()
    assert table.points().tobytes() == before.tobytes()
    assert table.state.views == views
    table.state.redo()
    table.state.redo()
    assert table.points().tobytes() == second.tobytes()
    assert table.state.views == seen


def test_the_picture_stays_under_the_hand() -> None:
    """Where a dragged control point would change what is framed, the view makes up for it."""
    table = Table("net=1")
    still, start = table.pixel(3), table.pixel(1)
    table.drag(1, (10.0, 60.0))
    assert table.pixel(3) == pytest.approx(still, abs=1e-6)
    assert np.abs(table.pixel(1) - start - (10.0, 60.0)).max() <= 0.5
    assert table.state.view("physical") != View()


def test_snapping() -> None:
    table = Table()
    table.drag(MIDDLE, (47.0, 31.0), snap=True)
    step = snap_step(2.0 * table.hand.panels[0].camera.half_height / SIZE[1], 1.0)
    point = table.points()[1, 1]
    assert point == pytest.approx(np.round(point / step) * step, abs=1e-15)
    assert (point != 0.0).all()
    assert all(len(repr(float(c))) <= 5 for c in point)


def test_steps_are_round_and_wide_enough() -> None:
    for unit in 10.0 ** np.linspace(-9, 9, 200):
        step = snap_step(unit, 1.0)
        assert 24.0 * unit <= step <= 2.5 * 24.0 * unit * (1 + 1e-12)
        assert round(step / 10.0 ** np.floor(np.log10(step) + 1e-12)) in (1, 2, 5)
        assert unit / 20.0 * (1 - 1e-12) <= fine(unit) <= unit / 2.0
    at, point = np.array([0.0, 0.0, 0.25]), np.array([0.123456, -7.0 / 3.0, 0.25])
    assert rounded(at, point, 0.001).tolist() == [0.123, -2.333, 0.25]
    assert rounded(at, point, 0.2).tolist() == [0.2, -2.4, 0.25]
    assert rounded(at, 1e4 * point, 100.0).tolist() == [1200.0, -23300.0, 2500.0]


def test_a_spatial_point_moves_in_the_view_plane() -> None:
    random = np.random.default_rng(2)
    points = random.uniform(-1.0, 1.0, (5, 3))
    camera = frame(points, *SIZE, View(azimuth=25.0, elevation=-40.0), True)
    for point in points:
        pixel = camera.pixels(point, *SIZE) + np.array([13.0, -7.0])
        moved = camera.moved(point, pixel, *SIZE)
        assert camera.pixels(moved, *SIZE) == pytest.approx(pixel, abs=1e-9)
        assert (moved - point) @ camera.rotation[2] == pytest.approx(0.0, abs=1e-12)


def test_in_perspective_the_picture_stays_while_a_handle_follows_the_mouse() -> None:
    """Far out, so that the body's box grows, by which the eye was placed."""
    table = Table("perspective=80", "net=true", scene="fig7")
    before = table.pixel(0), table.pixel(3)
    way = np.array([-150.0, 260.0])
    table.drag(3, (way[0], way[1]))
    table.draw()
    np.testing.assert_allclose(table.pixel(0), before[0], atol=1e-6)
    np.testing.assert_allclose(table.pixel(3), before[1] + way, atol=0.51)
    table.state.undo()
    table.draw()
    np.testing.assert_allclose(table.pixel(3), before[1], atol=1e-9)


def test_of_handles_at_one_place_the_nearest_to_the_eye_is_found() -> None:
    def figure(at: list[list[float]]) -> Figure:
        layer = Handles(np.array(at), lambda *_: {})
        return Figure((Space("physical", np.array([[-1.0] * 3, [1.0] * 3]), (layer,), True),))

    table = Table()
    eye = frame(np.eye(3), *SIZE, View(), True).rotation[2] * 0.3
    for order in (1, -1):
        at = [[0.0, 0.0, 0.0], eye.tolist()][::order]
        panels = arrange(figure(at), SIZE, {}, False, False)
        table.hand.see(panels)
        table.hand.point_at(SIZE[0] / 2, SIZE[1] / 2, 1.0)
        assert table.hand.over is not None
        assert at[table.hand.over.index] == eye.tolist()


def test_a_click_is_told_apart_from_a_drag() -> None:
    """Section 1 of figure 3 is modified; clicked it is kept, dragged it stays what it was."""
    table = Table(scene="fig3")
    assert table.state.subject.value("arcs") == "KMKM"
    table.drag(1, (1.0, -1.0))  # the handles of the sections come first
    assert table.state.subject.value("arcs") == "KKKM"
    table.draw()
    table.drag(1, (30.0, 0.0))
    assert table.state.subject.value("arcs") == "KKKM"
    table.state.undo()
    assert table.state.subject.value("arcs") == "KMKM"


def test_a_handle_that_stands_for_a_number() -> None:
    """The ratio of an edge: told and typed as such, not as where its handle is."""
    table = Table(scene="fig9")
    x, y = table.pixel(0)
    table.hand.point_at(x, y, 1.0)
    assert table.hand.over is not None
    assert table.hand.described(table.hand.over) == "ratio of edge 0-1 = 0.5"
    table.hand.ask()
    prompt = table.state.prompt
    assert prompt is not None
    assert (prompt.title, prompt.text) == ("ratio of edge 0-1 =", "0.5")
    for text, ratio in (("0.07", 0.07), ("5", 0.98)):
        table.hand.ask()
        table.state.type_text(text)
        table.state.type_key("ENTER")
        table.draw()
        assert table.state.subject.value("creases").tolist() == [[0.0, 1.0, ratio]]
        assert table.state.notice == f"ratio of edge 0-1 = {ratio:g}"
    table.hand.ask()
    table.state.type_text("wide")
    table.state.type_key("ENTER")
    assert table.state.notice == "expected a number, found 'wide'"
    table.state.type_key("ESC")
    table.drag(0, (12.0, 9.0))
    assert table.state.notice.startswith("ratio of edge 0-1 = 0.")
