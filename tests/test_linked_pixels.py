"""The linked cursor on the pixels: in all three spaces where float64 has it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reparam.geometry.camera import View
from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.net import control_net
from reparam.gpu.arrangement import UNITS, Panel, arrange
from reparam.gpu.targets import Target
from reparam.scenes import palette
from reparam.scenes.cursor import POINT
from reparam.scenes.display import Display
from reparam.scenes.layers import Figure, IsoLines, Space
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject
from reparam.viewer.pointer import Pointer
from reparam.viewer.state import State

SIZE = (780, 360)


def r(u: float, v: float) -> tuple[float, float]:
    a, b = 2.0 * u - 1.0, 2.0 * v - 1.0
    return b * (3.0 - a * a) / 2.0, -a * (3.0 - b * b) / 2.0


def places(texture: str, u: float, v: float) -> dict[str, tuple[float, float]]:
    """Where (u,v) is in each space, by formulas."""
    identity = (2.0 * v - 1.0, 1.0 - 2.0 * u)
    seen = identity if texture == "identity" else r(u, v)
    return {"domain": (v, 1.0 - u), "texture": seen, "physical": r(u, v)}


def pixel(panel: Panel, at: Sequence[float]) -> NDArray[np.float64]:
    """Of the frame, y up."""
    region = panel.region
    inside = panel.camera.pixels(np.array([*at, 0.0]), region.width, region.height)
    return np.asarray(inside + np.array([region.left, region.bottom]))


def panels_of(subject: Subject) -> dict[str, Panel]:
    panels = arrange(subject.figure(), SIZE, {}, False, False)
    return {panel.space.name: panel for panel in panels}


def dot(picture: NDArray[np.uint8], near: NDArray[np.float64]) -> NDArray[np.float64]:
    """The middle of the dot's pixels about a place, y up; the square's sides are further away."""
    radius = POINT * min(SIZE) / UNITS
    colour = np.round(255 * np.array(palette.CURSOR))
    rows, columns = np.nonzero((np.abs(picture - colour) < 40).all(-1))
    points = np.stack([columns + 0.5, picture.shape[0] - rows - 0.5], -1)
    points = points[np.linalg.norm(points - near, axis=1) < 2.2 * radius]
    assert len(points) == pytest.approx(np.pi * radius**2, rel=0.4)
    return np.asarray(points.mean(0))


@pytest.mark.parametrize("texture", ["identity", "r"])
@pytest.mark.parametrize(("u", "v"), [(0.3, 0.2), (0.75, 0.6)])
def test_the_dot_is_where_float64_has_it(studio: Studio, texture: str, u: float, v: float) -> None:
    subject = open_subject("fig6").assigned([f"texture={texture}", f"cursor={u},{v}"])
    picture = studio.draw(subject, SIZE)
    for name, place in places(texture, u, v).items():
        expected = pixel(panels_of(subject)[name], place)
        assert dot(picture, expected) == pytest.approx(expected, abs=0.5), name


@pytest.mark.parametrize("texture", ["identity", "r"])
def test_the_mouse_in_each_space_finds_the_same_point(texture: str) -> None:
    subject = open_subject("fig6").changed("texture", texture)
    state = State(subject, ("vertex",), "vertex")
    panels, pointer = panels_of(subject), Pointer(state)
    for u, v in ((0.3, 0.2), (0.9, 0.05), (1.0, 0.5)):
        for name, place in places(texture, u, v).items():
            state.changed = False
            pointer.point_at(list(panels.values()), *pixel(panels[name], place))
            assert state.cursor is not None
            assert (state.cursor.u, state.cursor.v) == pytest.approx((u, v), abs=1e-9), name


def test_outside_the_nearest_point_and_off_the_spaces_nothing() -> None:
    subject = open_subject("fig6")
    state = State(subject, ("vertex",), "vertex")
    panels, pointer = panels_of(subject), Pointer(state)
    for name, beyond, expected in (
        ("domain", (0.4, 1.05), (0.0, 0.4)),
        ("texture", (-1.1, -1.1), (1.0, 0.0)),
        ("physical", (1.59, 0.0), (0.5, 1.0)),
    ):
        pointer.point_at(list(panels.values()), *pixel(panels[name], beyond))
        assert state.cursor is not None
        assert (state.cursor.u, state.cursor.v) == pytest.approx(expected, abs=1e-9)
    state.changed = False
    pointer.point_at(list(panels.values()), 5.0, 2.0)  # in the caption
    assert not state.changed


def test_panned_and_zoomed_spaces_are_pointed_at_as_they_are_seen() -> None:
    subject = open_subject("fig6")
    state = State(subject, ("vertex",), "vertex")
    views = {"physical": View(zoom=3.0, pan=(0.5, -0.2))}
    panels = arrange(subject.figure(), SIZE, views, False, False)
    Pointer(state).point_at(panels, *pixel(panels[2], r(0.6, 0.7)))
    assert state.cursor is not None
    assert (state.cursor.u, state.cursor.v) == pytest.approx((0.6, 0.7), abs=1e-9)


def test_of_a_surface_in_space_the_near_side(tmp_path: Path) -> None:
    path = tmp_path / "roof.bv"
    path.write_text("5 2 1\n0 0 0\n0 1 0\n0.5 0 2\n0.5 1 2\n1 0 0\n1 1 0\n")
    subject = open_subject(str(path)).changed("linked", True)
    state = State(subject, ("vertex",), "vertex")
    panels = arrange(subject.figure(), SIZE, {}, False, False)
    physical = panels[-1]
    assert physical.space.map is not None
    (net,), rotation = physical.space.map, physical.camera.rotation
    hidden = []
    for u in np.linspace(0.05, 0.95, 7):
        at = project(evaluate(net, u, 0.4))
        region = physical.region
        x, y = physical.camera.pixels(at, region.width, region.height)
        Pointer(state).point_at(panels, x + region.left, y + region.bottom)
        assert state.cursor is not None
        shown = project(evaluate(net, state.cursor.u, state.cursor.v))
        assert rotation[:2] @ shown == pytest.approx(rotation[:2] @ at, abs=1e-8)
        hidden.append(rotation[2] @ (shown - at) > 1e-6)
        if not hidden[-1]:
            assert (state.cursor.u, state.cursor.v) == pytest.approx((u, 0.4), abs=1e-6)
    assert any(hidden)
    assert not all(hidden)


def test_a_lifted_line_lies_on_a_wider_one_all_along(studio: Studio) -> None:
    """Where it runs away from the eye, too: caps of two widths must not tilt the two lines."""
    net = control_net([[(0, 0, 0), (0, 9, 0)], [(1, 0, 0), (1, 9, 0)]])
    thin = IsoLines(net, u=(0.5,), color=(1.0, 0.0, 0.0), width=5.0, lift=1)
    wide = IsoLines(net, u=(0.5,), color=(0.0, 0.0, 0.0), width=14.0)

    def red(*layers: IsoLines) -> NDArray[np.bool_]:
        space = Space("body", project(net).reshape(-1, 3), layers, spatial=True)
        target = Target(studio.ctx, (300, 300), 1, studio.painter.capabilities)
        studio.painter.draw(Figure((space,)), target, Display())
        picture = target.pixels()
        studio.ctx.extra.use()
        target.release()
        return np.asarray((picture == (255, 0, 0)).all(-1))

    alone = red(thin)
    assert alone.sum() > 60
    assert (red(wide, thin) >= alone).all()
