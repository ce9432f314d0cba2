"""What the built-in program shades by: one light and one material, with OpenGL's defaults."""

from __future__ import annotations

from dataclasses import dataclass

from .arguments import numbers

RGB = tuple[float, ...]
COLORS = ("ambient", "diffuse", "specular", "model_ambient", "material_ambient",
          "material_diffuse", "material_specular")  # fmt: skip


@dataclass(frozen=True)
class Light:
    """GL_LIGHT0 and glMaterial, by OpenGL's formula (2.1 specification, section 2.14.1), for each
    fragment; and on both sides, unless GL_LIGHT_MODEL_TWO_SIDE is to be off, as OpenGL has it.

    `position` is in eye coordinates, a direction where its w is 0. A colour has three numbers; a
    fourth, which C's arrays have, is not looked at. With `color_material` the vertex colours stand
    for `material_ambient` and `material_diffuse`. Raises InvalidValue for other counts.
    """

    position: tuple[float, ...] = (0.0, 0.0, 1.0, 0.0)
    ambient: RGB = (0.0, 0.0, 0.0)
    diffuse: RGB = (1.0, 1.0, 1.0)
    specular: RGB = (1.0, 1.0, 1.0)
    model_ambient: RGB = (0.2, 0.2, 0.2)
    material_ambient: RGB = (0.2, 0.2, 0.2)
    material_diffuse: RGB = (0.8, 0.8, 0.8)
    material_specular: RGB = (0.0, 0.0, 0.0)
    shininess: float = 0.0
    color_material: bool = False
    two_sided: bool = True

    def __post_init__(self) -> None:
        keep = object.__setattr__  # it is frozen
        keep(self, "position", numbers("Light", "position", self.position, (4,)))
        for name in COLORS:
            keep(self, name, numbers("Light", name, getattr(self, name), (3, 4))[:3])
        (shininess,) = numbers("Light", "shininess", self.shininess, (1,))
        keep(self, "shininess", shininess)
