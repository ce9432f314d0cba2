"""From scene to scene and back, and from change to change: pages, reset, undo and redo."""

from __future__ import annotations

from itertools import pairwise

from states import MIXED, opened, run, value

from reparam.scenes.registry import scene_names
from reparam.subject import open_subject


def test_figures_and_pages_come_round() -> None:
    state = opened()
    for number in range(1, 10):
        before = state.subject.scene.name
        state.show_figure(number)
        there = f"fig{number}" in scene_names()
        assert state.subject.scene.name == (f"fig{number}" if there else before)
        assert there or state.notice == f"there is no figure {number} here"
    for direction in (1, -1):
        state = opened(scene_names()[0])
        seen = []
        for _ in scene_names():
            seen.append(state.subject.scene.name)
            state.turn_page(direction)
        assert sorted(seen) == scene_names()
        assert state.subject.scene.name == scene_names()[0]


def test_an_opened_file_is_a_page() -> None:
    state = opened(str(MIXED))
    body = state.subject.data["body"]
    state.turn_page(1)
    assert state.subject.scene.name == scene_names()[0]
    state.turn_page(-1)
    assert state.subject.data["body"] is body
    assert state.subject.title == "mixed.bv"


def test_scenes_remember_their_values_and_views() -> None:
    state = opened("fig5", "texture=r", "morph=0.4")
    state.pan("physical", 0.1, 0.2)
    views = dict(state.views)
    state.toggle_net()
    state.show_figure(4)
    assert state.views == {}
    assert value(state, "net") is True  # how things are displayed goes along
    assert value(state, "morph") == 1.0
    state.show_figure(5)
    assert (value(state, "texture"), value(state, "morph")) == ("r", 0.4)
    assert state.views == views


def test_a_new_page_stops_what_moves() -> None:
    state = opened()
    state.play()
    state.show_figure(4)
    assert not state.moving


def test_reset_takes_the_view_then_the_parameters() -> None:
    state = opened()
    state.next_texture()
    state.change_level(1)
    state.zoom("physical", 2.0, 0.0, 0.0)
    state.reset()
    assert state.notice == "view reset"
    assert (state.views, value(state, "texture")) == ({}, "r")
    state.reset()
    assert state.notice == "parameters reset"
    assert (value(state, "texture"), value(state, "level")) == ("identity", 32)
    assert state.subject == open_subject("fig5")


def test_reset_keeps_the_file() -> None:
    state = opened(str(MIXED))
    body = state.subject.data["body"]
    state.next_texture()
    state.reset()
    assert state.subject.data["body"] is body
    assert (state.subject.title, value(state, "texture")) == ("mixed.bv", "identity")


def test_each_change_of_parameters_is_undone_and_made_again() -> None:
    state = opened("fig5", "morph=0.25")
    seen = [state.subject]
    for press in (state.next_texture, state.next_checks, state.toggle_net, state.glide):
        press()
        if state.moving:
            run(state, 0.0, 1.0)
        seen.append(state.subject)
    state.play()
    run(state, 1.0, 0.5)  # frames of an animation are no steps
    state.play()
    for subject in reversed(seen[:-1]):
        state.undo()
        assert state.subject is subject
    state.undo()
    assert state.notice == "nothing to undo"
    for before, subject in pairwise(seen[:4]):
        assert state.subject is before
        state.redo()
        assert state.subject is subject
    state.redo()
    assert state.subject.value("morph") == seen[-1].value("morph")
    state.redo()
    assert state.notice == "nothing to redo"
    state.undo()
    state.next_texture()
    state.redo()
    assert state.notice == "nothing to redo"


def test_undo_returns_to_the_scene_of_the_change() -> None:
    state = opened()
    state.next_texture()
    state.show_figure(4)
    state.undo()
    assert (state.subject.scene.name, value(state, "texture")) == ("fig5", "identity")
    state.show_figure(4)
    assert state.subject.scene.name == "fig4"
