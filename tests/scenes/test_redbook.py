"""The Red Book's programs as scenes: their names, their hands, what they record."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.evaluators import GL_LINE, GL_MAP2_VERTEX_3, GL_POINT, Recorder
from reparam.evaluators.recording import Batch, Collection
from reparam.gpu.targets import Target
from reparam.scenes.display import Display
from reparam.scenes.layers import Figure, Handles, Recorded, Space, plane
from reparam.scenes.redbook import SURFACE, turned
from reparam.scenes.registry import load_scene, scene_names
from reparam.snapshot import Studio
from reparam.subject import open_subject

NAMES = [f"redbook-{name}" for name in ("bezcurve", "bezmesh", "bezsurf", "texturesurf")]


def test_underscores_of_modules_are_shown_as_hyphens() -> None:
    assert set(NAMES) <= set(scene_names())
    assert not [name for name in scene_names() if "_" in name]
    assert load_scene("redbook-bezmesh").name == "redbook-bezmesh"


@pytest.mark.parametrize("name", NAMES)
def test_a_dragged_point_goes_where_the_hand_is(name: str) -> None:
    subject = open_subject(name)
    for _ in range(2):
        (hand,) = (x for x in subject.figure().spaces[-1].layers if isinstance(x, Handles))
        target = hand.at[2] + [0.5, -0.25, 0.125]
        for parameter, value in hand.drag(subject.values, 2, target).items():
            subject = subject.changed(parameter, value)
        (moved,) = (x for x in subject.figure().spaces[-1].layers if isinstance(x, Handles))
        np.testing.assert_allclose(moved.at[2], target, atol=1e-12)
        np.testing.assert_allclose(np.delete(moved.at, 2, 0), np.delete(hand.at, 2, 0), atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_recorded(name: str) -> None:
    layers = load_scene(name)().spaces[-1].layers
    (recorded,) = (layer for layer in layers if isinstance(layer, Recorded))
    batches = recorded.recording.batches
    if name == "redbook-bezsurf":
        assert len(batches) == 18
    if name in ("redbook-bezmesh", "redbook-texturesurf"):
        (batch,) = batches
        assert isinstance(batch, Batch)
        corner = batch.feeds["vertex"].net[0, -1, :3]  # u = 0, v = 1: ctrlpoints[3][0]
        np.testing.assert_allclose(corner, turned(SURFACE[3, 0]), atol=1e-6)
    if name == "redbook-bezcurve":
        assert all(isinstance(batch, Collection) for batch in batches)


def test_a_mesh_of_lines_is_stroked_as_wide_as_asked(studio: Studio) -> None:
    """Black lines at u = 0, 1/2, 1 and a red point on one of them."""
    gl = Recorder()
    flat = np.array([[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0)]], float)
    gl.glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, flat)
    gl.glEnable(GL_MAP2_VERTEX_3)
    gl.glMapGrid2f(2, 0, 1, 1, 0, 1)
    gl.glColor3f(0, 0, 0)
    gl.glEvalMesh2(GL_LINE, 0, 2, 0, 1)
    gl.glColor3f(1, 0, 0)
    gl.glEvalMesh2(GL_POINT, 1, 1, 0, 0)
    layer = Recorded(gl.take(), width=16.0, radius=12.0)
    space = Space("physical", plane(-0.5, -0.5, 1.5, 1.5), (layer,))
    picture = drawn(studio, Figure((space,)))
    x = ((np.arange(128) + 0.5) / 128 * 2 - 1) * 1.08 + 0.5  # a margin is left around the bounds
    dark = picture[63, :, 0] < 128
    half = 8.0 / 512 * 2 * 1.08  # figure units in the model's
    expected = np.any([np.abs(x - edge) < half for edge in (0.0, 0.5, 1.0)], 0)
    clear = np.all([np.abs(np.abs(x - edge) - half) > 0.02 for edge in (0.0, 0.5, 1.0)], 0)
    assert (dark == expected)[clear].all()
    row = int((1 - (0.0 + 0.58) / 2.16) * 128)
    assert picture[row, 64].tolist() == [255, 0, 0]


def drawn(studio: Studio, figure: Figure) -> np.ndarray:
    target = Target(studio.ctx, (128, 128), 1, studio.painter.capabilities)
    studio.painter.draw(figure, target, Display())
    pixels = target.pixels()
    studio.ctx.extra.use()
    target.release()
    return pixels
