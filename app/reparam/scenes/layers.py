"""What a scene is made of: frozen layers in named spaces. Plain data, no OpenGL.

A layer's arrays are made read-only, for the GPU keeps what it made of an array as long as the
same object comes back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.evaluate import evaluate, project, sample_surface
from ..geometry.formula import Formula
from .textures import Frozen
from .textures import Picture as Picture
from .textures import Ramp as Ramp
from .textures import Texture as Texture

if TYPE_CHECKING:
    from ..evaluators.light import Light
    from ..evaluators.recording import Recording
    from ..geometry.trimming import TrimRegion

Array = NDArray[np.float64]
Color = tuple[float, float, float]

INK: Color = (0.13, 0.13, 0.13)


@dataclass(frozen=True)
class Kind:
    """What the display's shading by kind says of patches: a colour, and words for the legend."""

    color: Color = (1.0, 1.0, 1.0)
    words: str = ""


@dataclass(frozen=True)
class Patches(Frozen):
    """Tensor-product Bezier patches of one order: a net (m, n, 4) or (patches, m, n, 4).

    A layer is `solid` if it and the solid layers beside it bound a body that is closed, does not
    meet itself, and is seen from outside, p_u x p_v pointing outwards: what faces away is hidden.
    Patches of one surface share its trim region; `domains` (patches, 4) says where each lies
    in the surface's parameters: u0, u1, v0, v1.
    """

    net: Array
    texture: Texture | None = None
    color: Color = (1.0, 1.0, 1.0)
    lit: bool = False
    kind: Kind = Kind()
    domains: Array | None = None  # None: all are the unit square
    trim: TrimRegion | None = None  # None: the whole surface
    solid: bool = False

    def __post_init__(self) -> None:
        count = self.net.shape[0] if self.net.ndim == 4 else 1
        if self.domains is not None and self.domains.shape != (count, 4):
            raise ValueError(f"expected domains ({count}, 4), found {self.domains.shape}")
        super().__post_init__()


@dataclass(frozen=True)
class IsoLines(Frozen):
    """The curves u = const and v = const of patches, as wide as `width` (in figure units)."""

    net: Array
    u: tuple[float, ...] = ()
    v: tuple[float, ...] = ()
    color: Color = (0.0, 0.0, 0.0)
    width: float = 1.0
    span: tuple[float, float] = (0.0, 1.0)  # of the other parameter; beyond [0,1] extrapolates
    arrow: bool = False
    lift: int = 0  # of strokes in one place in space the higher one is seen


@dataclass(frozen=True)
class Curves(Frozen):
    """Bezier curves of one order: a net (n, 4) or (curves, n, 4), homogeneous.

    Curves that follow one another end to start are one line: they meet without a seam. An arrow
    stands at the end of each.
    """

    net: Array
    color: Color = INK
    width: float = 1.6
    span: tuple[float, float] = (0.0, 1.0)  # of the parameter; beyond [0,1] extrapolates
    arrow: bool = False


@dataclass(frozen=True)
class Polylines(Frozen):
    """Points (k, 3) or (lines, k, 3) joined by straight strokes, with round joins and caps."""

    points: Array
    color: Color = INK
    width: float = 1.0
    closed: bool = False
    arrow: bool = False
    lift: int = 0  # as of iso-lines


@dataclass(frozen=True)
class Dots(Frozen):
    """Discs at points (k, 3)."""

    at: Array
    color: Color = INK
    radius: float = 3.0
    lift: int = 0


@dataclass(frozen=True)
class Parametric(Frozen):
    """The curve (x(u), y(u)) at parameters (k,), evaluated on the GPU from its own formulas.

    The formulas hold u and w; `width` 0 draws no line, `radius` 0 no dots.
    """

    x: Formula
    y: Formula
    at: Array
    w: float = 0.0
    color: Color = INK
    width: float = 1.6
    radius: float = 0.0


@dataclass(frozen=True)
class Traced(Frozen):
    """Dots on Bezier curves at fractions (k,) of their length, found on the GPU from a table.

    `net` is (n, 4) or (curves, n, 4), end to start; `table` (entries, 2) holds u and du/dfraction
    at equal fractions of the length, curve i being u in [i, i+1].
    """

    net: Array
    table: Array
    at: Array
    color: Color = INK
    radius: float = 3.0


@dataclass(frozen=True)
class ControlNet(Frozen):
    """The control points of patches and the legs between them; drawn when the user asks."""

    net: Array
    color: Color = (0.0, 0.0, 0.0)
    width: float = 1.0
    dot: float = 3.0


@dataclass(frozen=True)
class Recorded:
    """What calls of OpenGL's evaluators recorded: its triangles in their colours, lit by a light in
    front of the viewer and with a picture if there is one, its lines and points as wide as asked
    (in figure units) in the current colour."""

    recording: Recording
    light: Light | None = None
    picture: Picture | None = None
    width: float = 1.6
    radius: float = 3.0


@dataclass(frozen=True)
class Label:
    """Text at a point of its space, moved by `offset` (in figure units, y up)."""

    text: str
    at: tuple[float, float, float]
    offset: tuple[float, float] = (0.0, 0.0)
    anchor: tuple[float, float] = (0.5, 0.5)  # the point of the text's box put there: 0..1, y up
    size: float = 16.0
    color: Color = INK
    italic: bool = False


Drag = Callable[[Mapping[str, Any], int, Array], Mapping[str, Any]]
Click = Callable[[Mapping[str, Any], int], Mapping[str, Any]]


@dataclass(frozen=True)
class Dial(Frozen):
    """Numbers (k,) that handles stand for: told and typed instead of their coordinates.

    `turn(values, index, number)` returns the parameters that change, as `drag` does.
    """

    numbers: Array
    turn: Callable[[Mapping[str, Any], int, float], Mapping[str, Any]]


@dataclass(frozen=True)
class Handles(Frozen):
    """What a hand can drag: points (k, 3). The window shows them, a picture only if asked to.

    `drag(values, index, point)` gets the scene's parameter values and where point `index` shall
    go, (3,), and returns the parameters that change. In a space of the plane z stays as it is, in
    a spatial one the point moves in the view plane. `click(values, index)`, where there is one, is
    asked the same when the hand lets go without having moved.
    """

    at: Array
    drag: Drag
    names: tuple[str, ...] = ()  # of each point, for the line that tells its coordinates
    color: Color = (0.8, 0.475, 0.655)  # reddish purple
    radius: float = 4.0  # figure units
    quiet: bool = False  # many: in the window only with the control net, or under the mouse
    click: Click | None = None
    dial: Dial | None = None

    def name(self, index: int) -> str:
        """What a point is called."""
        return self.names[index] if self.names else f"point {index + 1}"


Stroked = IsoLines | Curves | Polylines | Dots | Parametric | Traced
Layer = Patches | Stroked | ControlNet | Recorded | Label | Handles


@dataclass(frozen=True)
class Space(Frozen):
    """One viewport with a coordinate system of its own: domain, texture, physical, plot."""

    name: str
    bounds: Array  # (2, 3) smallest and largest coordinates, or (k, 3) points, to be seen
    layers: tuple[Layer, ...]
    spatial: bool = False  # orbited, with depth; else the plane z = 0 seen from above
    width: float = 1.0  # of its column, beside the other columns
    height: float = 1.0  # beside the others in its column
    below: bool = False  # in the column of the space before it, not in one of its own
    title: str = ""  # above it; neither pan nor zoom moves it
    notes: tuple[tuple[str, str], ...] = ()  # beneath it, names and values in two columns
    map: Array | None = None  # the nets by which the parameter square lands here: linked.py
    domains: Array | None = None  # of the map's patches in their surface's parameters


@dataclass(frozen=True)
class Figure:
    """A picture: spaces side by side and a caption beneath.

    The subject is the last space that is no plot and no domain, if there is another.
    """

    spaces: tuple[Space, ...]
    caption: tuple[str, ...] = ()

    @property
    def subject(self) -> Space:
        """The space that shows what the picture is about."""
        subjects = [s for s in self.spaces if not s.name.startswith(("domain", "plot"))]
        return (subjects or list(self.spaces))[-1]

    def plain(self) -> Figure:
        """The subject's patches alone, framed by themselves: no labels, nets, lines or caption.

        A subject without patches keeps its curves, lines, dots and recordings, and its bounds.
        """
        subject = self.subject
        patches = tuple(layer for layer in subject.layers if isinstance(layer, Patches))
        if not patches:
            lines = (Curves, Polylines, Dots, Parametric, Traced, Recorded)
            kept = tuple(layer for layer in subject.layers if isinstance(layer, lines))
            return Figure((replace(subject, layers=kept),))
        points = np.concatenate([sample_surface(layer.net) for layer in patches])
        bare = replace(subject, layers=patches, bounds=points, title="", notes=())
        return Figure((bare,))


def including(bounds: Array, net: Array) -> Array:
    """Bounds (k, 3) of a viewport that shows what `bounds` (2, 3) does and all of a patch.

    The patch is sampled; what may stand out between the samples has room in the margin.
    """
    t = np.linspace(0.0, 1.0, 17)
    points = project(evaluate(net, *np.meshgrid(t, t, indexing="ij")))
    return np.concatenate([bounds, points.reshape(-1, 3)])


def plane(x0: float, y0: float, x1: float, y1: float) -> Array:
    """Bounds of a rectangle in the plane z = 0."""
    return np.array([[x0, y0, 0.0], [x1, y1, 0.0]])
