"""Typed parameters, read off a function's signature, and their text form on the command line.

def fig5(texture: Literal["identity", "r"] = "identity",
         checks: Annotated[int, Range(1, 64), "squares along each side"] = 8): ...
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np

from ..errors import UsageError
from ..geometry.net import LARGEST, Array

Value = Any


@dataclass(frozen=True)
class Range:
    """Smallest and largest allowed value, both included; `step` is one key press.

    A `clock` runs evenly from low to high and begins again; others are moved to and fro.
    """

    low: float
    high: float
    step: float = 1.0
    clock: bool = False


@dataclass(frozen=True)
class Presets:
    """Marks a text of which some are known by name; others mean something too."""

    names: tuple[str, ...]


@dataclass(frozen=True)
class PictureFile:
    """Marks a text that names a picture; without one the scene shows what it shows for ""."""


@dataclass(frozen=True)
class MeshFile:
    """Marks a text that names a file with a mesh where it is none of the `Presets`; the scene gets
    what is in it, a Body, as its argument `file`."""


@dataclass(frozen=True)
class Form:
    """Marks a text that must have a form: what is expected, in words, and whether a text is so."""

    expected: str
    valid: Callable[[str], bool]


@dataclass(frozen=True)
class Points:
    """Marks an array of numbers of that shape; None is a length that the user chooses.

    Its text form is JSON: nested lists. Its values are read-only, so that the GPU may keep what
    it made of them.
    """

    shape: tuple[int | None, ...]
    help: str = ""

    def expected(self) -> str:
        """The arrays it takes, in words."""
        sides = " x ".join("n" if side is None else str(side) for side in self.shape)
        return f"{sides} numbers as nested JSON lists"

    def check(self, value: Any) -> Array:
        """The value as a read-only float64 array. Raises ValueError: what was found instead."""
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            raise ValueError("lists of unequal length, or something that is no number") from None
        if array.size == 0 and None in self.shape:  # [] has no second axis to tell
            array = array.reshape([side or 0 for side in self.shape])
        if not self._fits(array.shape):
            raise ValueError(" x ".join(map(str, array.shape)) or "a single number")
        bad = np.argwhere(~(np.abs(array) <= LARGEST))  # NaN too
        if len(bad):
            place = "".join(f"[{i}]" for i in bad[0])
            raise ValueError(f"{array[tuple(bad[0])]:g} at {place}")
        if array.flags.writeable:  # the caller may go on to change it
            array = array.copy()
            array.setflags(write=False)
        return array

    def _fits(self, shape: tuple[int, ...]) -> bool:
        return len(shape) == len(self.shape) and all(
            side in (None, found) for side, found in zip(self.shape, shape, strict=True)
        )


@dataclass(frozen=True)
class Parameter:
    """One parameter: its name, type, default, choices or range, and what it does."""

    name: str
    type: type
    default: Value
    choices: tuple[str, ...] = ()
    range: Range | None = None
    help: str = ""
    picture: bool = False  # the name of a picture file
    points: Points | None = None  # an array
    form: Form | None = None  # of a text
    presets: tuple[str, ...] = ()  # texts with a name; the scene says what others it takes
    mesh: bool = False  # other texts are names of mesh files

    def expected(self) -> str:
        """The values it takes, in words."""
        if self.points:
            return self.points.expected()
        if self.form:
            return self.form.expected
        if self.choices:
            return " or ".join(self.choices)
        if self.presets:
            other = "a file (.obj, .bv)" if self.mesh else "another text"
            return f"{', '.join(self.presets)} or {other}"
        if self.type is bool:
            return "0 or 1"
        kind = {int: "a whole number", float: "a number", str: "a text"}[self.type]
        return f"{kind} from {self.range.low:g} to {self.range.high:g}" if self.range else kind

    def row(self) -> dict[str, Any]:
        """The parameter as JSON has it."""
        interval = [self.range.low, self.range.high] if self.range else None
        return {
            "name": self.name,
            "type": "points" if self.points else "choice" if self.choices else self.type.__name__,
            "choices": list(self.choices) or None,
            "presets": list(self.presets) or None,
            "range": interval,
            "shape": list(self.points.shape) if self.points else None,
            "default": self.plain(self.default),
            "help": self.help,
        }

    def plain(self, value: Value) -> Any:
        """The value as JSON has it: an array as nested lists, whole numbers without a point."""
        if self.points:
            return [self.plain(part) for part in value] if np.ndim(value) else _number(value)
        return value

    def text(self, value: Value) -> str:
        """The text that `parse` takes for this value, bit for bit."""
        if self.points:
            return json.dumps(self.plain(value), separators=(",", ":"))
        return str(int(value)) if self.type is bool else str(value)

    def parse(self, text: str) -> Value:
        """The value that `text` stands for. Raises UsageError with what was expected and found."""
        if self.points:
            return self._parse_points(text)
        try:
            if self.type is bool:
                return {"0": False, "1": True, "false": False, "true": True}[text.lower()]
            return self.check(self.type(text))
        except (ValueError, KeyError):
            raise UsageError(f"{self.name}: expected {self.expected()}, found {text!r}") from None

    def accept(self, value: Any) -> Value:
        """The value if JSON's own types say what this parameter takes, else ValueError."""
        kinds: dict[type, tuple[type, ...]] = {float: (int, float), np.ndarray: (list,)}
        if type(value) not in kinds.get(self.type, (self.type,)):
            raise ValueError(f"{self.name}: expected {self.expected()}, found {value!r}")
        return self.check(float(value) if self.type is float else value)

    def _parse_points(self, text: str) -> Array:
        try:
            return self.check(json.loads(text))  # type: ignore[no-any-return]
        except (json.JSONDecodeError, RecursionError):
            short = text if len(text) <= 40 else text[:37] + "..."
            message = f"{self.name}: expected {self.expected()}, found {short!r}"
            raise UsageError(message) from None
        except ValueError as error:
            raise UsageError(str(error)) from None

    def check(self, value: Value) -> Value:
        """The value itself if it is allowed, else ValueError; an array comes back read-only."""
        if self.points:
            try:
                return self.points.check(value)
            except ValueError as fault:
                message = f"{self.name}: expected {self.expected()}, found {fault}"
                raise ValueError(message) from None
        allowed = (
            self.form.valid(value)
            if self.form
            else value in self.choices
            if self.choices
            else self.range is None
            or (math.isfinite(value) and self.range.low <= value <= self.range.high)
        )
        if not allowed:
            raise ValueError(f"{self.name}: expected {self.expected()}, found {value!r}")
        return value

    def following(self, value: Value) -> Value:
        """The next choice, the other truth, or one step up, coming round at the end."""
        names = self.choices or self.presets
        if names:
            return names[(names.index(value) + 1) % len(names) if value in names else 0]
        if self.type is bool:
            return not value
        assert self.range is not None, f"{self.name} has no step"
        up = self.type(value + self.range.step)
        return up if up <= self.range.high else self.type(self.range.low)


def _number(value: float) -> float:
    """The same number, bit for bit, as short as JSON can have it."""
    short = value.is_integer() and abs(value) < 1e15 and not (value == 0.0 and str(value)[0] == "-")
    return int(value) if short else float(value)


def parameters_of(function: Callable[..., object]) -> dict[str, Parameter]:
    """The parameters of a function, or the fields of a dataclass, that have a text form.

    Others (a Body, an array without `Points`) are data: their caller gives them.
    """
    hints = get_type_hints(function, include_extras=True)
    found = {}
    for name, argument in signature(function).parameters.items():
        parameter = _parameter(name, hints[name], argument.default)
        if parameter is not None:
            found[name] = parameter
    return found


def _parameter(name: str, hint: Any, default: Value) -> Parameter | None:
    hint, *extras = get_args(hint) if hasattr(hint, "__metadata__") else (hint,)
    points = next((extra for extra in extras if isinstance(extra, Points)), None)
    if points is not None:
        value = points.check(default)
        return Parameter(name, np.ndarray, value, help=points.help, points=points)
    choices = get_args(hint) if get_origin(hint) is Literal else ()
    kind = str if choices else hint
    if kind not in (bool, int, float, str):
        return None
    interval = next((extra for extra in extras if isinstance(extra, Range)), None)
    text = next((extra for extra in extras if isinstance(extra, str)), "")
    picture = any(isinstance(extra, PictureFile) for extra in extras)
    form = next((extra for extra in extras if isinstance(extra, Form)), None)
    presets = next((extra.names for extra in extras if isinstance(extra, Presets)), ())
    mesh = any(isinstance(extra, MeshFile) for extra in extras)
    return Parameter(
        name, kind, default, choices, interval, text, picture, form=form, presets=presets, mesh=mesh
    )


def find(parameters: Mapping[str, Parameter], name: str, option: str = "--set") -> Parameter:
    """The parameter of that name. Raises UsageError that suggests the nearest one."""
    if name in parameters:
        return parameters[name]
    from difflib import get_close_matches

    near = get_close_matches(name, parameters, 1)
    meant = f"; did you mean {near[0]}?" if near else ""
    raise UsageError(f"{option}: expected one of {', '.join(parameters)}, found {name!r}{meant}")
