"""A lit surface is as bright as the angle between its normal and the light by the eye says."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.camera import View, frame
from reparam.geometry.evaluate import sample_surface
from reparam.geometry.net import control_net
from reparam.scenes.layers import Patches
from reparam.snapshot import Studio

LIGHT = np.array([-0.35, 0.45, 1.0]) / np.linalg.norm([-0.35, 0.45, 1.0])
TILTED = control_net([[(0, 0, 0), (0, 1, 0.5)], [(1, 0, -0.7), (1, 1, -0.2)]])
NORMAL = np.array([0.7, -0.5, 1.0]) / np.linalg.norm([0.7, -0.5, 1.0])


@pytest.mark.parametrize("evaluator", ["vertex", "tessellation"])
def test_brightness_follows_the_eye(studio: Studio, evaluator: str) -> None:
    framebuffer = studio.ctx.framebuffer([studio.ctx.renderbuffer((33, 33))])
    color = np.array([1.0, 0.5, 0.25])
    layer = Patches(TILTED, color=tuple(color.tolist()), lit=True)
    for azimuth, elevation in [(0.0, 90.0), (-60.0, 30.0), (25.0, 50.0), (160.0, -35.0)]:
        camera = frame(sample_surface(TILTED), 33, 33, View(40.0, (0, 0), azimuth, elevation), True)
        framebuffer.use()
        framebuffer.clear()
        studio.painter.surfaces.draw(layer, camera, evaluator, 2)
        found = np.frombuffer(framebuffer.read(components=3, alignment=1), np.uint8)
        bright = 0.45 + 0.55 * abs(camera.rotation @ NORMAL @ LIGHT)
        expected = np.broadcast_to(255.0 * bright * color, (33, 33, 3))
        np.testing.assert_allclose(found.reshape(33, 33, 3), expected, atol=1.0)
    studio.ctx.extra.use()
    renderbuffer = framebuffer.color_attachments[0]
    framebuffer.release()
    renderbuffer.release()
