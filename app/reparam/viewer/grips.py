"""The handles as the window shows them over the frame."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, floor

from ..gpu.arrangement import UNITS, Panel
from ..gpu.labels import Style, measure
from ..scenes.layers import Handles
from .hand import Grip, Hand, model_units, snap_step
from .overlay import GROUND, INK, Sheet

LARGER = 1.35  # the handle under the mouse
LEAST = 3.0  # figure units, its radius before that
MOST = 2000  # handles of a layer that are shown at once
GRID = (0.0, 0.45, 0.70, 0.16)
AXIS = (0.0, 0.45, 0.70, 0.45)


def draw_handles(sheet: Sheet, hand: Hand, quiet: bool) -> None:
    """All that can be dragged, the quiet ones too if asked; too many only under the mouse."""
    for panel in hand.panels:
        for layer in panel.space.layers:
            if not isinstance(layer, Handles) or not 0 < len(layer.at) <= MOST:
                continue
            if quiet or not layer.quiet:
                _in_panel(sheet, panel, layer)


def draw_grip(sheet: Sheet, hand: Hand, grip: Grip) -> None:
    """The handle under the mouse, larger, and beside it its name and coordinates."""
    panel, layer = hand.panel(grip.space), hand.layer(grip)
    if panel is None or layer is None:
        return
    radius, size, labels = LARGER * max(layer.radius, LEAST), sheet.size, sheet.painter.labels
    _in_panel(sheet, panel, replace(layer, radius=radius), grip.index)
    em = 0.9 * sheet.em
    text = hand.described(grip)
    width, height = measure(text, round(em)) + em, 1.6 * em
    x, y = hand.place(grip)
    gap = radius * min(size) / UNITS + 0.5 * em
    left = min(max(0.0, x + gap), size[0] - width)
    bottom = y + gap if y + gap + height < size[1] else y - gap - height
    labels.box(left, bottom, width, height, size, GROUND)
    at = (left + em / 2, bottom + height / 2)
    labels.text(text, at, size, Style(em, INK, anchor=(0.0, 0.5)))


def draw_grid(sheet: Sheet, panel: Panel) -> None:
    """The lines whose crossings Shift snaps to, in a space of the plane."""
    if panel.space.spatial:
        return
    region, camera, labels, size = panel.region, panel.camera, sheet.painter.labels, sheet.size
    step = snap_step(model_units(panel), sheet.scale)
    middle = (region.left + region.width / 2, region.bottom + region.height / 2)
    half = (camera.half_width, camera.half_height)
    unit, thin = model_units(panel), max(1.0, round(sheet.scale))
    for axis in (0, 1):
        first = ceil((camera.center[axis] - half[axis]) / step)
        last = floor((camera.center[axis] + half[axis]) / step)
        for k in range(first, last + 1):
            at = round(middle[axis] + (k * step - camera.center[axis]) / unit - thin / 2)
            color = GRID if k else AXIS
            if axis == 0:
                labels.box(at, region.bottom, thin, region.height, size, color)
            else:
                labels.box(region.left, at, region.width, thin, size, color)


def _in_panel(sheet: Sheet, panel: Panel, layer: Handles, only: int | None = None) -> None:
    region, painter, size = panel.region, sheet.painter, sheet.size
    if only is None:  # half of a handle at the rim of a space would say nothing
        pixels = panel.camera.pixels(layer.at, region.width, region.height)
        inside = ((pixels >= 0.0) & (pixels <= [region.width, region.height])).all(-1)
        if not inside.any():
            return
        if not inside.all():
            layer = replace(layer, at=layer.at[inside])
    box = (region.left, region.bottom, region.width, region.height)
    painter.ctx.viewport = painter.ctx.scissor = box
    painter.strokes.draw_handles(layer, panel.camera, min(size) / UNITS, only)
    painter.ctx.scissor = None
    painter.ctx.viewport = (0, 0, *size)
