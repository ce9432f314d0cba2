"""Two values of one parameter in one picture: `compare` is "NAME=LEFT|RIGHT"."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .errors import UsageError
from .gpu.arrangement import extent
from .scenes.layers import Figure
from .subject import Subject

SEPARATOR = "|"
NOT_COMPARED = ("compare", "divider", "blend", "samples")


def comparison_text(subject: Subject, name: str, left: object, right: object) -> str:
    """The value of `compare` for these two values of a parameter."""
    parameter = subject.parameters()[name]
    return f"{name}={parameter.text(left)}{SEPARATOR}{parameter.text(right)}"


def sides(subject: Subject) -> tuple[Subject, Subject, str]:
    """The subject with either value, and the parameter's name. Raises UsageError.

    Where both are numbers, or arrays of one shape, the left one has blended by itself: half way
    from 0 to 1 is 1/2. Pictures of other values fade.
    """
    text = subject.display.compare
    name, _, values = text.partition("=")
    left, bar, right = values.partition(SEPARATOR)
    if not bar or name in NOT_COMPARED:
        raise UsageError(f"compare: expected NAME=LEFT{SEPARATOR}RIGHT, found {text!r}")
    sides = [subject.assigned([f"{name}={value}"]) for value in (left, right)]
    if subject.display.blend > 0.0 and blends_by_value(sides[0], sides[1], name):
        a, b = (np.asarray(side.value(name)) for side in sides)
        mixed = (1.0 - subject.display.blend) * a + subject.display.blend * b
        sides[0] = sides[0].changed(name, mixed if mixed.ndim else float(mixed))
    return sides[0], sides[1], name


def blends_by_value(left: Subject, right: Subject, name: str) -> bool:
    """Whether there are values between the two."""
    parameter = left.parameters()[name]
    if parameter.points is not None:
        return bool(left.value(name).shape == right.value(name).shape)
    return parameter.type is float


def default_comparison(subject: Subject) -> str:
    """Two values of the scene's first parameter that has a choice or a range; "" without one."""
    for name, parameter in subject.scene.parameters.items():
        if parameter.choices:
            now = subject.value(name)
            both = sorted([now, parameter.following(now)], key=parameter.choices.index)
        elif parameter.type is bool:
            both = [False, True]
        elif parameter.range is not None:
            both = [parameter.type(parameter.range.low), parameter.type(parameter.range.high)]
        else:
            continue
        return comparison_text(subject, name, *both)
    return ""


def agree(left: Figure, right: Figure, nets: tuple[bool, bool]) -> tuple[Figure, Figure]:
    """Both figures framed alike, with the lines of the caption that they share.

    `nets` says of each whether control nets are shown.
    """
    caption = tuple(line for line in left.caption if line in right.caption)
    others = {space.name: space for space in right.spaces}
    bounds = {}
    for space in left.spaces:
        if space.name in others:
            seen = [extent(space, nets[0]), extent(others[space.name], nets[1])]
            if not np.array_equal(seen[0], seen[1]):
                bounds[space.name] = np.concatenate(seen)

    def framed(figure: Figure) -> Figure:
        spaces = tuple(
            replace(space, bounds=bounds.get(space.name, space.bounds)) for space in figure.spaces
        )
        return replace(figure, spaces=spaces, caption=caption)

    return framed(left), framed(right)
