"""The linked cursor: one point (u,v) of a patch, marked in every space that the square maps to.

In each space stand the iso-lines through the point, the image of a little square about it, and
beneath, the point's coordinates, the determinant of the map there and its two stretches.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.evaluate import evaluate, project
from ..geometry.inverse import Picker
from ..geometry.stretch import stretch
from . import palette
from .layers import Array, Dots, Figure, IsoLines, Layer, Patches, Space

FIGURE_SPACE = "\u2007"  # as wide as a digit or a minus
SIDE = 0.1  # of the little square
POINT = 4.0  # its radius, in figure units
HALO = 2.6  # of ground, in figure units, that keeps marks apart from what they lie on
PLACES = {"domain": "(u, v)", "texture": "(s, t)"}
UNMOVED = (0.3, 0.2)  # where the cursor stands before anyone moved it


@dataclass(frozen=True)
class Cursor:
    """A point (u,v) in [0,1]^2 of one of the patches."""

    u: float
    v: float
    patch: int = 0

    @property
    def text(self) -> str:
        """`u,v`, and the patch if it is not the first; `parse` takes it, bit for bit."""
        return f"{self.u!r},{self.v!r}" + (f",{self.patch}" if self.patch else "")


EXPECTED = "u,v from 0 to 1, and ,patch if there are many"


def parse(text: str) -> Cursor | None:
    """The cursor that a text stands for, none for the empty one. Raises ValueError."""
    if not text.strip():
        return None
    u, v, *patch = text.split(",")
    cursor = Cursor(float(u), float(v), *map(int, patch))
    if not (0.0 <= cursor.u <= 1.0 and 0.0 <= cursor.v <= 1.0 and cursor.patch >= 0):
        raise ValueError(text)
    return cursor


def is_cursor(text: str) -> bool:
    """Whether `parse` takes it."""
    try:
        parse(text)
    except (ValueError, TypeError):
        return False
    return True


def patches_of(space: Space) -> Array | None:
    """The nets (p, m, n, 4) by which the square lands in a space, None where it does not."""
    return None if space.map is None else space.map.reshape(-1, *space.map.shape[-3:])


def picker(space: Space, plane_from_model: Array) -> Picker:
    """Finds what lies under a point of the view plane, whose camera has the matrix (4, 4).

    Raises ValueError for a space without a map.
    """
    nets = patches_of(space)
    if nets is None:
        raise ValueError(f"{space.name}: expected a space that the parameter square maps to")
    return Picker(nets @ plane_from_model.T)


def with_map(figure: Figure) -> Figure:
    """The figure, its subject's first patches taken for its map if no space has one."""
    subject = figure.spaces[-1]
    nets = [layer.net for layer in subject.layers if isinstance(layer, Patches)]
    if any(space.map is not None for space in figure.spaces) or not nets:
        return figure
    return replace(figure, spaces=(*figure.spaces[:-1], replace(subject, map=nets[0])))


def marked(figure: Figure, cursor: Cursor | None) -> Figure:
    """The figure with the cursor in all spaces that have a map, unmoved where there is none.

    Without a cursor a figure stays as it is unless two spaces at least are linked by maps.
    Raises ValueError for a patch that is not there.
    """
    figure = with_map(figure) if cursor else figure
    counts = [len(nets) for space in figure.spaces if (nets := patches_of(space)) is not None]
    if not counts or (cursor is None and len(counts) < 2):
        return figure
    cursor, many = cursor or Cursor(*UNMOVED), max(counts)
    if cursor.patch >= many:
        raise ValueError(f"cursor: expected a patch from 0 to {many - 1}, found {cursor.patch}")
    spaces = tuple(_mark(space, cursor, many) for space in figure.spaces)
    line = _from_texture(figure, cursor)
    return replace(figure, spaces=spaces, caption=(*figure.caption, *line))


def is_linked(figure: Figure) -> bool:
    """Whether two spaces at least show the parameter square."""
    return sum(space.map is not None for space in figure.spaces) >= 2


def within(figure: Figure, cursor: Cursor) -> Cursor:
    """The cursor, on the last patch if the figure has not so many as it names."""
    counts = [len(nets) for space in figure.spaces if (nets := patches_of(space)) is not None]
    return replace(cursor, patch=min(cursor.patch, max(counts, default=1) - 1))


def net_at(space: Space, cursor: Cursor) -> Array | None:
    """The net (m, n, 4) of the cursor's patch; one net answers for all patches."""
    if space.map is None or space.map.ndim == 3:
        return space.map
    return np.asarray(space.map[cursor.patch if len(space.map) > 1 else 0])


def _mark(space: Space, cursor: Cursor, many: int) -> Space:
    net = net_at(space, cursor)
    if net is None:
        return space
    layers, notes = (*space.layers, *marks(net, cursor)), notes_of(space, net, cursor, many)
    return replace(space, layers=layers, notes=(*space.notes, *notes))


def little_square(cursor: Cursor) -> tuple[tuple[float, float], tuple[float, float]]:
    """The square's sides in u and in v, cut off at the domain's edges."""
    u, v = ((max(0.0, t - SIDE / 2), min(1.0, t + SIDE / 2)) for t in (cursor.u, cursor.v))
    return u, v


def marks(net: Array, cursor: Cursor) -> tuple[Layer, ...]:
    """Iso-lines, the image of the little square, and the point, each on a halo of ground."""
    along_u, along_v = little_square(cursor)
    lines: list[tuple[IsoLines, ...]] = [
        (
            IsoLines(net, v=(cursor.v,), color=palette.ALONG_U, width=1.8),
            IsoLines(net, u=(cursor.u,), color=palette.ALONG_V, width=1.8),
        ),
        (
            IsoLines(net, v=along_v, span=along_u, color=palette.CURSOR, width=2.6),
            IsoLines(net, u=along_u, span=along_v, color=palette.CURSOR, width=2.6),
        ),
    ]
    layers: list[Layer] = []
    for lift, group in zip((1, 3), lines, strict=True):
        wider = [replace(each, color=palette.GROUND, width=each.width + HALO) for each in group]
        layers += [replace(each, lift=lift) for each in wider]
        layers += [replace(each, lift=lift + 1) for each in group]
    point = project(evaluate(net, cursor.u, cursor.v))[None]
    layers.append(Dots(point, palette.GROUND, POINT + HALO / 2, lift=5))
    layers.append(Dots(point, palette.CURSOR, POINT, lift=6))
    return tuple(layers)


def notes_of(space: Space, net: Array, cursor: Cursor, many: int) -> tuple[tuple[str, str], ...]:
    """The point's coordinates in a space, and what the map does to the little square."""
    if space.name == "domain":
        which = f"{FIGURE_SPACE}{cursor.patch} (of {many})" if many > 1 else ""
        rows = (("patch" if many > 1 else "", which), ("", ""))
        return ((PLACES["domain"], numbers(*parameters(space, cursor))), *rows)
    here = stretch(net, cursor.u, cursor.v)
    if space.domains is not None:
        u0, u1, v0, v1 = (float(t) for t in space.domains[cursor.patch])
        here = here.of_unit(u1 - u0, v1 - v0)
    x, y, z = project(evaluate(net, cursor.u, cursor.v))
    planar = len(here.jacobian) == 2
    place = PLACES.get(space.name, "(x, y)" if planar else "(x, y, z)")
    return (
        (place, numbers(x, y) if planar else numbers(x, y, z)),
        ("det" if planar else "area ×", numbers(here.determinant)),
        ("stretch", numbers(*here.factors)),
    )


def parameters(space: Space, cursor: Cursor) -> tuple[float, float]:
    """The cursor's u and v as the surface of its patch counts them."""
    if space.domains is None:
        return cursor.u, cursor.v
    u0, u1, v0, v1 = (float(t) for t in space.domains[cursor.patch])
    return u0 + (u1 - u0) * cursor.u, v0 + (v1 - v0) * cursor.v


def _from_texture(figure: Figure, cursor: Cursor) -> tuple[str, ...]:
    """How the picture's own little squares are stretched on their way to the subject."""
    texture = next((space for space in figure.spaces if space.name == "texture"), None)
    first = net_at(texture, cursor) if texture else None
    last = net_at(figure.spaces[-1], cursor)
    if first is None or last is None:
        return ()
    way = stretch(last, cursor.u, cursor.v).after(stretch(first, cursor.u, cursor.v))
    if way is None:
        return ("from (s, t) to (x, y): singular here",)
    det, factors = (
        numbers(*n).replace(FIGURE_SPACE, "") for n in ((way.determinant,), way.factors)
    )
    return (f"from (s, t) to (x, y): det {det}, stretch {factors}",)


def numbers(*values: float) -> str:
    """Values with four decimals and a true minus, in columns: a figure space where none is."""
    rounded = [round(value, 4) + 0.0 for value in values]  # no minus before 0.0000
    texts = [f"{value: .4f}" if abs(value) < 1e4 else f"{value: .4g}" for value in rounded]
    return ", ".join(text.replace(" ", FIGURE_SPACE).replace("-", "−") for text in texts)
