"""`reparam export`: the patches that a subject shows, as a file for other programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .errors import UsageError
from .files.models import Attached, Part, write_model
from .scenes.layers import Figure, Patches, Ramp, Texture
from .subject import Subject


def export(subject: Subject, path: Path) -> None:
    """Write the file at the display's level. Raises UsageError, ReparamError."""
    try:
        write_model(parts_of(subject.figure()), path, subject.display.level)
    except ValueError as fault:
        raise UsageError(f"export: {fault}") from None


def parts_of(figure: Figure) -> list[Part]:
    """The layers of patches in the figure's subject; each is a part with its colour and picture."""
    layers = [layer for layer in figure.spaces[-1].layers if isinstance(layer, Patches)]
    if not layers:
        raise UsageError("export: expected a subject that shows patches, found none")
    return [_part(layer, number) for number, layer in enumerate(layers)]


def _part(layer: Patches, number: int) -> Part:
    nets = layer.net.reshape(-1, *layer.net.shape[-3:])
    name = layer.kind.words or f"patches {number + 1}"
    texture = layer.texture
    domains = layer.domains
    if layer.trim is not None and domains is None:
        domains = np.tile([0.0, 1.0, 0.0, 1.0], (len(nets), 1))
    if texture is None:
        return Part(name, nets, layer.color, trim=layer.trim, domains=domains)
    maps = np.broadcast_to(texture.net, (len(nets), *texture.net.shape[-3:]))
    return Part(name, nets, layer.color, maps, _attached(texture), layer.trim, domains)


def _attached(texture: Texture) -> Attached | None:
    picture = texture.picture
    if isinstance(picture, Ramp):
        if picture.formula is not None:  # no file of a model holds formulas
            return None
        scale = 1.0 / (picture.high - picture.low)
        return Attached("ramp", scale, -picture.low * scale, True)
    return Attached(picture.source, picture.scale, picture.offset, picture.wrap == "mirror")
