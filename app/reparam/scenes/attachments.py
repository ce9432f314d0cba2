"""What is attached to a patch by a texture map: the checkerboard, or the user's own picture."""

from __future__ import annotations

from typing import Annotated, Literal

from .layers import Picture
from .parameters import PictureFile, Range

Checks = Annotated[int, Range(1, 256), "checker squares along each side of [-1,1]² in (s,t)"]
Image = Annotated[str, PictureFile(), "a picture instead of the checkerboard, once over [-1,1]²"]
Wrap = Annotated[Literal["mirror", "repeat"], "how that picture goes on beyond [-1,1]²"]
Filter = Annotated[Literal["smooth", "nearest"], "how the picture is looked up"]


def attachment(
    checks: int, image: str, wrap: Literal["mirror", "repeat"], filter: Literal["smooth", "nearest"]
) -> Picture:
    """The picture over [-1,1]^2 in (s,t): `checks` squares along each side, or the image once.

    The tile checkerboard.png holds 2 x 2 squares, (0,0) of the picture at (s,t) = (-1,-1).
    """
    if image:
        return Picture(image, wrap=wrap, filter=filter)
    return Picture("checkerboard", scale=checks / 4, offset=checks / 4, filter=filter)
