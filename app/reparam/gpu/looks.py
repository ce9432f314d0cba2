"""How patches look, whatever evaluates them: what patch.frag is compiled with, and its uniforms."""

from __future__ import annotations

from dataclasses import dataclass, replace

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..geometry.camera import Camera
from ..scenes.layers import Color, Patches, Picture, Ramp, Texture
from ..scenes.shading import DISTORTION, DRAWN, PLAIN_SCALE, Scale, Shading, attached_by
from .evaluation import Evaluation, orders, patch_count
from .nets import MAP_UNIT, NET_UNIT
from .pictures import Pictures
from .programs import Program, degree_defines
from .trims import Edges, Trims, trim_defines

Array = NDArray[np.float64]

SHAPED = ("zebra", "gauss", "mean")  # told by the patch's own derivatives, fragment by fragment
WHITE = (1.0, 1.0, 1.0)
RAMP = Picture("ramp", wrap="mirror")


@dataclass(frozen=True)
class Look:
    """One colour, one shading, with the layer's picture or without; `bare` without light too.

    `map` is what fragments evaluate beside the position: what a texture is attached by, or a field.
    """

    color: Color
    shading: Shading = "light"
    scale: Scale = PLAIN_SCALE
    pictured: bool = True
    bare: bool = False
    map: Array | None = None
    edges: Edges = "shares"  # of what is trimmed, where pixels have several samples


def look_of(layer: Patches, shading: Shading, scale: Scale, by_sample: bool) -> Look:
    """Of a layer that is shown by a shading; `by_sample` as in Surfaces.draw."""
    look = Look(layer.color)
    if shading in DISTORTION:
        look = Look(WHITE, shading, scale, pictured=False, map=attached_by(layer))
    elif shading in DRAWN or (layer.lit and shading != "light"):
        color = layer.kind.color if shading == "kind" else WHITE
        look = Look(color, shading, scale, pictured=False)
    elif layer.texture is not None and layer.texture.exact:
        look = Look(layer.color, map=layer.texture.net)
    return replace(look, edges="samples") if by_sample else look


class Looks:
    """Gives programs the look of layers."""

    def __init__(
        self, ctx: moderngl.Context, evaluation: Evaluation, pictures: Pictures, trims: Trims
    ) -> None:
        self._ctx = ctx
        self._evaluation = evaluation
        self._pictures = pictures
        self._trims = trims

    def defines(self, layer: Patches, look: Look) -> dict[str, int | str]:
        """What the shaders of a layer are compiled with."""
        defines: dict[str, int | str] = {}
        if look.shading in (*SHAPED, *DRAWN):
            defines |= {"LOCATED": 1, look.shading.upper(): 1}
            defines |= degree_defines(POSITION_=orders(layer.net))
        if look.shading in SHAPED:
            defines["SHAPED"] = 1
        if look.map is not None:
            defines |= {"MAPPED": 1, "LOCATED": 1}
            if look.shading in DISTORTION:
                defines |= {"DISTORTED": 1, look.shading.upper(): 1}
            defines |= degree_defines(POSITION_=orders(layer.net), MAP_=orders(look.map))
        if layer.texture is not None and look.pictured:
            defines |= _picture_defines(layer.texture)
        if layer.lit and not look.bare:
            defines["LIT"] = 1
        if layer.trim is not None:
            several = self._ctx.fbo.samples > 1 and not look.bare
            defines |= trim_defines(layer.trim, look.edges if several else "pixels")
        return defines

    def set(self, program: Program, layer: Patches, camera: Camera, look: Look) -> None:
        """The uniforms of patch.frag and of what both evaluators hand to it."""
        program.set(
            clip_from_model=camera.clip_from_model().T.astype(np.float32).tobytes(),
            color=(*look.color, 1.0),
        )
        if "LOCATED" in program.defines:
            self._evaluation.texture(layer.net).use(NET_UNIT)
            program.set(
                position_net=NET_UNIT, position_degree=orders(layer.net), scale=look.scale.full
            )
        if "SHAPED" in program.defines:
            program.set(sight=camera.sight(self._ctx.viewport))
        if "ERROR" in program.defines:
            _, _, width, height = self._ctx.viewport
            program.set(half_size=(width / 2.0, height / 2.0))
        if "MAPPED" in program.defines:
            self._set_map(program, look)
        if "LIT" in program.defines:
            program.set(view_from_model=camera.rotation.T.astype(np.float32).tobytes())
        if "PICTURE" in program.defines:
            assert layer.texture is not None
            self._set_picture(program, layer.texture)
        if "TRIMMED" in program.defines:
            self._trims.bind(program, layer, unit=3)

    def _set_picture(self, program: Program, texture: Texture) -> None:
        picture = texture.picture
        if isinstance(picture, Ramp):
            self._pictures.use(RAMP, unit=2)
            program.set(image=2, low=picture.low, high=picture.high)
            program.set(contours=float(picture.contours))
            if "TEXTURED" in program.defines:
                program.set(image_from_map=(1.0, 1.0, 0.0, 0.0))
            return
        self._pictures.use(picture, unit=2)
        scale, offset = picture.scale, picture.offset
        reach = 0.75 if picture.filter == "smooth" else 0.0
        program.set(image=2, image_from_map=(scale, scale, offset, offset), reach=reach)

    def _set_map(self, program: Program, look: Look) -> None:
        assert look.map is not None
        self._evaluation.texture(look.map).use(MAP_UNIT)
        program.set(
            map_net=MAP_UNIT,
            map_degree=orders(look.map),
            map_stride=0 if patch_count(look.map) == 1 else 1,
        )
        if "DISTORTED" in program.defines:
            program.set(middle=look.scale.middle)


def _picture_defines(texture: Texture) -> dict[str, int | str]:
    picture = texture.picture
    if isinstance(picture, Ramp):
        formula = picture.formula.glsl() if picture.formula else "x"
        where = "EXACT" if texture.exact else "TEXTURED"
        return {"PICTURE": 1, "RAMP": 1, "FIELD(x, y)": formula, where: 1}
    mirrored = {"MIRRORED": 1} if picture.wrap == "mirror" else {}
    return {"PICTURE": 1, "TEXTURED": 1, **mirrored}
