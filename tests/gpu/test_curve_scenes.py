"""The curves that scenes draw, evaluated on the GPU, against float64."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.curve import curve_points
from reparam.gpu.polylines import curve_parameters
from reparam.scenes.layers import Curves
from reparam.snapshot import Studio
from reparam.subject import open_subject

SCENES = [
    ("fig3",),
    ("fig3", "smooth=G2"),
    ("joins", "pieces=arch", "speed=3"),
    ("cusp", "turn=30"),
    ("pythagorean", "four=1"),
    ("spline", "weights=[1,2,0.5,3,1,0.2,1,1]"),
]


@pytest.mark.parametrize("words", SCENES, ids=" ".join)
def test_points(studio: Studio, words: tuple[str, ...]) -> None:
    layers = [
        layer
        for space in open_subject(words[0]).assigned(words[1:]).figure().spaces
        for layer in space.layers
        if isinstance(layer, Curves)
    ]
    assert layers
    for layer in layers:
        nets = layer.net.reshape(-1, layer.net.shape[-2], 4)
        parameters = curve_parameters((0.0, 1.0), 64)
        found = studio.painter.evaluation.read(nets[:, :, None], parameters).reshape(-1, 4)
        truth = curve_points(nets, parameters[:, 0])
        largest = np.abs(nets[..., :3] / np.maximum(nets[..., 3:], 1e-9)).max()
        error = np.abs(found[:, :3] / found[:, 3:] - truth.reshape(-1, 3)).max()
        assert error <= 1e-6 * largest
