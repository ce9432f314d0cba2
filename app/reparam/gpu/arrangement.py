"""Where the spaces of a figure stand in a picture, and the cameras they are seen by."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera, View, frame
from ..geometry.evaluate import project
from ..scenes.layers import ControlNet, Figure, Space
from ..scenes.remember import remember
from .region import Region

Array = NDArray[np.float64]

UNITS = 512.0  # figure units along the shorter side of a picture
CAPTION_LINE = 23.0
PADDING = 10.0


@dataclass(frozen=True)
class Panel:
    """A space with where it stands and how it is seen; its part of the picture, margins and all."""

    space: Space
    region: Region
    camera: Camera
    part: Region


def arrange(
    figure: Figure,
    size: tuple[int, int],
    views: Mapping[str, View],
    plain: bool,
    net: bool,
    field_of_view: float = 0.0,
) -> list[Panel]:
    """The spaces where `regions` puts them, less their margins, above the caption.

    With `net` the control nets must be seen too. With a field of view (degrees) spatial spaces
    are seen in perspective.
    """
    width, height = size
    unit = min(size) / UNITS
    foot = 0 if plain else round((len(figure.caption) * CAPTION_LINE + PADDING) * unit)
    foot = min(foot, height - 1)
    panels = []
    whole = regions(figure.spaces, width, height - foot, foot)
    for space, part in zip(figure.spaces, whole, strict=True):
        alike = zip(figure.spaces, whole, strict=True)
        narrowest = min(each.width for other, each in alike if other.width == space.width)
        region = part.inside(figure.spaces, unit, narrowest)
        view = views.get(space.name, View())
        seen = camera(space, region, view, net, field_of_view)
        panels.append(Panel(space, region, seen, part))
    return panels


def camera(space: Space, region: Region, view: View, net: bool, field_of_view: float) -> Camera:
    """The camera that a space is seen by in its region, as `arrange` has it."""
    others = surroundings(space) if space.spatial and field_of_view else None
    points = extent(space, net)
    return frame(points, region.width, region.height, view, space.spatial, field_of_view, others)


def regions(spaces: Sequence[Space], width: int, height: int, foot: int) -> list[Region]:
    """Columns side by side (rows one above another in an upright picture), `foot` from below.

    A space that stands `below` belongs to the column of the one before it. Columns are as wide,
    and spaces in a column as high, as they ask for in proportion; together they fill the whole.
    """
    columns: list[list[Space]] = []
    for space in spaces:
        if space.below and columns:
            columns[-1].append(space)
        else:
            columns.append([space])
    found = []
    across = width >= height
    wide = _cuts([column[0].width for column in columns], width if across else height)
    for column, (start, end) in zip(columns, wide, strict=True):
        high = _cuts([space.height for space in column], height if across else end - start)
        for low, up in high:  # both count from the top
            if across:
                region = Region(start, foot + height - up, end - start, up - low)
            else:
                region = Region(0, foot + height - start - up, width, up - low)
            found.append(region)
    return found


def _cuts(shares: Sequence[float], length: int) -> list[tuple[int, int]]:
    """A length cut in proportion: start and end of each part, at least 1 long."""
    ends = np.cumsum([0.0, *shares]) / sum(shares) * length
    whole = [round(end) for end in ends]
    return [(a, max(a + 1, b)) for a, b in pairwise(whole)]


def extent(space: Space, net: bool) -> Array:
    """Points (k, 3) that the space's viewport must show."""
    points = space.bounds
    if len(points) == 2:
        points = np.stack(np.meshgrid(*points.T, indexing="ij"), -1).reshape(-1, 3)
    nets = [layer.net for layer in space.layers if isinstance(layer, ControlNet) and net]
    controls = [control[control[..., 3] > 0.0] for control in nets]
    return np.concatenate([points, *(project(control) for control in controls)])


@remember
def surroundings(space: Space) -> Array:
    """The corners of a box (8, 3) around all that the space holds, be it to be seen or not."""
    boxes = [space.bounds.reshape(-1, 3), *_holds(space)]
    low = np.min([box.min(0) for box in boxes], 0)
    high = np.max([box.max(0) for box in boxes], 0)
    return np.stack(np.meshgrid(*np.stack([low, high], -1), indexing="ij"), -1).reshape(-1, 3)


def _holds(space: Space) -> Iterator[Array]:
    """The control points and points (k, 3) of the layers."""
    for layer in space.layers:
        net, points = getattr(layer, "net", None), getattr(layer, "points", None)
        if net is not None:
            points = project(net[net[..., 3] > 0.0])
        elif points is None:
            points = np.asarray(getattr(layer, "at", ()), np.float64)
        if points.size and points.shape[-1] == 3:  # the parameters of formulas are none
            yield points.reshape(-1, 3)
