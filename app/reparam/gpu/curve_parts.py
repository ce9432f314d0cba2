"""Into how many segments curves are cut in a view: as few as their bound allows."""

from __future__ import annotations

from collections.abc import Callable, Hashable

import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..geometry.curve_levels import Bends, curve_bends, iso_bends
from ..geometry.net import Array
from ..scenes.layers import Curves, IsoLines
from .kept import Kept
from .polylines import lines_of

WORTH = 1 << 12  # segments saved, for curves to be drawn in several parts

Ints = NDArray[np.int64]


class CurveParts:
    """Keeps what does not depend on the view, what does as long as that stays the same, and parts
    of layers as long as they do."""

    def __init__(self) -> None:
        self._bends: Kept[Bends] = Kept(lambda _: None)
        self._steps: Kept[Ints] = Kept(lambda _: None)
        self._starts: Kept[Ints] = Kept(lambda _: None)
        self._parts: Kept[list[tuple[int, Array]]] = Kept(lambda _: None)

    def sweep(self) -> None:
        """End of a frame."""
        self._bends.sweep()
        self._steps.sweep()
        self._starts.sweep()
        self._parts.sweep()

    def of_patches(self, layer: IsoLines, camera: Camera, pixels: float, tolerance: float) -> int:
        """Segments of each of a layer's curves; a unit of the view plane is `pixels` pixels."""
        curves = (layer.u, layer.v, layer.span)

        def bends() -> Bends:
            return iso_bends(layer.net, *curves)

        steps = self._steps_of(layer.net, curves, bends, (camera, pixels, tolerance))
        return int(steps.max(initial=1))

    def of_curves(
        self, layer: Curves, camera: Camera, pixels: float, tolerance: float
    ) -> list[tuple[int, Array]]:
        """Segments, and the net of the curves that are drawn in so many: all of them in as many as
        the worst one needs, if that is cheap; else each line by itself."""
        nets = layer.net.reshape(-1, *layer.net.shape[-2:])

        def bends() -> Bends:
            return curve_bends(nets, layer.span)

        steps = self._steps_of(layer.net, layer.span, bends, (camera, pixels, tolerance))
        if steps.max() * len(steps) - steps.sum() < WORTH:
            return [(int(steps.max()), layer.net)]
        starts = self._starts.get(layer.net, None, lambda: lines_of(nets)[0])
        along = np.maximum.reduceat(steps, starts)
        steps = np.repeat(along, np.diff(np.append(starts, len(nets))))
        key = steps.astype(np.int16).tobytes()
        return self._parts.get(
            layer.net, key, lambda: [(int(n), nets[steps == n]) for n in np.unique(steps)]
        )

    def _steps_of(
        self,
        net: Array,
        curves: Hashable,
        make: Callable[[], Bends],
        view: tuple[Camera, float, float],
    ) -> Ints:
        """Segments of each of a net's curves in a view: `Bends.steps` with its arguments."""
        camera, pixels, tolerance = view
        bends = self._bends.get(net, curves, make)
        key = (curves, camera.clip_from_model().tobytes(), pixels, tolerance)
        return self._steps.get(net, key, lambda: bends.steps(*view))
