"""The hand: which handle is under the mouse, and what dragging it does. No window in here."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from math import ceil, floor, log10

import numpy as np
from numpy.typing import NDArray

from ..errors import ReparamError, UsageError
from ..geometry.camera import Camera, view_through
from ..geometry.net import LARGEST
from ..gpu.arrangement import Panel, camera
from ..scenes.layers import Handles
from .state import State

Array = NDArray[np.float64]

REACH = 9.0  # pixels (of content scale 1) from the middle of a handle that still take hold of it
DEAD = 2.0  # pixels that a held handle stays before it follows: a click moves nothing
GRID = 24.0  # pixels between the points that Shift snaps to, at least


@dataclass(frozen=True)
class Grip:
    """One handle of a figure: its space, its layer among the space's layers, its index there."""

    space: str
    layer: int
    index: int


class Hand:
    """Points at handles and drags them. Pixels are the framebuffer's, y up."""

    def __init__(self, state: State) -> None:
        self._state = state
        self.panels: list[Panel] = []  # drawn last
        self.over: Grip | None = None  # under the mouse
        self.chosen: Grip | None = None  # taken hold of last: what Enter types the place of
        self.held = False  # the chosen one is being dragged
        self.snapping = False
        self._camera: Camera | None = None  # when it was taken: the picture stays still meanwhile
        self._from = np.zeros(2)  # the mouse then
        self._offset = np.zeros(2)  # from the mouse to the handle's middle then
        self._moving = False
        self._places: dict[tuple[str, int], Array] = {}  # pixels of layers, since the last drawing

    def see(self, panels: list[Panel]) -> None:
        """These were drawn last."""
        self.panels = panels
        self._places.clear()
        if self.chosen is not None and self.layer(self.chosen) is None:
            self.chosen, self.held = None, False
        if self.over is not None and self.layer(self.over) is None:
            self.over = None

    def panel(self, name: str) -> Panel | None:
        """The space of that name, as it was drawn."""
        return next((panel for panel in self.panels if panel.space.name == name), None)

    def layer(self, grip: Grip) -> Handles | None:
        """The layer of a handle, if the figure still has the handle."""
        panel = self.panel(grip.space)
        layers = panel.space.layers if panel else ()
        layer = layers[grip.layer] if grip.layer < len(layers) else None
        return layer if isinstance(layer, Handles) and grip.index < len(layer.at) else None

    def place(self, grip: Grip) -> Array:
        """Where a handle is, in pixels of the framebuffer."""
        panel, layer = self.panel(grip.space), self.layer(grip)
        assert panel is not None
        assert layer is not None
        return _pixels(panel, layer.at[grip.index])

    def point_at(self, x: float, y: float, scale: float) -> None:
        """The mouse is here and holds nothing."""
        over = self._find(np.array([x, y]), REACH * scale)
        if over != self.over:
            self.over = over
            self._state.refresh = True

    def _find(self, mouse: Array, reach: float) -> Grip | None:
        """The nearest handle in reach; of those at one place the one nearest to the eye."""
        best, found = (reach, 0.0), None
        for panel in self.panels:
            if not panel.region.contains(*mouse):
                continue
            for number, layer in enumerate(panel.space.layers):
                if not isinstance(layer, Handles) or not len(layer.at):
                    continue
                key = (panel.space.name, number)
                if key not in self._places:
                    self._places[key] = _pixels(panel, layer.at)
                away = np.linalg.norm(self._places[key] - mouse, axis=-1).round(1)
                if away.min() > reach:
                    continue
                behind = -(layer.at @ panel.camera.rotation[2])
                index = int(np.lexsort((behind, away))[0])
                rank = (float(away[index]), float(behind[index]))
                if rank < best:
                    best, found = rank, Grip(panel.space.name, number, index)
        return found

    def take(self, x: float, y: float, scale: float) -> bool:
        """Take hold of the handle under the mouse; whether there is one."""
        self.point_at(x, y, scale)
        if self.chosen != self.over:
            self._state.refresh = True
        self.chosen = self.over
        if self.over is None:
            return False
        panel = self.panel(self.over.space)
        assert panel is not None
        self._camera = panel.camera
        self._from = np.array([x, y])
        self._offset = self.place(self.over) - self._from
        self.held, self._moving = True, False
        self._state.begin_gesture()
        return True

    def drag(self, x: float, y: float, scale: float, snap: bool) -> None:
        """The mouse, holding a handle, is here now: the handle goes where it is."""
        assert self.chosen is not None
        mouse = np.array([x, y])
        self.snapping = snap
        if not self._moving and np.linalg.norm(mouse - self._from) < DEAD * scale:
            return
        self._moving = True
        panel, layer = self.panel(self.chosen.space), self.layer(self.chosen)
        if panel is None or layer is None:
            return
        region, at = panel.region, layer.at[self.chosen.index]
        pixel = mouse + self._offset - [region.left, region.bottom]
        point = panel.camera.moved(at, pixel, region.width, region.height)
        unit = model_units(panel) / float(panel.camera.enlargement(at))
        self.move(self.chosen, rounded(at, point, snap_step(unit, scale) if snap else fine(unit)))

    def move(self, grip: Grip, point: Array) -> None:
        """The handle to that point: the parameters that change by it."""
        layer = self.layer(grip)
        if layer is not None and not np.array_equal(point, layer.at[grip.index]):
            try:
                self._state.change(layer.drag(self._state.subject.values, grip.index, point))
            except ValueError as fault:  # the scene cannot have the point there
                self._state.say(str(fault))

    def release(self) -> None:
        """Let go."""
        if not self.held:
            return
        self.held = self.snapping = False
        self._camera = None
        self._state.end_gesture()
        if self.chosen is None:
            return
        layer = self.layer(self.chosen)
        if self._moving:
            self._renew()  # the last bit of the way is not drawn yet
            self._state.say(self.described(self.chosen))
        elif layer is not None and layer.click is not None:
            try:
                self._state.change(layer.click(self._state.subject.values, self.chosen.index))
            except ValueError as fault:
                self._state.say(str(fault))

    def _renew(self) -> None:
        """The layers as they will be drawn next, if they can be drawn."""
        try:
            spaces = {space.name: space for space in self._state.subject.figure().spaces}
        except ReparamError:
            return
        self.see([replace(p, space=spaces.get(p.space.name, p.space)) for p in self.panels])

    def ask(self) -> None:
        """Ask for the coordinates of the handle under the mouse, or of the one held last."""
        grip = self.over or self.chosen
        panel, layer = (self.panel(grip.space), self.layer(grip)) if grip else (None, None)
        if grip is None or panel is None or layer is None:
            self._state.ask_for_parameter()
            return
        spatial = panel.space.spatial
        self.chosen = grip
        if layer.dial is not None:
            title, count = f"{layer.name(grip.index)} =", 1
            start = f"{layer.dial.numbers[grip.index]:.4g}"
        else:
            title = f"{layer.name(grip.index)} =  x, y{', z' if spatial else ''}"
            start = coordinates(layer.at[grip.index], spatial)[1:-1]
            count = 3 if spatial else 2
        self._state.ask(title, lambda text: self._put(grip, text, count), start)

    def _put(self, grip: Grip, text: str, count: int) -> None:
        """A handle to the coordinates or the number typed, or a parameter. Raises UsageError."""
        if "=" in text:
            self._state.set_by_text(text)
            return
        layer = self.layer(grip)
        try:
            numbers = [float(word) for word in text.strip("()").replace(",", " ").split()]
            point = np.array(numbers)
            if layer is None or len(numbers) != count or not (np.abs(point) <= LARGEST).all():
                raise ValueError
        except ValueError:
            expected = f"{count} numbers" if count > 1 else "a number"
            raise UsageError(f"expected {expected}, found {text!r}") from None
        if layer.dial is not None:
            values = self._state.subject.values
            self._state.change(layer.dial.turn(values, grip.index, numbers[0]))
        else:
            self.move(grip, np.array([*numbers, *layer.at[grip.index, count:]]))
        self._renew()
        self._state.say(self.described(grip))

    def described(self, grip: Grip) -> str:
        """Name and coordinates of a handle, or the number that it stands for."""
        panel, layer = self.panel(grip.space), self.layer(grip)
        if panel is None or layer is None:
            return ""
        if layer.dial is not None:
            return f"{layer.name(grip.index)} = {layer.dial.numbers[grip.index]:.4g}"
        point = coordinates(layer.at[grip.index], panel.space.spatial)
        return f"{layer.name(grip.index)} = {point}"

    def steady(self) -> None:
        """Before drawing: a dragged point may change what is to be seen, but the picture stays."""
        panel = self.panel(self.chosen.space) if self.held and self.chosen else None
        if panel is None or self._camera is None:
            return
        subject = self._state.subject
        for space in subject.figure().spaces:
            if space.name == panel.space.name:
                framed = partial(
                    camera,
                    space,
                    panel.region,
                    net=subject.display.net,
                    field_of_view=subject.display.perspective,
                )
                view = self._state.view(space.name)
                self._state.keep_view(space.name, view_through(self._camera, view, framed))


def _pixels(panel: Panel, points: Array) -> Array:
    region = panel.region
    corner = np.array([region.left, region.bottom])
    return np.asarray(panel.camera.pixels(points, region.width, region.height) + corner)


def model_units(panel: Panel) -> float:
    """Model units a pixel, in the view plane."""
    return 2.0 * panel.camera.half_height / panel.region.height


def fine(unit: float) -> float:
    """The power of ten below half a pixel: what a dragged coordinate is rounded to."""
    return float(10.0 ** floor(log10(unit / 2.0)))


def snap_step(unit: float, scale: float) -> float:
    """1, 2 or 5 times a power of ten, at least GRID pixels wide."""
    least = GRID * scale * unit
    power = float(10.0 ** floor(log10(least)))
    return next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n >= least)


def rounded(at: Array, point: Array, step: float) -> Array:
    """The moved coordinates as multiples of a step, written with no more decimals than it has."""
    decimals = ceil(-log10(step) - 1e-9)
    steps = np.round(np.round(point / step) * step, decimals)
    return np.where(point == at, at, steps)


def coordinates(point: Array, spatial: bool) -> str:
    """(x, y) or (x, y, z), all digits that are meant."""
    return "(" + ", ".join(f"{value:.10g}" for value in point[: 3 if spatial else 2]) + ")"
