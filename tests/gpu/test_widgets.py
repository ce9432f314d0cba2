"""What Dear ImGui lays out, on the pixels: places, colours, cuts, letters, a larger atlas."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from imgui_bundle import imgui

from reparam.gpu.targets import Target
from reparam.gpu.widgets import Widgets
from reparam.snapshot import Studio
from reparam.viewer.panel import begin

SIZE = (90, 60)
Picture = np.ndarray


@pytest.fixture
def drawn(studio: Studio) -> Iterator[Callable[..., Picture]]:
    """Draws on white what a function lays out, by one renderer that lives on."""
    studio.ctx.__enter__()  # current, should there have been another
    before = imgui.get_current_context()
    begin()
    widgets = Widgets(studio.ctx, studio.painter.programs)

    def draw(lay_out: Callable[[imgui.ImDrawList], None], ratio: int = 1) -> Picture:
        size = (SIZE[0] * ratio, SIZE[1] * ratio)
        target = Target(studio.ctx, size, 1, studio.painter.capabilities)
        target.framebuffer.use()
        target.framebuffer.clear(1.0, 1.0, 1.0, 1.0)
        io = imgui.get_io()
        io.display_size, io.delta_time = imgui.ImVec2(*SIZE), 1 / 60
        io.display_framebuffer_scale = imgui.ImVec2(ratio, ratio)
        imgui.new_frame()
        lay_out(imgui.get_background_draw_list())
        imgui.render()
        widgets.draw(imgui.get_draw_data())
        target.resolve()
        picture = target.pixels()
        studio.ctx.extra.use()
        target.release()
        return picture

    yield draw
    imgui.destroy_context(imgui.get_current_context())
    if before is not None:
        imgui.set_current_context(before)


def box(ink: imgui.ImDrawList) -> None:
    ink.add_rect_filled(imgui.ImVec2(10, 20), imgui.ImVec2(40, 50), 0xFF0000FF)  # red, as ABGR


@pytest.mark.parametrize("ratio", [1, 2])
def test_a_rectangle_is_where_and_what_it_should_be(
    drawn: Callable[..., Picture], ratio: int
) -> None:
    picture = drawn(box, ratio)
    red = (picture == (255, 0, 0)).all(-1)
    expected = np.zeros_like(red)
    expected[20 * ratio : 50 * ratio, 10 * ratio : 40 * ratio] = True
    assert (red == expected).all()
    assert (picture[~expected] == 255).all()


def test_a_cut_cuts(drawn: Callable[..., Picture]) -> None:
    def cut(ink: imgui.ImDrawList) -> None:
        ink.push_clip_rect(imgui.ImVec2(0, 0), imgui.ImVec2(20, 30))
        box(ink)
        ink.pop_clip_rect()
        ink.push_clip_rect(imgui.ImVec2(30, 0), imgui.ImVec2(300, 300))
        box(ink)
        ink.pop_clip_rect()

    red = (drawn(cut) == (255, 0, 0)).all(-1)
    expected = np.zeros_like(red)
    expected[20:30, 10:20] = expected[20:50, 30:40] = True
    assert (red == expected).all()


def test_half_covering_colours_mix(drawn: Callable[..., Picture]) -> None:
    def veil(ink: imgui.ImDrawList) -> None:
        ink.add_rect_filled(imgui.ImVec2(0, 0), imgui.ImVec2(90, 60), 0x80000000)

    assert np.abs(drawn(veil).astype(int) - 127).max() <= 1


def test_letters_are_drawn_and_the_atlas_grows(drawn: Callable[..., Picture]) -> None:
    def letters(size: float, text: str) -> Callable[[imgui.ImDrawList], None]:
        def lay_out(ink: imgui.ImDrawList) -> None:
            ink.add_text(imgui.get_font(), size, imgui.ImVec2(2, 2), 0xFF000000, text)

        return lay_out

    first = drawn(letters(20.0, "r(u, v)"))
    assert 0.01 < (first < 128).all(-1).mean() < 0.3
    for size in range(21, 60, 2):  # more glyphs than the first atlas holds
        dark = (drawn(letters(float(size), "σβ²−×Ωwmgq@")) < 128).all(-1)
        assert dark.any()
    assert np.array_equal(drawn(letters(20.0, "r(u, v)")), first)


def test_nothing_of_the_state_is_left_behind(drawn: Callable[..., Picture], studio: Studio) -> None:
    subject_picture = studio.picture("fig5", (64, 64))
    drawn(box)
    assert np.array_equal(studio.picture("fig5", (64, 64)), subject_picture)
