"""Plots put data where their axes say; combs are as long as a curve is bent."""

from __future__ import annotations

from math import pi

import numpy as np

from reparam.geometry.curve import circular_arc, curve_net
from reparam.scenes.combs import comb_teeth
from reparam.scenes.layers import Label, Polylines
from reparam.scenes.palette import INK
from reparam.scenes.plots import Plot


def texts(plot: Plot) -> list[str]:
    return [layer.text for layer in plot.axes() if isinstance(layer, Label)]


def test_linear_axes() -> None:
    plot = Plot((0.0, 2.0), (-1.0, 3.0), "u", "speed", size=(4.0, 8.0))
    assert plot.at([0.0, 1.0, 2.0], [-1.0, 1.0, 3.0]).tolist() == [[0, 0, 0], [2, 4, 0], [4, 8, 0]]
    assert texts(plot) == ["0", "0.5", "1", "1.5", "2", "−1", "0", "1", "2", "3", "u", "speed"]


def test_log_axes() -> None:
    plot = Plot((1.0, 100.0), (1e-4, 1.0), log=True, size=(2.0, 4.0))
    assert np.abs(plot.at([10.0], [1e-3]) - [[1.0, 1.0, 0.0]]).max() < 1e-15
    assert texts(plot)[:4] == ["10", "0", "10", "1"]
    assert texts(plot)[6:8] == ["10", "−4"]
    line = plot.function(lambda x: x**-2, INK).points[0]
    assert np.abs(line[:, 1] - (4.0 - 2.0 * line[:, 0])).max() < 1e-14  # a line: slope -2


def test_lines_are_cut_at_the_box() -> None:
    plot = Plot((0.0, 1.0), (0.0, 1.0), size=(1.0, 1.0))
    (segment,) = plot.curve([-1.0, 2.0], [-1.0, 2.0], INK).points
    assert np.abs(segment[:, :2] - [[0.0, 0.0], [1.0, 1.0]]).max() < 1e-15
    assert len(plot.curve([0.0, 1.0], [2.0, 2.0], INK).points) == 0
    assert len(plot.curve([0.0, 1.0], [0.5, 0.5], INK).points) == 1
    pole = plot.curve([0.0, 0.3, 0.5, 0.7, 1.0], [0.2, 0.4, np.nan, 0.4, 0.2], INK).points
    assert pole.shape == (2, 2, 3)
    assert len(plot.dots([0.5, 2.0], [0.5, 0.5], INK).at) == 1


def test_the_comb_of_a_circle_is_a_circle() -> None:
    arcs = np.stack([circular_arc(2.0, 0.1, 1.4), circular_arc(2.0, 2.0, 2.0 + 0.8 * pi)])
    teeth = comb_teeth(arcs, 3.0, 10)
    assert teeth.shape == (2, 11, 2, 3)
    radii = np.linalg.norm(teeth, axis=-1)
    assert np.abs(radii[..., 0] - 2.0).max() < 1e-14
    assert np.abs(radii[..., 1] - 3.5).max() < 1e-12


def test_no_tooth_at_a_cusp() -> None:
    teeth = comb_teeth(curve_net([[0, 0], [0, 0], [1, 0], [1, 1]]), 1.0, 4)
    assert np.isfinite(teeth).all()
    assert (teeth[0, 0, 0] == teeth[0, 0, 1]).all()


def test_an_empty_polyline_is_nothing() -> None:
    assert Polylines(np.zeros((0, 2, 3))).points.size == 0
